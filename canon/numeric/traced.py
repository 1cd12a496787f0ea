"""A function as jax's program of it: traced, not run, so that no operation of it is compiled on its own."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.map_shape import COMPLEX, WHOLE, forms
from canon.numeric.precision import UNIT, UNIT_32, double
from canon.numeric.same_program import alike

Array = np.ndarray
ADDRESS: Final = re.compile(r" at 0x[0-9a-f]+")
"""What differs in a program's text between two objects that are the same function."""
UNTOLD: Final = re.compile(r" at 0x|custom_|callback")
"""Signs that two programs of one text may differ."""
SHORT: Final = {"f32": UNIT_32, "f16": 2.0**-11, "bf16": 2.0**-8}
"""Types of fewer digits as a program's text names them, with their unit roundoffs."""


@dataclass(frozen=True)
class Source:
    """A jax program as a key: two are equal only if they have the same operations and the same numbers.

    `text` has every operation with its numbers in full, `constants` the bits of the arrays that it refers to.
    """

    text: str
    constants: tuple[bytes, ...]
    one: Callable[[Any], Any] = field(compare=False)


@dataclass(frozen=True)
class Traced:
    """A map of one point as a jax program: `one` runs it, `form` says how the function takes a point.

    `steady` says that tracing it twice gave one program; `unit` is the roundoff of its least precise type. `source` is
    the program as a key, None where its text does not say all: derivatives of its own, calls to Python.
    """

    one: Callable[[Any], Any]
    form: str
    steady: bool
    unit: float
    source: Source | None = None

    def has_derivatives(self, size: int) -> bool:
        """Whether jax can differentiate the program in forward mode: not through calls to Python, or a `custom_vjp`."""
        if self.source is not None:
            return True
        import jax

        with double():
            try:
                jax.eval_shape(jax.jacfwd(self.one), np.zeros(size))
            except Exception:  # jax raises what it likes here
                return False
        return True


def traced(function: Callable[..., Any], size: int) -> Traced | None:
    """The function's program, in the first form in which jax can trace it; None where there is none.

    **Raises:** `InputError` where the function returns complex numbers, or whole ones.
    """
    import jax

    with double():
        point = jax.ShapeDtypeStruct((size,), np.float64)
        for form, one in forms(function, size):
            try:
                first, second = (jax.jit(_anew(one)).trace(point) for _ in range(2))
            except Exception:  # a function of numpy may raise anything when it is given a tracer
                continue
            closed, again, shape = first.jaxpr, second.jaxpr, first.out_info
            if getattr(shape, "shape", None) != (size,):
                continue
            if np.issubdtype(shape.dtype, np.complexfloating):
                raise InputError(COMPLEX)
            if not jax.numpy.issubdtype(shape.dtype, np.floating):
                raise InputError(WHOLE.format(shape.dtype))
            text, run = str(closed.jaxpr), _runner(closed)
            steady = _same(closed, text, again) or _repeats(one, size)
            return Traced(run, form, steady, _least_precise(text), _source(closed, text, run))
    return None


def _least_precise(text: str) -> float:
    """The unit roundoff of the least precise type that a program's text names."""
    named = (name for name in SHORT if f"{name}[" in text)
    return max([UNIT, *(SHORT[name] for name in named if re.search(rf"\b{name}\[", text))])


def _anew(one: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """The same function as another object: jax remembers what it has traced."""
    return lambda z: one(z)


def _runner(closed: Any) -> Callable[[Any], Any]:
    from jax.extend.core import jaxpr_as_fun

    run = jaxpr_as_fun(closed)
    return lambda z: run(z)[0]


def _same(first: Any, text: str, second: Any) -> bool:
    """Whether two programs, the first with its text, have the same operations and the same numbers."""
    if alike(first, second):
        return True
    if ADDRESS.sub("", text) != ADDRESS.sub("", str(second.jaxpr)):
        return False
    pairs = zip(_constants(first), _constants(second), strict=True)
    return all(np.array_equal(a, b) for a, b in pairs)


def _source(closed: Any, text: str, one: Callable[[Any], Any]) -> Source | None:
    if UNTOLD.search(text):
        return None
    constants = [np.asarray(constant) for constant in _constants(closed)]
    if any(constant.dtype.kind not in "fiub" for constant in constants):
        return None
    return Source(text, tuple(constant.tobytes() for constant in constants), one)


def _constants(closed: Any) -> Iterator[Any]:
    """The arrays that a program and the programs within it refer to, which its text shows by name alone."""
    yield from closed.consts
    for equation in closed.jaxpr.eqns:
        for value in equation.params.values():
            for inner in value if isinstance(value, (tuple, list)) else (value,):
                if hasattr(inner, "eqns") and hasattr(inner, "consts"):
                    yield from _constants(inner)


def _repeats(one: Callable[[Any], Any], size: int) -> bool:
    """Whether two evaluations agree, where two programs differ: they may differ by a name alone."""
    point = np.linspace(0.2, 0.9, size)
    first, second = (np.asarray(one(point.copy())) for _ in range(2))
    return np.array_equal(first, second, equal_nan=True)
