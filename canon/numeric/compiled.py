"""jax's compiler, asked for the widest vector registers that the processor has, or to be quick.

XLA prefers 256 bits where the processor has 512, for the sake of old ones that slow down at them. Loops over points and
orbits are elementwise, and take half to three quarters of the time at 512; what each number is does not depend on it.

The program of one orbit has nothing to gain from the generators of code for fused loops over arrays, which take half of
its compilation: without them it is compiled in half the time, and runs as fast.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, Final

WIDE: Final = {"xla_cpu_prefer_vector_width": 512}
LEAN: Final = {"xla_cpu_use_fusion_emitters": False}


def compiled(function: Callable[..., Any]) -> Any:
    """`jax.jit` of a function that is called from Python alone: within another program it can't be compiled so."""
    import jax

    return jax.jit(function, compiler_options=_taken(tuple(WIDE.items())))


def compiled_soon(function: Callable[..., Any]) -> Any:
    """The same of a function of few numbers, one orbit's: what counts is how soon it is compiled."""
    import jax

    return jax.jit(function, compiler_options=_taken(tuple(LEAN.items())))


@lru_cache(maxsize=2)
def _taken(options: tuple[tuple[str, Any], ...]) -> dict[str, Any] | None:
    """The options, where this version of jax takes them, on a processor."""
    import jax

    if jax.default_backend() != "cpu":
        return None
    try:
        jax.jit(lambda x: x, compiler_options=dict(options)).lower(0.0).compile()
    except jax.errors.JaxRuntimeError:  # no such option
        return None
    return dict(options)
