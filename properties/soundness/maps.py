"""Canonical maps by construction: compositions of factors, each of which is canonical by a theorem."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from properties.soundness.formula import Formula, call, names, of, size, substituted, variable

LARGEST = 700
NICE = (
    Fraction(1, 3),
    Fraction(1, 2),
    Fraction(2, 3),
    1,
    Fraction(3, 2),
    2,
    3,
    -1,
    Fraction(-1, 2),
    -2,
    Fraction(1, 1000),
)


@dataclass(frozen=True)
class Map:
    """New variables in old ones, positions first; the box of the old variables; the factors' names."""

    q: tuple[str, ...]
    p: tuple[str, ...]
    functions: tuple[Formula, ...]
    box: dict[str, tuple[Any, Any]] = field(default_factory=dict)
    factors: tuple[str, ...] = ()

    @property
    def n(self) -> int:
        """Degrees of freedom."""
        return len(self.q)

    @property
    def variables(self) -> tuple[str, ...]:
        """The old variables."""
        return self.q + self.p


def identity(n: int) -> Map:
    """The identity in n degrees of freedom."""
    q, p = tuple(f"q{k + 1}" for k in range(n)), tuple(f"p{k + 1}" for k in range(n))
    return Map(q, p, tuple(variable(name) for name in q + p))


def pick(rng: random.Random) -> Formula:
    """A simple number that isn't 0."""
    return of(rng.choice(NICE))


def smooth(rng: random.Random, arguments: Sequence[Formula]) -> Formula:
    """A random smooth function of one of the arguments or of two of them."""
    x = rng.choice(arguments)
    y = rng.choice(arguments)
    c = pick(rng)
    kind = rng.randrange(11)
    if kind == 0:
        return c * x**2 + pick(rng) * x * y
    if kind == 1:
        return c * x**3
    if kind == 2:
        return c * call("sin", pick(rng) * x + y)
    if kind == 3:
        return c * call("exp", pick(rng) * x)
    if kind == 4:
        return c * call("log", 1 + x**2)
    if kind == 5:
        return c * call("sqrt", 1 + x**2 + y**2)
    if kind == 6:
        return c * call("atan", x)
    if kind == 7:
        return c * call("cos", x) * y
    if kind == 8:
        return c / (2 + x**2)
    if kind == 9:
        return c * x * y**2 + variable("a") * x
    return c * call("tanh", x) + variable("a") * x**2


def slope(f: Formula, name: str) -> Formula:
    """The derivative of the formulas that `smooth` makes, by the rules of the textbook."""
    if f.head == "num":
        return of(0)
    if f.head == "var":
        return of(int(f.args[0] == name))
    if name not in names(f):
        return of(0)
    if f.head == "+":
        terms = [slope(part, name) for part in f.args if name in names(part)]
        return terms[0] if len(terms) == 1 else terms[0] + terms[1]
    if f.head == "*":
        a, b = f.args
        terms = [slope(a, name) * b] if name in names(a) else []
        terms += [a * slope(b, name)] if name in names(b) else []
        return terms[0] if len(terms) == 1 else terms[0] + terms[1]
    if f.head == "/":
        a, b = f.args
        if name not in names(a):
            return -a * slope(b, name) / b**2
        return slope(a, name) / b - a * slope(b, name) / b**2
    if f.head == "**":
        return f.args[1] * f.args[0] ** (f.args[1].args[0] - 1) * slope(f.args[0], name)
    (u,) = f.args
    outer: dict[str, Callable[[], Formula]] = {
        "sin": lambda: call("cos", u), "cos": lambda: -call("sin", u), "exp": lambda: f, "log": lambda: 1 / u,
        "sqrt": lambda: 1 / (2 * f), "atan": lambda: 1 / (1 + u**2), "tanh": lambda: 1 - f**2,
        "sinh": lambda: call("cosh", u), "cosh": lambda: call("sinh", u), "cbrt": lambda: f / (3 * u),
    }  # fmt: skip
    return outer[f.head]() * slope(u, name)


def kick(rng: random.Random, old: Map) -> Map:
    """p → p − ∂V/∂q: a shear."""
    new = [variable(name) for name in old.q]
    V = smooth(rng, new)
    f = [variable(p) - slope(V, q) for q, p in zip(old.q, old.p, strict=True)]
    return _then(old, [*new, *f], "kick")


def drift(rng: random.Random, old: Map) -> Map:
    """q → q + ∂T/∂p: a shear."""
    p = [variable(name) for name in old.p]
    T = smooth(rng, p)
    f = [variable(q) + slope(T, name) for q, name in zip(old.q, old.p, strict=True)]
    return _then(old, [*f, *p], "drift")


def exchange(rng: random.Random, old: Map) -> Map:
    """(q, p) → (p, −q) in one degree of freedom."""
    k = rng.randrange(old.n)
    q, p = [variable(x) for x in old.q], [variable(x) for x in old.p]
    q[k], p[k] = p[k], -q[k]
    return _then(old, [*q, *p], "exchange")


def squeeze(rng: random.Random, old: Map) -> Map:
    """(q, p) → (c q, p/c)."""
    k, c = rng.randrange(old.n), rng.choice((pick(rng), call("exp", variable("a")), 1 + variable("a") ** 2))
    q, p = [variable(x) for x in old.q], [variable(x) for x in old.p]
    q[k], p[k] = c * q[k], p[k] / c
    return _then(old, [*q, *p], "squeeze")


def rotation(rng: random.Random, old: Map) -> Map:
    """(q, p) turned by an angle: a Pythagorean one, a parameter, or a function of the radius."""
    k = rng.randrange(old.n)
    q, p = [variable(x) for x in old.q], [variable(x) for x in old.p]
    x, y = q[k], p[k]
    angle = rng.choice((variable("a"), (x**2 + y**2) * pick(rng), None))
    c, s = (of(Fraction(3, 5)), of(Fraction(4, 5))) if angle is None else (call("cos", angle), call("sin", angle))
    q[k], p[k] = c * x + s * y, c * y - s * x
    return _then(old, [*q, *p], "rotation")


def mixing(rng: random.Random, old: Map) -> Map:
    """Positions and momenta of two degrees of freedom turned by the same angle."""
    if old.n < 2:
        return rotation(rng, old)
    i, j = rng.sample(range(old.n), 2)
    angle = rng.choice((variable("a"), of(1)))
    c, s = call("cos", angle), call("sin", angle)
    f = [variable(x) for x in old.variables]
    for shift in (0, old.n):
        x, y = f[i + shift], f[j + shift]
        f[i + shift], f[j + shift] = c * x + s * y, c * y - s * x
    return _then(old, f, "mixing")


def point(rng: random.Random, old: Map) -> Map:
    """q → f(q), p → p/f'(q) with f strictly increasing, and a gradient added to p."""
    k = rng.randrange(old.n)
    q, p = [variable(x) for x in old.q], [variable(x) for x in old.p]
    x = q[k]
    c = of(rng.choice([v for v in NICE if v > 0]))
    f = rng.choice((call("exp", c * x), call("sinh", x), x**3 + c * x, call("atan", c * x), x / call("sqrt", 1 + x**2)))
    q[k], p[k] = f, p[k] / slope(f, old.q[k])
    return _then(old, [*q, *p], "point")


def polar(rng: random.Random, old: Map) -> Map:
    """Cartesian to polar coordinates with their momenta."""
    if old.n < 2:
        return action(rng, old)
    i, j = rng.sample(range(old.n), 2)
    f = [variable(x) for x in old.variables]
    x, y, u, v = f[i], f[j], f[i + old.n], f[j + old.n]
    r = call("sqrt", x**2 + y**2)
    f[i], f[j], f[i + old.n], f[j + old.n] = r, call("atan2", y, x), (x * u + y * v) / r, x * v - y * u
    return _then(old, f, "polar")


def action(rng: random.Random, old: Map) -> Map:
    """(q, p) → (atan2(q, p), (p² + q²)/2), with a frequency."""
    k = rng.randrange(old.n)
    f = [variable(x) for x in old.variables]
    q, p = f[k], f[k + old.n]
    w = of(rng.choice((1, 2, Fraction(1, 2))))
    f[k], f[k + old.n] = call("atan2", w * q, p), (p**2 + w**2 * q**2) / (2 * w)
    return _then(old, f, "action")


def oscillator(rng: random.Random, old: Map) -> Map:
    """(φ, I) → (√(2I) sin φ, √(2I) cos φ): only as the first factor, where I > 0 can be asked for."""
    if old.factors:
        return kick(rng, old)
    k = rng.randrange(old.n)
    f = [variable(x) for x in old.variables]
    phi, radius = f[k], call("sqrt", 2 * f[k + old.n])
    f[k], f[k + old.n] = radius * call("sin", phi), radius * call("cos", phi)
    return replace(_then(old, f, "oscillator"), box={**old.box, old.p[k]: (Fraction(0), None)})


def potential(rng: random.Random, old: Map) -> Map:
    """p → p − V′(q) with an arbitrary function V: only as the first factor, where V′ can be written."""
    if old.factors:
        return drift(rng, old)
    k = rng.randrange(old.n)
    f = [variable(x) for x in old.variables]
    q = f[k]
    f[k + old.n] = f[k + old.n] - call("D", call("V", *f[: old.n]), q)
    for i in range(old.n):
        if i != k:
            f[i + old.n] = f[i + old.n] - call("D", call("V", *f[: old.n]), f[i])
    return _then(old, f, "potential")


def _then(first: Map, second: Sequence[Formula], name: str) -> Map:
    """The composition: `second`, stated in the old names, after `first`."""
    images = dict(zip(first.variables, first.functions, strict=True))
    return replace(first, functions=tuple(substituted(f, images) for f in second), factors=(*first.factors, name))


FACTORS = (kick, drift, exchange, squeeze, rotation, mixing, point, polar, action, oscillator, potential)


def canonical_map(rng: random.Random) -> Map:
    """A composition of one to four factors in one to three degrees of freedom, not too long to write down."""
    n = rng.choice((1, 1, 1, 2, 2, 3))
    made = identity(n)
    for _ in range(rng.choice((1, 1, 2, 2, 3, 4))):
        longer = rng.choice(FACTORS)(rng, made)
        if sum(size(f) for f in longer.functions) <= LARGEST:
            made = longer
    return made if made.factors else kick(rng, made)
