"""A function as jax's program of it: traced, not run, so that no operation of it is compiled on its own."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.map_shape import forms
from canon.numeric.precision import double

Array = np.ndarray
ADDRESS: Final = re.compile(r" at 0x[0-9a-f]+")
"""What differs in a program's text between two objects that are the same function."""


@dataclass(frozen=True)
class Traced:
    """A map of one point as a jax program: `one` runs it, `form` says how the function takes a point.

    `steady` says that tracing it twice gave one program; `single`, that it computes in float32 somewhere.
    """

    one: Callable[[Any], Any]
    form: str
    steady: bool
    single: bool


def traced(function: Callable[..., Any], size: int) -> Traced | None:
    """The function's program, in the first form in which jax can trace it; None where there is none.

    **Raises:** `InputError` where the function returns complex numbers.
    """
    import jax

    with double():
        for form, one in forms(function, size):
            try:
                closed, shape = jax.make_jaxpr(_anew(one), return_shape=True)(np.zeros(size))
                again = jax.make_jaxpr(_anew(one))(np.zeros(size))
            except Exception:  # a function of numpy may raise anything when it is given a tracer
                continue
            if getattr(shape, "shape", None) != (size,):
                continue
            if np.issubdtype(shape.dtype, np.complexfloating):
                raise InputError("the map returns complex numbers: an audit is of a real map")
            steady = _same(closed, again) or _repeats(one, size)
            return Traced(_runner(closed), form, steady, "f32[" in str(closed))
    return None


def _anew(one: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """The same function as another object: jax remembers what it has traced."""
    return lambda z: one(z)


def _runner(closed: Any) -> Callable[[Any], Any]:
    from jax.extend.core import jaxpr_as_fun

    run = jaxpr_as_fun(closed)
    return lambda z: run(z)[0]


def _same(first: Any, second: Any) -> bool:
    """Whether two programs have the same operations and the same numbers."""
    texts = [ADDRESS.sub("", str(program.jaxpr)) for program in (first, second)]
    return texts[0] == texts[1] and all(np.array_equal(a, b) for a, b in zip(first.consts, second.consts, strict=True))


def _repeats(one: Callable[[Any], Any], size: int) -> bool:
    """Whether two evaluations agree, where two programs differ: they may differ by a name alone."""
    point = np.linspace(0.2, 0.9, size)
    first, second = (np.asarray(one(point.copy())) for _ in range(2))
    return np.array_equal(first, second, equal_nan=True)
