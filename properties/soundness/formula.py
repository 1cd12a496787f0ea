"""Formulas as trees: written as text for a claim file, and evaluated by mpmath where they are defined.

Evaluation knows nothing of sympy or of the deciders: it follows the text, principal values throughout, and raises
`Outside` where a subexpression is undefined, not real though nothing complex was written, or not smooth.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath as mp

Number = int | Fraction
DIGITS = 50
LARGEST = 60


class Outside(Exception):
    """The point isn't in the open domain of the formula."""


class TooLarge(Outside):
    """The point isn't looked at: a value there is too large for the digits used."""


def tiny() -> Any:
    """What is taken for 0 where that is left out of the domain: less in more digits."""
    return mp.mpf(10) ** (-3 * mp.mp.dps // 5)


@dataclass(frozen=True)
class Formula:
    """A tree: `head` is "num", "var", "+", "*", "**" or a function's name; `args` a number, a name, or formulas."""

    head: str
    args: tuple[Any, ...]

    def __add__(self, other: Formula | Number) -> Formula:
        return Formula("+", (self, of(other)))

    def __radd__(self, other: Number) -> Formula:
        return Formula("+", (of(other), self))

    def __sub__(self, other: Formula | Number) -> Formula:
        return Formula("+", (self, -of(other)))

    def __rsub__(self, other: Number) -> Formula:
        return Formula("+", (of(other), -self))

    def __mul__(self, other: Formula | Number) -> Formula:
        return Formula("*", (self, of(other)))

    def __rmul__(self, other: Number) -> Formula:
        return Formula("*", (of(other), self))

    def __truediv__(self, other: Formula | Number) -> Formula:
        return Formula("/", (self, of(other)))

    def __rtruediv__(self, other: Number) -> Formula:
        return Formula("/", (of(other), self))

    def __neg__(self) -> Formula:
        return Formula("*", (of(-1), self))

    def __pow__(self, exponent: Formula | Number) -> Formula:
        return Formula("**", (self, of(exponent)))

    def __str__(self) -> str:
        if self.head == "num":
            value = self.args[0]
            return f"({value})" if value < 0 or isinstance(value, Fraction) else str(value)
        if self.head == "var":
            return self.args[0]
        if self.head in ("+", "*", "/", "**"):
            return "(" + f" {self.head} ".join(map(str, self.args)) + ")"
        return f"{self.head}({', '.join(map(str, self.args))})"


def of(value: Formula | Number) -> Formula:
    """A number as a formula."""
    return value if isinstance(value, Formula) else Formula("num", (value,))


def variable(name: str) -> Formula:
    """A name."""
    return Formula("var", (name,))


def call(name: str, *arguments: Formula | Number) -> Formula:
    """A function, built in or arbitrary."""
    return Formula(name, tuple(of(a) for a in arguments))


def substituted(formula: Formula, images: Mapping[str, Formula]) -> Formula:
    """The formula with names replaced, all at once."""
    if formula.head == "num":
        return formula
    if formula.head == "var":
        return images.get(formula.args[0], formula)
    return Formula(formula.head, tuple(substituted(a, images) for a in formula.args))


def size(formula: Formula) -> int:
    """The number of nodes."""
    return 1 if formula.head in ("num", "var") else 1 + sum(size(a) for a in formula.args)


def names(formula: Formula) -> set[str]:
    """The names in it."""
    if formula.head == "var":
        return {formula.args[0]}
    return set() if formula.head == "num" else set().union(*(names(a) for a in formula.args))


Point = Mapping[str, Any]


def value(formula: Formula, point: Point) -> Any:
    """The value at a point; **raises** `Outside`."""
    head = formula.head
    if head == "num":
        number = formula.args[0]
        return mp.mpf(number.numerator) / number.denominator
    if head == "var":
        name = formula.args[0]
        return mp.pi if name == "pi" else mp.mpc(0, 1) if name == "1j" else point[name]
    if head == "D":
        return _slope(formula.args[0], formula.args[1].args[0], point)
    arguments = [value(a, point) for a in formula.args]
    if head == "+":
        return mp.fsum(arguments) if not any(_complex(a) for a in arguments) else sum(arguments)
    if head == "*":
        return mp.fprod(arguments)
    if head == "/":
        return arguments[0] / _nonzero(arguments[1])
    if head == "**":
        return _power(arguments[0], arguments[1], formula.args[1])
    found = FUNCTIONS.get(head)
    return found(*arguments) if found is not None else arbitrary(head)(*arguments)


def _slope(f: Formula, name: str, point: Point) -> Any:
    h = mp.mpf(10) ** -12
    near, far = (value(f, {**point, name: point[name] + k * h}) - value(f, {**point, name: point[name] - k * h})
                 for k in (1, 2))  # fmt: skip
    return (8 * near - far) / (12 * h)


def arbitrary(name: str) -> Callable[..., Any]:
    """A concrete smooth function to stand for an arbitrary one."""
    shift = mp.mpf(sum(map(ord, name)) % 7 + 2)
    return lambda *a: mp.sin(sum((k + 2) * x for k, x in enumerate(a)) / shift) + sum(x * x for x in a) / shift + shift


def _complex(z: Any) -> bool:
    return isinstance(z, mp.mpc)


def _nonzero(z: Any) -> Any:
    if abs(z) < tiny():
        raise Outside("a zero denominator")
    return z


def _positive(z: Any) -> Any:
    if _complex(z):
        if abs(z.imag) < tiny() and z.real < tiny():
            raise Outside("on a cut")
    elif z < tiny():
        raise Outside("not positive")
    return z


def _power(base: Any, exponent: Any, written: Formula) -> Any:
    if not _complex(exponent) and mp.isint(exponent):
        if exponent < 0:
            _nonzero(base)
        if abs(exponent) > 200:
            raise TooLarge
        return base ** int(exponent)
    if written.head == "var" and written.args[0] in ("n", "k"):
        raise Outside("an integer that is none")
    return mp.exp(_small(exponent * mp.log(_positive(base))))


def _real(function: Callable[..., Any], test: Callable[..., bool] = lambda *a: True) -> Callable[..., Any]:
    def rule(*arguments: Any) -> Any:
        if any(_complex(a) for a in arguments):
            raise Outside("complex")
        if not test(*arguments):
            raise Outside("undefined")
        return function(*arguments)

    return rule


def _away(function: Callable[[Any], Any]) -> Callable[[Any], bool]:
    return lambda a: abs(function(_bounded(a))) > tiny()


def _bounded(a: Any) -> Any:
    """An argument for which no cancellation eats the digits used; larger ones are left out of the samples."""
    if abs(a.imag) > LARGEST or abs(a.real) > LARGEST**2:
        raise TooLarge
    return a


def _small(a: Any) -> Any:
    """The same for functions that grow exponentially."""
    if abs(a) > LARGEST:
        raise TooLarge
    return a


def _inside(a: Any) -> bool:
    return 1 - a * a > tiny()


def _beside_poles(a: Any) -> bool:
    if abs(a) > LARGEST:
        raise TooLarge
    return a > tiny() or abs(a - mp.nint(a)) > tiny()


def _regular(*arguments: Any) -> bool:
    """Whether an elliptic integral is regular at its parameter, and from 0 to its angle."""
    *angles, m = arguments
    far = not angles or abs(_bounded(angles[0])) >= mp.pi / 2
    return 1 - m * (1 if far else mp.sin(angles[0]) ** 2) > tiny()


def _jacobi(name: str) -> Callable[[Any, Any], Any]:
    return lambda u, m: mp.ellipfun(name, u, m=m)


def _between(u: Any, m: Any) -> bool:
    _bounded(u)
    if not 0 < m < 1:
        raise TooLarge
    return True


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": lambda a: mp.sqrt(_positive(a)), "cbrt": lambda a: mp.exp(mp.log(_positive(a)) / 3),
    "exp": lambda a: mp.exp(_small(a)), "log": lambda a: mp.log(_positive(a)), "sin": lambda a: mp.sin(_bounded(a)),
    "cos": lambda a: mp.cos(_bounded(a)), "sinh": lambda a: mp.sinh(_small(a)), "tanh": mp.tanh,
    "cosh": lambda a: mp.cosh(_small(a)), "tan": _real(mp.tan, _away(mp.cos)),
    "asin": _real(mp.asin, _inside), "acos": _real(mp.acos, _inside), "atan": _real(mp.atan),
    "atan2": _real(mp.atan2, lambda y, x: x > tiny() or abs(y) > tiny()), "asinh": _real(mp.asinh),
    "acosh": _real(mp.acosh, lambda a: a > 1 + tiny()), "atanh": _real(mp.atanh, _inside),
    "cot": _real(mp.cot, _away(mp.sin)), "sec": _real(mp.sec, _away(mp.cos)), "csc": _real(mp.csc, _away(mp.sin)),
    "coth": _real(mp.coth, lambda a: abs(a) > tiny()), "gamma": _real(mp.gamma, _beside_poles),
    "lambertw": _real(mp.lambertw, lambda a: a + mp.exp(-1) > tiny()),
    "elliptic_k": _real(mp.ellipk, lambda m: 1 - m > tiny()), "elliptic_e": _real(mp.ellipe, _regular),
    "elliptic_f": _real(mp.ellipf, _regular), "elliptic_pi": _real(mp.ellippi, lambda n, m: min(1 - n, 1 - m) > tiny()),
    "jacobi_sn": _real(_jacobi("sn"), _between), "jacobi_cn": _real(_jacobi("cn"), _between),
    "jacobi_dn": _real(_jacobi("dn"), _between),
    "abs": _real(abs, lambda a: abs(a) > tiny()), "sign": _real(mp.sign, lambda a: abs(a) > tiny()),
}  # fmt: skip
