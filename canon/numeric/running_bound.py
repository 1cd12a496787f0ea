"""Running rounding bounds on straight-line programs: each value beside a bound on its distance from the exact one.

An operation's bound is its operands' bounds times its partial derivatives, plus its own rounding (Higham, Accuracy and
Stability of Numerical Algorithms, section 3.3), to first order in the unit roundoff. What is exact (inputs, numbers,
changes of sign, products with powers of two) stays exact, so that a sparse Jacobian has sparse bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import frexp
from typing import Any, Final

import numpy as np

from canon.numeric.emit import apply
from canon.numeric.precision import UNIT
from canon.program import PREDICATES, Node, Operation, Program

ULPS: Final = 4
"""The error granted to an elementary function, in units of roundoff of its value."""

_EXACT: Final = PREDICATES | {"input", "sign", "floor", "ceil", "round"}


def run_bounded(
    program: Program, rows: Sequence[Any], numbers: Any = np, *, rounded_numbers: bool = False
) -> list[tuple[Any, Any]]:
    """(value, bound) for each output, at rows of points that are exact; a bound is 0.0 where the value is exact.

    `numbers` is the module that computes, numpy or jax.numpy. With `rounded_numbers`, numbers that are no integers
    stand for ones that were rounded to them.
    """
    values: list[Any] = []
    bounds: list[Any] = []
    for operation, spent in zip(program.operations, program.spent, strict=True):
        x, e = [values[a] for a in operation.operands], [bounds[a] for a in operation.operands]
        value = apply(operation, rows, x, numbers)
        values.append(value)
        if operation.name == "number":
            bounds.append(UNIT * abs(value) if rounded_numbers and not float(value).is_integer() else 0.0)
        elif operation.name in _EXACT:
            bounds.append(0.0)
        else:
            bounds.append(_rule(operation, x, e, value, numbers))
        for node in spent:
            values[node] = bounds[node] = None
    return [(values[node], bounds[node]) for node in program.outputs]


def rounds(program: Program, node: Node) -> bool:
    """Whether a node's bound is certain to be at least one rounding of its own value."""
    name, operands, _ = program.operations[node]
    if name in ("neg", "abs"):
        return rounds(program, operands[0])
    if name == "mul" and any(_power_of_two(_float(program.constant(a))) for a in operands):
        return False
    return name not in _EXACT and name not in ("number", "max", "min", "select")


def _float(value: Any) -> Any:
    return float(value) if isinstance(value, (int, float)) else value


def is_zero(x: Any) -> bool:
    """Whether x is the constant 0, not an array that happens to vanish."""
    return isinstance(x, float) and x == 0.0


def _power_of_two(value: Any) -> bool:
    return isinstance(value, float) and value != 0 and abs(frexp(value)[0]) == 0.5


def _scaled(factor: Any, error: Any) -> Any:
    """|factor| · error, with no operation where nothing is off."""
    return 0.0 if is_zero(error) else abs(factor) * error


def _rule(operation: Operation, x: list[Any], e: list[Any], value: Any, numbers: Any) -> Any:
    name = operation.name
    if name in ("neg", "abs"):
        return e[0]
    if name in ("max", "min"):
        return numbers.maximum(e[0], e[1])
    if name == "select":
        return numbers.where(x[0], e[1], e[2])
    own = UNIT * abs(value)
    if name in ("add", "sub"):
        return e[0] + e[1] + own
    if name == "mul":
        carried = _scaled(x[0], e[1]) + _scaled(x[1], e[0])
        if not is_zero(e[0]) and not is_zero(e[1]):
            carried = carried + e[0] * e[1]
        return carried if any(_power_of_two(a) for a in x) else carried + own
    if name == "div":
        if is_zero(e[1]):
            return own if is_zero(e[0]) else e[0] / abs(x[1]) + own
        room = abs(x[1]) - e[1]
        return numbers.where(room > 0, (e[0] + abs(value) * e[1]) / room, np.inf) + own
    if name == "rem":
        return e[0] + _scaled(x[0] / x[1], e[1]) + own
    if name == "power":
        exponent = int(operation.datum)
        slope = 0.0 if is_zero(e[0]) else exponent * apply(operation._replace(datum=exponent - 1), (), x, numbers)
        return _scaled(slope, e[0]) + (abs(exponent) + 1) * own
    if name == "root":
        # an exponent that is no binary fraction is rounded too, which costs that rounding times the logarithm
        exponent = float(Fraction(operation.datum))
        return _scaled(exponent * value / x[0], e[0]) + (ULPS + abs(exponent * numbers.log(x[0]))) * own
    if name == "pow":
        other = 0.0 if is_zero(e[1]) else numbers.where(e[1] > 0, abs(value * numbers.log(abs(x[0]))) * e[1], 0.0)
        return _scaled(x[1] * numbers.power(x[0], x[1] - 1.0), e[0]) + other + ULPS * own
    if name == "atan2":
        if is_zero(e[0]) and is_zero(e[1]):
            return ULPS * own
        return (_scaled(x[0], e[1]) + _scaled(x[1], e[0])) / (x[0] * x[0] + x[1] * x[1]) + ULPS * own
    if is_zero(e[0]):
        return ULPS * own
    return numbers.where(e[0] > 0, abs(slope_of(name, x[0], value, numbers)) * e[0], 0.0) + ULPS * own


def slope_of(name: str, x: Any, f: Any, numbers: Any) -> Any:
    """The derivative of an elementary function at the argument x, where its value is f."""
    root = lambda square: numbers.sqrt(abs(square))
    slopes = {
        "square": lambda: 2 * x,
        "sqrt": lambda: 0.5 / f,
        "rsqrt": lambda: 0.5 * f / x,
        "cbrt": lambda: f / (3 * x),
        "exp": lambda: f,
        "exp2": lambda: 0.7 * f,
        "expm1": lambda: f + 1,
        "log": lambda: 1 / x,
        "log1p": lambda: 1 / (1 + x),
        "sin": lambda: numbers.cos(x),
        "cos": lambda: numbers.sin(x),
        "tan": lambda: 1 + f * f,
        "sinh": lambda: root(1 + f * f),
        "cosh": lambda: root(f * f - 1),
        "tanh": lambda: 1 - f * f,
        "asin": lambda: 1 / root(1 - x * x),
        "acos": lambda: 1 / root(1 - x * x),
        "atan": lambda: 1 / (1 + x * x),
        "asinh": lambda: 1 / root(1 + x * x),
        "acosh": lambda: 1 / root(x * x - 1),
        "atanh": lambda: 1 / (1 - x * x),
        "logistic": lambda: f * (1 - f),
    }
    return slopes[name]()
