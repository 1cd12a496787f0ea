"""Parts with closed flows, for splittings: quadratic Hamiltonians, Kepler's motion, and damping.

What depends on a substep's length alone (cosines, exponentials, matrices) is prepared once, outside all loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators.problem import ExactPart, State

_SYMMETRIC: Final = 1e-12


def quadratic_part(
    inverse_mass: Sequence[float], stiffness: Any = None, rotation: Any = None, name: str = "quadratic"
) -> ExactPart:
    """The flow of H = Σ p_i²/2m_i + ½ qᵀ K q + qᵀ W p on slots (q, p), W antisymmetric.

    It is exp(hW) times the oscillations of the normal modes, whatever the signs of their squares: a rotating frame
    −Ω·(x × p) has W; a charge in a uniform magnetic field, in the symmetric gauge, W and K.

    **Arguments:** `inverse_mass` (n,); `stiffness` K (n, n), symmetric; `rotation` W (n, n).

    **Raises:** `InputError` where W does not commute with the rest, so that the flow is no such product.
    """
    n = len(inverse_mass)
    masses = np.diag(np.asarray(inverse_mass, dtype=float))
    K = np.zeros((n, n)) if stiffness is None else np.asarray(stiffness, dtype=float)
    W = np.zeros((n, n)) if rotation is None else np.asarray(rotation, dtype=float)
    if not commutes(masses, K, W):
        raise InputError(f"{name}: the rotation does not commute with the kinetic energy and the stiffness")
    root = np.sqrt(np.diag(masses))
    squares, modes = np.linalg.eigh(root[:, None] * K * root[None, :])
    turns, vectors = np.linalg.eigh(1j * W.T)
    left, right = root[:, None] * modes, np.divide(1.0, root)[:, None] * modes
    planes = [(np.real(np.outer(v, v.conj())), np.imag(np.outer(v, v.conj()))) for v in vectors.T]
    turning = bool(W.any())

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        from canon.numeric.exact.stumpff import stumpff

        h = jnp.asarray(lengths)[:, None]
        c0, c1, _, _ = stumpff(jnp.asarray(squares) * h * h)
        qq = jnp.einsum("ik,sk,jk->sij", left, c0, right)
        qp = jnp.einsum("ik,sk,jk->sij", left, h * c1, left)
        pq = jnp.einsum("ik,sk,jk->sij", right, -squares * h * c1, right)
        pp = jnp.einsum("ik,sk,jk->sij", right, c0, left)
        if not turning:
            return qq, qp, pq, pp
        angle = jnp.asarray(turns) * h
        turn = jnp.einsum("sk,kij->sij", jnp.cos(angle), np.array([real for real, _ in planes]))
        turn = turn + jnp.einsum("sk,kij->sij", jnp.sin(angle), np.array([imag for _, imag in planes]))
        return tuple(jnp.einsum("sij,sjk->sik", turn, block) for block in (qq, qp, pq, pp))

    used = _pattern(K, W)

    def flow(state: State, blocks: Any, t: Any) -> State:
        q, p, *others = state
        qq, qp, pq, pp = blocks
        return (_rows(q, (qq, q), (qp, p), used), _rows(p, (pq, q), (pp, p), used), *others)

    return ExactPart(flow, prepare, name)


def commutes(masses: np.ndarray, K: np.ndarray, W: np.ndarray) -> bool:
    """Whether qᵀ W p commutes with Σ p²/2m + ½ qᵀ K q: W is antisymmetric and commutes with both matrices."""
    size = max(1.0, float(np.abs(W).max(initial=0)) * max(np.abs(K).max(initial=0), masses.max(initial=0)))
    rests = (W + W.T, W @ masses - masses @ W, W @ K - K @ W, K - K.T)
    return all(bool(np.abs(rest).max(initial=0) <= _SYMMETRIC * size) for rest in rests)


def _pattern(K: np.ndarray, W: np.ndarray) -> list[list[int]]:
    """For every coordinate, the ones that the flow couples it to."""
    near = (K != 0) | (W != 0) | np.eye(len(K), dtype=bool)
    for _ in K:
        near = (near.astype(int) @ near.astype(int)) > 0
    return [[int(j) for j in np.flatnonzero(row)] for row in near]


def _rows(like: Any, first: Any, second: Any, used: list[list[int]]) -> Any:
    """A x + B y by rows, without the products that are known to be zero."""
    import jax.numpy as jnp

    (A, x), (B, y) = first, second
    values = []
    for i, columns in enumerate(used):
        terms = [A[i, j] * x[j] + B[i, j] * y[j] for j in columns]
        values.append(sum(terms[1:], start=terms[0]))
    return tuple(values) if isinstance(like, tuple) else jnp.stack(values)


def kepler_part(mass: float, a: float) -> ExactPart:
    """The flow of H = p²/2m − a/|q| on slots (q, p): Kepler's motion in closed form."""

    def flow(state: State, h: Any, t: Any) -> State:
        import jax

        from canon.numeric.exact.kepler import kepler

        q, p, *others = state
        q, v = kepler(q, jax.tree.map(lambda x: x / mass, p), a / mass, h)
        return (q, jax.tree.map(lambda x: mass * x, v), *others)

    return ExactPart(flow, name="Kepler")


def damping_part(rate: Any, slot: int = 1) -> ExactPart:
    """ṗ = −2 rate p, the force −2 m rate v: `rate`, a number, or one for each coordinate (n,).

    With a Hamiltonian flow it makes a conformal symplectic method: M J Mᵀ = exp(−2 rate t) J for one rate for all.
    McLachlan and Perlmutter (2001), J. Geom. Phys. 39, 276.
    """
    rates = np.asarray(rate, dtype=float)

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        return jnp.exp(-2 * jnp.asarray(lengths).reshape(-1, *(1,) * rates.ndim) * rates)

    def flow(state: State, factor: Any, t: Any) -> State:
        import jax

        p = state[slot]
        if isinstance(p, tuple):
            damped: Any = tuple(x * (factor[i] if rates.ndim else factor) for i, x in enumerate(p))
        else:
            damped = jax.tree.map(lambda x: x * factor.reshape(factor.shape + (1,) * (x.ndim - factor.ndim)), p)
        return (*state[:slot], damped, *state[slot + 1 :])

    return ExactPart(flow, prepare, "damping", hamiltonian=False)


def rayleigh_part(matrix: Any, mass: Sequence[float], slot: int = 1) -> ExactPart:
    """ṗ = −α v with v = p/m, of Rayleigh's dissipation function ½ vᵀ α v: `matrix` α (n, n), symmetric; `mass` (n,).

    **Raises:** `InputError` where α is not symmetric: Rayleigh's function knows no other part of it.
    """
    alpha = np.asarray(matrix, dtype=float)
    if alpha.shape != (len(mass),) * 2 or not np.allclose(alpha, alpha.T, rtol=1e-14, atol=0):
        raise InputError(f"Rayleigh's matrix is symmetric, {len(mass)} × {len(mass)}; this is {alpha.tolist()}")
    root = np.sqrt(np.asarray(mass, dtype=float))
    rates, modes = np.linalg.eigh(alpha / root[:, None] / root[None, :])
    left, right = root[:, None] * modes, modes / root[:, None]

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        return jnp.einsum("ik,sk,jk->sij", left, jnp.exp(-jnp.asarray(lengths)[:, None] * rates), right)

    used = _pattern(alpha, np.zeros_like(alpha))

    def flow(state: State, block: Any, t: Any) -> State:
        p = state[slot]
        zero = np.zeros((len(used), len(used)))
        return (*state[:slot], _rows(p, (block, p), (zero, p), used), *state[slot + 1 :])

    return ExactPart(flow, prepare, "damping", hamiltonian=False)
