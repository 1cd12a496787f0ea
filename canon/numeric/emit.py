"""A straight-line program run on rows of points, one array a scalar: at once in numpy, or traced by jax."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.program import Operation, Program

_NAMES: Final = {
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "asinh": "arcsinh",
    "acosh": "arccosh",
    "atanh": "arctanh",
    "atan2": "arctan2",
    "pow": "power",
    "max": "maximum",
    "min": "minimum",
    "and": "logical_and",
    "or": "logical_or",
    "not": "logical_not",
    "round": "rint",
    "rem": "fmod",
}


def run(program: Program, rows: Sequence[Any], numbers: Any = np) -> list[Any]:
    """The outputs of a program at points given by rows, one array (N,) for each input.

    `numbers` is the module that computes, numpy or jax.numpy; outputs that are constant come out as floats.
    """
    values: list[Any] = []
    for operation, spent in zip(program.operations, program.spent, strict=True):
        values.append(apply(operation, rows, [values[a] for a in operation.operands], numbers))
        for node in spent:
            values[node] = None
    return [values[node] for node in program.outputs]


def apply(operation: Operation, rows: Sequence[Any], operands: Sequence[Any], numbers: Any) -> Any:
    """The value of one operation."""
    name, _, datum = operation
    if name == "input":
        return rows[int(datum)]
    if name == "number":
        return np.float64(datum)
    if name == "power":
        return integer_power(operands[0], int(datum))
    if name == "root":
        return numbers.power(operands[0], float(Fraction(datum)))
    if name in _DIRECT:
        return _DIRECT[name](*operands)
    if name == "select":
        return numbers.where(*operands)
    return getattr(numbers, _NAMES.get(name, name))(*operands)


_DIRECT: Final[dict[str, Callable[..., Any]]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
}


def integer_power(base: Any, exponent: int) -> Any:
    """base ** exponent by repeated squaring; 1/base ** |exponent| for a negative one."""
    if exponent < 0:
        return 1.0 / integer_power(base, -exponent)
    result = None
    while exponent:
        if exponent & 1:
            result = base if result is None else result * base
        exponent >>= 1
        base = base * base if exponent else base
    return 1.0 if result is None else result
