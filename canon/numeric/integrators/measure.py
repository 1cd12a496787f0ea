"""Measures an integrator's traits on a problem: its order above the rounding plateau, and what its step preserves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from canon.numeric.compiled import compiled_soon
from canon.numeric.integrate import flow_map, integrate
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method
from canon.numeric.precision import double


def errors(
    problem: Any, method: Method, state: State, reference: State, *, duration: float, steps: Sequence[int]
) -> np.ndarray:
    """The largest error of a component at the end, for each number of steps."""
    exact = _flat(reference)
    runs = (
        integrate(problem, method, state, duration=duration, steps=count, compensated=False).state for count in steps
    )
    return np.array([np.abs(_flat(found) - exact).max() for found in runs])


def measured_order(
    problem: Any, method: Method, state: State, reference: State, *, duration: float, steps: Sequence[int]
) -> float:
    """The slope of log error over log h between the two largest numbers of steps: choose them above the plateau."""
    last, best = errors(problem, method, state, reference, duration=duration, steps=steps[-2:])
    return float(np.log(last / best) / np.log(steps[-1] / steps[-2]))


def jacobian(problem: Any, method: Method, state: State, *, h: float, steps: int = 1) -> np.ndarray:
    """M, the derivative of the map of `steps` steps, in the order of the state's components."""
    import jax
    import jax.numpy as jnp
    from jax.flatten_util import ravel_pytree

    with double():
        flat, restore = ravel_pytree(jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state))
        mapped = flow_map(problem, method, steps=steps, h=h)
        return np.asarray(compiled_soon(jax.jacfwd(lambda z: ravel_pytree(mapped(restore(z)))[0]))(flat))


@dataclass(frozen=True)
class StepMeasures:
    """How far a step of h is from being symplectic, from preserving volume, and from being undone by one of −h.

    ‖M J Mᵀ − J‖ in the largest entry for states (q, p), |det M − 1|, and the largest component of what is left.
    """

    symplecticity: float
    volume: float
    asymmetry: float


def measure_step(problem: Any, method: Method, state: State, *, h: float, t0: float = 0.0) -> StepMeasures:
    """The properties of one step, measured at a state of slots (q, p)."""
    import jax
    import jax.numpy as jnp
    from jax.flatten_util import ravel_pytree

    with double():
        flat, restore = ravel_pytree(jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state))
        there = flow_map(problem, method, steps=1, h=h, t0=t0)
        back = flow_map(problem, method, steps=1, h=-h, t0=t0 + h)

        @compiled_soon
        def measured(z: Any) -> Any:
            M, after = jax.jacfwd(lambda x: (ravel_pytree(there(restore(x)))[0],) * 2, has_aux=True)(z)
            return M, ravel_pytree(back(restore(after)))[0] - z

        M, left = map(np.asarray, measured(flat))
    n = len(M) // 2
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    symplecticity = np.abs(M @ J @ M.T - J).max() if len(M) == 2 * n else np.inf
    return StepMeasures(float(symplecticity), abs(float(np.linalg.det(M)) - 1), float(np.abs(left).max()))


def _flat(state: State) -> np.ndarray:
    import jax

    return np.concatenate([np.ravel(x) for x in jax.tree.leaves(state)])


def symplectic_defect_of_a_step(
    problem: Any, method: Method, state: tuple[np.ndarray, np.ndarray], h: float, *, t0: float = 0.0
) -> float:
    """max |M J Mᵀ − J| of the derivative M of one step of length h at a state (q, p); compiled once for all h."""
    with double():
        M = np.asarray(_derivative(problem, method)(np.concatenate(state), h, t0))
    n = len(M) // 2
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return float(np.abs(M @ J @ M.T - J).max())


@lru_cache(maxsize=32)
def _derivative(problem: Any, method: Method) -> Any:
    import jax
    import jax.numpy as jnp

    def stepped(z: Any, h: Any, t0: Any) -> Any:
        n = z.shape[0] // 2
        return jnp.concatenate(flow_map(problem, method, steps=1, h=h, t0=t0)((z[:n], z[n:])))

    return compiled_soon(jax.jacfwd(stepped))
