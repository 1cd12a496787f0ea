"""Parts with closed flows, for splittings: quadratic Hamiltonians, Kepler's motion, and damping.

What depends on a substep's length alone (cosines, exponentials, matrices) is prepared once, outside all loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators.normal_mode_flow import coupled, flow_blocks, modes_of
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
    modes = modes_of(inverse_mass, K)
    turns, planes = _planes(W)
    turning = bool(W.any())

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        blocks = flow_blocks(modes, lengths)
        if not turning:
            return blocks
        angle = jnp.asarray(turns) * jnp.asarray(lengths)[:, None]
        less = jnp.einsum("sk,kij->sij", -2 * jnp.sin(angle / 2) ** 2, np.array([real for real, _ in planes]))
        less = less + jnp.einsum("sk,kij->sij", jnp.sin(angle), np.array([imag for _, imag in planes]))
        turned = [block + jnp.einsum("sij,sjk->sik", less, block) for block in blocks]
        return (turned[0] + less, *turned[1:3], turned[3] + less)

    used = _pattern(K, W)

    def flow(state: State, blocks: Any, t: Any) -> State:
        q, p, *others = state
        qq, qp, pq, pp = blocks
        return (_moved(q, (qq, q), (qp, p), used), _moved(p, (pq, q), (pp, p), used), *others)

    return ExactPart(flow, prepare, name)


def commutes(masses: np.ndarray, K: np.ndarray, W: np.ndarray) -> bool:
    """Whether qᵀ W p commutes with Σ p²/2m + ½ qᵀ K q: W is antisymmetric and commutes with both matrices.

    Each entry is compared with its own terms: beside a stiff spring a weak one is no rounding.
    """

    def agree(A: np.ndarray, B: np.ndarray, sizes: np.ndarray) -> bool:
        return bool(np.all(np.abs(A - B) <= _SYMMETRIC * sizes))

    sizes = np.abs(W)
    pairs = [(W @ X, X @ W, sizes @ np.abs(X) + np.abs(X) @ sizes) for X in (masses, K)]
    return agree(W, -W.T, sizes) and agree(K, K.T, np.abs(K)) and all(agree(*pair) for pair in pairs)


def _planes(W: np.ndarray) -> tuple[np.ndarray, list[tuple[np.ndarray, np.ndarray]]]:
    """The rates of exp(hW), and what its cosines and sines multiply: of each set of coupled coordinates by itself."""
    n = len(W)
    rates, planes = [], []
    for block in coupled(W):
        turns, vectors = np.linalg.eigh(1j * W[np.ix_(block, block)].T)
        for rate, v in zip(turns, vectors.T, strict=True):
            real, imaginary = np.zeros((n, n)), np.zeros((n, n))
            whole = np.outer(v, v.conj())
            real[np.ix_(block, block)], imaginary[np.ix_(block, block)] = np.real(whole), np.imag(whole)
            rates.append(rate)
            planes.append((real, imaginary))
    return np.array(rates), planes


def _pattern(K: np.ndarray, W: np.ndarray) -> list[list[int]]:
    """For every coordinate, the ones that the flow couples it to."""
    near = (K != 0) | (W != 0) | np.eye(len(K), dtype=bool)
    for _ in K:
        near = (near.astype(int) @ near.astype(int)) > 0
    return [[int(j) for j in np.flatnonzero(row)] for row in near]


def _moved(at: Any, first: Any, second: Any, used: list[list[int]]) -> Any:
    """z + A x + B y by rows, without the products that are known to be zero."""
    import jax.numpy as jnp

    (A, x), (B, y) = first, second
    values = []
    for i, columns in enumerate(used):
        terms = [A[i, j] * x[j] + B[i, j] * y[j] for j in columns]
        values.append(at[i] + sum(terms[1:], start=terms[0]))
    return tuple(values) if isinstance(at, tuple) else jnp.stack(values)


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

        return jnp.expm1(-2 * jnp.asarray(lengths).reshape(-1, *(1,) * rates.ndim) * rates)

    def flow(state: State, factor: Any, t: Any) -> State:
        import jax

        p = state[slot]
        if isinstance(p, tuple):
            damped: Any = tuple(x + x * (factor[i] if rates.ndim else factor) for i, x in enumerate(p))
        else:
            damped = jax.tree.map(lambda x: x + x * factor.reshape(factor.shape + (1,) * (x.ndim - factor.ndim)), p)
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

        return jnp.einsum("ik,sk,jk->sij", left, jnp.expm1(-jnp.asarray(lengths)[:, None] * rates), right)

    used = _pattern(alpha, np.zeros_like(alpha))

    def flow(state: State, block: Any, t: Any) -> State:
        p = state[slot]
        zero = np.zeros((len(used), len(used)))
        return (*state[:slot], _moved(p, (block, p), (zero, p), used), *state[slot + 1 :])

    return ExactPart(flow, prepare, "damping", hamiltonian=False)
