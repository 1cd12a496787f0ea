"""What is no number, no list that ends, or no symbol of the space, from Python: one error, wherever it is given."""

from collections.abc import Callable
from itertools import count
from time import monotonic
from typing import Any

import numpy as np
import pytest
import sympy as sp
from hypothesis import find

import canon
from canon.errors import InputError
from canon.expected import listed
from canon.mechanics.algebra.sums import semidirect_sum
from canon.mechanics.integral_invariant import cartan_form
from canon.testing import phase_points

SPACE = canon.PhaseSpace("q", "p", new=("Q", "P"))
q, p, Q = (SPACE.symbol(name) for name in ("q", "p", "Q"))
PLANE = canon.PhaseSpace("x y", "px py")
x, y, px, py = (PLANE.symbol(name) for name in ("x", "y", "px", "py"))
FREE = (px**2 + py**2) / 2
NOT_Q, NOT_X = sp.Symbol("q"), sp.Symbol("x")
FUNCTION: Any = sp.Lambda(NOT_X, NOT_X)  # float() and numpy make an IndexError of it
NAMES: Any = sp.IndexedBase("a")  # it has an item at every place, and so no end
HALF = sp.Rational(1, 2)
AFFINE = canon.LieAlgebra.of(["A", "B"], {"A,B": "B"})
SWAP = canon.Transformation(SPACE, Q=p, P=-q)

WRONG: dict[str, Callable[[], Any]] = {
    "closure, budget": lambda: canon.closure(PLANE, {"A": x}, budget=FUNCTION),
    "separates, budget": lambda: canon.separates(PLANE, FREE + x**2, "cartesian", budget=FUNCTION),
    "normal_modes, a function": lambda: canon.normal_modes(FUNCTION, [[1]]),
    "normal_modes, an entry": lambda: canon.normal_modes([[FUNCTION]], [[1]]),
    "williamson": lambda: canon.williamson(FUNCTION),
    "frequency_lines": lambda: canon.frequency_lines(FUNCTION, 0.1),
    "frequency_lines, an entry": lambda: canon.frequency_lines([FUNCTION] * 40, 0.1),
    "audit, domain": lambda: canon.audit(SWAP, domain=[(FUNCTION, 1)] * 2, samples=2),
    "audit, parameters": lambda: canon.audit(SWAP, parameters={"a": FUNCTION}, samples=2),
    "surface_invariant, a text": lambda: canon.surface_invariant(SWAP, lambda u: u, periodic="a" * 200),  # type: ignore[arg-type]
    "surface_invariant, a relation": lambda: canon.surface_invariant(
        SWAP,
        lambda u: u,
        periodic=[sp.Eq(q, 1), False],  # type: ignore[list-item]
    ),
    "surface_invariant, 40 directions": lambda: canon.surface_invariant(SWAP, lambda u: u, periodic=[True] * 40),
    "lagrange_bracket, no end": lambda: canon.lagrange_bracket(q, p, [q], NAMES),
    "LieAlgebra.of, no end": lambda: canon.LieAlgebra.of(NAMES, {}),
    "polyhedron, no end": lambda: canon.polyhedron(NAMES, [(0, 1, 2)]),
    "chain_frequencies, no end": lambda: canon.chain_frequencies(count(1), (1.0,)),  # type: ignore[arg-type]
    "a coefficient that is a class": lambda: AFFINE.bracket({"A": sp.Function("f")}, {"B": 1}),
    "a coefficient that is a function": lambda: AFFINE.bracket({"A": 1}, {"B": FUNCTION}),
    "a coefficient that is a relation": lambda: AFFINE.show({0: sp.Eq(q, 1)}),  # type: ignore[dict-item]
    "a matrix that is none": lambda: semidirect_sum(AFFINE, AFFINE, {"A": 1}),  # type: ignore[dict-item]
    "boost, 30 digits": lambda: canon.boost((0, 0, HALF / 3 * 2), c=10**30),
    "compose_boosts, 100 digits": lambda: canon.compose_boosts((0, 0, HALF), (0, 0, HALF / 3), c=10**100),
    "phase_points, a text": lambda: find(phase_points("a"), bool),  # type: ignore[arg-type]
    "phase_points, no scales": lambda: find(phase_points(1, scales=0.5), bool),  # type: ignore[arg-type]
    "compose_boosts, an integral": lambda: canon.compose_boosts(
        (0, 0, sp.Rational(1, 2)), (0, 0, 0), c=sp.Integral(q**2 + 1, (q, 0, 1))
    ),
}

FOREIGN: dict[str, Callable[[], Any]] = {
    "transformed": lambda: SWAP.transformed(p**2 + NOT_Q),
    "separates_here": lambda: canon.separates_here(PLANE, FREE + x * y * NOT_X),
    "levi_civita": lambda: canon.levi_civita(PLANE, FREE + NOT_X * y),
    "separates": lambda: canon.separates(PLANE, FREE + NOT_X * y, "polar"),
    "a convention's bracket": lambda: canon.LANDAU_LIFSHITZ.bracket(NOT_Q, p, SPACE),
    "cartan_form": lambda: cartan_form(SWAP, NOT_Q, Q),
    "a domain": lambda: canon.PhaseSpace("q", "p", domain=canon.Domain((canon.Condition("positive", (NOT_Q,)),))),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_number_or_has_no_end_is_an_input_error(name: str) -> None:
    with pytest.raises(InputError):
        WRONG[name]()


@pytest.mark.parametrize("name", FOREIGN)
def test_a_symbol_that_only_shares_its_name_is_refused(name: str) -> None:
    """`separates_here` said `proved` of H = … + x y with another x: derivatives by x miss it."""
    with pytest.raises(InputError, match="two different symbols"):
        FOREIGN[name]()


def test_lists() -> None:
    assert listed(range(3), "numbers", "x") == (0, 1, 2)
    assert listed((k for k in range(3)), "numbers", "x") == (0, 1, 2)
    assert listed(sp.Matrix([1, 2]), "numbers", "x") == (1, 2)
    assert listed(np.array([1.0, 2.0]), "numbers", "x") == (1.0, 2.0)
    for wrong in ("12", {1: 2}, {1, 2}, frozenset({1}), 1, None, np.array(1.0), NAMES, count()):
        with pytest.raises(InputError, match="x: a list of numbers is expected"):
            listed(wrong, "numbers", "x")


@pytest.mark.parametrize("kink", [sp.Abs(q) / q, sp.sqrt(q**2) * q, sp.Abs(q) ** 3])
def test_the_inverse_of_an_explicit_map_is_right_on_both_sides_of_a_kink(kink: sp.Expr) -> None:
    """P = p - |q|/q was inverted as p = P + 1, which is so for q > 0 alone, and composed as if that were so."""
    sheared = canon.Transformation(SPACE, Q=q, P=p - kink)
    back = sheared.backward().expressions
    for place in (-2, 3):
        found = [value.subs([(SPACE.Q[0], place), (SPACE.P[0], 5)]) for value in back]
        assert found == [place, 5 + kink.subs(q, place)]
    assert canon.compose(sheared, sheared.inverse()).expressions == (q, p)


def test_solving_has_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sympy's solver lasted for minutes."""
    monkeypatch.setattr("canon.mechanics.solving._SECONDS", 0.2)
    bent = q + sp.cosh(p)
    turned = canon.Transformation(SPACE, Q=sp.atan(bent), P=p * (1 + bent**2))
    began = monotonic()
    with pytest.raises(InputError, match="no generating function of type 1 was found"):
        turned.generating_function_of(1)
    assert monotonic() - began < 60


def test_a_cross_section_beyond_all_doubles() -> None:
    r = sp.Symbol("r", positive=True)
    found = canon.scattering(1 / r, r, energy=1e-300, impact_parameter=0.5)
    assert found is not None
    assert found.cross_section == float("inf")
    far = canon.scattering(r**-1 * 10**200, r, energy=1e100, impact_parameter=1.0)
    assert far is not None
    assert far.cross_section == pytest.approx(6.25e198, rel=1e-14)
