"""Quadratic Hamiltonians: symplectic diagonalisation, and the normal modes of small oscillations.

Conditioning: squares of frequencies are known to roundings of the largest one, so that a slow mode beside a fast one
loses (Ω/ω)²; of chains `canon.numeric.chains` keeps it. Modes of frequencies that coincide are known up to rotations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from canon.errors import InputError
from canon.expected import real_array

Array = Any
SYMMETRIC = 1e-12
"""By how much, relative to its size, a symmetric matrix may differ from its transpose."""


@dataclass(frozen=True)
class Williamson:
    """A symplectic S (2n, 2n) with Sᵀ A S = diag(ω, ω), for H = ½ zᵀ A z in the order z = (q, p).

    In the new variables Z = S⁻¹ z, H = Σ ω_k (Q_k² + P_k²)/2. `frequencies` (n,) in ascending order, in radians per
    unit of time. `symplectic_defect` is the largest entry of |Sᵀ J S − J|, `diagonal_defect` that of |Sᵀ A S − D|, over
    the largest frequency.
    """

    frequencies: Array
    S: Array
    symplectic_defect: float
    diagonal_defect: float


@dataclass(frozen=True)
class NormalModes:
    """Modes of M ẍ + K x = 0: the columns of `modes` (n, n) with Vᵀ M V = 1 and Vᵀ K V = diag(`squares`).

    `squares` (n,) are the ω² in ascending order; a negative one is an instability, exp(√−ω² t).
    """

    squares: Array
    modes: Array

    @property
    def stable(self) -> bool:
        """Whether all ω² are positive."""
        return bool(self.squares[0] > 0)


def normal_modes(M: Any, K: Any) -> NormalModes:
    """The normal modes of T = ½ ẋᵀ M ẋ, V = ½ xᵀ K x: the generalised eigenproblem K v = ω² M v.

    Goldstein, Poole and Safko (2002), section 6.2; by Cholesky's factor of M.

    **Arguments:** M and K, symmetric (n, n), M positive definite.

    **Raises:** `InputError` where they aren't.
    """
    mass, stiffness = _symmetric(M, "M"), _symmetric(K, "K")
    if mass.shape != stiffness.shape:
        raise InputError(f"{stiffness.shape[0]} rows for {mass.shape[0]} coordinates", "K")
    L = _cholesky(mass, "M")
    half = np.linalg.solve(L, stiffness)
    inner = np.linalg.solve(L, half.T)
    squares, rotation = np.linalg.eigh((inner + inner.T) / 2)
    return NormalModes(squares, np.linalg.solve(L.T, rotation))


def williamson(A: Any) -> Williamson:
    """Williamson's theorem: a positive definite quadratic Hamiltonian is a sum of oscillators in canonical variables.

    With A = L Lᵀ the antisymmetric Lᵀ J L has the eigenvalues ±iω; its real normal form gives S = L⁻ᵀ O √ω
    (Williamson, Amer. J. Math. 58, 1936; Arnold, Mathematical Methods, app. 6).

    **Arguments:** A, symmetric and positive definite, (2n, 2n), in the order (q₁, …, q_n, p₁, …, p_n).

    **Raises:** `InputError` where it isn't.
    """
    matrix = _symmetric(A, "A")
    if len(matrix) % 2:
        raise InputError("a Hamiltonian has as many momenta as coordinates: an even number of rows", "A")
    n = len(matrix) // 2
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    L = _cholesky(matrix, "A")
    values: Array
    vectors: Array
    values, vectors = np.linalg.eigh(1j * (L.T @ J @ L))
    frequencies, upper = values[n:], vectors[:, n:]
    O = np.sqrt(2) * np.hstack([upper.imag, upper.real])
    D = np.concatenate([frequencies, frequencies])
    S = np.linalg.solve(L.T, O * np.sqrt(D))
    off = np.abs(S.T @ matrix @ S - np.diag(D)).max() / D.max()
    return Williamson(frequencies, S, float(np.abs(S.T @ J @ S - J).max()), float(off))


def _symmetric(value: Any, where: str) -> Array:
    matrix = real_array(value, where)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not len(matrix):
        raise InputError("a square matrix is expected", where)
    if not np.isfinite(matrix).all() or np.abs(matrix - matrix.T).max() > SYMMETRIC * np.abs(matrix).max():
        raise InputError("the matrix isn't symmetric", where)
    return (matrix + matrix.T) / 2


def _cholesky(matrix: Array, where: str) -> Array:
    try:
        return np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        least = np.linalg.eigvalsh(matrix)[0]
        said = f"the matrix isn't positive definite: its least eigenvalue is {least:.6g}"
        raise InputError(said, where) from None
