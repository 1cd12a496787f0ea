"""Strategies shrink to what one can read: the quality of counterexamples is tested, as Hypothesis tests its own."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from hypothesis import HealthCheck, Phase, find, settings
from hypothesis import strategies as st

from canon import PhaseSpace
from canon.testing import (
    Mutant,
    canonical_maps,
    generating_functions,
    hamiltonians,
    loops,
    matrix_mutants,
    mutants,
    phase_points,
    phase_spaces,
    polynomials,
    surfaces,
    symplectic_matrices,
)

LINE = PhaseSpace("q", "p", new=("Q", "P"))
PLANE = PhaseSpace("x y", "u v", new=("X Y", "U V"))
q, p = LINE.old
QUIET = settings(
    max_examples=300,
    database=None,
    derandomize=True,
    phases=(Phase.generate, Phase.shrink),
    suppress_health_check=list(HealthCheck),
)


def simplest(strategy: st.SearchStrategy[Any], condition: Callable[[Any], bool] = lambda _: True) -> Any:
    """The simplest example that Hypothesis finds."""
    return find(strategy, condition, settings=QUIET)


def test_phase_points() -> None:
    assert simplest(phase_points(2)).tolist() == [0, 0, 0, 0]
    assert sorted(simplest(phase_points(1), lambda z: abs(z).max() > 1e5)) in ([0, 1e8], [-1e8, 0])
    twins = simplest(phase_points(1), lambda z: z[0] != 0 and z[0] == z[1])
    assert twins.tolist() == [1, 1]
    electron = simplest(phase_points(1, units=(5e-11, 2e-24)), lambda z: z[1] != 0)
    assert electron.tolist() == [0, 2e-24]


def test_symplectic_matrices() -> None:
    assert np.array_equal(simplest(symplectic_matrices(3)), np.eye(6))
    sheared = simplest(symplectic_matrices(1), lambda M: abs(M - np.eye(2)).max() > 0)
    assert sheared.tolist() == [[1, 0], [1, 1]]
    stretched = simplest(symplectic_matrices(2, condition=1e4))
    assert np.allclose(stretched, np.diag([100, 1, 0.01, 1]))


def test_mutants_of_matrices() -> None:
    mutant = simplest(matrix_mutants(2), lambda m: m.bracket == "{P1,P2}")
    assert mutant.defect == 1e-3
    assert np.array_equal(mutant.matrix, np.eye(4) + 1e-3 * np.eye(4)[:, [2]] @ np.eye(4)[[1]])


def test_phase_spaces_and_polynomials() -> None:
    assert simplest(phase_spaces()).n == 1
    assert simplest(polynomials(LINE.old), lambda f: f.has(p)) == p


def test_maps() -> None:
    assert str(simplest(canonical_maps(LINE))) in ("Q = q, P = p", "Q = p, P = -q")
    nonlinear = simplest(canonical_maps(LINE), lambda made: made.expressions[1].diff(q, 2) != 0)
    assert sum(sp.count_ops(f) for f in nonlinear.expressions) <= 4
    mutant: Mutant = simplest(mutants(PLANE), lambda m: m.bracket == "{Q1,Q2}")
    assert sum(sp.count_ops(f) for f in mutant.transformation.expressions) <= 3
    assert mutant.defect == sp.Rational(1, 1000)
    assert set(mutant.witness.values()) == {1}


def test_generating_functions() -> None:
    x, y = PLANE.q
    X, Y = PLANE.Q
    assert simplest(generating_functions(PLANE)).F.expr == x * X + y * Y
    near = simplest(generating_functions(LINE, smallest=sp.Rational(1, 10**6)))
    assert near.F.expr == q * LINE.Q[0] / 10**6
    assert simplest(generating_functions(LINE), lambda F: F.type == 4).F.expr == p * LINE.P[0]


def test_hamiltonians() -> None:
    assert simplest(hamiltonians(LINE)).H.expr == p**2 / 2
    assert simplest(hamiltonians(LINE), lambda H: H.H.expr.has(sp.sin)).H.expr == p**2 / 2 + sp.sin(q)
    well = simplest(hamiltonians(LINE, kinds=("polynomial",)), lambda H: H.H.expr.diff(q, 2) != 0)
    assert well.H.expr == p**2 / 2 + q**2


def test_loops_and_surfaces() -> None:
    loop = simplest(loops(1), lambda made: made.integral != 0)
    assert len(loop.cosines) == 1
    assert sorted(map(abs, (*loop.centre, *loop.cosines[0], *loop.sines[0]))) == [0, 0, 0, 0, 0.1, 0.1]
    surface = simplest(surfaces(1), lambda made: made.integral != 0)
    assert surface.corner == (0.0, 0.0)


@pytest.mark.parametrize(
    "strategy",
    [
        phase_points,
        symplectic_matrices,
        matrix_mutants,
        canonical_maps,
        mutants,
        generating_functions,
        hamiltonians,
        loops,
        surfaces,
        phase_spaces,
        polynomials,
    ],
)
def test_what_has_a_default_is_given_by_name(strategy: Callable[..., Any]) -> None:
    import inspect

    for parameter in inspect.signature(strategy).parameters.values():
        if parameter.default is not inspect.Parameter.empty:
            assert parameter.kind is inspect.Parameter.KEYWORD_ONLY, parameter
