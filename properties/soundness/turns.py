"""Inverse circular functions of circular functions, on intervals that end within a piece or reach beyond it.

asin(sin u) is u on one piece, π − u on the next, and so on; which piece an interval lies in is known exactly, since its
ends are α π + β with fractions. An interval that reaches beyond its piece does so by as little as 10⁻¹².
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from properties.soundness.formula import Formula, call, of, variable
from properties.soundness.identities import (
    HALF,
    Equation,
    I,
    acos,
    asin,
    atan,
    atan2,
    cos,
    exp,
    log,
    pi,
    sin,
    sqrt,
    tan,
)
from properties.soundness.rooted import TINY


@dataclass(frozen=True)
class Periodic:
    """left(u) = right(u, k) for ((start + step·k) π < u < (start + step·(k + 1)) π), and on no other such piece."""

    left: Callable[[Formula], Formula]
    right: Callable[[Formula, int], Formula]
    start: Fraction
    step: int


def _turn(k: int) -> Formula:
    return k * pi


def _flip(k: int) -> int:
    return -1 if k % 2 else 1


PERIODIC: dict[str, Periodic] = {
    "asin of sin": Periodic(lambda u: asin(sin(u)), lambda u, k: _flip(k) * (u - _turn(k)), -HALF, 1),
    "asin of cos": Periodic(
        lambda u: asin(cos(u)), lambda u, k: _flip(k) * (_turn(k) + pi / 2 - u), Fraction(0), 1),
    "acos of cos": Periodic(
        lambda u: acos(cos(u)), lambda u, k: u - _turn(k) if k % 2 == 0 else _turn(k + 1) - u, Fraction(0), 1),
    "acos of sin": Periodic(
        lambda u: acos(sin(u)), lambda u, k: pi / 2 - _flip(k) * (u - _turn(k)), -HALF, 1),
    "atan of tan": Periodic(lambda u: atan(tan(u)), lambda u, k: u - _turn(k), -HALF, 1),
    "atan of cot": Periodic(lambda u: atan(1 / tan(u)), lambda u, k: pi / 2 - u + _turn(k), Fraction(0), 1),
    "atan of a quotient": Periodic(lambda u: atan(sin(u) / cos(u)), lambda u, k: u - _turn(k), -HALF, 1),
    "atan2 of sin and cos": Periodic(lambda u: atan2(sin(u), cos(u)), lambda u, k: u - _turn(2 * k), Fraction(-1), 2),
    "atan2 of cos and sin": Periodic(
        lambda u: atan2(cos(u), sin(u)), lambda u, k: pi / 2 - u + _turn(2 * k), -HALF, 2),
    "root of 1 - cos": Periodic(
        lambda u: sqrt((1 - cos(u)) / 2), lambda u, k: _flip(k) * sin(u / 2), Fraction(0), 2),
    "root of 1 + cos": Periodic(
        lambda u: sqrt((1 + cos(u)) / 2), lambda u, k: _flip(k) * cos(u / 2), Fraction(-1), 2),
    "root of 1 - sin**2": Periodic(lambda u: sqrt(1 - sin(u) ** 2), lambda u, k: _flip(k) * cos(u), -HALF, 1),
    "root of 1 + tan**2": Periodic(lambda u: sqrt(1 + tan(u) ** 2), lambda u, k: of(_flip(k)) / cos(u), -HALF, 1),
    "absolute sine": Periodic(lambda u: call("abs", sin(u)), lambda u, k: _flip(k) * sin(u), Fraction(0), 1),
    "sign of the cosine": Periodic(lambda u: call("sign", cos(u)), lambda u, k: of(_flip(k)), -HALF, 1),
    "half the tangent": Periodic(
        lambda u: sqrt((1 - cos(u)) / (1 + cos(u))), lambda u, k: _flip(k) * tan(u / 2), Fraction(0), 1),
    "log of a turn": Periodic(lambda u: log(exp(I * u)), lambda u, k: I * (u - _turn(2 * k)), Fraction(-1), 2),
    "root of a turn": Periodic(lambda u: sqrt(exp(I * u)), lambda u, k: _flip(k) * exp(I * u / 2), Fraction(-1), 2),
}  # fmt: skip


def _end(alpha: Fraction, beta: Fraction) -> Formula:
    turns = of(0) if alpha == 0 else alpha * pi
    return turns if beta == 0 else turns + beta


def turned(rng: random.Random) -> tuple[Equation, bool]:
    """A random equation with its truth."""
    x, y = variable("x"), variable("y")
    name, rule = rng.choice(list(PERIODIC.items()))
    c = rng.choice((Fraction(1), Fraction(1), Fraction(2), Fraction(-1), HALF, Fraction(-3, 2)))
    shift = rng.choice((of(0), of(0), of(0), pi / 2, pi, of(1), 3 * pi / 4))
    u = rng.choice((x, x, x, x + y, x * y, x - y, x**3))
    u = u if c == 1 else c * u
    u = u if shift == of(0) else u + shift
    k = rng.randrange(-2, 3)
    piece = (rule.start + rule.step * k, rule.start + rule.step * (k + 1))
    low, high = (piece[0], Fraction(0)), (piece[1], Fraction(0))
    if rng.random() < 0.4:
        low = (low[0] + rng.choice((Fraction(1, 4), Fraction(1, 10), Fraction(1, 1000))), low[1])
    if rng.random() < 0.4:
        high = (high[0] - rng.choice((Fraction(1, 4), Fraction(1, 10), Fraction(1, 1000))), high[1])
    truth, claimed = True, k
    kind = rng.randrange(6)
    if kind in (0, 1):
        truth, low = False, (piece[0], -rng.choice(TINY))
    elif kind == 2:
        truth, high = False, (piece[1], rng.choice(TINY))
    elif kind == 3:
        truth, claimed = False, k + rng.choice((1, -1))
    rhs = rule.right(u, claimed)
    if truth and rng.random() < 0.3:
        truth, rhs = False, rhs + rng.choice(TINY[2:]) * (1 + y**2)
    positive = (u - _end(*low), _end(*high) - u)
    return Equation(rule.left(u), rhs, {"x": "real", "y": "real"}, {}, positive, name), truth
