"""What strategies promise holds: symplectic matrices of a condition, stated defects, known integrals, Hessians."""

import numpy as np
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from canon import PhaseSpace
from canon.numeric.loops import loop_integral
from canon.numeric.surfaces import surface_integral
from canon.numeric.symplectic_matrix import symplectic_defect, unit_form
from canon.testing import (
    Loop,
    MatrixMutant,
    Surface,
    generating_functions,
    hamiltonians,
    loops,
    matrix_mutants,
    mutants,
    phase_points,
    surfaces,
    symplectic_matrices,
)

Array = np.ndarray
PLANE = PhaseSpace("x y", "u v", new=("X Y", "U V"))
quick = settings(max_examples=20, deadline=None, derandomize=True, database=None)


def entry(label: str, n: int) -> tuple[int, int]:
    """Where a bracket such as "{Q1,P2}" stands in M J Mᵀ."""
    first, second = label[1:-1].split(",")
    return tuple(int(name[1:]) - 1 + n * (name[0] == "P") for name in (first, second))  # type: ignore[return-value]


@quick
@given(st.integers(1, 5).flatmap(symplectic_matrices))
def test_matrices_are_symplectic(M: Array) -> None:
    size, bound = symplectic_defect(M)
    assert size <= 16 * bound


@quick
@given(st.integers(1, 4).flatmap(lambda n: symplectic_matrices(n, made="generators", max_factors=3)))
def test_matrices_of_generators_are_exact(M: Array) -> None:
    J = unit_form(len(M) // 2)
    assert np.array_equal(M @ J @ M.T, J)


@quick
@given(st.sampled_from([1.0, 1e2, 1e6]).flatmap(lambda k: st.tuples(st.just(k), symplectic_matrices(3, condition=k))))
def test_the_condition_is_prescribed(given: tuple[float, Array]) -> None:
    condition, M = given
    assert np.isclose(np.linalg.cond(M), condition, rtol=1e-6)


@quick
@given(st.integers(1, 4).flatmap(matrix_mutants))
def test_a_matrix_misses_by_its_stated_defect(mutant: MatrixMutant) -> None:
    M, n = mutant.matrix, len(mutant.matrix) // 2
    residual = M @ unit_form(n) @ M.T - unit_form(n)
    scale = (np.abs(M) @ np.abs(M).T).max()
    i, j = entry(mutant.bracket, n)
    assert abs(residual[i, j] - mutant.defect) <= 1e-14 * scale
    residual[i, j] = residual[j, i] = 0
    assert np.abs(residual).max() <= 1e-14 * scale


@quick
@given(st.data())
def test_a_map_misses_by_its_stated_defect(data: st.DataObject) -> None:
    mutant = data.draw(mutants(PLANE, buried=False))
    residual = mutant.transformation.symplectic_residual()
    i, j = entry(mutant.bracket, 2)
    point = dict(mutant.witness)
    assert sp.expand(residual[i, j].subs(point)) == mutant.defect
    assert sum(sp.expand(f.subs(point)) != 0 for f in residual) == 2


@quick
@given(st.integers(1, 3).flatmap(loops))
def test_the_integral_of_a_loop_is_known(loop: Loop) -> None:
    if not loop(np.arange(8) / 8).any():
        return
    found = loop_integral(loop)
    assert abs(found.value - loop.integral) <= 1e-12


@quick
@given(st.integers(1, 3).flatmap(surfaces))
def test_the_integral_of_a_surface_is_known(surface: Surface) -> None:
    found = surface_integral(surface, (False, False))
    assert abs(found.value - surface.integral) <= 1e-12


@quick
@given(st.data())
def test_mixed_hessians_are_regular_everywhere(data: st.DataObject) -> None:
    smallest = data.draw(st.sampled_from([None, sp.Rational(1, 10**6)]))
    F = data.draw(generating_functions(PLANE, solvable=False, smallest=smallest))
    determinant = sp.lambdify(F.mixed, F.mixed_hessian().det(), "numpy")
    rng = np.random.default_rng(0)
    values = np.broadcast_to(determinant(*rng.uniform(-50, 50, (4, 200))), 200)
    assert np.all(values > 0) or np.all(values < 0)


@quick
@given(st.data())
def test_hamiltonians_are_smooth_and_have_an_invertible_kinetic_energy(data: st.DataObject) -> None:
    H = data.draw(hamiltonians(PLANE, separable=False))
    assert sp.hessian(H.H.expr, PLANE.p).det() > 0
    assert np.isfinite(float(H.H.expr.subs(dict.fromkeys(PLANE.old, 3))))


@quick
@given(phase_points(2, units=(1e-10, 1e-24)))
def test_phase_points_have_their_units(z: Array) -> None:
    assert z.shape == (4,)
    assert np.all(np.abs(z[:2]) <= 9e-2)
    assert np.all(np.abs(z[2:]) <= 9e-16)
