"""What an integrator's flow does to neighbours of an orbit: its derivative, loops carried along, and the way back.

A phase point has q before p: `first` counts the entries of q, half of all where it is left out.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from canon.numeric.compiled import compiled_soon
from canon.numeric.integrate import flow_map, integrate
from canon.numeric.integrators.stepper import Method
from canon.numeric.precision import double

Array = np.ndarray

STENCIL: Final = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
"""Of a central difference of order 8, at 1, 2, 3, 4 times its width. Fornberg (1988), Math. Comp. 51, 699."""
WIDTHS: Final = (2e-3, 4e-3)


def flow_jacobian(problem: Any, method: Method, q: Array, p: Array, *, steps: int, h: float, t0: float) -> Array:
    """M (N, N), the derivative of the flow of `steps` steps from t0 at a state (q, p): the variational equations,
    solved by the very steps of the integrator.
    """
    import jax
    import jax.numpy as jnp

    n = len(q)
    with double():
        mapped = flow_map(problem, method, steps=steps, h=h, t0=t0)

        def flat(z: Any) -> Any:
            return jnp.concatenate(mapped((z[:n], z[n:])))

        return np.asarray(compiled_soon(jax.jacfwd(flat))(jnp.concatenate([jnp.asarray(q), jnp.asarray(p)])))


def flow_differences(
    problem: Any,
    method: Method,
    curves: Any,
    *,
    first: int,
    steps: int,
    duration: float,
    t0: float,
) -> tuple[Array, float]:
    """The derivative (N, d) of the flow along d curves of phase points, by central differences of order 8, and how far
    it may be off: for flows in closed form, whose own derivatives lose digits.

    **Arguments:** `curves(s)` takes parameters (k,) to points (k, d, N), smooth at s = 0.
    """
    places = np.array([sign * width * k for width in WIDTHS for k in (1, 2, 3, 4) for sign in (1, -1)])
    points = curves(places)
    shape = points.shape
    after = transported(
        problem, method, points.reshape(-1, shape[-1]), steps=steps, duration=duration, t0=t0, first=first
    ).reshape(len(WIDTHS), len(STENCIL), 2, *shape[1:])
    slopes = np.einsum("k,wkij->wij", STENCIL, after[:, :, 0] - after[:, :, 1]) / np.reshape(WIDTHS, (-1, 1, 1))
    return slopes[0].T, float(np.abs(slopes[1] - slopes[0]).max())


def transported(
    problem: Any, method: Method, points: Array, *, steps: int, duration: float, t0: float, first: int | None = None
) -> Array:
    """Phase points (k, N), all after the same number of steps; nan where one of them gets lost."""
    return transported_along(problem, method, points, steps=steps, duration=duration, t0=t0, first=first)[-1]


def transported_along(
    problem: Any,
    method: Method,
    points: Array,
    *,
    steps: int,
    duration: float,
    t0: float,
    samples: int = 2,
    first: int | None = None,
) -> Array:
    """Phase points (k, N) at `samples` equidistant times (samples, k, N), the first one included; nan from where all of
    them are lost.
    """
    n = points.shape[1] // 2 if first is None else first
    state = (np.ascontiguousarray(points[:, :n].T), np.ascontiguousarray(points[:, n:].T))
    run = integrate(problem, method, state, duration=duration, steps=steps, samples=samples, t0=t0, batched=True)
    found = np.full((samples, *points.shape), np.nan)
    found[: run.completed] = np.concatenate([np.asarray(slot) for slot in run.states], axis=1).transpose(0, 2, 1)
    return found


def shifted(
    problem: Any,
    method: Method,
    points: Array,
    times: Array,
    *,
    steps: int,
    t0: float,
    first: int | None = None,
) -> Array:
    """Phase points (k, N) at t0, each after a time (k,) of its own."""
    import jax
    import jax.numpy as jnp

    n = points.shape[1] // 2 if first is None else first
    with double():

        def one(z: Any, span: Any) -> Any:
            return jnp.concatenate(flow_map(problem, method, steps=steps, h=span / steps, t0=t0)((z[:n], z[n:])))

        return np.asarray(jax.jit(jax.vmap(one))(jnp.asarray(points), jnp.asarray(times)))
