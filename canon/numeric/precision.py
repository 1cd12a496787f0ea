"""Double precision inside this package's own entry points, whatever the host program has chosen for jax."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

import numpy as np

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


def unit_of(dtype: np.dtype) -> float:
    """The unit roundoff of a floating-point type."""
    known = {name: unit for unit, name in NAMES.items()}
    return known[str(dtype)] if str(dtype) in known else float(np.finfo(dtype).eps) / 2
