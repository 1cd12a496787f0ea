"""Williamson's theorem and normal modes."""

import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.normal_modes import normal_modes, williamson


@pytest.mark.parametrize("n", [1, 2, 5, 12])
def test_williamson(n):
    rng = np.random.default_rng(n)
    B = rng.normal(size=(2 * n, 2 * n))
    found = williamson(B @ B.T + 0.1 * np.eye(2 * n))
    assert found.symplectic_defect < 1e-12 * np.linalg.cond(found.S)
    assert found.diagonal_defect < 1e-12 * np.linalg.cond(found.S)
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    values = np.linalg.eigvals(J @ (B @ B.T + 0.1 * np.eye(2 * n)))
    assert np.allclose(np.sort(values.imag)[n:], found.frequencies, rtol=1e-9)
    assert np.allclose(values.real, 0, atol=1e-8)


def test_an_oscillator_in_a_magnetic_field():
    """H = (p + b × q)²/2 + w² q²/2: the frequencies are √(w² + b²) ± b (Landau levels' classical pair)."""
    b, w = 0.3, 1.1
    A = np.block(
        [[(b**2 + w**2) * np.eye(2), b * np.array([[0, -1], [1, 0]])], [b * np.array([[0, 1], [-1, 0]]), np.eye(2)]]
    )
    root = np.hypot(b, w)
    assert np.allclose(williamson(A).frequencies, [root - b, root + b], rtol=1e-14)


def test_equal_frequencies_and_very_unequal_masses():
    found = williamson(np.diag([1e6, 1.0, 1e-6, 1.0]))
    assert np.allclose(found.frequencies, [1, 1], rtol=1e-14)
    assert found.symplectic_defect < 1e-14


def test_two_masses_on_three_springs():
    """ω² = 1 and 3 (Goldstein, problem 6.4)."""
    found = normal_modes(np.eye(2), [[2, -1], [-1, 2]])
    assert np.allclose(found.squares, [1, 3], rtol=1e-14)
    assert np.allclose(found.modes[:, 0] / found.modes[0, 0], [1, 1])
    assert found.stable
    assert not normal_modes(np.eye(2), [[1, 2], [2, 1]]).stable


def test_modes_against_williamson():
    rng = np.random.default_rng(0)
    B, C = rng.normal(size=(2, 4, 4))
    M, K = B @ B.T + np.eye(4), C @ C.T + np.eye(4)
    modes = normal_modes(M, K)
    A = np.block([[K, np.zeros((4, 4))], [np.zeros((4, 4)), np.linalg.inv(M)]])
    assert np.allclose(williamson(A).frequencies, np.sqrt(modes.squares), rtol=1e-10)
    V = modes.modes
    assert np.allclose(V.T @ M @ V, np.eye(4), atol=1e-12)
    assert np.allclose(V.T @ K @ V, np.diag(modes.squares), atol=1e-11)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: williamson(np.diag([1.0, -1.0])), "positive definite.*-1"),
        (lambda: williamson(np.eye(3)), "even number"),
        (lambda: williamson([[1, 2], [0, 1]]), "symmetric"),
        (lambda: normal_modes(np.eye(2), np.eye(3)), "3 rows for 2"),
        (lambda: normal_modes(np.zeros((2, 2)), np.eye(2)), "positive definite"),
        (lambda: williamson([1, 2]), "square"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
