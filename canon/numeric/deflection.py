"""The deflection of a particle by a central potential that vanishes far away, and the cross-section with it.

A particle of energy E = mv²/2 far away that would pass the centre at a distance b turns round at r₀, the largest zero
of 1 − V/E − b²/r². With W(u) = V(r₀/u)/E, A = 1 − u² and B = b²/r₀² A + W(1) − W(u), it is deflected by

    χ = 2∫₀¹ (W(1) − W(u)) / (√A √B (√B + (b/r₀)√A)) du,   and   π − χ = 2 (b/r₀) ∫₀¹ du/√B:

the first form keeps its digits where χ is small, the second where the particle comes straight back. χ > 0 is repulsion,
χ < 0 attraction. Landau and Lifshitz, Mechanics, §18; Goldstein, Classical Mechanics, 3.10. For V = k/r Rutherford's
formulas: tan(χ/2) = k/(2Eb), dσ/dΩ = (k/4E)²/sin⁴(χ/2). Conditioning: χ and π − χ are each known to a part of
themselves; far out in a screened potential they answer to b as V does, by b/λ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, hypot, pi
from typing import Any, Final

import numpy as np

Array = Any
Potential = Callable[[Array], Array]
"""V at distances r (m,)."""

NODES: Final = 24
HALVINGS: Final = 40
"""Panels towards either end of the integral, each half as long as the one before."""
NEAR: Final = 1e-2
"""Below this 1 − u the difference W(1) − W(u) is the integral of its slope."""
SPREAD: Final = 2e-3
"""Of the impact parameters between which dχ/db is a difference."""
FARTHEST: Final = 1e8
NEAREST: Final = 1e-8
"""Distances, beside the one that the particle begins at, between which it is followed."""


@dataclass(frozen=True)
class Deflection:
    """The angle χ, positive where it is repelled, and π − |χ|, which has digits of its own for repulsion.

    `nearest` is the distance r₀ at which the particle turns round.
    """

    angle: float
    backward: float
    nearest: float


def rutherford(k: float, E: float, b: float) -> Deflection:
    """The deflection by V = k/r, and π − |χ|: tan(χ/2) = k/(2Eb). The turning point without cancellation."""
    side = 2 * E * b
    far = hypot(k, side)
    nearest = (k + far) / (2 * E) if k > 0 else side * b / (far - k) if side else 0.0
    return Deflection(2 * atan2(k, side), 2 * atan2(side, abs(k)), nearest)


def rutherford_cross_section(k: float, E: float, b: float) -> float:
    """dσ/dΩ at the angle that belongs to b: (k² + 4E²b²)²/(4Ek)², ∞ beyond all doubles."""
    root = k / (4 * E) + b * (E * b / k)
    return root * root


def deflection(V: Potential, slope: Potential, E: float, b: float, begin: float) -> Deflection | None:
    """The deflection by any V, with `slope` = dV/dr; the particle is, at some time, at a distance `begin`.

    None where it does not come from far away and go back there: it is bound, or falls into the centre.
    """
    with np.errstate(all="ignore"):
        return _deflection(V, slope, E, b, begin)


def _deflection(V: Potential, slope: Potential, E: float, b: float, begin: float) -> Deflection | None:
    nearest = turning_point(V, E, b, begin)
    if nearest is None:
        return None
    W1, ratio = float(V(np.array([nearest]))[0]) / E, b / nearest
    u, away, root_A, weights = _nodes()
    change = W1 - V(nearest / u) / E
    close = away < NEAR
    x, w = np.polynomial.legendre.leggauss(8)
    between = 1 - away[close, None] * (x + 1) / 2
    slopes = -slope((nearest / between).ravel()).reshape(between.shape) * nearest / (between**2 * E)
    change[close] = away[close] * (slopes @ w) / 2
    B = (ratio * root_A) ** 2 + change
    if not np.all(B > 0):
        return None
    root_B = np.sqrt(B)
    angle = 2 * float(weights @ (change / (root_B * (root_B + ratio * root_A))))
    if angle < 0:
        return Deflection(angle, pi + angle, nearest)
    return Deflection(angle, 2 * ratio * float(weights @ (root_A / root_B)), nearest)


def beyond_barriers(V: Potential, E: float, b: float, begin: float) -> float:
    """`begin`, or a place further out than where the particle is kept away last, if it is kept away from there."""
    with np.errstate(all="ignore"):
        out = np.geomspace(begin, FARTHEST * begin, 1200)
        kept = np.flatnonzero(~(1 - V(out) / E - (b / out) ** 2 > 0))
    return float(10 * out[kept[-1]]) if kept.size else begin


def turning_point(V: Potential, E: float, b: float, begin: float) -> float | None:
    """r₀, the largest distance from which the particle is kept away; None where there is none, or it can't leave."""
    if not E > 0:
        return None
    room = lambda r: 1 - V(r) / E - (b / r) ** 2
    out = np.geomspace(begin, FARTHEST * begin, 1200)[1:]
    inside = np.geomspace(begin, NEAREST * begin, 1200)
    if not np.all(room(out) > 0):
        return None
    closed = ~(room(inside) > 0)
    closed[0] = False  # the particle is there
    if not closed.any():
        return None
    k = int(np.argmax(closed))
    low, high = inside[k], inside[k - 1]
    for _ in range(80):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (low, middle) if room(np.array([middle]))[0] > 0 else (middle, high)
    return float(high)


def cross_section(of: Callable[[float], Deflection | None], b: float, scale: float) -> float | None:
    """dσ/dΩ = b/|sin χ · dχ/db| of the particles with impact parameters about b; `scale` is a length where b is 0.

    `of` is the deflection as a function of b. None where there is none, or all of them go the same way.
    """
    h = SPREAD * max(b, scale if b < SPREAD * scale else b)
    here = of(b)
    around = [_signed(of, b + k * h) for k in (-2, -1, 1, 2)]
    if here is None or any(each is None for each in around):
        return None
    backwards = abs(here.angle) > pi / 2
    before2, before, after, after2 = (each[1 if backwards else 0] for each in around if each is not None)
    rate = (8 * (after - before) - (after2 - before2)) / (12 * h)
    if rate == 0:
        return None
    if b == 0:
        return 1 / rate**2
    sine = np.sin(here.backward if backwards else here.angle)
    return float(abs(b / (sine * rate))) if sine != 0 else None


def _signed(of: Callable[[float], Deflection | None], b: float) -> tuple[float, float] | None:
    """χ and π − |χ|, both odd functions of b."""
    found = of(abs(b))
    if found is None:
        return None
    sign = 1.0 if b >= 0 else -1.0
    return sign * found.angle, sign * found.backward


def _nodes() -> tuple[Array, Array, Array, Array]:
    """u, 1 − u and √(1 − u²) at nodes of ∫₀¹ … du/√(1 − u²), and the weights: Gauss's, in panels that shrink towards
    both ends, each end in an angle of its own."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    edges = np.concatenate([[0.0], 2.0 ** np.arange(-HALVINGS, 1)]) * pi / 4
    middle, width = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    angle, weights = (middle[:, None] + width[:, None] * x).ravel(), (width[:, None] * w).ravel()
    sine, cosine, away = np.sin(angle), np.cos(angle), 2 * np.sin(angle / 2) ** 2
    return (
        np.concatenate([cosine, sine]),
        np.concatenate([away, 1 - sine]),
        np.concatenate([sine, cosine]),
        np.tile(weights, 2),
    )
