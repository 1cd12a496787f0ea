"""Refutations of normal forms, beside `counterexample.py`: Birkhoff's and Gustavson's, in exact fractions.

H₂ + N₃ + … is one of H if {H₂, N} = 0, and a product of flows exp {·, χ}, with χ of degree 3 and higher, leads from
H to it. Up to an order these are a unipotent group that acts linearly on polynomials, and those of them that leave
the lower degrees as they are make the exponential of a Lie algebra. So when F, reached from H, is N below degree m,
N can be reached in degree m only by a χ with {F, χ} = 0 below m and {F, χ} = N − F in degree m: linear equations.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations_with_replacement
from math import factorial, prod
from typing import Any

if __package__:
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Arithmetic, Open, check_domain, somewhere
    from canon.checker.counterexample_formulas import Writer, inner_names
    from canon.checker.counterexample_functions import Place, just
    from canon.checker.counterexample_integrals import claim_with
else:  # as a program's part, beside the other files
    from alone import Stop  # type: ignore
    from counterexample import Arithmetic, Open, check_domain, somewhere  # type: ignore
    from counterexample_formulas import Writer, inner_names  # type: ignore
    from counterexample_functions import Place, just  # type: ignore
    from counterexample_integrals import claim_with  # type: ignore

MOST_ORDER, MOST_UNKNOWN, BITS = 8, 260, 128
Polynomial = dict[tuple[int, ...], Fraction]
"""{exponents of q…, p…: coefficient}."""


def exponents(names: int, degree: int) -> list[tuple[int, ...]]:
    """All monomials of a degree."""
    ways = combinations_with_replacement(range(names), degree)
    return [tuple(way.count(k) for k in range(names)) for way in ways]


def taylor(point: Place, text: str, names: list[str], order: int) -> Polynomial:
    """The terms of a formula about 0, up to an order; Open where one isn't an exact fraction."""
    found: Polynomial = {}
    for degree in range(order + 1):
        for powers in exponents(len(names), degree):
            by = [name for name, n in zip(names, powers, strict=True) for _ in range(n)]
            low, high = point.at(point.claim.known(text), *sorted(by))
            if low != high:
                raise Open("a coefficient that isn't rational")
            if low:
                found[powers] = low / prod(map(factorial, powers))
    return found


def bracket(f: Polynomial, g: Polynomial, order: int) -> Polynomial:
    """Poisson's, up to an order."""
    found: Polynomial = {}
    for a, x in f.items():
        for b, y in g.items():
            if sum(a) + sum(b) - 2 > order:
                continue
            n = len(a) // 2
            for k in range(n):
                if c := a[k] * b[n + k] - a[n + k] * b[k]:
                    powers = tuple(i + j - (m in (k, n + k)) for m, (i, j) in enumerate(zip(a, b, strict=True)))
                    found[powers] = found.get(powers, Fraction(0)) + c * x * y
    return {powers: x for powers, x in found.items() if x}


def flow(f: Polynomial, chi: Polynomial, order: int) -> Polynomial:
    """exp {·, χ} f up to an order."""
    found, term = {**f}, f
    for k in range(1, order):
        term = {powers: x / k for powers, x in bracket(term, chi, order).items()}
        for powers, x in term.items():
            found[powers] = found.get(powers, Fraction(0)) + x
    return {powers: x for powers, x in found.items() if x}


def solution(columns: list[Polynomial], right: Polynomial) -> list[Fraction] | None:
    """Coefficients with Σ c column = right, by elimination; None where there are none."""
    places = [*dict.fromkeys(powers for column in (*columns, right) for powers in column)]
    rows = [{k: column[place] for k, column in enumerate([*columns, right]) if place in column} for place in places]
    last, pivots = len(columns), dict[int, dict[int, Fraction]]()
    for row in rows:
        while row and (first := min(row)) != last:
            if first not in pivots:
                pivots[first] = {k: x / row[first] for k, x in row.items()}
                row = {}
                break
            ratio = row[first]
            for k, x in pivots[first].items():
                row[k] = row.get(k, Fraction(0)) - ratio * x
                if not row[k]:
                    del row[k]
        if row:
            return None
    found = [Fraction(0)] * last
    for first in sorted(pivots, reverse=True):
        row = pivots[first]
        found[first] = row.get(last, Fraction(0)) - sum(x * found[k] for k, x in row.items() if first < k < last)
    return found


def reached(h: Polynomial, n: Polynomial, order: int) -> Polynomial | None:
    """What near-identity canonical maps make of H that bring it to N, degree by degree; None where none does."""
    size = len(next(iter(h)))
    for m in range(3, order + 1):
        unknown = [powers for degree in range(3, m + 1) for powers in exponents(size, degree)]
        if len(unknown) > MOST_UNKNOWN:
            raise Stop("not shown", "so many coefficients")
        columns = [bracket(h, {powers: Fraction(1)}, m) for powers in unknown]
        terms = {*h, *n}
        right = {p: n.get(p, Fraction(0)) - h.get(p, Fraction(0)) for p in terms if sum(p) == m}
        found = solution(columns, {p: x for p, x in right.items() if x})
        if found is None:
            return None
        h = flow(h, {p: x for p, x in zip(unknown, found, strict=True) if x}, order)
    return h


RULES = {"normal_form"}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether N isn't a normal form of H, at the witness's parameters."""
    del known
    claim = tables["claim"]
    if claim["kind"] not in RULES or {"transformation", "generating_function"} & {*tables}:
        raise Stop("not shown", "a refutation of such a claim, or beside such a map")
    order = claim["order"]
    if not isinstance(order, int) or not 3 <= order <= MOST_ORDER or {*claim} - {"kind", "order", "N"}:
        raise Stop("not shown", "such an order")
    texts = {f"_n{degree}": text for degree, text in claim["N"].items()}
    asked = claim_with(tables, [], texts)
    names, time = asked.names[:-1], asked.names[-1]
    if any({*asked.words.get(name, ())} - {"real"} for name in names):
        raise Stop("not shown", "variables that have signs")
    write = Writer(asked)
    if any(time in inner_names(write.written(asked.known(text)), asked) for text in ("_H", *texts)):
        raise Stop("not shown", "a Hamiltonian that depends on time")
    of = somewhere(asked, witness if isinstance(witness, dict) else {}, 0)
    point = Place(asked, of | {name: just(Fraction(0)) for name in names}, Arithmetic(BITS))
    try:
        check_domain(point, {"hamiltonian": tables["hamiltonian"]})
        h = taylor(point, "_H", names, order)
        n: Polynomial = {powers: x for powers, x in h.items() if sum(powers) == 2}
        quadratic = {**n}
        if any(sum(powers) == 1 for powers in h) or not quadratic:
            raise Stop("not shown", "what is no equilibrium")
        for degree, text in ((int(key[2:]), key) for key in texts):
            terms = taylor(point, text, names, order)
            if degree > order or degree < 2 or any(sum(powers) != degree for powers in terms):
                raise Stop("not shown", "terms of another degree")
            if degree == 2 and terms != quadratic:
                return "shown", ""
            n |= terms
        h = {powers: x for powers, x in h.items() if sum(powers) > 1}
        if bracket(quadratic, n, order) or reached(h, n, order) is None:
            return "shown", ""
    except Open as left:
        return "not shown", str(left)
    return "not shown", "that it is none"
