"""Measures an integrator's traits on a problem: its order above the rounding plateau, and what its step preserves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

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
        return np.asarray(jax.jit(jax.jacfwd(lambda z: ravel_pytree(mapped(restore(z)))[0]))(flat))


def symplecticity(problem: Any, method: Method, state: State, *, h: float, steps: int = 1) -> float:
    """‖M J Mᵀ − J‖ of a map of states (q, p), in the largest entry."""
    M = jacobian(problem, method, state, h=h, steps=steps)
    n = len(M) // 2
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return float(np.abs(M @ J @ M.T - J).max())


def volume(problem: Any, method: Method, state: State, *, h: float, steps: int = 1) -> float:
    """|det M − 1|."""
    return abs(float(np.linalg.det(jacobian(problem, method, state, h=h, steps=steps))) - 1)


def asymmetry(problem: Any, method: Method, state: State, *, h: float) -> float:
    """How far a step of −h after a step of h is from the identity, in the largest component."""
    import jax
    import jax.numpy as jnp

    with double():
        there = flow_map(problem, method, steps=1, h=h)
        back = flow_map(problem, method, steps=1, h=-h, t0=h)
        state = jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state)
        return float(np.abs(_flat(jax.jit(lambda z: back(there(z)))(state)) - _flat(state)).max())


def _flat(state: State) -> np.ndarray:
    import jax

    return np.concatenate([np.ravel(x) for x in jax.tree.leaves(state)])
