"""Formulas as functions of balls: real numbers with a bound of their rounding, of any precision (python-flint's Arb).

A ball that is not finite says that the formula has no value there; nothing is raised.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, Final

import sympy as sp
from flint import arb, arb_series, fmpq

from canon.ball_precision import precision as precision
from canon.errors import InputError
from canon.expected import exact_object, formula_of, shown

Ball = Any  # flint.arb; the package has no type stubs
BallFunction = Callable[..., Ball]

NOTHING: Final = arb("nan")
_METHODS: Final[dict[Any, str]] = {
    sp.exp: "exp",
    sp.log: "log",
    sp.sin: "sin",
    sp.cos: "cos",
    sp.tan: "tan",
    sp.cot: "cot",
    sp.sec: "sec",
    sp.csc: "csc",
    sp.asin: "asin",
    sp.acos: "acos",
    sp.atan: "atan",
    sp.sinh: "sinh",
    sp.cosh: "cosh",
    sp.tanh: "tanh",
    sp.coth: "coth",
    sp.asinh: "asinh",
    sp.acosh: "acosh",
    sp.atanh: "atanh",
    sp.sign: "sgn",
    sp.gamma: "gamma",
    sp.LambertW: "lambertw",
}


def ball_function(expression: Any, symbols: Sequence[sp.Symbol]) -> BallFunction:
    """The function of balls, in the order of `symbols`, that the formula states, at the precision of each call.

    **Raises:** `InputError` for a name that is none of the symbols, or a function that has no such form.
    """
    program = program_of([formula_of(expression, "")], symbols, _step)

    def function(*values: Ball) -> Ball:
        return program([value if isinstance(value, (arb, arb_series)) else arb(value) for value in values])[0]

    return function


def program_of(
    expressions: Sequence[Any], symbols: Sequence[Any], step_of: Callable[[Any, list[int]], Callable[[list[Any]], Any]]
) -> Callable[[Sequence[Any]], list[Any]]:
    """The formulas' values from those of the symbols, every subexpression computed once.

    **Arguments:** `step_of(part, places)` makes of a formula's head, whose arguments stand at these places, the
    function from all values so far to its own.
    """
    steps: list[Callable[[list[Any]], Any]] = []
    places: dict[Any, int] = {symbol: k for k, symbol in enumerate(symbols)}

    def place(part: Any) -> int:
        if part not in places:
            step = step_of(part, [place(argument) for argument in part.args])
            places[part] = len(symbols) + len(steps)
            steps.append(step)
        return places[part]

    last = [place(expression) for expression in expressions]

    def program(values: Sequence[Any]) -> list[Any]:
        row = list(values)
        for step in steps:
            row.append(step(row))
        return [row[k] for k in last]

    return program


def _step(part: Any, at: list[int]) -> BallFunction:
    if isinstance(part, (sp.Rational, sp.Float)):
        exact = exact_number(part)
        return lambda row: arb(exact)
    if part is sp.pi:
        return lambda row: arb.pi()
    if part is sp.E:
        return lambda row: arb.const_e()
    if isinstance(part, sp.Add):
        return lambda row: sum((row[k] for k in at[1:]), start=row[at[0]])
    if isinstance(part, sp.Mul):
        return lambda row: product([row[k] for k in at])
    if isinstance(part, sp.Pow):
        return _power(part, at)
    if isinstance(part, sp.exp):
        return lambda row: row[at[0]].exp()
    if isinstance(part, sp.Abs):
        return lambda row: abs(row[at[0]])
    if isinstance(part, sp.atan2):
        return lambda row: arb.atan2(row[at[0]], row[at[1]])
    if part.func in _METHODS and len(at) == 1:
        name = _METHODS[part.func]
        return lambda row: getattr(row[at[0]], name)()
    if isinstance(part, sp.Symbol):
        raise InputError(f"no value is given for {part}: give one in `parameters`")
    raise InputError(f"{part.func} has no numerical form in actions")


def product(values: Sequence[Any]) -> Any:
    """The product of one factor or more, of whatever kind."""
    value = values[0]
    for factor in values[1:]:
        value = value * factor
    return value


def _power(part: Any, at: list[int]) -> BallFunction:
    base, exponent = at
    power = part.exp
    if power.is_Integer and abs(power) < 10_000:
        n = int(power)
        return (lambda row: row[base] ** n) if n > 0 else (lambda row: 1 / row[base] ** -n)
    if power.is_Rational and power.q == 2 and abs(power.p) < 10_000:
        odd = int(power.p)
        return (lambda row: row[base].sqrt() ** odd) if odd > 0 else (lambda row: 1 / row[base].sqrt() ** -odd)
    return lambda row: row[base] ** row[exponent]


def exact_number(value: Any) -> fmpq:
    """A rational number, or the very number that a float is, exactly."""
    if isinstance(value, sp.Rational):
        return fmpq(int(value.p), int(value.q))
    fraction = Fraction(float(value)) if not isinstance(value, sp.Float) else _fraction(value)
    return fmpq(fraction.numerator, fraction.denominator)


def _fraction(value: sp.Float) -> Fraction:
    rational: Any = sp.Rational(value)
    return Fraction(int(rational.p), int(rational.q))


def ball_of(value: Any, where: str = "") -> Ball:
    """A number as a ball: an int, a float (exactly), a ball, or a constant formula. **Raises:** `InputError`."""
    if isinstance(value, arb):
        return value
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return arb(value)
    found = exact_object(value)
    if not isinstance(found, sp.Expr):
        raise InputError(f"a real number is expected, not {shown(value)}", where)
    return ball_function(found, ())()


def middle(ball: Ball) -> Ball:
    """The exact number in the middle of a ball."""
    return ball.mid()


def sign_of(ball: Ball) -> int | None:
    """1, −1 or 0 where the sign is certain; None where it isn't, or the ball isn't finite."""
    if not ball.is_finite():
        return None
    if ball > 0:
        return 1
    if ball < 0:
        return -1
    return 0 if ball.is_zero() else None
