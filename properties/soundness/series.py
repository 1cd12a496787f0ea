"""Lie series with known sums, and maps that are canonical up to an order, with mutants of both."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from fractions import Fraction

import mpmath as mp

from properties.soundness import oracle
from properties.soundness.dynamics import bracket, file, maybe
from properties.soundness.formula import DIGITS, Formula, Outside, call, of, substituted, value, variable
from properties.soundness.maps import pick, slope, smooth
from properties.soundness.truth import Case, judged

Q, P = ("q",), ("p",)
q, p, s, eps, a = (variable(name) for name in ("q", "p", "s", "eps", "a"))
HALF = Fraction(1, 2)


def _flow(rng: random.Random) -> tuple[Formula, Formula, Formula]:
    """A generator G with the images of q and p under exp(s {·, G})."""
    kind = rng.randrange(6)
    c, w = pick(rng), rng.choice((1, 2, HALF))
    if kind == 0:
        return c * p, q + c * s, p
    if kind == 1:
        return p**2 / 2, q + s * p, p
    if kind == 2:
        return c * q * p, q * call("exp", c * s), p * call("exp", -c * s)
    if kind == 3:
        C, S = call("cos", of(w) * s), call("sin", of(w) * s)
        return of(w) * (p**2 + q**2) / 2, q * C + p * S, p * C - q * S
    if kind == 4:
        V = smooth(rng, [q])
        return V, q, p - s * slope(V, "q")
    T = smooth(rng, [p])
    return T, q + s * slope(T, "p"), p


def lie_series(rng: random.Random) -> Case | None:
    """exp(s {·, G}) f in closed form, as a germ at s = 0: false if it differs at a small s and is analytic up to it."""
    G, x, y = _flow(rng)
    f = smooth(rng, [q, p])
    closed = substituted(f, {"q": x, "p": y})
    given, what = maybe(rng, closed)
    keys = f'generator = "{G}"\nparameter = "s"\nf = "{f}"\nequals = "{given}"'
    text = file(f'kind = "lie_series"\n{keys}', q=Q, p=P)
    if not what:
        return Case("lie_series", text, True)
    box = {"s": (Fraction(-1, 8), Fraction(1, 8))}

    def analytic(point: object) -> bool:
        with mp.workdps(DIGITS):
            return all(_defined(given, {**point, "s": point["s"] * k / 16}) for k in range(17))  # type: ignore

    place, seen = oracle.differs(rng, given, closed, ("q", "p", "s", "a"), box, count=6, inside=analytic)
    return Case("lie_series", text, False if place is not None else None, what) if seen else None


def _defined(f: Formula, point: dict[str, object]) -> bool:
    try:
        value(f, point)
    except (Outside, ZeroDivisionError):
        return False
    return True


def _terms(f: Formula, G: Formula, order: int) -> list[Formula]:
    """{…{f, G}…, G}/k! for k = 0 … order."""
    out = [f]
    for _ in range(order):
        out.append(bracket(out[-1], G, Q, P))
    return [term * Fraction(1, math.factorial(k)) if k > 1 else term for k, term in enumerate(out)]


def _polynomial(terms: Sequence[Formula], parameter: Formula) -> Formula:
    total = terms[0]
    for k, term in enumerate(terms[1:], 1):
        total = total + parameter**k * term
    return total


def _generator(rng: random.Random) -> Formula:
    return rng.choice((q**2 * p, q**3 + p**2, q * p**2, p**2 / 2 + q**4, call("cos", q) + p**2, a * q * p + q**3))


def truncated_series(rng: random.Random) -> Case | None:
    """The polynomial of a Lie series up to an order, a term of which may be changed."""
    order = rng.choice((1, 2, 2, 3))
    G, f = _generator(rng), rng.choice((q, p, q * p, q**2))
    right = _terms(f, G, order)
    given, what = list(right), ""
    if rng.random() < 0.5:
        k = rng.randrange(order + 1)
        given[k], what = maybe(rng, given[k], 1)
    keys = f'generator = "{G}"\nparameter = "s"\nf = "{f}"\norder = {order}\nequals = "{_polynomial(given, s)}"'
    text = file(f'kind = "lie_series"\n{keys}', q=Q, p=P)
    residuals = [x - y for x, y in zip(given, right, strict=True)] if what else [of(0)]
    found = judged(rng, "truncated_series", text, residuals, ("q", "p", "a"), changed=what)
    return None if found is None else Case(found.family, text, found.truth, found.note)


def truncated_map(rng: random.Random) -> Case | None:
    """A near-identity map by a Lie series up to an order, anything beyond it, and perhaps a changed coefficient."""
    order = rng.choice((1, 2, 2, 3))
    G = _generator(rng)
    new, what = [_terms(x, G, order) for x in (q, p)], ""
    if rng.random() < 0.5:
        side, k = rng.randrange(2), rng.randint(1, order)
        new[side][k], what = maybe(rng, new[side][k], 1)
    if rng.random() < 0.5:
        new[0].append(smooth(rng, [q, p]))
    residuals = []
    for total in range(1, order + 1):
        coefficient = of(0)
        for i in range(total + 1):
            coefficient = coefficient + bracket(new[0][i], new[1][total - i], Q, P)
        residuals.append(coefficient)
    functions = [_polynomial(terms, eps) for terms in new]
    sections = f'[transformation]\nQ = ["{functions[0]}"]\nP = ["{functions[1]}"]\n'
    text = file(f'kind = "canonical"\norder = ["eps", {order}]', q=Q, p=P, sections=sections, new=True)
    found = judged(rng, "truncated_map", text, residuals, ("q", "p", "a"), changed=what)
    return None if found is None else Case(found.family, text, found.truth, found.note)


SERIES: dict[str, Callable[[random.Random], Case | None]] = {
    "lie_series": lie_series,
    "truncated_series": truncated_series,
    "truncated_map": truncated_map,
}
"""Families by name, each a function of a random stream."""
