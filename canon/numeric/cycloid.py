"""The fastest descent between two points: the cycloid through both.

Conditioning: the time is known to a part of itself, Σ |∂ln T/∂ln x| ≤ 1.22 over `across`, `down` and g; the radius of a
steep descent, which is as `down`³/`across`², to 5 roundings.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf, isfinite, nan, pi, sin, sqrt, ulp

from canon.errors import InputError
from canon.expected import finite_number

SMALL = 0.5
"""Below this angle θ − sin θ and the ratio's slope are taken from their series."""


@dataclass(frozen=True)
class Descent:
    """x = r (θ − sin θ), depth = r (1 − cos θ), θ from 0 to `angle`; at rest at the beginning, `time` to the end.

    `angle` lies in (0, 2π); beyond π the curve comes up again. `straight` is the time down the straight line.
    """

    radius: float
    angle: float
    time: float
    straight: float

    def place(self, share: float) -> tuple[float, float]:
        """(x, depth) after a share of the time, 0 to 1: θ grows uniformly."""
        finite_number(share, "share")
        if not 0 <= share <= 1:
            raise InputError(f"a share of the time is from 0 to 1, not {share}", "share")
        theta = share * self.angle
        return self.radius * _arc(theta), self.radius * _height(theta)


def fastest_descent(across: float, down: float, g: float = 9.80665) -> Descent:
    """The brachistochrone from rest to a point `across` to the side (> 0) and `down` below (≥ 0), no friction.

    The ratio across/down = (θ − sin θ)/(1 − cos θ) grows from 0 to ∞ with θ in (0, 2π), so that there is one cycloid
    (Goldstein, Poole and Safko (2002), section 2.2).

    **Raises:** `InputError` for an end point that isn't beside and not above the beginning, or a g that isn't positive.
    """
    for value, name in ((across, "across"), (down, "down"), (g, "g")):
        finite_number(value, name)
    for value, name in ((across, "across"), (g, "g")):
        if not (isfinite(value) and value > 0):
            raise InputError(f"a positive number is expected, not {value}", name)
    if not (isfinite(down) and down >= 0):
        raise InputError(f"the end lies not above the beginning: a number from 0 on is expected, not {down}", "down")
    try:
        theta = _angle(across / down if down else inf)
        radius = across / _arc(theta) if down < across else down / _height(theta)
        straight = hypot(across, down) * sqrt(2 / (g * down)) if down else inf
        return Descent(radius, theta, sqrt(radius / g) * theta, straight)
    except (ZeroDivisionError, OverflowError):
        raise InputError(f"in double precision there is no cycloid to ({across}, {down})", "across, down") from None


def _angle(ratio: float) -> float:
    """θ with (θ − sin θ)/(1 − cos θ) = ratio, by bisection and Newton's steps inside the bracket."""
    if ratio == inf:
        return 2 * pi
    low, high = 0.0, 2 * pi
    theta = min(3 * ratio, pi)
    for _ in range(200):
        height = _height(theta)
        off = _arc(theta) - ratio * height
        low, high = (theta, high) if off < 0 else (low, theta)
        slope = height - ratio * sin(theta)
        step = theta - off / slope if slope else nan
        new = step if low < step < high else (low + high) / 2
        if abs(new - theta) <= 2 * ulp(theta):
            return new
        theta = new
    return theta


def _height(theta: float) -> float:
    """1 − cos θ without cancellation."""
    return 2 * sin(theta / 2) ** 2


def _arc(theta: float) -> float:
    """θ − sin θ without cancellation."""
    if abs(theta) > SMALL:
        return theta - sin(theta)
    square, term, total = theta * theta, theta**3 / 6, 0.0
    k = 3
    while total + term != total:
        total += term
        term *= -square / ((k + 1) * (k + 2))
        k += 2
    return total
