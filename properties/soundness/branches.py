"""Equations between branches of roots, logarithms, angles and absolute values, whose truth follows from signs.

Two polynomials P and Q are made of their real roots, so that their signs on an interval are known exactly, by comparing
fractions. Each template says where it is defined, and where it holds, by the signs of P and Q alone; an interval may
reach across a root by as little as 10⁻¹². Nothing is sampled and no oracle is asked.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from properties.soundness.formula import Formula, call, of, variable
from properties.soundness.identities import (
    Equation,
    V,
    absolute,
    acos,
    asin,
    atan,
    atan2,
    exp,
    log,
    pi,
    sign,
    sqrt,
)
from properties.soundness.rooted import TINY, polynomial

Interval = tuple[Fraction | None, Fraction | None]
Signs = tuple[int, int]
FAR = Fraction(10**6)


@dataclass(frozen=True)
class Template:
    """lhs = rhs of P and Q, its domain and where it holds there, both by the signs of P and Q."""

    sides: Callable[[Formula, Formula], tuple[Formula, Formula]]
    holds: Callable[[int, int], bool]
    defined: Callable[[int, int], bool] = lambda s, t: True


def always(s: int, t: int) -> bool:
    """Wherever it is defined."""
    return True


def first(s: int, t: int) -> bool:
    """P is positive."""
    return s > 0


def second(s: int, t: int) -> bool:
    """Q is positive."""
    return t > 0


def both(s: int, t: int) -> bool:
    """Both are."""
    return s > 0 and t > 0


def alike(s: int, t: int) -> bool:
    """They have the same sign."""
    return s * t > 0


def radius(P: Formula, Q: Formula) -> Formula:
    """√(P² + Q²)."""
    return sqrt(P**2 + Q**2)


TEMPLATES: dict[str, Template] = {
    "root of a square": Template(lambda P, Q: (sqrt(P**2), P), first),
    "root of a square, minus": Template(lambda P, Q: (sqrt(P**2), -P), lambda s, t: s < 0),
    "root of a square, absolutely": Template(lambda P, Q: (sqrt(P**2), absolute(P)), always),
    "fourth root": Template(lambda P, Q: ((P**4) ** Fraction(1, 4), P), first),
    "fourth root of a square": Template(lambda P, Q: ((P**2) ** Fraction(1, 4), sqrt(absolute(P))), always),
    "sixth root": Template(lambda P, Q: ((P**2) ** Fraction(1, 6), call("cbrt", absolute(P))), always),
    "cube root": Template(lambda P, Q: (call("cbrt", P**3), P), always, first),
    "absolute value": Template(lambda P, Q: (absolute(P), P), first),
    "absolute cube": Template(lambda P, Q: (absolute(P) ** 3, P**3), first),
    "sign": Template(lambda P, Q: (sign(P), of(1)), first),
    "sign times": Template(lambda P, Q: (sign(P) * P, absolute(P)), always),
    "sign of a product": Template(lambda P, Q: (sign(P) * sign(Q), sign(P * Q)), always),
    "signs alike": Template(lambda P, Q: (sign(P), sign(Q)), alike),
    "absolute product": Template(lambda P, Q: (absolute(P) * absolute(Q), P * Q), alike),
    "absolute product, absolutely": Template(lambda P, Q: (absolute(P) * absolute(Q), absolute(P * Q)), always),
    "absolute quotient": Template(lambda P, Q: (absolute(P / Q), P / absolute(Q)), first),
    "divided by its absolute value": Template(lambda P, Q: (absolute(P) / P, of(1)), first),
    "removable, absolutely": Template(lambda P, Q: (P**2 / absolute(P), absolute(P)), always),
    "vanishing parts": Template(
        lambda P, Q: ((P + absolute(P)) * (Q - absolute(Q)), of(0)), lambda s, t: s < 0 or t > 0),
    "vanishing sum": Template(lambda P, Q: (absolute(P) - P + absolute(Q) - Q, of(0)), both),
    "sum of absolute values": Template(lambda P, Q: (absolute(P) + absolute(Q), P + Q), both),
    "sum of roots of squares": Template(lambda P, Q: (sqrt(P**2) + sqrt(Q**2), P - Q), lambda s, t: s > 0 > t),
    "squared sum": Template(
        lambda P, Q: (absolute(P) + absolute(Q), sqrt(P**2 + Q**2 + 2 * absolute(P * Q))), always),
    "root of a product": Template(lambda P, Q: (sqrt(P * Q), sqrt(P) * sqrt(Q)), always, both),
    "root of a product, minus": Template(
        lambda P, Q: (sqrt(P * Q), sqrt(-P) * sqrt(-Q)), always, lambda s, t: s < 0 and t < 0),
    "root of a product, absolutely": Template(
        lambda P, Q: (sqrt(P * Q), sqrt(absolute(P)) * sqrt(absolute(Q))), always, alike),
    "root of a quotient": Template(lambda P, Q: (sqrt(P / Q), sqrt(P * Q) / Q), second, alike),
    "root of a quotient, absolutely": Template(lambda P, Q: (sqrt(P / Q), sqrt(P * Q) / absolute(Q)), always, alike),
    "root of a quotient, two roots": Template(lambda P, Q: (sqrt(P / Q), sqrt(P) / sqrt(Q)), always, both),
    "square under a root": Template(lambda P, Q: (sqrt(P**2 * Q), P * sqrt(Q)), first, second),
    "square under a root, minus": Template(lambda P, Q: (sqrt(P**2 * Q), -P * sqrt(Q)), lambda s, t: s < 0, second),
    "root over a square": Template(lambda P, Q: (sqrt(Q / P**2), sqrt(Q) / P), first, second),
    "nested root": Template(lambda P, Q: (sqrt(P**2 + Q**2 + 2 * P * Q + 0), absolute(P + Q)), always),
    "log of a square": Template(lambda P, Q: (log(P**2), 2 * log(P)), always, first),
    "log of a square, absolutely": Template(lambda P, Q: (log(P**2), 2 * log(absolute(P))), always),
    "log of a product": Template(lambda P, Q: (log(P * Q), log(P) + log(Q)), always, both),
    "log of a product, minus": Template(
        lambda P, Q: (log(P * Q), log(-P) + log(-Q)), always, lambda s, t: s < 0 and t < 0),
    "log of a product, absolutely": Template(
        lambda P, Q: (log(P * Q), log(absolute(P)) + log(absolute(Q))), always, alike),
    "log of a quotient": Template(lambda P, Q: (log(P / Q), log(P) - log(Q)), always, both),
    "log of a quotient, absolutely": Template(
        lambda P, Q: (log(P / Q), log(absolute(P)) - log(absolute(Q))), always, alike),
    "exponential of a log": Template(lambda P, Q: (exp(2 * log(absolute(P))), P**2), always),
    "exponential of half a log": Template(lambda P, Q: (exp(log(P**2) / 2), P), first),
    "log of a root": Template(lambda P, Q: (log(sqrt(P**2)), log(P)), always, first),
    "atan of the inverse": Template(lambda P, Q: (atan(P) + atan(1 / P), pi / 2), first),
    "atan of the inverse, minus": Template(lambda P, Q: (atan(P) + atan(1 / P), -pi / 2), lambda s, t: s < 0),
    "atan of the inverse, sign": Template(lambda P, Q: (atan(P) + atan(1 / P), sign(P) * pi / 2), always),
    "atan of a quotient": Template(lambda P, Q: (atan(P / Q) + atan(Q / P), pi / 2), alike),
    "atan2 as atan": Template(lambda P, Q: (atan2(P, Q), atan(P / Q)), second),
    "atan2 as atan, turned": Template(lambda P, Q: (atan2(P, Q), atan(P / Q) + pi), lambda s, t: s > 0 > t),
    "atan2 as atan, turned back": Template(lambda P, Q: (atan2(P, Q), atan(P / Q) - pi), lambda s, t: s < 0 and t < 0),
    "atan2 as atan, signs": Template(
        lambda P, Q: (atan2(P, Q), atan(P / Q) + sign(P) * (1 - sign(Q)) / 2 * pi), always),
    "atan2 exchanged": Template(
        lambda P, Q: (atan2(P, Q) + atan2(Q, P), pi / 2), lambda s, t: not (s < 0 and t < 0)),
    "atan2 turned": Template(lambda P, Q: (atan2(P, Q) - atan2(-P, -Q), pi), first),
    "atan2 turned, sign": Template(lambda P, Q: (atan2(P, Q) - atan2(-P, -Q), sign(P) * pi), always),
    "atan2 by acos": Template(lambda P, Q: (atan2(P, Q), acos(Q / radius(P, Q))), first),
    "atan2 by asin": Template(lambda P, Q: (atan2(P, Q), asin(P / radius(P, Q))), second),
    "atan2 by half the angle": Template(lambda P, Q: (atan2(P, Q), 2 * atan(P / (radius(P, Q) + Q))), always),
    "acosh": Template(lambda P, Q: (call("acosh", 1 + 2 * P**2), 2 * call("asinh", P)), first),
    "arbitrary function of a root": Template(lambda P, Q: (V(sqrt(P**2)), V(P)), first),
    "arbitrary function of a modulus": Template(lambda P, Q: (V(sqrt(P**2)), V(absolute(P))), always),
    "removable": Template(lambda P, Q: ((P**2 - Q**2) / (P - Q), P + Q), always),
    "removable cube": Template(lambda P, Q: ((P**3 - Q**3) / (P - Q), P**2 + P * Q + Q**2), always),
    "removable sine": Template(lambda P, Q: (call("sin", P) ** 2 / (1 - call("cos", P)), 1 + call("cos", P)), always),
    "removable exponential": Template(lambda P, Q: ((exp(2 * P) - 1) / (exp(P) - 1), exp(P) + 1), always),
    "removable quotient": Template(lambda P, Q: (P * Q / Q, P), always),
    "removable roots": Template(lambda P, Q: ((P - Q) / (sqrt(P) - sqrt(Q)), sqrt(P) + sqrt(Q)), always, both),
    "conjugate": Template(lambda P, Q: (1 / (sqrt(1 + P**2) - P), sqrt(1 + P**2) + P), always),
    "conjugate of a root": Template(lambda P, Q: (1 / (sqrt(1 + P**2) - sqrt(P**2)), sqrt(1 + P**2) + P), first),
}  # fmt: skip


@dataclass(frozen=True)
class Inner:
    """u as a strictly monotone function of names, and the interval of its values."""

    formula: Formula
    values: Interval = (None, None)


def inners(x: Formula, y: Formula) -> tuple[Inner, ...]:
    """What may stand for u."""
    unit = (Fraction(-1), Fraction(1))
    return (
        *(Inner(x),) * 6, Inner(2 * x + 1), Inner(1 - x), Inner(x**3), Inner(x + y), Inner(x * y), Inner(x - y**2),
        Inner(exp(x), (Fraction(0), None)), Inner(sqrt(x), (Fraction(0), None)), Inner(log(x)),
        Inner(call("sin", x), unit), Inner(call("tanh", x), unit), Inner(call("sinh", x)), Inner(x / y),
        Inner(x**2 + y**2, (Fraction(0), None)), Inner(exp(x) * y),
    )  # fmt: skip


def inside(rng: random.Random, values: Interval, anchors: Sequence[Fraction]) -> Interval | None:
    """A random interval of values, often with an end close to one of the anchors; None where it is empty."""
    ends: list[Fraction | None] = []
    for _ in range(2):
        end = None if rng.random() < 0.25 else rng.choice(anchors)
        if end is not None and rng.random() < 0.5:
            end += rng.choice((1, -1)) * rng.choice(TINY)
        ends.append(end)
    low, high = ends
    if low is not None and high is not None and low > high:
        low, high = high, low
    if values[0] is not None and (low is None or low < values[0]):
        low = values[0]
    if values[1] is not None and (high is None or high > values[1]):
        high = values[1]
    return None if low is not None and high is not None and low >= high else (low, high)


def middles(interval: Interval, cuts: Sequence[Fraction]) -> Iterator[Fraction]:
    """A point of each part into which an open interval is cut."""
    low, high = interval
    left = low if low is not None else -FAR
    right = high if high is not None else FAR
    edges = [left, *sorted(c for c in {*cuts} if left < c < right), right]
    for a, b in pairwise(edges):
        yield (a + b) / 2


def conditions(u: Formula, interval: Interval) -> tuple[Formula, ...]:
    """Expressions that are positive where u is in the interval."""
    low, high = interval
    return (*(() if low is None else (u - low,)), *(() if high is None else (high - u,)))


def branch(rng: random.Random) -> tuple[Equation, bool] | None:
    """A random equation with its truth; None where it is defined nowhere."""
    x, y, z = variable("x"), variable("y"), variable("z")
    name, template = rng.choice(list(TEMPLATES.items()))
    anchors = rng.sample([Fraction(n, d) for n in range(-3, 4) for d in (1, 2, 3)], 3)
    one = rng.choice(inners(x, y))
    apart = rng.random() < 0.3 and "removable" not in name
    other = rng.choice((Inner(z), Inner(z), Inner(z**3), Inner(exp(z), (Fraction(0), None)))) if apart else one
    P, Q = polynomial(rng, anchors), polynomial(rng, anchors)
    if P.roots == Q.roots or {root for root, _ in P.roots} == {root for root, _ in Q.roots}:
        return None
    box = inside(rng, one.values, anchors)
    second_box = inside(rng, other.values, anchors) if apart else None
    if box is None or (apart and second_box is None):
        return None
    signs: set[Signs]
    if second_box is not None:
        on_one = {P.sign(u) for u in middles(box, P.changes())}
        signs = {(s, Q.sign(v)) for s in on_one for v in middles(second_box, Q.changes())}
    else:
        signs = {(P.sign(u), Q.sign(u)) for u in middles(box, (*P.changes(), *Q.changes()))}
    defined = {s for s in signs if template.defined(*s)}
    if not defined:
        return None
    truth = all(template.holds(*s) for s in defined)
    lhs, rhs = template.sides(P.written(rng, one.formula), Q.written(rng, other.formula))
    if truth and rng.random() < 0.35:
        truth = False
        gap = rng.choice(TINY[2:]) * rng.choice((of(1), 1 + x**2, exp(x), call("cos", x)))
        if "arbitrary" in name:
            rhs = (1 + gap) * rhs
        else:
            rhs = rhs + gap
    positive = conditions(one.formula, _asked(box, one.values))
    if second_box is not None:
        positive += conditions(other.formula, _asked(second_box, other.values))
    words = {"x": "real", "y": "real", "z": "real"}
    return Equation(lhs, rhs, words, {}, positive, name), truth


def _asked(box: Interval, values: Interval) -> Interval:
    """The ends of an interval that have to be asked for."""
    low, high = box
    return (None if low == values[0] else low), (None if high == values[1] else high)
