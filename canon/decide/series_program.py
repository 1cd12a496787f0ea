"""A straight-line program run on power series in balls: rigorous values and derivatives, at a point or over a box.

Elementary functions are composed with their Taylor series at the constant term. Where a branch, a kink or a pole can't
be excluded, `Unenclosed` is raised; nothing is continued across it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from typing import Any, Final

import flint
from flint import arb

from canon.decide.enclosure import precision
from canon.decide.series import Algebra, Ball, Series, constant_term
from canon.decide.tape import Unsupported
from canon.decide.taylor_coefficients import TAYLOR, Unenclosed, binomial, number
from canon.program import PREDICATES, Operation, Program

__all__ = ["Unenclosed", "number", "run_series", "working"]

Truth = bool | None
"""What a comparison of balls certainly is; None where they overlap."""


@contextmanager
def working(bits: int, degree: int) -> Iterator[None]:
    """Arb's precision, and the length of its series, both global to the process, set and put back."""
    with precision(bits):
        before = flint.ctx.cap
        flint.ctx.cap = max(before, degree + 1)
        try:
            yield
        finally:
            flint.ctx.cap = before


def run_series(program: Program, inputs: Sequence[Series], algebra: Algebra) -> list[Series]:
    """The series of a program's outputs. To be called within `working`.

    **Raises:** `Unenclosed` where it isn't certified to be smooth, `Unsupported` for an operation without a series.
    """
    values: list[Any] = []
    varies: list[bool] = []
    for operation in program.operations:
        operands = [values[a] for a in operation.operands]
        varies.append(operation.name == "input" or any(varies[a] for a in operation.operands))
        if operation.name in PREDICATES:
            value = _compared(operation.name, operands, varies[-1])
        else:
            value = _apply(operation, operands, inputs, algebra)
        if isinstance(value, dict) and not all(ball.is_finite() for ball in value.values()):
            raise Unenclosed(f"{operation.name} is not certified to be finite")
        values.append(value)
    return [values[node] for node in program.outputs]


def _apply(operation: Operation, x: list[Any], inputs: Sequence[Series], algebra: Algebra) -> Any:
    name, _, datum = operation
    if name == "input":
        return inputs[int(datum)]
    if name == "number":
        return algebra.constant(number(datum))
    if name == "select":
        if x[0] is None:
            raise Unenclosed("a choice between two formulas")
        return x[1] if x[0] else x[2]
    if name == "add":
        return algebra.add(x[0], x[1])
    if name == "sub":
        return algebra.add(x[0], algebra.scaled(x[1], arb(-1)))
    if name == "neg":
        return algebra.scaled(x[0], arb(-1))
    if name == "mul":
        return algebra.multiply(x[0], x[1])
    if name == "div":
        return algebra.multiply(x[0], _power(x[1], Fraction(-1), algebra))
    if name == "power":
        return _integer_power(x[0], int(datum), algebra)
    if name == "root":
        return _power(x[0], Fraction(datum), algebra)
    if name in _TWO:
        return _TWO[name](x[0], x[1], algebra)
    if name in _PIECEWISE:
        return _PIECEWISE[name](x[0], algebra)
    if name in TAYLOR:
        return algebra.compose(TAYLOR[name](constant_term(x[0]), algebra.degree), x[0])
    raise Unsupported(f"no series of {name}")


def _compared(name: str, x: list[Any], varies: bool) -> Truth:
    """What a comparison is throughout a neighbourhood; numbers that vary must differ for that."""
    if name == "and":
        return False if False in x else None if None in x else True
    if name == "or":
        return True if True in x else None if None in x else False
    if name == "not":
        return None if x[0] is None else not x[0]
    if any(not isinstance(value, dict) for value in x):
        return None if None in x else x[0] == x[1]
    a, b = constant_term(x[0]), constant_term(x[1])
    if not a.overlaps(b):
        return name != "equal" and bool(a < b)
    if varies or not (a.is_exact() and b.is_exact()):
        return None
    return name != "less"


# -- powers ----------------------------------------------------------------------------------------


def _power(base: Series, exponent: Fraction, algebra: Algebra) -> Series:
    return algebra.compose(binomial(constant_term(base), exponent, algebra.degree), base)


def _integer_power(base: Series, exponent: int, algebra: Algebra) -> Series:
    if exponent < 0:
        return _power(base, Fraction(exponent), algebra)
    result, square = algebra.constant(arb(1)), base
    while exponent:
        if exponent & 1:
            result = algebra.multiply(result, square)
        exponent >>= 1
        square = algebra.multiply(square, square) if exponent else square
    return result


def _general_power(base: Series, exponent: Series, algebra: Algebra) -> Series:
    if set(exponent) <= {0} and constant_term(exponent).is_exact():
        (value,) = [constant_term(exponent)]
        if value.is_integer():
            return _integer_power(base, int(value.unique_fmpz()), algebra)
    if not constant_term(base) > 0:
        raise Unenclosed("a power of something that may be zero or negative")
    logarithm = algebra.compose(TAYLOR["log"](constant_term(base), algebra.degree), base)
    product = algebra.multiply(exponent, logarithm)
    return algebra.compose(TAYLOR["exp"](constant_term(product), algebra.degree), product)


# -- functions with branches -----------------------------------------------------------------------


def _atan2(y: Series, x: Series, algebra: Algebra) -> Series:
    a, b = constant_term(y), constant_term(x)
    if b > 0 and not abs(a) > b:
        numerator, denominator, turn, sign = y, x, arb(0), 1
    elif not a.contains(0):
        numerator, denominator, sign = x, y, -1
        turn = arb.pi() / 2 if a > 0 else -arb.pi() / 2
    else:
        raise Unenclosed("atan2 at its cut")
    ratio = algebra.multiply(numerator, _power(denominator, Fraction(-1), algebra))
    angle = algebra.compose(TAYLOR["atan"](constant_term(ratio), algebra.degree), ratio)
    return algebra.add(algebra.constant(turn), algebra.scaled(angle, arb(sign)))


def _larger(x: Series, y: Series, algebra: Algebra) -> Series:
    a, b = constant_term(x), constant_term(y)
    if a > b:
        return x
    if a < b:
        return y
    raise Unenclosed("the larger of two numbers that may be equal")


def _smaller(x: Series, y: Series, algebra: Algebra) -> Series:
    negative = [algebra.scaled(f, arb(-1)) for f in (x, y)]
    return algebra.scaled(_larger(negative[0], negative[1], algebra), arb(-1))


def _remainder(x: Series, y: Series, algebra: Algebra) -> Series:
    """x − y trunc(x/y), which has the sign of x."""
    if constant_term(y).contains(0):
        raise Unenclosed("a denominator that may be zero")
    ratio = constant_term(x) / constant_term(y)
    if abs(ratio) < 1:
        return x
    whole = _whole(abs(ratio))
    return algebra.add(x, algebra.scaled(y, arb(-whole if ratio > 0 else whole)))


def _whole(value: Ball) -> int:
    """The integer below a number that is certainly none."""
    whole = None if value.contains_integer() else value.floor().unique_fmpz()
    if whole is None:
        raise Unenclosed("a rounding at a jump")
    return int(whole)


def _step(name: str) -> Callable[[Series, Algebra], Series]:
    def rule(x: Series, algebra: Algebra) -> Series:
        value = constant_term(x)
        if name == "sign":
            if value.contains(0):
                raise Unenclosed("the sign of something that may be zero")
            return algebra.constant(arb(1 if value > 0 else -1))
        whole = _whole(value + arb(0.5) if name == "round" else value)
        return algebra.constant(arb(whole + 1 if name == "ceil" else whole))

    return rule


def _absolute(x: Series, algebra: Algebra) -> Series:
    value = constant_term(x)
    if value.contains(0):
        raise Unenclosed("the absolute value of something that may be zero")
    return x if value > 0 else algebra.scaled(x, arb(-1))


def _cube_root(x: Series, algebra: Algebra) -> Series:
    sign = arb(1 if constant_term(x) > 0 else -1)
    return algebra.scaled(_power(algebra.scaled(x, sign), Fraction(1, 3), algebra), sign)


_TWO: Final[dict[str, Callable[[Series, Series, Algebra], Series]]] = {
    "pow": _general_power,
    "atan2": _atan2,
    "max": _larger,
    "min": _smaller,
    "rem": _remainder,
}
_PIECEWISE: Final[dict[str, Callable[[Series, Algebra], Series]]] = {
    "sign": _step("sign"),
    "floor": _step("floor"),
    "ceil": _step("ceil"),
    "round": _step("round"),
    "abs": _absolute,
    "cbrt": _cube_root,
    "sqrt": lambda x, algebra: _power(x, Fraction(1, 2), algebra),
}
