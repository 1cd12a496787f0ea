"""Symplectic matrices near others: exact to rounding, near, and named by the method that found them."""

import numpy as np
import pytest

from canon import InputError, symplectify
from canon.numeric.symplectic_matrix import adjoint, symplectic_defect, unit_form

Array = np.ndarray


def symplectic(n: int, seed: int) -> Array:
    """A product of shears and a rotation of all pairs."""
    rng = np.random.default_rng(seed)
    one, zero = np.eye(n), np.zeros((n, n))
    X, Y = (A + A.T for A in rng.normal(size=(2, n, n)) / (2 * n))
    c, s = np.cos(0.7) * one, np.sin(0.7) * one
    return np.block([[one, X], [zero, one]]) @ np.block([[c, s], [-s, c]]) @ np.block([[one, zero], [Y, one]])


def test_the_adjoint_is_the_inverse_of_a_symplectic_matrix() -> None:
    S = symplectic(3, 0)
    assert adjoint(S) @ S == pytest.approx(np.eye(6), abs=1e-14)
    M = np.arange(16.0).reshape(4, 4)
    J = unit_form(2)
    assert np.array_equal(adjoint(M), -J @ M.T @ J)


@pytest.mark.parametrize("n", [1, 2, 10, pytest.param(50, marks=pytest.mark.slow)])
@pytest.mark.parametrize("off", [1e-2, 1e-6, 1e-10])
def test_a_nearby_matrix_is_found(n: int, off: float) -> None:
    M = symplectic(n, n) + off * np.random.default_rng(1).normal(size=(2 * n, 2 * n)) / n
    for method in ("nearest", "cayley", "polar"):
        repair = symplectify(M, method=method)
        assert repair.defect <= 16 * repair.bound
        assert symplectic_defect(np.asarray(repair)) == (repair.defect, repair.bound)
        assert repair.distance == pytest.approx(float(np.linalg.norm(repair.matrix - M)))
        assert repair.distance <= 20 * off
    assert symplectify(M).distance == min(symplectify(M).distances.values())


def test_a_symplectic_matrix_stays() -> None:
    S = symplectic(4, 2)
    assert symplectify(S).distance <= 1e-13
    assert symplectify([[1, 0.5], [0, 1]]).distance <= 1e-15


def test_the_report_names_the_method() -> None:
    M = symplectic(2, 3) + 1e-3
    repair = symplectify(M)
    name = {"cayley": "Cayley's transform", "polar": "the symplectic polar factor"}[repair.method]
    assert str(repair).startswith(f"symplectic matrix by {name}, ")
    assert f"cayley {repair.distances['cayley']:.3g}" in str(repair)


def test_at_the_eigenvalue_minus_one_the_polar_factor_remains() -> None:
    half_turn = np.diag([-1.0, 2.0, -1.0, 0.5])
    repair = symplectify(half_turn * 1.0)
    assert repair.method == "polar"
    assert "cayley" not in repair.distances
    with pytest.raises(InputError, match="no symplectic matrix is near"):
        symplectify(half_turn, method="cayley")


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.diag([1.0, -1.0]), "no symplectic matrix is near this one"),
        (np.zeros((2, 2)), "no symplectic matrix is near this one"),
        (np.eye(3), r"a matrix \(2n, 2n\) is expected, not of shape \(3, 3\)"),
        ([[1.0, np.nan], [0.0, 1.0]], "not finite"),
        ([[1j, 0], [0, 1]], "real numbers"),
    ],
)
def test_what_has_no_symplectic_neighbour(matrix: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        symplectify(matrix)  # type: ignore[call-overload]


def test_a_method_that_does_not_exist() -> None:
    with pytest.raises(InputError, match="one of 'nearest', 'cayley', 'polar' is expected, not 'qr'"):
        symplectify(np.eye(2), method="qr")
