"""Sp(2n, R): flows of quadratic Hamiltonians, and back.

Conditioning: exp(J S) is off by some 1 + |J S| roundings of its norm, at most five times as many in what was tried, up
to |J S| = 100: entries far below the largest lose what they are smaller by, and `log` of such a matrix has nan.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from canon.numeric.symplectic_matrix import unit_form

ROOTS: Final = 4
NEWTON_STEPS: Final = 12
NODES: Final = 12

KNOWN: Final = 1e-6
"""So much of M's largest entry the exponential of its logarithm may be off; it is all where the roots fail."""


def generator(S: Any) -> Any:
    """J S (…, 2n, 2n) for a symmetric S: ż = J S z are Hamilton's equations of H = zᵀ S z / 2, z = (q, p)."""
    import jax.numpy as jnp

    return jnp.asarray(unit_form(S.shape[-1] // 2), dtype=S.dtype) @ S


def exp(S: Any) -> Any:
    """The symplectic matrix exp(J S) (…, 2n, 2n): the flow of zᵀ S z / 2 to time 1. Scaling, squaring, Padé."""
    from jax.scipy.linalg import expm

    return expm(generator(S))


def log(M: Any) -> Any:
    """The symmetric S (…, 2n, 2n) with exp(J S) = M, for a symplectic M without eigenvalues on the negative real axis.

    nan where exp(J S) doesn't give M back: for other M, which may have no real logarithm at all, and where M is so
    ill conditioned that its rounded entries don't know S.

    Square roots by Newton's iteration in product form, with M^(1/2^k) − 1 kept to full relative precision by
    (M − 1)/(M^(1/2) + 1), then Gauss' quadrature of the integral of (M − 1)/(1 + x (M − 1)).
    Higham, Functions of Matrices (2008), 11.5; eq. 6.29 for the roots.
    """
    import jax
    import jax.numpy as jnp

    one = jnp.eye(M.shape[-1], dtype=M.dtype)

    def halved(_: int, rest: Any) -> Any:
        root = _square_root(one + rest)
        return jnp.swapaxes(jnp.linalg.solve(jnp.swapaxes(root + one, -1, -2), jnp.swapaxes(rest, -1, -2)), -1, -2)

    rest = jax.lax.fori_loop(0, ROOTS, halved, M - one)
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    x = jnp.asarray((nodes + 1) / 2, dtype=M.dtype).reshape(NODES, *([1] * M.ndim))
    parts = jnp.linalg.solve(one + x * rest, jnp.broadcast_to(rest, (NODES, *rest.shape)))
    total = jnp.tensordot(jnp.asarray(weights / 2, dtype=M.dtype), parts, 1)
    J = jnp.asarray(unit_form(M.shape[-1] // 2), dtype=M.dtype)
    S = -J @ (2.0**ROOTS * total)
    S = (S + jnp.swapaxes(S, -1, -2)) / 2
    gap = jnp.abs(exp(jax.lax.stop_gradient(S)) - M).max((-2, -1), keepdims=True)
    return jnp.where(gap <= KNOWN * jnp.abs(M).max((-2, -1), keepdims=True), S, jnp.nan)


def _square_root(M: Any) -> Any:
    """The principal square root: X ← X (1 + P⁻¹)/2, P ← (1 + (P + P⁻¹)/2)/2 from X = P = M."""
    import jax
    import jax.numpy as jnp

    one = jnp.eye(M.shape[-1], dtype=M.dtype)

    def improved(_: int, pair: Any) -> Any:
        X, P = pair
        inverse = jnp.linalg.inv(P)
        return X @ (one + inverse) / 2, (one + (P + inverse) / 2) / 2

    return jax.lax.fori_loop(0, NEWTON_STEPS, improved, (M, M))[0]
