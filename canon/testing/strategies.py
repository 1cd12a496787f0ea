"""Strategies of phase spaces, functions on them, and generating functions.

They are functions that return strategies; every argument that has a default is given by its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from hypothesis import strategies as st

from canon.expected import whole_number, yes_or_no
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace


def rationals(*, largest: int = 5, nonzero: bool = True) -> st.SearchStrategy[sp.Rational]:
    """Simple rational numbers up to `largest` in size; they shrink to small whole ones."""
    largest = whole_number(largest, "largest", 1)
    yes_or_no(nonzero, "nonzero")
    numerators = st.integers(-largest, largest)
    if nonzero:
        numerators = numerators.filter(bool)
    return st.builds(rational, numerators, st.integers(1, 3))


def rational(numerator: Any, denominator: int = 1) -> sp.Rational:
    """The fraction, as sympy's."""
    value: Any = sp.Rational(numerator, denominator)
    return value


@st.composite
def phase_spaces(
    draw: st.DrawFn, *, min_degrees: int = 1, max_degrees: int = 3, new: bool = True, parameters: Sequence[str] = ("a",)
) -> PhaseSpace:
    """Phase spaces q1 …, p1 … with new variables Q1 …, P1 … (unless `new` is False) and real parameters."""
    n = draw(st.integers(min_degrees, max_degrees))
    q, p, Q, P = ([f"{word}{k + 1}" for k in range(n)] for word in "qpQP")
    return PhaseSpace(q, p, new=(Q, P) if new else None, real=list(parameters))


@st.composite
def polynomials(
    draw: st.DrawFn, variables: Sequence[sp.Symbol], *, min_degree: int = 0, max_degree: int = 3, max_terms: int = 3
) -> sp.Expr:
    """Polynomials with simple rational coefficients in some of the variables."""
    total: sp.Expr = sp.S.Zero
    for _ in range(draw(st.integers(1, max_terms))):
        degree = draw(st.integers(min_degree, max_degree))
        factors = draw(st.lists(st.sampled_from(list(variables)), min_size=degree, max_size=degree))
        total += draw(rationals()) * sp.Mul(*factors)
    return total


@st.composite
def functions(draw: st.DrawFn, variables: Sequence[sp.Symbol], *, transcendental: bool = True) -> sp.Expr:
    """Functions that are smooth for all real values of the variables: polynomials, also inside sin, exp, √(1+x²) …"""
    inner = draw(polynomials(variables, max_degree=2, max_terms=2))
    if not transcendental:
        return inner
    outer = draw(
        st.sampled_from(
            (
                lambda u: u,
                lambda u: u**2,
                sp.sin,
                sp.cos,
                lambda u: sp.exp(u / 2),
                sp.atan,
                lambda u: sp.sqrt(1 + u**2),
                lambda u: sp.log(1 + u**2),
                lambda u: 1 / (1 + u**2),
            )
        )
    )
    return draw(rationals()) * outer(inner) + draw(polynomials(variables, max_degree=2, max_terms=1))


@st.composite
def generating_functions(
    draw: st.DrawFn,
    space: PhaseSpace,
    *,
    types: Sequence[int] = (1, 2, 3, 4),
    mixed: bool = True,
    solvable: bool = True,
    smallest: sp.Rational | None = None,
) -> GeneratingFunction:
    """Generating functions whose mixed Hessian is regular everywhere.

    With old arguments a and new ones b it is Σ c_k a_k b_k + V(a) + W(b) with c_k ≠ 0, of one of the `types` or
    (`mixed`) of another one in each degree of freedom. `solvable` keeps W quadratic, so that the equations can be
    solved for the new variables; otherwise r sin(a_i) sin(b_j) is added, with an r that is less than half of each c_k.
    One of the c_k is the number `smallest`, if that is given: the Hessian is nearly singular then.
    """
    kinds = draw(st.lists(st.sampled_from(list(types)), min_size=space.n, max_size=space.n))
    kind: int | tuple[int, ...] = tuple(kinds) if mixed and len(set(kinds)) > 1 else kinds[0]
    template = GeneratingFunction(space, kind, 0)
    old, new = template.old_arguments, template.new_arguments
    factors = [draw(rationals()) for _ in old]
    if smallest is not None:
        factors[draw(st.integers(0, space.n - 1))] = smallest
    F = sp.Add(*(c * x * y for c, x, y in zip(factors, old, new, strict=True)))
    nothing = st.just(sp.S.Zero)
    F += draw(nothing | functions(old, transcendental=not solvable))
    F += draw(nothing | (polynomials(new, min_degree=2, max_degree=2, max_terms=2) if solvable else functions(new)))
    if not solvable:
        x, y = draw(st.sampled_from(old)), draw(st.sampled_from(new))
        F += min(map(abs, factors)) / draw(st.integers(3, 9)) * sp.sin(x) * sp.sin(y)
    return GeneratingFunction(space, kind, F)
