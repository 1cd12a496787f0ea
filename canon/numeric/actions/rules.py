"""Rules of quadrature whose nodes are doubled until nothing changes: one for each nature of the end points.

- Of a period of a smooth periodic function: equidistant nodes. Trefethen and Weideman, SIAM Review 56 (2014) 385.
- Between two simple turning points: Gauss–Chebyshev, equidistant in the angle θ of q = mid − half cos θ.
- Where an end is anything else (an unstable point, or one nearby; a kink; a wall): tanh-sinh. Takahasi and Mori,
  Publ. RIMS 9 (1974) 721. It is told how far each node is from the nearer end, which a difference wouldn't say.

The change of the last doubling bounds what is left, as the error falls faster than geometrically in the number of
nodes; the rounding is bounded by the balls themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import flint
from flint import arb

from canon.numeric.actions.balls import Ball

Integrand = Callable[[Ball], Sequence[Ball]]
Nodes = Iterator[tuple[Ball, Ball]]

FEWEST: Final = 8
MOST_CHEBYSHEV: Final = 512
MOST_PERIODIC: Final = 1024
LEVELS: Final = 12
_ENOUGH: Final = 4
"""Levels after which the last node tells whether the precision leaves out too much beyond it."""


@dataclass(frozen=True)
class Quadrature:
    """The integrals of several functions at once: their `values`, balls whose radius bounds rounding and truncation.

    `resolved` is False where the last doubling still changed one of them by more than was asked for; `hopeless` says
    that more digits would not help.
    """

    values: tuple[Ball, ...]
    nodes: int
    rule: str
    resolved: bool
    hopeless: bool = False


def periodic(integrand: Integrand, start: Ball, period: Ball, bits: int) -> Quadrature:
    """∫ over one period, from anywhere."""

    def nodes(count: int, fresh: bool) -> Nodes:
        for k in range(1 if fresh else 0, count, 2 if fresh else 1):
            yield start + period * k / count, period / count

    return _doubled(integrand, nodes, bits, MOST_PERIODIC, "periodic trapezoid")


def chebyshev(integrand: Integrand, low: Ball, high: Ball, bits: int) -> Quadrature:
    """∫ between simple turning points, of p or of 1/p: both are smooth in θ with the weight sin θ."""
    centre, half = (low + high) / 2, (high - low) / 2

    def nodes(count: int, fresh: bool) -> Nodes:
        # the nodes of θ = kπ/N, k = 1 … N − 1, of which every second one is fresh; the ends would add nothing to J,
        # but they would to T: half-odd nodes have none there, at the price of no nesting
        del fresh
        for k in range(count):
            sine, cosine = (arb.pi() * (2 * k + 1) / (2 * count)).sin_cos()
            yield centre - half * cosine, half * sine * arb.pi() / count

    return _doubled(integrand, nodes, bits, MOST_CHEBYSHEV, "Gauss-Chebyshev", nested=False)


def tanh_sinh(integrand: Integrand, low: Ball, high: Ball, bits: int) -> Quadrature:
    """∫ between ends of any kind, at which the integrand may vanish or diverge as a power above −1."""
    length = high - low
    before, total, count = None, None, 0
    for level in range(1, LEVELS + 1):
        part, last = None, None
        for fraction, weight in _tanh_sinh_nodes(flint.ctx.prec, level):
            pair = [integrand(low + length * fraction), integrand(high - length * fraction)]
            if fraction == _HALF:
                pair = pair[:1]
            terms = [length * weight * sum((row[k] for row in pair[1:]), start=pair[0][k]) for k in range(len(pair[0]))]
            part = terms if part is None else [a + b for a, b in zip(part, terms, strict=True)]
            last, count = terms, count + len(pair)
        assert part is not None
        assert last is not None
        total = part if total is None else [a / 2 + b for a, b in zip(total, part, strict=True)]
        if not all(value.is_finite() for value in total):
            break
        if before is not None:
            # what lies beyond the last node is of the size of what lies at it
            beyond = [4 * abs(a).upper() for a in last]
            found = _settled(total, before, bits, beyond)
            if found is not None:
                return Quadrature(found, count, "tanh-sinh", True)
            if level >= _ENOUGH and any(a > abs(b) / 2**bits for a, b in zip(beyond, total, strict=True)):
                break
        before = total
    else:
        return Quadrature(tuple(total or ()), count, "tanh-sinh", False, hopeless=True)
    return Quadrature(tuple(total or ()), count, "tanh-sinh", False)


_HALF: Final = arb(0.5)


@lru_cache(maxsize=64)
def _tanh_sinh_nodes(prec: int, level: int) -> tuple[tuple[Any, Any], ...]:
    """Fractions of the length from an end, and weights, of the nodes u = kh, h = 2^−level, that are new at the level.

    Nodes nearer than 2^(−2 prec/5) to an end are left out: nearer ones could not tell E − V from 0.
    """
    h = arb(1) / 2**level
    found = []
    k, step = (0, 1) if level == 1 else (1, 2)
    nearest = arb(2) ** (-2 * prec // 5)
    while True:
        u = h * k
        g = arb.pi() * u.sinh()
        fraction = 1 / (1 + g.exp())
        if fraction < nearest:
            return tuple(found)
        weight = h * arb.pi() * u.cosh() * fraction * (1 - fraction)
        found.append((_HALF if k == 0 else fraction, weight))
        k += step


def _doubled(
    integrand: Integrand, nodes: Callable[[int, bool], Nodes], bits: int, most: int, name: str, nested: bool = True
) -> Quadrature:
    count, before, evaluated = FEWEST, None, 0
    while True:
        fresh = nested and before is not None
        sums: list[Ball] | None = None
        for x, weight in nodes(count, fresh):
            row = [weight * value for value in integrand(x)]
            sums = row if sums is None else [a + b for a, b in zip(sums, row, strict=True)]
            evaluated += 1
        assert sums is not None
        values = [a / 2 + b for a, b in zip(before, sums, strict=True)] if fresh and before else sums
        if not all(value.is_finite() for value in values):
            return Quadrature(tuple(values), evaluated, name, False)
        if before is not None and (found := _settled(values, before, bits)) is not None:
            return Quadrature(found, evaluated, name, True)
        if 2 * count > most:
            return Quadrature(tuple(values), evaluated, name, False)
        count, before = 2 * count, values


def _settled(
    values: Sequence[Ball], before: Sequence[Ball], bits: int, beyond: Sequence[Ball] = ()
) -> tuple[Ball, ...] | None:
    """The values with the last change in their radius, if each is known to `bits` then."""
    found = []
    for k, (value, old) in enumerate(zip(values, before, strict=True)):
        change = abs(value.mid() - old.mid())
        if beyond:
            change = change + beyond[k]
        wide = value + arb(0, change)
        if wide.rel_accuracy_bits() < bits and not (value.mid().is_zero() and change.is_zero()):
            return None
        found.append(wide)
    return tuple(found)
