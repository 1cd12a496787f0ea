"""Functions of real constants, written so that sympy's automatic evaluation can be trusted.

sympy rewrites |c|, sign(c), √(c x) and more by the sign of the constant c, which it takes from an evaluation with two
digits. That is sound for sums, products, powers, exp, log, sin and cos, where it watches its precision, but not for
other functions near a pole or at the end of their range: in sympy 1.14 sec(288865/7) has the wrong sign, and
acosh(1 + 1e-6) and acos(tanh(9)) are zero. Such values are written with the functions that it evaluates well.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.errors import InputError
from canon.special import EllipticPi

if TYPE_CHECKING:
    from canon.domain import Condition

HUGE: Final = 1e100
"""The largest constant that a function is applied to."""
STEEP: Final = 700.0
"""The largest constant in an exponent, times the logarithm of the base."""
FRAGILE: Final = (sp.tan, sp.cot, sp.sec, sp.csc, sp.asin, sp.acos, sp.acosh, sp.atanh)
"""Functions whose values at constants sympy misjudges near a pole, or at the end of their range."""
_NEAR: Final = 0.9
_ELLIPTIC: Final = (sp.elliptic_k, sp.elliptic_e, sp.elliptic_f, EllipticPi)


def is_constant(values: Any) -> bool:
    """Whether all values are numbers, and none is known not to be real."""
    return all(value.is_number and value.is_real is not False for value in values)


def constant(function: Any, c: Any, *more: Any) -> Any:
    """`function(c, *more)` for real constants.

    **Raises:** `InputError` if a value is too large, or if no reliable form of it is known.
    """
    size = approximate(c)
    if function in (sp.exp, sp.sinh, sp.cosh, sp.tanh, sp.coth) and size > STEEP:
        raise InputError("an exponential of too large a number")
    if size > HUGE:
        raise InputError("a function of too large a number")
    value = function(c, *more)
    if not value.has(function):
        return value
    if function in _QUOTIENTS:
        above, below = _QUOTIENTS[function]
        return above(c) / below(c)
    if function is sp.acosh:
        return sp.log(c + sp.sqrt(c**2 - 1))
    if function is sp.acos:
        return sp.pi / 2 - constant(sp.asin, c)
    if function is sp.asin and size > _NEAR:
        return sp.atan(c / sp.sqrt(1 - c**2))
    if function is sp.atanh and size > _NEAR:
        return sp.log((1 + c) / (1 - c)) / 2
    if function is sp.gamma:
        return _gamma(c)
    if function is sp.LambertW and sp.Rational(-36, 100) > c:
        raise InputError("lambertw of a constant near the end of its range")
    if function is EllipticPi and sp.Rational(99, 100) < c:
        raise InputError("an elliptic integral of a constant near its pole")
    if function in _ELLIPTIC and sp.Rational(99, 100) < (more or (c,))[-1]:
        raise InputError("an elliptic integral of a constant near its pole")
    return value


def reliable(expression: Any) -> Any:
    """`expression` with such functions of real constants in it written so that sympy's evaluation can be trusted.

    **Raises:** `InputError` as `constant` does.
    """
    if not any(isinstance(part, FRAGILE) and is_constant(part.args) for part in expression.atoms(*FRAGILE)):
        return expression
    return expression.replace(
        lambda part: isinstance(part, FRAGILE) and is_constant(part.args), lambda part: constant(part.func, *part.args)
    )


def put_in(expression: Any, mapping: Mapping[Any, Any]) -> Any:
    """`expression` with what `mapping` says put in, where that may make functions of real constants."""
    known: dict[Any, Any] = {key: sp.sympify(value) for key, value in mapping.items()}

    def image(part: Any) -> Any:
        if part in known or not part.args:
            return known.get(part, part)
        arguments = [image(argument) for argument in part.args]
        if isinstance(part, FRAGILE) and is_constant(arguments):
            known[part] = constant(part.func, *arguments)
        else:
            known[part] = part if tuple(arguments) == part.args else part.func(*arguments)
        return known[part]

    return image(expression)


def check_constant_power(base: Any, exponent: Any) -> None:
    """Refuse a power of real constants that is too large. **Raises:** `InputError`."""
    if base.is_Rational and exponent.is_Rational:
        return
    if is_constant((base, exponent)) and abs(exponent) * abs(sp.log(abs(base)).evalf(5)) > STEEP:
        raise InputError("a power of constants that is too large")


def check_constant_condition(condition: Condition) -> None:
    """Refuse a condition on a constant that plainly fails. **Raises:** `InputError`."""
    term = condition.terms[0]
    if condition.kind != "positive" or not term.is_number:
        return
    value = term.evalf(10)
    if value.is_Float and value < -1e-6:
        raise InputError(f"undefined everywhere: it needs {condition}, which is never so")


def approximate(c: Any) -> float:
    """About |c|, for a real constant."""
    try:
        return abs(complex(c.evalf(5)))
    except (OverflowError, TypeError, ValueError):
        return float("inf")


def _gamma(c: Any) -> Any:
    """gamma(c), by its recurrence where c is negative."""
    if not c.is_Rational:
        raise InputError("gamma of an irrational constant")
    steps = max(0, 1 - int(sp.floor(c)))
    return sp.gamma(c + steps) / sp.Mul(*(c + k for k in range(steps)))


def _one(_: Any) -> Any:
    return sp.Integer(1)


_QUOTIENTS: Final[dict[Any, tuple[Any, Any]]] = {
    sp.tan: (sp.sin, sp.cos),
    sp.cot: (sp.cos, sp.sin),
    sp.sec: (_one, sp.cos),
    sp.csc: (_one, sp.sin),
}
