"""Double precision inside this package's own entry points, whatever the host program has chosen for jax."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import real_array

UNIT: Final = 2.0**-53
"""The unit roundoff of float64: an operation's relative error when it rounds to nearest."""

UNIT_32: Final = 2.0**-24
"""The unit roundoff of float32."""

NAMES: Final = {UNIT: "float64", UNIT_32: "float32", 2.0**-11: "float16", 2.0**-8: "bfloat16"}
"""The types by their unit roundoff."""


@contextmanager
def double() -> Iterator[None]:
    """jax computes in 64 bits within this context; the host's setting is put back after it."""
    import jax

    with jax.enable_x64(True), np.errstate(all="ignore"):
        yield


def doubles(**given: Any) -> list[Any]:
    """Real numbers, by their arguments' names, as arrays of jax, which may trace them.

    **Raises:** `InputError` for what they aren't, and where the host has left jax in 32 bits: of these neither bounds
    nor last digits know.
    """
    import jax
    import jax.numpy as jnp

    if jnp.result_type(float) != np.float64:
        said = 'jax computes in 32 bits here, and this needs 64: jax.config.update("jax_enable_x64", True) first'
        raise InputError(said)
    found = [x if isinstance(x, jax.Array) else real_array(x, name) for name, x in given.items()]
    for name, x in zip(given, found, strict=True):
        if jnp.iscomplexobj(x):
            raise InputError("real numbers are expected, not complex ones", name)
    return [jnp.asarray(x, float) for x in found]


def unit_of(dtype: np.dtype) -> float:
    """The unit roundoff of a floating-point type."""
    known = {name: unit for unit, name in NAMES.items()}
    return known[str(dtype)] if str(dtype) in known else float(np.finfo(dtype).eps) / 2
