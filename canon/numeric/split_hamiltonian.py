"""Finds how a Hamiltonian splits into parts that can be solved exactly.

A term that has, of every degree of freedom, q or p but not both is solved by a shear; terms that agree on which make
one part. Beside these: kinetic energy with a quadratic potential and a rotation, and Kepler's motion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.gradient import monomial
from canon.numeric.integrators.parts import commutes, kepler_part, quadratic_part
from canon.numeric.integrators.problem import ExactPart, Part, Splitting, clock_part
from canon.numeric.shears import Formula, Parameters, shear, sides_of


@dataclass(frozen=True)
class SplitHamiltonian:
    """H as a sum of solvable `terms`, outermost first, with their `names`; `kind` says by which rule.

    `nystrom`: H = A + V(q, t) with A at most quadratic in the momenta. `time_dependent`: t occurs in a term.
    """

    kind: str
    terms: tuple[sp.Expr, ...]
    names: tuple[str, ...]
    nystrom: bool
    time_dependent: bool
    build: Callable[[Parameters], Splitting]

    def splitting(self, parameters: Parameters | None = None) -> Splitting:
        """The problem for an integrator, with values for the parameters; slots (q, p), as arrays or tuples."""
        return self.build(parameters or {})


def split_hamiltonian(
    H: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], t: sp.Symbol | None = None
) -> tuple[SplitHamiltonian, ...]:
    """All the splittings that the rules find, two shears first and more than two last; none where none applies."""
    expanded: Formula = sp.expand(H)
    shears = _shears(H, q, p, t) or _shears(expanded, q, p, t)
    special = [_kepler(expanded, q, p, t), _quadratic(expanded, q, p, t)]
    few = shears is not None and len(shears.terms) <= 2
    order = [shears, *special] if few else [*special, shears]
    return tuple(found for found in order if found is not None)


def _shears(H: Formula, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], t: sp.Symbol | None) -> SplitHamiltonian | None:
    groups: list[tuple[list[int], list[sp.Expr]]] = [([-1] * len(q), []), ([1] * len(q), [])]
    mixed = []
    for term in sp.Add.make_args(H):
        sides = sides_of(term, q, p)
        if sides is None:
            return None
        if all(side <= 0 for side in sides):
            groups[0][1].append(term)
        elif all(side >= 0 for side in sides):
            groups[1][1].append(term)
        else:
            mixed.append((term, sides))
    for k in (0, 1):
        used = [sides_of(term, q, p) or () for term in groups[k][1]]
        groups[k] = ([next((s[i] for s in used if s[i]), 0) for i in range(len(q))], groups[k][1])
    for term, sides in mixed:
        for place, terms in reversed(groups):
            if all(a * b >= 0 for a, b in zip(place, sides, strict=True)):
                place[:] = [a or b for a, b in zip(place, sides, strict=True)]
                terms.append(term)
                break
        else:
            groups.append(([*sides], [term]))
    parts = [sp.Add(*terms) for _, terms in (groups[0], *groups[2:], groups[1]) if terms]
    nystrom = len(parts) == 2 and not mixed and quadratic_in(parts[0], p, t)
    names = [_name(part, q, p) for part in parts]
    timed = [t is not None and t in part.free_symbols for part in parts]

    def build(parameters: Parameters) -> Splitting:
        made: list[Part] = [shear(part, q, p, t, parameters, name) for part, name in zip(parts, names, strict=True)]
        return with_clock(made, timed, nystrom)

    kind = "T(p) + V(q)" if not mixed and len(parts) == 2 else f"{len(parts)} shears"
    return SplitHamiltonian(kind, tuple(parts), tuple(names), nystrom, any(timed), build)


def with_clock(parts: Sequence[Part], timed: Sequence[bool], nystrom: bool) -> Splitting:
    """A splitting whose clock is a part that does not depend on time, or one of its own."""
    if not any(timed):
        return Splitting(tuple(parts), None, nystrom)
    if not all(timed):
        return Splitting(tuple(parts), timed.index(False), nystrom and not timed[0])
    return Splitting((clock_part(), *parts), 0, False)


def _name(H: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> str:
    free = H.free_symbols
    coordinates, momenta = bool(free & {*q}), bool(free & {*p})
    return "T" if momenta and not coordinates else "V" if coordinates and not momenta else "T and V"


def quadratic_in(H: Formula, p: Sequence[sp.Symbol], t: sp.Symbol | None) -> bool:
    """Whether H is a polynomial of degree 2 at most in the momenta, without time: looked at term by term."""
    return (t is None or t not in H.free_symbols) and all(_degree_2(x, {*p}) for x in sp.Add.make_args(H))


def _degree_2(term: Formula, p: set[Any]) -> bool:
    degree = _degree(term, p)
    return degree is not None and degree <= 2


def _degree(term: Formula, symbols: set[Any]) -> int | None:
    """The degree of a term in these symbols; None where it is no polynomial."""
    found = monomial(term)
    if found is not None:
        degrees = [exponent for symbol, exponent in found[1].items() if symbol in symbols]
        return int(sum(degrees)) if all(e > 0 for e in degrees) else None
    own = term.free_symbols & symbols
    if not own:
        return 0
    return int(sp.Poly(term, *own).total_degree()) if term.is_polynomial(*own) else None


def _kinetic_masses(H: Formula, p: Sequence[sp.Symbol]) -> list[Formula] | None:
    """1/m_i of Σ p_i²/2m_i, all of H's terms that are quadratic in p; None where there are others."""
    terms = sp.Add.make_args(H)
    degrees = [_degree(term, {*p}) for term in terms]
    if any(degree is None or degree > 2 for degree in degrees):
        return None
    # term by term: a potential may have thousands, which a polynomial in p would have for a coefficient
    upper = _sum(term for term, degree in zip(terms, degrees, strict=True) if degree == 2)
    squares = [2 * upper.coeff(y, 2) for y in p]
    mixed = sp.expand(upper - _sum(m * y**2 / 2 for m, y in zip(squares, p, strict=True)))
    return None if mixed != 0 or any(m == 0 for m in squares) else squares


def _kepler(H: Formula, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], t: sp.Symbol | None) -> SplitHamiltonian | None:
    """p²/2m − a/r and a perturbation V(q, t)."""
    masses: list[Formula] | None = _kinetic_masses(H, p)
    free = {*q, *p, *(() if t is None else (t,))}
    if masses is None or len({*masses}) != 1 or masses[0].free_symbols & free:
        return None
    squared = _sum(x**2 for x in q)
    attraction = [
        term
        for term in sp.Add.make_args(H)
        if term.free_symbols & {*q} and not (term * sp.sqrt(squared)).free_symbols & free
    ]
    if len(attraction) != 1:
        return None
    kinetic = _sum(y**2 for y in p) * masses[0] / 2
    rest = _sum([sp.expand(H - kinetic), -attraction[0]])
    none_left = rest == 0
    if rest.free_symbols & {*p}:
        return None
    strength = -attraction[0] * sp.sqrt(squared)
    terms: tuple[Formula, ...] = (kinetic + attraction[0],) if none_left else (kinetic + attraction[0], rest)
    timed = [False, t is not None and t in rest.free_symbols][: len(terms)]

    def build(parameters: Parameters) -> Splitting:
        made: list[Part] = [kepler_part(1 / _number(masses[0], parameters), _number(strength, parameters))]
        if not none_left:
            made.append(shear(rest, q, p, t, parameters, "perturbation"))
        return with_clock(made, timed, not none_left)

    names = ("Kepler", "perturbation")[: len(terms)]
    return SplitHamiltonian("Kepler and perturbation", terms, names, not none_left, any(timed), build)


def _quadratic(
    H: Formula, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], t: sp.Symbol | None
) -> SplitHamiltonian | None:
    """Σ p²/2m + ½ qᵀKq + qᵀWp, and the rest V(q, t)."""
    masses = _kinetic_masses(H, p)
    free = {*q, *p, *(() if t is None else (t,))}
    if masses is None or any(m.free_symbols & free for m in masses):
        return None
    W = [[H.coeff(y, 1).coeff(x, 1) for y in p] for x in q]
    origin = dict.fromkeys(q, 0)
    still = [term for term in sp.Add.make_args(H) if not term.free_symbols & {*p}]
    well = _sum(term for term in still if _degree(term, {*q}) == 2)
    K = [[well.diff(x, y).xreplace(origin) for y in q] for x in q]
    if any(entry.free_symbols & free for row in (*W, *K) for entry in row):
        return None
    kinetic = _sum(m * y**2 for m, y in zip(masses, p, strict=True)) / 2
    turning = _sum(x * W[i][j] * y for i, x in enumerate(q) for j, y in enumerate(p))
    rest = sp.expand(H - kinetic - turning)
    if rest.free_symbols & {*p} or (well == 0 and turning == 0):
        return None
    with_well = sp.expand(rest - well)
    solved = kinetic + turning + well
    timed = [False, t is not None and t in rest.free_symbols]

    def build(parameters: Parameters) -> Splitting:
        inverse = [_number(m, parameters) for m in masses]
        stiffness = np.array([[_number(entry, parameters) for entry in row] for row in K])
        rotation = np.array([[_number(entry, parameters) for entry in row] for row in W])
        left = with_well
        if not commutes(np.diag(inverse), stiffness, rotation):
            stiffness, left = np.zeros_like(stiffness), rest
        first: ExactPart = quadratic_part(inverse, stiffness, rotation, "quadratic")
        made: list[Part] = [first]
        if left != 0:
            made.append(shear(left, q, p, t, parameters, "rest"))
        return with_clock(made, timed[: len(made)], left != 0)

    terms = (solved, with_well) if with_well != 0 else (solved,)
    return SplitHamiltonian(
        "quadratic and rest", terms, ("quadratic", "rest")[: len(terms)], with_well != 0, any(timed), build
    )


def _sum(terms: Iterable[Formula]) -> Formula:
    total: Formula = sp.Add(*terms)
    return total


def _number(value: Formula, parameters: Parameters) -> float:
    found = value.xreplace({symbol: sp.Float(float(number), 30) for symbol, number in parameters.items()})
    if found.free_symbols:
        raise InputError(f"no value is given for {', '.join(sorted(map(str, found.free_symbols)))}")
    return float(found)
