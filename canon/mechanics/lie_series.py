"""Infinitesimal transformations and the Lie series that sum them up: exp(s {., G}) f."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.expression import Formula
from canon.mechanics import statements
from canon.mechanics.extent import check_extent
from canon.mechanics.formulas import Expression, as_expression, as_formula, replaced
from canon.mechanics.linear_recurrence import constant_recurrence, periodic_sum, recurrent_sum
from canon.mechanics.one_form import tidy
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import bracket_in, check_functions
from canon.mechanics.transformation import Transformation

HIGHEST = 1000
"""The highest order of a series: each is a bracket, and most grow from one to the next."""

_LONGEST = 200  # operations in a bracket, after which no pattern is looked for


def iterated_brackets(f: Expression, generator: Expression, space: PhaseSpace, count: int) -> tuple[sp.Expr, ...]:
    """f, {f, G}, {{f, G}, G}, ...: `count` brackets, so count + 1 functions."""
    G, terms = as_expression(generator), [as_expression(f)]
    check_functions([G, *terms], space)
    for k in range(count):
        terms.append(tidy(bracket_in(terms[-1], G, space.q, space.p)) if terms[-1] else sp.S.Zero)
        check_extent(terms[-1], where=f"order {k + 1} of the series")
    return tuple(terms)


def _check(parameter: Any, space: PhaseSpace) -> None:
    """**Raises** `InputError` where there is no space, or the parameter is no symbol besides its variables."""
    check_space(space)
    instance_of(parameter, sp.Symbol, "parameter")
    if parameter in (*space.old, *space.new, space.t):
        said = f"{parameter} is a variable of the phase space: the parameter is another symbol, as a real one"
        raise InputError(said, "parameter")


def truncated_lie_series(
    f: Expression, generator: Expression, parameter: sp.Symbol, space: PhaseSpace, order: int
) -> sp.Expr:
    """The series up to the power `order` of the parameter. Deprit (1969)."""
    _check(parameter, space)
    order = whole_number(order, "order", 0, HIGHEST)
    terms = iterated_brackets(f, generator, space, order)
    return sp.Add(*(parameter**k / sp.factorial(k) * term for k, term in enumerate(terms)))


def closed_lie_series(
    f: Expression, generator: Expression, parameter: sp.Symbol, space: PhaseSpace, depth: int = 5
) -> sp.Expr | None:
    """The sum of the series where it is found; `None` where not.

    It is, within `depth` brackets, where these end at zero; where one is a constant of the flow times an earlier one
    (exponential and harmonic cases); where {f, G} = r f with {r, G} = l r^2, l a number (a power of 1 - l s r: Möbius
    maps); where they obey a linear recurrence with constant coefficients; and for a function
    of variables that are such themselves, since exp(s {., G}) commutes with products.
    """
    _check(parameter, space)
    depth = whole_number(depth, "depth", 1, HIGHEST)
    value, G = as_expression(f), as_expression(generator)
    check_functions([value, G], space)
    if value.is_Symbol:
        return _summed(value, G, parameter, space, depth, recurrences=True)
    moving = [x for x in space.old if x in value.free_symbols]
    if value.is_rational_function(*moving):
        found = _summed(value, G, parameter, space, depth, recurrences=False)
        if found is not None:
            return found
    images = {x: _summed(x, G, parameter, space, depth, recurrences=True) for x in moving}
    if any(image is None for image in images.values()):
        return _summed(value, G, parameter, space, depth, recurrences=True)
    return tidy(replaced(value, {x: image for x, image in images.items() if image is not None}))


def _summed(
    f: sp.Expr, G: sp.Expr, s: sp.Symbol, space: PhaseSpace, depth: int, *, recurrences: bool
) -> sp.Expr | None:
    """The sum as far as the brackets of f itself show it."""
    terms: list[sp.Expr] = [f]
    for _ in range(depth):
        following = tidy(bracket_in(terms[-1], G, space.q, space.p))
        if following == 0:
            return sp.Add(*(s**k / sp.factorial(k) * term for k, term in enumerate(terms)))
        for start in range(max(0, len(terms) - 2), len(terms)):
            ratio = tidy(following / terms[start])
            if tidy(bracket_in(ratio, G, space.q, space.p)) == 0:
                return periodic_sum(terms, start, ratio, s)
        terms.append(following)
        if sp.count_ops(following) > _LONGEST:
            break
    logarithmic = tidy(terms[1] / f)
    growth = tidy(bracket_in(logarithmic, G, space.q, space.p) / logarithmic**2)
    if growth.is_Rational:
        return f * (1 - growth * s * logarithmic) ** (-1 / growth)
    if recurrences:
        for length in range(2, len(terms)):
            coefficients = constant_recurrence(terms[: length + 1], space.old)
            if coefficients is not None:
                return recurrent_sum(terms[:length], coefficients, s)
    return None


@dataclass(frozen=True, init=False)
class InfinitesimalTransformation:
    """The infinitesimal canonical transformation that G generates: delta omega = eps J dG/d omega.

    Goldstein, Poole and Safko (2002), eq. 9.63.
    """

    space: PhaseSpace
    generator: Formula

    def __init__(self, space: PhaseSpace, generator: Expression) -> None:
        check_space(space)
        object.__setattr__(self, "space", space)
        object.__setattr__(self, "generator", as_formula(generator, "generator"))
        check_functions([self.generator], space, "generator")

    def change(self, f: Expression) -> sp.Expr:
        """{f, G}: the change of f, without the eps."""
        value = as_expression(f)
        check_functions([value], self.space)
        return bracket_in(value, self.generator.expr, self.space.q, self.space.p)

    def changes(self) -> tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]:
        """(dq, dp) = (dG/dp, -dG/dq), without the eps."""
        G = self.generator.expr
        return tuple(G.diff(y) for y in self.space.p), tuple(-G.diff(x) for x in self.space.q)

    def moves(self, dq: Expression | Sequence[Expression], dp: Expression | Sequence[Expression]) -> Claim:
        """Claims that G changes the variables so."""
        return statements.infinitesimal(self.space, self.generator, dq, dp)

    def finite(self, parameter: sp.Symbol, order: int | None = None) -> Transformation:
        """The map at a finite parameter, new variables in old: the sum of the series, or its start up to an order.

        **Raises:** `InputError` where no closed form is found, or the space has no new variables.
        """
        space, images = self.space, []
        if len(space.Q) != space.n:
            raise InputError("name the new variables in the phase space first")
        for x in space.old:
            if order is not None:
                images.append(truncated_lie_series(x, self.generator, parameter, space, order))
                continue
            image = closed_lie_series(x, self.generator, parameter, space)
            if image is None:
                raise InputError(f"no closed form of the series of {x} was found; give an order")
            images.append(image)
        return Transformation(space, Q=tuple(images[: space.n]), P=tuple(images[space.n :]))

    def _repr_latex_(self) -> str:
        dq, dp = self.changes()
        changes = zip(self.space.old, (*dq, *dp), strict=True)
        rows = [f"\\delta {latex(x)} &= \\varepsilon \\left({latex(change)}\\right)" for x, change in changes]
        return "$\\begin{aligned} " + " \\\\ ".join(rows) + " \\end{aligned}$"
