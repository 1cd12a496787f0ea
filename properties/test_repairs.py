"""Repairs: what is symplectic stays, what is nearly so moves by its defect, and the result passes its audit."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from canon import symplectify
from canon.numeric.images import compare_loops
from canon.numeric.loops import loop_integral
from canon.numeric.mixed_variables import best_conditioned
from canon.numeric.symplectic_matrix import symplectic_defect
from canon.testing import MatrixMutant, loops, matrix_mutants, symplectic_matrices

Array = np.ndarray
few = settings(max_examples=max(2, settings.default.max_examples // 16))


@given(st.integers(1, 4).flatmap(lambda n: matrix_mutants(n, condition=4.0)))
def test_a_matrix_moves_by_about_its_defect(mutant: MatrixMutant) -> None:
    repair = symplectify(mutant.matrix)
    assert repair.defect <= 16 * repair.bound
    assert abs(mutant.defect) / 100 <= repair.distance <= 10 * abs(mutant.defect)


@given(st.integers(1, 4).flatmap(symplectic_matrices))
def test_a_symplectic_matrix_stays(M: Array) -> None:
    repair = symplectify(M, method="polar")
    assert repair.distance <= 1e-13 * np.linalg.norm(M) * np.linalg.cond(M)


@given(st.integers(1, 3).flatmap(symplectic_matrices))
def test_every_symplectic_matrix_has_a_regular_type(M: Array) -> None:
    """Arnold (1989), section 48: among the 4ⁿ choices of variables one is free of caustics."""
    chosen = best_conditioned(M[None])
    assert chosen.compared == 4 ** (len(M) // 2)
    assert chosen.condition <= 50 * np.linalg.cond(M)


def spoiled(M: Array, size: float) -> Any:
    """A kick with a cubic and a quartic potential, a linear symplectic map, and a term of this size that spoils it."""

    def step(z: Array) -> Array:
        n = len(M) // 2
        q, p = z[:n], z[n:]
        p = p - 0.2 * q**2 + 0.1 * q**3 + size * q * p
        return M @ np.concatenate([q, p])

    return step


@pytest.mark.parametrize("size", [0.0, pytest.param(1e-3, marks=pytest.mark.slow), 1e-6])
@few
@given(st.data())
def test_a_map_moves_by_about_its_defect_and_keeps_loops(size: float, data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 2))
    M = data.draw(symplectic_matrices(n, condition=2.0))
    step = spoiled(M, size)
    repair = symplectify(step, dimension=2 * n, domain=(-0.3, 0.3), samples=6)
    assert repair.unsolved == 0
    if size == 0:
        assert repair.largest <= 1e-13
    else:
        assert size / 1e4 <= repair.largest <= size
        assert repair.order == 2
    loop = data.draw(loops(n, size=0.03, harmonics=1))
    if loop(np.arange(4) / 4).any():
        kept = compare_loops(repair, loop)
        assert loop_integral(loop).resolved
        assert abs(kept.difference) <= kept.bound + 1e-15, kept
    assert symplectic_defect(M)[0] < 1e-14
