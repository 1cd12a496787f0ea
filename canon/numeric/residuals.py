"""What must vanish at a symplectic map's Jacobian M, each residual beside a bound on its own error.

M = (A B; C D) by positions and momenta, so that the brackets of the new variables are {Q,Q} = A Bᵀ − B Aᵀ,
{P,P} = C Dᵀ − D Cᵀ and {Q,P} = A Dᵀ − B Cᵀ: the blocks of M J Mᵀ, without J. Arrays have one entry a point.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import fsum
from typing import Final

import numpy as np

from canon.numeric.precision import UNIT

Array = np.ndarray

LARGEST_FOR_INVARIANTS: Final = 4
"""Degrees of freedom up to which the invariants of all orders are computed: they have C(2n, 2k) coefficients."""


@dataclass(frozen=True)
class Residuals:
    """Residuals (N, …) of one condition, with `bounds` of the same shape on their errors."""

    name: str
    sizes: Array
    bounds: Array


@dataclass(frozen=True)
class Brackets:
    """The brackets of new variables at N points: (N, n, n) each, beside bounds on their errors."""

    QQ: Array
    PP: Array
    QP: Array
    QQ_bound: Array
    PP_bound: Array
    QP_bound: Array

    def residuals(self, scale: float, off: float = 0.0) -> tuple[Residuals, Residuals, Residuals]:
        """What M J Mᵀ = scale J leaves of each family; `off`, by how much the scale may be off."""
        diagonal = np.eye(self.QP.shape[1])
        expected = scale * diagonal
        bound = self.QP_bound + UNIT * np.abs(expected) + off * diagonal
        return (
            Residuals("{Q,Q}", np.abs(self.QQ), self.QQ_bound),
            Residuals("{P,P}", np.abs(self.PP), self.PP_bound),
            Residuals("{Q,P}", np.abs(self.QP - expected), bound),
        )

    def valence(self) -> tuple[Array, Array]:
        """The mean of {Q_i,P_i} at each point, which is c where M J Mᵀ = c J; and its error's bound."""
        diagonal = np.einsum("bii->bi", self.QP)
        return diagonal.mean(axis=1), np.einsum("bii->bi", self.QP_bound).mean(axis=1)


def weighted_mean(values: Array, errors: Array) -> tuple[float, float]:
    """The mean of values, each weighted by its error; and how far it may be off, its own rounding included."""
    weights = 1 / np.maximum(errors, 1e-300) ** 2
    weights = np.ones_like(errors) if not np.isfinite(weights.sum()) or not weights.sum() else weights
    mean, off = (fsum(weights * x) / fsum(weights) for x in (values, errors))
    return mean, off + 3 * UNIT * abs(mean)


def _product(X: Array, EX: Array, Y: Array, EY: Array) -> tuple[Array, Array]:
    """X Yᵀ, and a bound on its error for factors off by at most EX and EY."""
    transposed, size = np.swapaxes(Y, 1, 2), np.abs(np.swapaxes(Y, 1, 2))
    off = np.swapaxes(EY, 1, 2)
    rounding = (X.shape[2] + 1) * UNIT
    return X @ transposed, EX @ (size + off) + np.abs(X) @ (off + rounding * size)


def brackets(M: Array, E: Array) -> Brackets:
    """The brackets at Jacobians M (N, 2n, 2n), whose entries are off by at most E."""
    n = M.shape[1] // 2
    A, B, C, D = M[:, :n, :n], M[:, :n, n:], M[:, n:, :n], M[:, n:, n:]
    EA, EB, EC, ED = E[:, :n, :n], E[:, :n, n:], E[:, n:, :n], E[:, n:, n:]
    AB, AB_bound = _product(A, EA, B, EB)
    CD, CD_bound = _product(C, EC, D, ED)
    AD, AD_bound = _product(A, EA, D, ED)
    BC, BC_bound = _product(B, EB, C, EC)
    QQ, PP, QP = AB - np.swapaxes(AB, 1, 2), CD - np.swapaxes(CD, 1, 2), AD - BC
    return Brackets(
        QQ,
        PP,
        QP,
        AB_bound + np.swapaxes(AB_bound, 1, 2) + UNIT * np.abs(QQ),
        CD_bound + np.swapaxes(CD_bound, 1, 2) + UNIT * np.abs(PP),
        AD_bound + BC_bound + UNIT * np.abs(QP),
    )


def determinants(M: Array, E: Array, lengths: Array) -> tuple[Array, Array, Array]:
    """det M, a bound on its error, and the condition number of M (1-norm), in units of `lengths` of the variables.

    The error is |det M| tr(|M⁻¹| E), with the factorisation's own rounding in E; where M is singular, or that is no
    number, it is what Hadamard's inequality grants: Π(|mᵢ| + |eᵢ|) − Π|mᵢ| with the norms of rows.
    """
    size = M.shape[1]
    M, E = (array * lengths / lengths[:, None] for array in (M, E))
    det = np.linalg.det(M)
    inverse = np.full_like(M, np.inf)
    regular = np.isfinite(det) & (det != 0)
    inverse[regular] = np.abs(np.linalg.inv(M[regular]))
    condition = np.abs(M).sum(axis=1).max(axis=1) * inverse.sum(axis=1).max(axis=1)
    spread = np.abs(M) @ inverse @ np.abs(M)
    with np.errstate(all="ignore"):
        relative = np.einsum("bji,bij->b", inverse, E + 3 * size * UNIT * spread)
        bound = np.abs(det) * relative
        bound = np.where(np.isfinite(bound), bound, _singular(M, E))
    return det, np.where(np.isnan(bound), np.inf, bound), condition


def _singular(M: Array, E: Array) -> Array:
    """How far det(M + E) may be from det M, for any M: each term of its expansion by rows keeps to Hadamard's bound."""
    size = M.shape[1]
    own = 3 * size**2 * UNIT * np.abs(M).max(axis=(1, 2), keepdims=True)  # the factorisation's rounding
    rows, off = np.linalg.norm(M, axis=2), np.linalg.norm(E + own, axis=2)
    return np.prod(rows + off, axis=1) - np.prod(rows, axis=1)


def invariants(M: Array, E: Array, scale: float) -> tuple[Residuals, ...]:
    """For each order k, M*ωᵏ − scaleᵏ ωᵏ: Poincaré's integral invariants, coefficient by coefficient.

    ωᵏ/k! has on the directions S the coefficient Pf(J[S, S]), and its pull-back Pf((Mᵀ J M)[S, S]). Arnold (1989),
    section 44. Empty for more than `LARGEST_FOR_INVARIANTS` degrees of freedom.
    """
    count, size, _ = M.shape
    n = size // 2
    if n > LARGEST_FOR_INVARIANTS:
        return ()
    up, down = np.swapaxes(M[:, :n], 1, 2), np.swapaxes(M[:, n:], 1, 2)
    off_up, off_down = np.swapaxes(E[:, :n], 1, 2), np.swapaxes(E[:, n:], 1, 2)
    X, bound = _product(up, off_up, down, off_down)
    L, L_bound = X - np.swapaxes(X, 1, 2), bound + np.swapaxes(bound, 1, 2) + UNIT * np.abs(X - np.swapaxes(X, 1, 2))
    found = []
    known: dict[tuple[int, ...], tuple[Array, Array]] = {(): (np.ones(count), np.zeros(count))}
    for order in range(1, n + 1):
        sizes, bounds = [], []
        for S in combinations(range(size), 2 * order):
            value, error = known[S] = _pfaffian(S, L, L_bound, known)
            pairs = all(i + n in S for i in S[:order]) and S[:order] == tuple(i for i in S if i < n)
            sign = (-1.0) ** (order * (order - 1) // 2)
            expected = sign * scale**order if pairs else 0.0
            sizes.append(np.abs(value - expected))
            bounds.append(error + UNIT * (np.abs(value) + abs(expected)))
        found.append(Residuals(f"order {order}", np.stack(sizes, axis=1), np.stack(bounds, axis=1)))
    return tuple(found)


def _pfaffian(
    S: tuple[int, ...], L: Array, bound: Array, known: dict[tuple[int, ...], tuple[Array, Array]]
) -> tuple[Array, Array]:
    """Pf(L[S, S]) by expansion along the first row, with a bound on its error."""
    total, error = np.zeros(L.shape[0]), np.zeros(L.shape[0])
    first, *rest = S
    for position, j in enumerate(rest):
        minor, minor_error = known[tuple(rest[:position] + rest[position + 1 :])]
        entry, off = L[:, first, j], bound[:, first, j]
        term = entry * minor
        total = total + (-1) ** position * term
        error = error + off * (np.abs(minor) + minor_error) + np.abs(entry) * minor_error
        error = error + len(S) * UNIT * np.abs(term)
    return total, error
