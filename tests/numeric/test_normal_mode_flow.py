"""Quadratic Hamiltonians whose springs are up to 10¹² apart: every entry of the flow's matrix, beside many digits."""

import threading
from typing import Any

import jax
import mpmath
import numpy as np
import pytest

from canon.numeric.integrators import normal_mode_flow
from canon.numeric.integrators.normal_mode_flow import coupled, modes_of
from canon.numeric.integrators.parts import commutes, quadratic_part
from canon.numeric.precision import double

CASES = {
    "two equal oscillators with a weak spring between": ([1.0, 1.0], [[1 + 1e-12, -1e-12], [-1e-12, 1 + 1e-12]]),
    "a weak spring that hangs on a stiff one": (
        [1.0, 2.0, 1.0],
        [[1e12 + 1, -1e12, 0], [-1e12, 1e12 + 1e-3, -1e-3], [0, -1e-3, 1e-3 + 1]],
    ),
    "a chain": ([1.0, 1.0, 1.0, 3.0], [[1e12, 1, 0, 0], [1, 2, -1e-6, 0], [0, -1e-6, 2, 1e-9], [0, 0, 1e-9, 1]]),
    "two maxima that nearly agree": ([1.0, 1.0, 2.0], [[-1, 1e-7, 0], [1e-7, -1, 1e-3], [0, 1e-3, 5]]),
    "a free sum and a relative motion": ([1.0, 1.0], [[1e-10, -1e-10], [-1e-10, 1e-10]]),
}


def exactly(inverse: list[float], K: np.ndarray, h: float) -> list[np.ndarray]:
    """exp of the whole matrix (q, p), less 1, in 80 digits, by scaling, Taylor's series, and squaring."""
    n = len(inverse)
    with mpmath.workdps(80):
        B = mpmath.matrix(2 * n, 2 * n)
        for i in range(n):
            B[i, n + i] = mpmath.mpf(inverse[i])
            for j in range(n):
                B[n + i, j] = -mpmath.mpf(float(K[i, j]))
        E = mpmath.expm(B * mpmath.mpf(h), method="taylor")
        whole = np.array([[float(E[i, j] - (i == j)) for j in range(2 * n)] for i in range(2 * n)])
    return [whole[:n, :n], whole[:n, n:], whole[n:, :n], whole[n:, n:]]


@pytest.mark.parametrize("name", CASES)
def test_every_entry_is_exact_beside_its_own_size(name: str) -> None:
    inverse, rows = CASES[name]
    K = np.array(rows, dtype=float)
    lengths = [1e-3, 1.7]
    with double():
        blocks = [np.asarray(block) for block in jax.jit(quadratic_part(inverse, K).prepare)(np.array(lengths))]
    for place, h in enumerate(lengths):
        for block, wanted in zip(blocks, exactly(inverse, K, h), strict=True):
            assert np.all(np.abs(block[place] - wanted) <= 2e-8 * np.abs(wanted))


def test_the_digits_are_neither_set_for_other_threads_nor_taken_from_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """mpmath's own digits are the process'. Here another thread sets them in the midst, as one may at any time."""
    inverse, rows = CASES["a chain"]
    K = np.array(rows)
    expected = modes_of(inverse, K)
    seen = []

    def late(matrix: Any) -> list[np.ndarray]:
        def other() -> None:
            seen.append(mpmath.mp.dps)
            mpmath.mp.dps = 5

        thread = threading.Thread(target=other)
        thread.start()
        thread.join()
        return coupled(matrix)

    with mpmath.workdps(12):
        monkeypatch.setattr(normal_mode_flow, "coupled", late)
        found = modes_of(inverse, K)
    assert seen == [12]
    assert np.array_equal(found.squares, expected.squares)
    assert np.array_equal(found.gap, expected.gap)


@pytest.mark.parametrize("h", [1 / 8, 1 / 64, 3 / 128])
def test_the_rounding_of_many_flows_does_not_add_up(h: float) -> None:
    """16384 flows are the one flow of their whole time: what a step's matrix is rounded by is the same each time."""
    W = np.array([[0.0, 0.7], [-0.7, 0.0]])
    part, count = quadratic_part([1.0, 1.0], np.eye(2), W), 16384

    @jax.jit
    def moved(state: Any, length: Any, times: Any) -> Any:
        tables = jax.tree.map(lambda x: x[0], part.prepare(length[None]))
        return jax.lax.fori_loop(0, times, lambda _, now: part.flow(now, tables, None), state)

    with double():
        state = tuple(map(np.array, ([0.3, 0.5], [0.2, 1.0])))
        step, whole = np.array(h), np.array(h * count)
        by_steps, at_once = (np.concatenate(moved(state, *each)) for each in ((step, count), (whole, 1)))
    assert np.abs(by_steps - at_once).max() < 4e-16 * (count**0.5 + h * count)


def test_what_a_coarse_look_beside_a_stiff_spring_would_call_a_symmetry() -> None:
    """The plane that turns has unequal springs, whose difference is 10¹⁵ times less than the stiffest one."""
    K = np.diag([1e12, 1.0, 1.001])
    W = np.array([[0.0, 0, 0], [0, 0, 0.3], [0, -0.3, 0]])
    assert not commutes(np.eye(3), K, W)
    assert commutes(np.eye(3), np.diag([1e12, 1.0, 1.0]), W)
    assert not commutes(np.diag([1.0, 1.0, 1.0 + 1e-9]), np.zeros((3, 3)), W)


def test_coordinates_that_nothing_couples_stay_apart() -> None:
    """A stiff pair beside a soft one: two sets, each with its own modes; the flow has no entry between them."""
    K: Any = np.zeros((4, 4))
    K[:2, :2] = [[3e12, 1e12], [1e12, 3e12]]
    K[2:, 2:] = [[2.0, 1e-9], [1e-9, 2.0]]
    with double():
        qq, qp, _, _ = (
            np.asarray(block)[0] for block in jax.jit(quadratic_part([1.0] * 4, K).prepare)(np.array([0.5]))
        )
    assert np.all(qq[:2, 2:] == 0)
    # the derivative of cos ωh by the coupling, at ω² = 2
    root = np.sqrt(2.0)
    assert qq[2, 3] == pytest.approx(-1e-9 * 0.5 * np.sin(root * 0.5) / (2 * root), rel=1e-12)
    assert qp[2, 2] == pytest.approx(np.sin(root * 0.5) / root, rel=1e-14)
