"""Light in layers, by Fermat's principle: reflection, refraction, and the ray between two points.

In double precision. Along a ray through plane layers n sin θ keeps its value (Snell), the momentum of the ray that the
translations along the layers conserve (Born & Wolf, Principles of Optics, sections 3.2 and 3.3). Conditioning: the
optical path grows with each index and each length and Σ |∂ln path/∂ln x| = 2, as it is of degree 1 in both; the
invariant has at most 3. Flat rays in a layer of index n beside the least one n₀ have a slope that knows n − n₀ only:
to n/(n − n₀) roundings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import fsum, isfinite, sqrt

from canon.errors import InputError
from canon.expected import finite_number, numbers

STEPS = 200


@dataclass(frozen=True)
class LayeredRay:
    """A ray down through plane layers.

    **Arguments:** `invariant`, n sin θ; `places`, (across, depth) at the beginning, each interface and the end;
    `slopes`, tan θ in each layer; `optical_path`, Σ n·length, the least of all paths between the ends.
    """

    invariant: float
    places: tuple[tuple[float, float], ...]
    slopes: tuple[float, ...]
    optical_path: float


def ray_through_layers(indices: Sequence[float], thicknesses: Sequence[float], across: float) -> LayeredRay:
    """The ray from a point at the top of plane layers to one at their bottom, `across` to the side.

    Σ d tan θ = across grows with tan θ in the layer of the least index, so that there is one ray; with sin θ it would
    lose its digits for flat rays.

    **Arguments:** `indices` and `thicknesses`, positive, one for each layer; `across`, 0 or more.

    **Raises:** `InputError`.
    """
    n, d = numbers(indices, "indices"), numbers(thicknesses, "thicknesses")
    if not n or len(n) != len(d):
        raise InputError("one index and one thickness are expected for each layer", "indices")
    for values, where in ((n, "indices"), (d, "thicknesses")):
        for value in values:
            if not (isfinite(value) and value > 0):
                raise InputError(f"positive numbers are expected, not {value}", where)
    finite_number(across, "across", least=0.0)
    s = _slope(n, d, across)
    slopes = _slopes(n, s)
    least = min(n)
    places = [(0.0, 0.0)]
    for thickness, slope in zip(d, slopes, strict=True):
        places.append((places[-1][0] + thickness * slope, places[-1][1] + thickness))
    path = fsum(a * t * sqrt(1 + slope * slope) for a, t, slope in zip(n, d, slopes, strict=True))
    return LayeredRay(least * s / sqrt(1 + s * s), tuple(places), slopes, path)


def _slopes(n: Sequence[float], s: float) -> tuple[float, ...]:
    """tan θ in each layer where it is s in that of the least index."""
    least = min(n)
    return tuple(least * s / sqrt((a - least) * (a + least) * (1 + s * s) + least * least) for a in n)


def _slope(n: Sequence[float], d: Sequence[float], across: float) -> float:
    """s with Σ d tan θ = across, by Newton's steps inside a bracket."""
    least = min(n)
    low, high = across / fsum(d), across / fsum(t for a, t in zip(n, d, strict=True) if a == least)
    s = high
    for _ in range(STEPS):
        slopes = _slopes(n, s)
        off = fsum([*(t * slope for t, slope in zip(d, slopes, strict=True)), -across])
        if off == 0 or high <= low:
            break
        low, high = (s, high) if off < 0 else (low, s)
        # d tan θ/ds = a² tan³ θ/(least² s³), a the index of the layer
        rate = fsum(t * (a / least) ** 2 * (slope / s) ** 3 for a, t, slope in zip(n, d, slopes, strict=True))
        newer = s - off / rate
        newer = newer if low <= newer <= high else (low + high) / 2
        if newer == s:
            break
        s = newer
    return s


def reflected(direction: Sequence[float], normal: Sequence[float]) -> tuple[float, ...]:
    """The unit vector of a ray that comes in with a direction, behind a mirror with this normal (of either sign)."""
    way = _unit(direction, "direction")
    across = _unit(normal, "normal", len(way))
    twice = 2 * _dot(way, across)
    return tuple(a - twice * b for a, b in zip(way, across, strict=True))


def refracted(
    direction: Sequence[float], normal: Sequence[float], before: float, behind: float
) -> tuple[float, ...] | None:
    """The unit vector of the ray behind an interface, of index `behind`; None where all is reflected.

    n₁ t₁ × N = n₂ t₂ × N for the unit vectors t of the rays and N of the normal, of either sign.
    """
    for value, where in ((before, "before"), (behind, "behind")):
        finite_number(value, where)
        if not value > 0:
            raise InputError(f"a positive index is expected, not {value}", where)
    way = _unit(direction, "direction")
    across = _unit(normal, "normal", len(way))
    along = _dot(way, across)
    aside = [a - along * b for a, b in zip(way, across, strict=True)]
    ratio = before / behind
    rest = 1 - ratio * ratio * _dot(aside, aside)
    if rest < 0:
        return None
    forward = sqrt(rest) if along >= 0 else -sqrt(rest)
    return tuple(ratio * a + forward * b for a, b in zip(aside, across, strict=True))


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return fsum(x * y for x, y in zip(a, b, strict=True))


def _unit(vector: Sequence[float], where: str, dimension: int | None = None) -> list[float]:
    found = numbers(vector, where)
    if dimension is not None and len(found) != dimension:
        raise InputError(f"a vector of {dimension} numbers is expected, as many as the direction has", where)
    size = sqrt(_dot(found, found))
    if len(found) not in (2, 3) or not (isfinite(size) and size > 0):
        raise InputError("a vector of two or three numbers, not all 0, is expected", where)
    return [x / size for x in found]
