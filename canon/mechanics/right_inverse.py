"""Right inverses of a map that is given backward: for old variables, new ones whose image they are.

An angle stands for a point of the circle: where it occurs in sines and cosines of one multiple of it alone, what is
solved for are that sine s and cosine c, with s² + c² = 1. What is found here is a guess: whoever uses it verifies it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Final

import sympy as sp

from canon.substitution import QUOTIENTS, with_quotients

WAVES: Final = (sp.sin, sp.cos)
SECANTS: Final[dict[Any, Any]] = {sp.sec: sp.cos, sp.csc: sp.sin}
MOST: Final = 8
"""Unknowns that are solved for."""
BRANCHES: Final = 4
"""Solutions of one equation that are tried."""
Solution = dict[Any, Any]


@dataclass(frozen=True)
class Angle:
    """A variable that occurs in sines and cosines of `argument` = `rate` · variable + … alone, of which they are
    `sine` and `cosine`. As the variable runs through all numbers, these run through the circle."""

    variable: sp.Symbol
    argument: Any
    rate: Any
    sine: sp.Dummy
    cosine: sp.Dummy

    def put_in(self, expression: Any) -> Any:
        """The expression with names for the sine and the cosine."""
        return as_waves(expression).xreplace({sp.sin(self.argument): self.sine, sp.cos(self.argument): self.cosine})


def as_waves(expression: Any) -> Any:
    """The expression with its tangents and secants as quotients of sines and cosines."""
    found = with_quotients(expression) if expression.has(*QUOTIENTS) else expression
    for function, under in SECANTS.items():
        found = found.replace(function, lambda a, under=under: 1 / under(a))
    return found


def angles_of(formulas: Sequence[Any], unknown: Sequence[sp.Symbol]) -> list[Angle]:
    """Those of the unknowns that are angles."""
    waves = [as_waves(formula) for formula in formulas]
    found = []
    for variable in unknown:
        inside = {wave.args[0] for formula in waves for wave in formula.atoms(*WAVES) if wave.has(variable)}
        if len(inside) != 1:
            continue
        (argument,) = inside
        rate = argument.diff(variable)
        if rate.free_symbols & {*unknown}:
            continue
        name = variable.name
        angle = Angle(
            variable, argument, rate, sp.Dummy(f"sin({name})", real=True), sp.Dummy(f"cos({name})", real=True)
        )
        if not any(angle.put_in(formula).has(variable) for formula in formulas):
            found.append(angle)
    return found


def right_inverses(equations: Sequence[Any], unknown: Sequence[Any], angles: Sequence[Angle]) -> Iterator[Solution]:
    """Values of the unknowns, of angles their sines and cosines, at which all equations vanish."""
    circles = [(angle.sine, angle.cosine) for angle in angles]
    turning = {angle.variable for angle in angles}
    wanted = [u for u in unknown if u not in turning] + [name for circle in circles for name in circle]
    if len(wanted) > MOST:
        return
    yield from _solved([_plain(e) for e in equations], wanted, circles)


def _plain(expression: Any) -> Any:
    return sp.expand(sp.fraction(sp.together(expression))[0])


def _solved(equations: Sequence[Any], unknown: Sequence[Any], circles: Sequence[tuple[Any, Any]]) -> Iterator[Solution]:
    left = [e for e in equations if e != 0]
    if not unknown:
        yield {}
        return
    on_circles = {name for circle in circles for name in circle}
    for steps in (_singly(left, unknown, on_circles), _round(left, circles), _linearly(left, unknown)):
        tried = False
        for values, used, more in steps:
            tried = True
            rest = [_plain(e.xreplace(values)) for e in (*(e for e in left if e not in used), *more)]
            others = [u for u in unknown if u not in values]
            open_circles = [c for c in circles if c[0] not in values]
            for found in _solved(rest, others, open_circles):
                yield {**found, **{name: value.xreplace(found) for name, value in values.items()}}
        if tried:
            return


Step = tuple[Mapping[Any, Any], Sequence[Any], Sequence[Any]]
"""Values of some unknowns, perhaps in the others; the equations that gave them; and new ones."""


def _singly(equations: Sequence[Any], unknown: Sequence[Any], on_circles: set[Any]) -> Iterator[Step]:
    """By an equation with one unknown, which is none of a circle's."""
    for equation in equations:
        names = equation.free_symbols & {*unknown}
        if len(names) != 1 or names & on_circles:
            continue
        (name,) = names
        free = sp.Dummy("x")
        for root in sp.solve(equation.xreplace({name: free}), free)[:BRANCHES]:
            if not root.has(sp.I, free):
                yield {name: root}, [equation], []
        return


def _round(equations: Sequence[Any], circles: Sequence[tuple[Any, Any]]) -> Iterator[Step]:
    """A sine and a cosine by two equations that are linear in them, of those with the fewest other names."""
    for s, c in circles:
        pairs = sorted(
            combinations([e for e in equations if e.has(s) or e.has(c)], 2),
            key=lambda pair: len(pair[0].free_symbols | pair[1].free_symbols),
        )
        for pair in pairs:
            if not all(e.is_polynomial(s, c) and sp.Poly(e, s, c).total_degree() == 1 for e in pair):
                continue
            A, b = sp.linear_eq_to_matrix(pair, [s, c])
            det = _plain(A.det())
            if det == 0:
                continue
            sine, cosine = (sp.cancel(x) for x in A.adjugate() * b / A.det())
            yield {s: sine, c: cosine}, pair, [sine**2 + cosine**2 - 1]
            return


def _linearly(equations: Sequence[Any], unknown: Sequence[Any]) -> Iterator[Step]:
    """All unknowns at once where the equations are linear in them; else one by an equation that is linear in it."""
    if all(e.is_polynomial(*unknown) and sp.Poly(e, *unknown).total_degree() == 1 for e in equations):
        if len(equations) == len(unknown):
            A, b = sp.linear_eq_to_matrix(equations, unknown)
            if _plain(A.det()) != 0:
                yield dict(zip(unknown, map(sp.cancel, A.adjugate() * b / A.det()), strict=True)), equations, []
        return
    for equation in sorted(equations, key=lambda e: len(e.free_symbols & {*unknown})):
        for name in unknown:
            if equation.has(name) and equation.is_polynomial(name) and sp.Poly(equation, name).degree() == 1:
                yield {name: sp.cancel(-equation.coeff(name, 0) / equation.coeff(name, 1))}, [equation], []
                return
