"""Principal values of expressions in balls, at rational values of their names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import sympy as sp
from flint import acb, arb, fmpq

from canon.ball_precision import precision

_FUNCTIONS: Final = ("exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan", "asinh")


class Unknown(Exception):
    """Something that isn't understood, or isn't defined at the point."""


def ball_of(expression: Any, values: Mapping[Any, Any], bits: int) -> acb | None:
    """A ball that holds the principal value at rational values of the names; None where none is certified."""
    with precision(bits):
        try:
            found = ball(expression, values, bits)
        except (Unknown, ZeroDivisionError, OverflowError):
            return None
        return found if found.is_finite() else None


def ball(expression: Any, values: Mapping[Any, Any], bits: int) -> acb:
    """The same at the working precision. **Raises:** `Unknown`, and what divisions by 0 raise."""
    if expression.is_Rational:
        return acb(fmpq(int(expression.p), int(expression.q)))
    if expression.is_Symbol:
        if expression not in values:  # bound, as in an integral that wasn't done
            raise Unknown
        return ball(values[expression], values, bits)
    if expression is sp.pi:
        return acb.pi()
    if expression is sp.E:
        return acb(1).exp()
    if expression is sp.I:
        return acb(0, 1)
    if isinstance(expression, sp.CRootOf):
        return _algebraic(expression, bits)
    parts = [ball(part, values, bits) for part in expression.args]
    if expression.is_Add:
        return sum(parts, start=acb(0))
    if expression.is_Mul:
        return math.prod(parts, start=acb(1))
    if expression.is_Pow:
        return power(parts[0], expression.exp, parts[1])
    name = expression.func.__name__
    if name == "Abs":
        return acb(abs(parts[0]))
    if name not in _FUNCTIONS:
        raise Unknown
    return getattr(parts[0], name)()


def power(base: acb, exponent: Any, there: acb) -> acb:
    """base ** exponent, where `there` is the ball of the exponent. **Raises:** `Unknown` at 0."""
    if exponent.is_Integer:
        n = int(exponent)
        if abs(n) > 10_000 or (n < 0 and base.contains(0)):
            raise Unknown
        return base**n if n >= 0 else 1 / base ** (-n)
    if base.contains(0):
        raise Unknown
    if exponent.is_Rational and exponent.q == 2:
        root = base.sqrt() ** abs(int(exponent.p))
        return root if exponent > 0 else 1 / root
    return (there * base.log()).exp()


def _algebraic(root: Any, bits: int) -> acb:
    """A ball around a zero of a polynomial that sympy isolates by exact intervals."""
    width = sp.Rational(1, 2**bits)
    near = root.eval_rational(width, width)
    real, imaginary = near.as_real_imag()
    off = arb(0, 2.0 ** (1 - bits))
    parts = [arb(fmpq(int(part.p), int(part.q))) + off for part in (real, imaginary)]
    return acb(parts[0], arb(0)) if root.is_real else acb(*parts)
