"""What an integrator's flow does to neighbours of an orbit: its derivative, loops carried along, and the way back."""

from __future__ import annotations

from typing import Any

import numpy as np

from canon.numeric.integrate import flow_map, integrate
from canon.numeric.integrators.stepper import Method
from canon.numeric.precision import double

Array = np.ndarray


def flow_jacobian(problem: Any, method: Method, q: Array, p: Array, *, steps: int, h: float, t0: float) -> Array:
    """M (2n, 2n), the derivative of the flow of `steps` steps from t0 at a state (q, p): the variational equations,
    solved by the very steps of the integrator.
    """
    import jax
    import jax.numpy as jnp

    n = len(q)
    with double():
        mapped = flow_map(problem, method, steps=steps, h=h, t0=t0)

        def flat(z: Any) -> Any:
            return jnp.concatenate(mapped((z[:n], z[n:])))

        return np.asarray(jax.jit(jax.jacfwd(flat))(jnp.concatenate([jnp.asarray(q), jnp.asarray(p)])))


def transported(problem: Any, method: Method, points: Array, *, steps: int, duration: float, t0: float) -> Array:
    """Phase points (N, 2n), all after the same number of steps; nan where one of them gets lost."""
    n = points.shape[1] // 2
    state = (np.ascontiguousarray(points[:, :n].T), np.ascontiguousarray(points[:, n:].T))
    run = integrate(problem, method, state, duration=duration, steps=steps, t0=t0, batched=True)
    return np.concatenate([np.asarray(slot) for slot in run.state], axis=0).T if run.completed == 2 else points * np.nan


def shifted(problem: Any, method: Method, points: Array, times: Array, *, steps: int, t0: float) -> Array:
    """Phase points (N, 2n) at t0, each after a time (N,) of its own."""
    import jax
    import jax.numpy as jnp

    n = points.shape[1] // 2
    with double():

        def one(z: Any, span: Any) -> Any:
            return jnp.concatenate(flow_map(problem, method, steps=steps, h=span / steps, t0=t0)((z[:n], z[n:])))

        return np.asarray(jax.jit(jax.vmap(one))(jnp.asarray(points), jnp.asarray(times)))
