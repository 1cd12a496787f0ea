"""jax's compiler, asked for the widest vector registers that the processor has.

XLA prefers 256 bits where the processor has 512, for the sake of old ones that slow down at them. Loops over points and
orbits are elementwise, and take half to three quarters of the time at 512; what each number is does not depend on it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, Final

WIDE: Final = {"xla_cpu_prefer_vector_width": 512}


def compiled(function: Callable[..., Any]) -> Any:
    """`jax.jit` of a function that is called from Python alone: within another program it can't be compiled so."""
    import jax

    options = _options()
    return jax.jit(function, compiler_options=options) if options else jax.jit(function)


@lru_cache(maxsize=1)
def _options() -> dict[str, int]:
    """What this version of jax takes of `WIDE`, on a processor."""
    import jax

    if jax.default_backend() != "cpu":
        return {}
    try:
        jax.jit(lambda x: x, compiler_options=WIDE).lower(0.0).compile()
    except jax.errors.JaxRuntimeError:  # no such option
        return {}
    return WIDE
