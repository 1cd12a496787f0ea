"""Which engine computes the steps of a run: XLA, or native code of this package's own."""

from __future__ import annotations

from functools import lru_cache
from importlib.util import find_spec
from typing import Final, Literal

from canon.errors import InputError

Engine = Literal["auto", "native", "xla"]
Settled = Literal["native", "xla"]
ENGINES: Final[tuple[Engine, ...]] = ("auto", "native", "xla")
MISSING: Final = "the native engine is not installed: pip install 'canon-mechanics[native]', or choose the engine xla"


def settled(engine: Engine, batched: bool = False) -> Settled:
    """The engine by which a run is begun. "auto" is the native one where it is installed and jax has one processor.

    **Raises:** `InputError` where the native one is asked for and not installed, or there is no engine of this name.
    """
    if engine not in ENGINES:
        raise InputError(f"there is no engine {engine!r}: one of {', '.join(ENGINES)}")
    if engine == "auto":
        return "native" if installed() and _one_processor(batched) else "xla"
    if engine == "native" and not installed():
        raise InputError(MISSING)
    return engine


@lru_cache(maxsize=1)
def installed() -> bool:
    """Whether the optional extra `native` is there."""
    return find_spec("llvmlite") is not None


def _one_processor(batched: bool) -> bool:
    """Whether jax would compute on this processor alone: orbits are divided among devices, if there are more."""
    import jax

    return jax.default_backend() == "cpu" and not (batched and len(jax.devices()) > 1)
