"""Which engine computes the steps of a run: XLA, or native code of this package's own."""

from __future__ import annotations

from functools import lru_cache
from typing import Final, Literal

from canon.errors import InputError

Engine = Literal["auto", "native", "xla"]
Settled = Literal["native", "xla"]
ENGINES: Final[tuple[Engine, ...]] = ("auto", "native", "xla")
MISSING: Final = "the native engine is not installed: pip install 'canon-mechanics[native]', or choose the engine xla"
BROKEN: Final = "the native engine can't be used ({}): install 'canon-mechanics[native]' anew, or choose the engine xla"


def settled(engine: Engine, batched: bool = False) -> Settled:
    """The engine by which a run is begun. "auto" is the native one where it is installed and jax has one processor.

    **Raises:** `InputError` where the native one is asked for and can't be used, or there is no engine of this name.
    """
    if engine not in ENGINES:
        raise InputError(f"there is no engine {engine!r}: one of {', '.join(ENGINES)}")
    if engine == "auto":
        return "native" if installed() and _one_processor(batched) else "xla"
    if engine == "native" and (fault := hindrance()):
        raise InputError(fault)
    return engine


def installed() -> bool:
    """Whether the optional extra `native` is there, and can be used."""
    return not hindrance()


@lru_cache(maxsize=1)
def hindrance() -> str:
    """Why there is no native engine: it isn't installed, or its library is broken. Nothing where it can be used."""
    try:
        from canon.numeric.native.compile import tried

        tried()
    except ModuleNotFoundError as error:
        return MISSING if (error.name or "").partition(".")[0] == "llvmlite" else BROKEN.format(error)
    except Exception as error:  # whatever a library of other versions, or half of one, may raise
        return BROKEN.format(" ".join(f"{type(error).__name__}: {error}".split()))
    return ""


def _one_processor(batched: bool) -> bool:
    """Whether jax would compute on this processor alone: orbits are divided among devices, if there are more."""
    import jax

    return jax.default_backend() == "cpu" and not (batched and len(jax.devices()) > 1)
