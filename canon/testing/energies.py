"""Strategies of Hamiltonians: polynomial and trigonometric ones, with a kinetic energy that can be inverted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import sympy as sp
from hypothesis import strategies as st

from canon.mechanics.hamiltonian import Hamiltonian
from canon.mechanics.phase_space import PhaseSpace
from canon.testing.strategies import polynomials, rationals

Kind = Literal["polynomial", "trigonometric"]


@st.composite
def hamiltonians(
    draw: st.DrawFn,
    space: PhaseSpace,
    *,
    kinds: Sequence[Kind] = ("polynomial", "trigonometric"),
    max_degree: int = 4,
    separable: bool = True,
) -> Hamiltonian:
    """H = Σ p²/(2 m_k) + V(q), smooth for all real values; it shrinks to that of free particles.

    V is a polynomial of at most `max_degree`, or a sum of such waves as 2 cos(q1 − 3 q2). Unless `separable`, a product
    of coordinates and momenta may be added.
    """
    H: sp.Expr = sp.Add(*(p**2 / (2 * draw(st.integers(1, 3))) for p in space.p))
    if draw(st.sampled_from(list(kinds))) == "polynomial":
        H += draw(polynomials(space.q, max_degree=max_degree)) * draw(st.integers(0, 1))
    else:
        H += draw(waves(space.q))
    if not separable:
        H += draw(st.integers(-2, 2)) * draw(st.sampled_from(space.q)) * draw(st.sampled_from(space.p))
    return Hamiltonian(space, H)


@st.composite
def waves(draw: st.DrawFn, variables: Sequence[sp.Symbol], *, max_terms: int = 2, highest: int = 3) -> sp.Expr:
    """Trigonometric polynomials: sums of c cos(k·x) and c sin(k·x) with whole numbers k up to `highest`."""
    total: sp.Expr = sp.S.Zero
    for _ in range(draw(st.integers(0, max_terms))):
        phase: Any = sp.Add(*(draw(st.integers(-highest, highest)) * x for x in variables))
        total += draw(rationals()) * draw(st.sampled_from((sp.cos, sp.sin)))(phase)
    return total
