"""Random equations that hold on part of their domain or on all of it: branches, cuts, integers, arbitrary functions.

Each template is a pair (left, right) that is true somewhere; whether it is true on the whole domain of a random box is
left to the oracle.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from properties.soundness.formula import Formula, call, of, variable
from properties.soundness.mutants import NEAR

x, y, a, n, pi = (variable(name) for name in ("x", "y", "a", "n", "pi"))
z, w, I = variable("z"), variable("w"), variable("1j")
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Equation:
    """lhs = rhs for the names with what is assumed of them, in a box, where further expressions are positive."""

    lhs: Formula
    rhs: Formula
    words: dict[str, str]
    box: dict[str, tuple[Any, Any]] = field(default_factory=dict)
    positive: tuple[Formula, ...] = ()
    template: str = ""


def sqrt(u: Formula) -> Formula:
    """The square root."""
    return call("sqrt", u)


def f(name: str) -> Callable[..., Formula]:
    """A function by name."""
    return lambda *arguments: call(name, *arguments)


sin, cos, tan, exp, log, atan, asin, acos, atan2, sign, cosh, sinh, tanh = map(
    f, ("sin", "cos", "tan", "exp", "log", "atan", "asin", "acos", "atan2", "sign", "cosh", "sinh", "tanh")
)
absolute, V = f("abs"), f("V")

REAL: dict[str, Callable[[Formula, Formula], tuple[Formula, Formula]]] = {
    "root of a square": lambda u, v: (sqrt(u**2), u),
    "root of minus a square": lambda u, v: (sqrt(u**2), -u),
    "root is an absolute value": lambda u, v: (sqrt(u**2), absolute(u)),
    "root of an expanded square": lambda u, v: (sqrt(u**2 + 2 * u * v + v**2), u + v),
    "root of a quotient": lambda u, v: (sqrt(u / v), sqrt(u) / sqrt(v)),
    "root of a product": lambda u, v: (sqrt(u * v), sqrt(u) * sqrt(v)),
    "root of a quotient times": lambda u, v: (sqrt(u / v) * v, sqrt(u * v)),
    "root of a product, absolutely": lambda u, v: (sqrt(u * v), sqrt(absolute(u)) * sqrt(absolute(v))),
    "square under a root": lambda u, v: (sqrt(u**2 * v), u * sqrt(v)),
    "cube root": lambda u, v: (call("cbrt", u**3), u),
    "fourth root": lambda u, v: ((u**4) ** Fraction(1, 4), u),
    "sixth root": lambda u, v: ((u**2) ** Fraction(1, 6), call("cbrt", absolute(u))),
    "nested root": lambda u, v: (sqrt(u + 2 * sqrt(u - 1)), 1 + sqrt(u - 1)),
    "nested root, minus": lambda u, v: (sqrt(u - 2 * sqrt(u - 1)), 1 - sqrt(u - 1)),
    "nested root, plus": lambda u, v: (sqrt(u - 2 * sqrt(u - 1)), sqrt(u - 1) - 1),
    "sum of two roots": lambda u, v: (sqrt(u + v + 2 * sqrt(u * v)), sqrt(u) + sqrt(v)),
    "root of a root": lambda u, v: (sqrt(sqrt(u**4)), u),
    "log of a square": lambda u, v: (log(u**2), 2 * log(u)),
    "log of a square, absolutely": lambda u, v: (log(u**2), 2 * log(absolute(u))),
    "log of a product": lambda u, v: (log(u * v), log(u) + log(v)),
    "log of a quotient": lambda u, v: (log(u / v), log(absolute(u)) - log(absolute(v))),
    "log of an exponential": lambda u, v: (log(exp(u) * exp(v)), u + v),
    "log of a root": lambda u, v: (log(sqrt(u**2)), log(u)),
    "exponential of a log": lambda u, v: (exp(2 * log(u)), u**2),
    "power law": lambda u, v: ((u**2) ** a, u ** (2 * a)),
    "product of powers": lambda u, v: (u**a * v**a, (u * v) ** a),
    "absolute value": lambda u, v: (absolute(u), u),
    "sign": lambda u, v: (sign(u), of(1)),
    "sign times": lambda u, v: (sign(u) * u, absolute(u)),
    "sign of a product": lambda u, v: (sign(u) * sign(v), sign(u * v)),
    "absolute product": lambda u, v: (absolute(u) * absolute(v), u * v),
    "absolute sum": lambda u, v: (absolute(u + v), absolute(u) + absolute(v)),
    "removable": lambda u, v: ((u**2 - v**2) / (u - v), u + v),
    "removable, absolutely": lambda u, v: (u * absolute(u) / u, u),
    "asin of sin": lambda u, v: (asin(sin(u)), u),
    "asin of sin, reflected": lambda u, v: (asin(sin(u)), pi - u),
    "acos of cos": lambda u, v: (acos(cos(u)), u),
    "acos of cos, absolutely": lambda u, v: (acos(cos(u)), absolute(u)),
    "atan of tan": lambda u, v: (atan(tan(u)), u),
    "atan2 of sin and cos": lambda u, v: (atan2(sin(u), cos(u)), u),
    "atan of the inverse": lambda u, v: (atan(u) + atan(1 / u), pi / 2),
    "atan of the inverse, sign": lambda u, v: (atan(u) + atan(1 / u), sign(u) * pi / 2),
    "atan of the inverse, minus": lambda u, v: (atan(u) + atan(1 / u), -pi / 2),
    "double atan": lambda u, v: (2 * atan(u), atan(2 * u / (1 - u**2))),
    "double atan by asin": lambda u, v: (2 * atan(u), asin(2 * u / (1 + u**2))),
    "double atan by acos": lambda u, v: (2 * atan(u), acos((1 - u**2) / (1 + u**2))),
    "sum of atan": lambda u, v: (atan(u) + atan(v), atan((u + v) / (1 - u * v))),
    "atan2 as atan": lambda u, v: (atan2(v, u), atan(v / u)),
    "atan2 as atan, turned": lambda u, v: (atan2(v, u), atan(v / u) + pi),
    "atan2 by the half angle": lambda u, v: (atan2(v, u), 2 * atan(v / (sqrt(u**2 + v**2) + u))),
    "atan2 turned": lambda u, v: (atan2(v, u) - atan2(-v, -u), pi),
    "atan2 exchanged": lambda u, v: (atan2(v, u) + atan2(u, v), pi / 2),
    "atan2 by acos": lambda u, v: (atan2(v, u), acos(u / sqrt(u**2 + v**2))),
    "asin and acos": lambda u, v: (asin(u) + acos(u), pi / 2),
    "asin by atan": lambda u, v: (asin(u), atan(u / sqrt(1 - u**2))),
    "acos by atan2": lambda u, v: (acos(u), atan2(sqrt(1 - u**2), u)),
    "acos of minus": lambda u, v: (acos(-u), pi - acos(u)),
    "double asin": lambda u, v: (2 * asin(u), asin(2 * u * sqrt(1 - u**2))),
    "double acos": lambda u, v: (2 * acos(u), acos(2 * u**2 - 1)),
    "asin by acos": lambda u, v: (asin(u), acos(sqrt(1 - u**2))),
    "root of 1 - cos": lambda u, v: (sqrt((1 - cos(u)) / 2), sin(u / 2)),
    "root of 1 + cos": lambda u, v: (sqrt((1 + cos(u)) / 2), cos(u / 2)),
    "root of 1 - sin**2": lambda u, v: (sqrt(1 - sin(u) ** 2), cos(u)),
    "root of 1 + sin": lambda u, v: (sqrt(1 + sin(2 * u)), sin(u) + cos(u)),
    "root of 1 + tan**2": lambda u, v: (sqrt(1 + tan(u) ** 2), 1 / cos(u)),
    "half tan": lambda u, v: (tan(u / 2), sin(u) / (1 + cos(u))),
    "sum of sines": lambda u, v: (sin(u + v), sin(u) * cos(v) + cos(u) * sin(v)),
    "acosh of cosh": lambda u, v: (call("acosh", cosh(u)), u),
    "acosh by log": lambda u, v: (call("acosh", u), log(u + sqrt(u**2 - 1))),
    "acosh doubled": lambda u, v: (call("acosh", 1 + 2 * u**2), 2 * call("asinh", u)),
    "asinh by log": lambda u, v: (call("asinh", u), -log(sqrt(u**2 + 1) - u)),
    "atanh by log": lambda u, v: (call("atanh", u), log((1 + u) / (1 - u)) / 2),
    "atanh by log, doubled": lambda u, v: (2 * call("atanh", u), log((1 + u) ** 2 / (1 - u) ** 2) / 2),
    "root of cosh": lambda u, v: (sqrt(cosh(u) ** 2 - 1), sinh(u)),
    "root of exponentials": lambda u, v: (sqrt(exp(u) - 2 + exp(-u)), 2 * sinh(u / 2)),
    "log of tanh": lambda u, v: (log(1 + tanh(u)) - log(1 - tanh(u)), 2 * u),
    "gudermannian": lambda u, v: (2 * atan(exp(u)) - pi / 2, atan(sinh(u))),
    "gudermannian by asin": lambda u, v: (asin(tanh(u)), atan(sinh(u))),
    "sum of absolute values": lambda u, v: (absolute(u) + absolute(v), sqrt(u**2 + v**2 + 2 * absolute(u * v))),
    "maximum": lambda u, v: ((u + v + absolute(u - v)) / 2, u),
    "conjugate": lambda u, v: (1 / (sqrt(1 + u**2) - u), sqrt(1 + u**2) + u),
    "conjugate, minus": lambda u, v: (1 / (sqrt(1 + u**2) - sqrt(u**2)), sqrt(1 + u**2) + u),
    "power of a sign": lambda u, v: (absolute(u) ** 3, u**3),
    "function of a root": lambda u, v: (V(sqrt(u**2)), V(u)),
    "function of a modulus": lambda u, v: (V(absolute(u), v), V(sqrt(u**2), v)),
    "even function": lambda u, v: (V(u) * V(-u), V(absolute(u)) * V(-absolute(u))),
    "root of a function": lambda u, v: (sqrt(V(u) ** 2), V(u)),
}
INTEGER: dict[str, Callable[[Formula, Formula], tuple[Formula, Formula]]] = {
    "cosine turned": lambda u, v: (cos(u + pi * n), of(-1) ** n * cos(u)),
    "sine turned": lambda u, v: (sin(u + 2 * pi * n), sin(u)),
    "sine half turned": lambda u, v: (sin(u + pi * n), sin(u)),
    "tangent turned": lambda u, v: (tan(u + pi * n), tan(u)),
    "parity of a square": lambda u, v: (of(-1) ** (n**2), of(-1) ** n),
    "cosine at integers": lambda u, v: (cos(pi * n) * u, of(-1) ** n * u),
    "square of a power": lambda u, v: ((u**n) ** 2, (u**2) ** n),
    "root of an even power": lambda u, v: (sqrt(u ** (2 * n)), u**n),
    "root of an even power, absolutely": lambda u, v: (sqrt(u ** (2 * n)), absolute(u) ** n),
    "power of a product": lambda u, v: ((u * v) ** n, u**n * v**n),
    "power of minus": lambda u, v: ((-u) ** n, of(-1) ** n * u**n),
    "power by the logarithm": lambda u, v: (exp(n * log(absolute(u))), u**n),
    "absolute even power": lambda u, v: (absolute(u) ** (2 * n), u ** (2 * n)),
    "sine of multiples": lambda u, v: (sin(pi * n * 2 + u) ** 2, 1 - cos(u) ** 2),
    "quarter turns": lambda u, v: (cos(pi * n / 2) ** 2 + sin(pi * n / 2) ** 2, of(1)),
    "atan at integers": lambda u, v: (atan(n) + atan(1 / n), pi / 2),
    "root of n**2": lambda u, v: (sqrt(n**2) * u, n * u),
}
COMPLEX: dict[str, Callable[[Formula, Formula], tuple[Formula, Formula]]] = {
    "root of a square": lambda u, v: (sqrt(u**2), u),
    "square of a root": lambda u, v: (sqrt(u) ** 2, u),
    "roots": lambda u, v: (sqrt(u) * sqrt(v), sqrt(u * v)),
    "log of exp": lambda u, v: (log(exp(u)), u),
    "exp of log": lambda u, v: (exp(log(u)), u),
    "log of a square": lambda u, v: (log(u**2), 2 * log(u)),
    "log of a product": lambda u, v: (log(u * v), log(u) + log(v)),
    "log of the inverse": lambda u, v: (log(1 / u), -log(u)),
    "root of the inverse": lambda u, v: (sqrt(1 / u), 1 / sqrt(u)),
    "root of minus": lambda u, v: (sqrt(-u), I * sqrt(u)),
    "Euler": lambda u, v: (exp(I * u), cos(u) + I * sin(u)),
    "de Moivre": lambda u, v: ((cos(u) + I * sin(u)) ** 3, cos(3 * u) + I * sin(3 * u)),
    "Pythagoras": lambda u, v: (sin(u) ** 2 + cos(u) ** 2, of(1)),
    "sinh": lambda u, v: (sinh(u), -I * sin(I * u)),
    "power law": lambda u, v: ((u**2) ** HALF, u),
    "half of log": lambda u, v: (exp(log(u) / 2), sqrt(u)),
    "quotient of roots": lambda u, v: (sqrt(u / v), sqrt(u) / sqrt(v)),
    "asinh": lambda u, v: (log(u + sqrt(u**2 + 1)) + log(sqrt(u**2 + 1) - u), of(0)),
    "cube of a root": lambda u, v: (sqrt(u) ** 3, sqrt(u**3)),
    "difference of squares": lambda u, v: ((u**2 - v**2) / (u + v), u - v),
}
INNER: tuple[Callable[[random.Random], Formula], ...] = (
    lambda rng: x, lambda rng: x, lambda rng: x, lambda rng: x - rng.choice((1, HALF, 2)), lambda rng: 2 * x + 1,
    lambda rng: x * y, lambda rng: x + y, lambda rng: x - y, lambda rng: sin(x), lambda rng: exp(x) - 1,
    lambda rng: x**2 - 1, lambda rng: x**2 + x + 1, lambda rng: 1 - x, lambda rng: cos(x) - y, lambda rng: x / y,
    lambda rng: a * x, lambda rng: x**3 - x, lambda rng: log(x), lambda rng: x / 2, lambda rng: tan(x),
    lambda rng: 3 - x, lambda rng: sqrt(x) - 1, lambda rng: 1 - y**2, lambda rng: sin(x) + cos(x),
    lambda rng: x**2 + y**2,
)  # fmt: skip
ENDS = (None, None, None, -3, -2, -1, -HALF, 0, 0, HALF, 1, 2, 3, 4, "-pi", "-1/2*pi", "1/2*pi", "pi", "3/2*pi", "2*pi")


def bounds(rng: random.Random) -> tuple[Any, Any] | None:
    """A random interval, or None."""
    low, high = rng.choice(ENDS), rng.choice(ENDS)
    if low is None and high is None:
        return None
    if low is not None and high is not None:
        if size_of(low) == size_of(high):
            return None
        if size_of(low) > size_of(high):
            low, high = high, low
    return _exact(low), _exact(high)


def size_of(end: Any) -> float:
    """An end as a floating-point number."""
    if not isinstance(end, str):
        return float(end)
    factor = end.replace("pi", "").rstrip("*")
    return 3.141592653589793 * float(Fraction(factor + "1" if factor in ("", "-") else factor))


def _exact(end: Any) -> Any:
    if isinstance(end, str):
        factor = end.replace("pi", "").rstrip("*")
        return f"{Fraction(factor + '1' if factor in ('', '-') else factor)}pi"
    return None if end is None else Fraction(end)


def wrapped(rng: random.Random, lhs: Formula, rhs: Formula, inner: Sequence[Formula]) -> tuple[Formula, Formula]:
    """Both sides in the same surroundings."""
    kind, g = rng.randrange(9), rng.choice(inner)
    if kind == 0:
        return lhs * g, rhs * g
    if kind == 1:
        return lhs + exp(g), rhs + exp(g)
    if kind == 2:
        return lhs**2, rhs**2
    if kind == 3:
        return sin(lhs) * g, g * sin(rhs)
    if kind == 4:
        return lhs - rhs, of(0) * g
    if kind == 5:
        return exp(lhs + g), exp(g) * exp(rhs)
    return lhs, rhs


def _entangled(
    rng: random.Random, name: str, template: Callable[..., tuple[Formula, Formula]], u: Formula, v: Formula
) -> tuple[str, tuple[Formula, Formula]]:
    """Two templates in one equation, which then share radicals, logarithms and angles: nested, added or multiplied."""
    other, second = rng.choice(list(REAL.items()))
    left, right = second(u, v)
    kind = rng.randrange(4)
    if kind == 0:
        return f"{name} of {other}", template(left, v)
    if kind == 1:
        lhs, rhs = template(u, left)
        return f"{name} beside {other}", (lhs, rhs)
    lhs, rhs = template(u, v)
    if kind == 2:
        return f"{name} + {other}", (lhs + left, right + rhs)
    return f"{name} * {other}", (lhs * right, rhs * left)


def equation(rng: random.Random) -> Equation:
    """A random equation."""
    family = rng.choice(("real",) * 8 + ("integer", "complex"))
    words = {"x": "real", "y": "real", "a": "real"}
    positive: tuple[Formula, ...] = ()
    box: dict[str, tuple[Any, Any]] = {}
    if family == "complex":
        words = {"z": "complex", "w": "complex"}
        name, template = rng.choice(list(COMPLEX.items()))
        u = rng.choice((z, z, z - 1, I * z, z * w, exp(z), z**2 + 1))
        v = rng.choice((w, w, -z, z + w))
    else:
        table = REAL if family == "real" else INTEGER
        name, template = rng.choice(list(table.items()))
        u, v = rng.choice(INNER)(rng), rng.choice((y, y, 1 - y, x + 1, x**2 + 1, 2 * y, of(2)))
        for variable_name in ("x", "y", "a"):
            interval = bounds(rng) if rng.random() < (0.75 if variable_name == "x" else 0.5) else None
            if interval is not None:
                box[variable_name] = interval
        if rng.random() < 0.2:
            positive = (rng.choice((x * y, x + y, 1 - x**2 - y**2, x**2 - 1, x * (x - 1), sin(x), x - y, cos(x))),)
        if rng.random() < 0.25:
            word = rng.choice(("positive", "negative", "nonnegative", "nonzero"))
            box.pop("x", None)
            words["x"] = word
        if family == "integer":
            words["n"] = rng.choice(("integer", "integer", "integer positive", "integer nonnegative"))
    if family == "real" and rng.random() < 0.3:
        name, (lhs, rhs) = _entangled(rng, name, template, u, v)
    else:
        lhs, rhs = template(u, v)
    lhs, rhs = wrapped(rng, lhs, rhs, (u, v))
    if rng.random() < 0.15:
        rhs = rhs * rng.choice(NEAR)
    return Equation(lhs, rhs, words, box, positive, f"{family}: {name}")
