"""The phase space of a constrained system as a surface in that of all coordinates: its tangents, points put on it."""

from __future__ import annotations

from typing import Any

import numpy as np

from canon.numeric.integrators.constrained import Held, gradients, onto_surface
from canon.numeric.integrators.multipliers import along
from canon.numeric.precision import double


def tangents(problem: Held, q: np.ndarray, p: np.ndarray, t: float) -> np.ndarray:
    """An orthonormal basis (2n, 2(n − m)) of what g(q, t) = 0 and its rate leave at a state, at this time."""
    import jax
    import jax.numpy as jnp

    n = len(q)

    def kept(z: Any) -> Any:
        x, y = z[:n], z[n:]
        values, rows, rates = gradients(problem, x, t)
        velocity = problem.rates(x, y, t)[0]
        return jnp.concatenate([jnp.asarray(values), jnp.asarray(along(rows, velocity, rates))])

    with double():
        normals = np.asarray(jax.jit(jax.jacfwd(kept))(jnp.concatenate([jnp.asarray(q), jnp.asarray(p)])))
    _, _, rows = np.linalg.svd(normals)
    return rows[len(normals) :].T


def tangent_places(problem: Held, q: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Orthonormal bases (samples, n, n − m) of the velocities that the constraints allow at places (samples, n)."""
    import jax
    import jax.numpy as jnp

    with double():
        rows = jax.jit(lambda x, s: jnp.asarray(gradients(problem, x, s)[1]))(jnp.asarray(q).T, jnp.asarray(t))
        normals = np.moveaxis(np.asarray(rows), -1, 0)
    _, _, bases = np.linalg.svd(normals)
    return np.swapaxes(bases[:, normals.shape[1] :], 1, 2)


def put_on(problem: Held, points: np.ndarray, t: float) -> np.ndarray:
    """Phase points (k, 2n) near the surface, put on it."""
    import jax
    import jax.numpy as jnp

    n = points.shape[1] // 2
    with double():
        move = jax.jit(lambda x, y: jnp.concatenate(onto_surface(problem, x, y, t)))
        return np.asarray(move(jnp.asarray(points[:, :n].T), jnp.asarray(points[:, n:].T))).T
