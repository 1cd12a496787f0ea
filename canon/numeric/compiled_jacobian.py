"""Values and Jacobian of a jax function, compiled for blocks of points: of long or large maps, and those in float32."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from canon.numeric.differences import neighbours
from canon.numeric.precision import double
from canon.numeric.rounding import Unbounded, with_rounding

Array = np.ndarray
Linearise = Callable[[Array], tuple[Array, Array]]

LARGEST_TAKEN_APART: Final = 32
"""Maps of more variables are left to jax as they are."""

MOST_POINTS: Final = 2048
MOST_ENTRIES: Final = 2**22
"""So many entries of Jacobians are computed at once, so that memory does not grow with the dimension."""

FEW: Final = 16
BLOCK: Final = 128
"""Points at once where errors are estimated: such functions are long, and each point is computed three times."""


def compiled_jacobian(
    one: Callable[[Any], Any], size: int, unit: float, *, bounds: bool = True
) -> tuple[Callable[[Array], Array], Linearise, bool]:
    """Values and Jacobian of a jax function, compiled once, for blocks of points of a fixed length; without `bounds`
    errors are estimated from neighbours.
    """
    import jax
    import jax.numpy as jnp

    block = max(1, min(MOST_POINTS, MOST_ENTRIES // size**2))

    def both(z: Any) -> Any:
        """(Z M), so that there is one program to compile."""
        M, Z = jax.jacfwd(lambda w: (one(w),) * 2, has_aux=True)(z)
        return jnp.concatenate([Z[:, None], M], axis=1)

    with double():
        try:
            if not bounds:
                raise Unbounded("asked for")
            program, bounded = with_rounding(both, jnp.zeros(size)), True
        except Unbounded:
            program, bounded = lambda z: (both(z),), False
        compiled: Any = jax.jit(jax.vmap(program))
        values: Any = jax.jit(jax.vmap(lambda z: (one(z),)))

    def call(z: Array, function: Any = compiled, length: int = block) -> list[Array]:
        parts = []
        for start in range(0, len(z), length):
            part = z[start : start + length]
            padded = np.concatenate([part, np.repeat(part[-1:], length - len(part), axis=0)])
            with double():
                parts.append([np.asarray(array, dtype=float)[: len(part)] for array in function(padded)])
        return [np.concatenate(column) for column in zip(*parts, strict=True)]

    def linearise(z: Array) -> tuple[Array, Array]:
        values, errors = call(z)
        return values[:, :, 1:], errors[:, :, 1:]

    def evaluate(z: Array) -> Array:
        if size > LARGEST_TAKEN_APART:  # the values alone are a shorter program, and Jacobians are large
            return call(z, values, FEW)[0]
        return call(z)[0][:, :, 0]

    def stretched(z: Array, stretch: float) -> Array:
        return call(z, lambda part: slopes(part, stretch), min(block, BLOCK))[0]

    if bounded:
        return evaluate, linearise, True
    with double():
        slopes: Any = jax.jit(jax.vmap(lambda z, s: (_slopes(one, z, s),), in_axes=(0, None)))
    return evaluate, neighbours(stretched, unit), False


def _slopes(one: Callable[[Any], Any], z: Any, stretch: Any) -> Any:
    """M (2n, 2n) from tangents that are longer than 1: of a linear map, too, it is rounded otherwise."""
    import jax
    import jax.numpy as jnp

    columns = jax.vmap(lambda v: jax.jvp(one, (z,), (v,))[1])(stretch * jnp.eye(z.shape[0], dtype=z.dtype))
    return columns.T / stretch
