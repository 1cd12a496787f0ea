"""Symplectic matrices near a matrix that is nearly one: by Cayley's transform, and as a generalised polar factor.

Feng and Qin, Symplectic Geometric Algorithms (2010), section 3.2; Higham, Mackey, Mackey and Tisseur, SIAM Journal on
Matrix Analysis 26 (2005) 849, on polar factors and Newton's iteration in groups of automorphisms.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from canon.errors import InputError
from canon.expected import one_of
from canon.numeric.precision import UNIT

Array = np.ndarray
MOST_ITERATIONS: Final = 100
POLISHINGS: Final = 2


@dataclass(frozen=True, eq=False)
class Candidate:
    """A symplectic `matrix`, found by a `method`, at a `distance` (Frobenius) from the matrix that was given."""

    method: str
    matrix: Array
    distance: float


def unit_form(n: int) -> Array:
    """J = [[0, 1], [−1, 0]] with n-by-n blocks."""
    zero, one = np.zeros((n, n)), np.eye(n)
    return np.block([[zero, one], [-one, zero]])


def adjoint(M: Array) -> Array:
    """M^# = J⁻¹ Mᵀ J of a matrix or of matrices (…, 2n, 2n): M is symplectic where M^# M = 1."""
    n = M.shape[-1] // 2
    A, B, C, D = (np.swapaxes(block, -1, -2) for block in _blocks(M, n))
    return np.concatenate([np.concatenate([D, -B], axis=-1), np.concatenate([-C, A], axis=-1)], axis=-2)


def symplectic_defect(M: Array) -> tuple[float, float]:
    """The worst entry of |M J Mᵀ − J|, and the rounding that is to be expected there.

    An M that was computed is taken to be off by roundings of |M| |M^#| |M|: so much Newton's iteration leaves.
    """
    n = M.shape[0] // 2
    J = unit_form(n)
    residual = np.abs(M @ J @ M.T - J)
    across = np.abs(J) @ np.abs(M).T
    off = np.abs(M) @ np.abs(adjoint(M)) @ np.abs(M) @ across
    rounding = (n + 1) * UNIT * (np.abs(M) @ across + off + off.T + np.abs(J))
    worst = np.unravel_index(int(np.argmax(residual / np.maximum(rounding, 1e-300))), residual.shape)
    return float(residual[worst]), float(rounding[worst])


def by_cayley(M: Array) -> Array | None:
    """(1 − A)⁻¹ (1 + A) with the Hamiltonian part A of (M + 1)⁻¹ (M − 1); None where a matrix is singular.

    M is symplectic exactly when J (M + 1)⁻¹ (M − 1) is symmetric, so the symmetric part is what is kept. It fails near
    the eigenvalue −1 of M.
    """
    n = M.shape[0] // 2
    one, J = np.eye(2 * n), unit_form(n)
    try:
        transformed = J @ np.linalg.solve(M + one, M - one)
        A = -J @ (transformed + transformed.T) / 2
        return _polished(np.linalg.solve(one - A, one + A))
    except np.linalg.LinAlgError:
        return None


def by_polar_factor(M: Array) -> Array | None:
    """The symplectic factor S of M = S P, P² = M^# M; None where Newton's iteration finds none.

    There is one if M^# M has no eigenvalue on the negative axis.
    """
    X = M
    for _ in range(MOST_ITERATIONS):
        try:
            following = (X + np.linalg.inv(adjoint(X))) / 2
        except np.linalg.LinAlgError:
            return None
        change = float(np.abs(following - X).max())
        X = following
        if not np.isfinite(change):
            return None
        if change <= 1e-8 * float(np.abs(X).max()):
            return _polished(X)
    return None


def nearest(M: Array, method: str = "nearest") -> tuple[Candidate, tuple[Candidate, ...]]:
    """The symplectic matrix of a method ("cayley", "polar", or the "nearest" of both), and all that were found.

    **Raises:** `InputError` where there is none.
    """
    makers = {"cayley": by_cayley, "polar": by_polar_factor}
    one_of(method, ("nearest", *makers), "method")
    if not np.linalg.slogdet(M)[0] > 0:
        raise InputError("no symplectic matrix is near this one: its determinant is not positive, theirs is 1", "map")
    found = []
    for name, maker in makers.items():
        if method not in ("nearest", name):
            continue
        S = maker(M)
        if S is not None and np.all(np.isfinite(S)):
            size, bound = symplectic_defect(S)
            if size <= 64 * bound:
                found.append(Candidate(name, S, float(np.linalg.norm(S - M))))
    if not found:
        raise InputError(
            "no symplectic matrix is near this one: J⁻¹ Mᵀ J M has an eigenvalue on the negative axis, as where "
            "brackets {Q, P} are negative, or (Cayley's transform) M has the eigenvalue −1",
            "map",
        )
    return min(found, key=lambda candidate: candidate.distance), tuple(found)


def _polished(X: Array) -> Array:
    """X with its defect brought down to rounding: X ← X (3 − X^# X)/2, which needs no inverse."""
    for _ in range(POLISHINGS):
        X = X + X @ (np.eye(len(X)) - adjoint(X) @ X) / 2
    return X


def _blocks(M: Array, n: int) -> tuple[Array, Array, Array, Array]:
    return M[..., :n, :n], M[..., :n, n:], M[..., n:, :n], M[..., n:, n:]
