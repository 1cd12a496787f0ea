"""Many points of a region in double precision: proposed at random and spread from certified ones.

Membership is judged with rounding bounds, so that a point is kept only where each requirement holds by more than its
rounding. Nothing here is certified: verdicts rest on balls, elsewhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.budget import Budget
from canon.decide.arbitrary import ChosenFunction
from canon.decide.floating import Rounded, evaluate_many
from canon.decide.proposal import Coordinate
from canon.decide.region import Requirement
from canon.decide.sample import Sample
from canon.decide.search import Finder
from canon.decide.tape import Node

Array = Any  # numpy arrays of floats or complex numbers

ROUNDS: Final = 12
PROPOSED: Final = 0.25
"""The part of a round's points that is proposed afresh, once as it is and once with other signs; the others are
spread from points already found."""

FLIPPED: Final = 0.3
"""How often a coordinate of either sign changes its own."""

SPREAD: Final = (-3.0, 0.3)
"""Powers of ten between which the size of a step relative to the coordinate is chosen at first; the lower one falls
from round to round, for regions that are thin."""


@dataclass(frozen=True)
class Cloud:
    """Points of a region: an array a symbol, and the functions chosen for arbitrary ones."""

    points: Mapping[Node, Array]
    functions: Mapping[str, ChosenFunction]

    @property
    def size(self) -> int:
        """How many points there are."""
        return len(next(iter(self.points.values()), ()))

    def exactly(self, index: int) -> dict[Node, Coordinate]:
        """One of the points as the rational numbers that its floats are."""
        return {node: _fraction(array[index]) for node, array in self.points.items()}


def cloud_around(finder: Finder, seeds: Sequence[Sample], count: int, budget: Budget, seed: int) -> Cloud:
    """About `count` points of the finder's region, spread around certified points that share their functions.

    **Raises:** `Unsupported` where a condition has no evaluation in double precision.
    """
    rng = np.random.default_rng(seed)
    functions = seeds[0].functions
    found = _inside(finder, _columns(finder, [sample.point for sample in seeds]), functions)
    tried = 0
    while _size(found) < count and tried < ROUNDS and finder.symbols:
        if tried and budget.spent():
            break
        tried += 1
        missing = count - _size(found)
        fresh = [
            {node: finder.propose(node, False, effort) for node in finder.symbols}
            for effort in range(max(1, int(PROPOSED * missing)))
        ]
        proposed = _columns(finder, fresh)
        parts = [proposed, _flipped(finder, proposed, rng)]
        if _size(found):
            parts.append(_moved(finder, found, missing, SPREAD[0] - tried + 1, rng))
        new = _inside(finder, _joined(parts), functions)
        found = {node: values[:count] for node, values in _joined([found, new]).items()}
    return Cloud(found, functions)


def _fraction(value: Any) -> Coordinate:
    if isinstance(value, complex | np.complexfloating):
        return Fraction(float(value.real)), Fraction(float(value.imag))
    return Fraction(float(value))


def _columns(finder: Finder, points: Sequence[Mapping[Node, Coordinate]]) -> dict[Node, Array]:
    out: dict[Node, Array] = {}
    for node in finder.symbols:
        values = [point[node] for point in points]
        out[node] = np.array([complex(*map(float, v)) if isinstance(v, tuple) else float(v) for v in values])
    return out


def _joined(parts: Sequence[Mapping[Node, Array]]) -> dict[Node, Array]:
    return {node: np.concatenate([part[node] for part in parts]) for node in parts[0]}


def _size(points: Mapping[Node, Array]) -> int:
    return len(next(iter(points.values()), ()))


def _either_sign(finder: Finder, node: Node) -> bool:
    """Whether neither an assumption nor a bound says which sign the symbol has."""
    symbol = finder.tape.symbol_at(node)
    return bool(symbol.is_real) and not (symbol.is_nonnegative or symbol.is_nonpositive) and node not in finder.bounds


def _flipped(finder: Finder, points: Mapping[Node, Array], rng: np.random.Generator) -> dict[Node, Array]:
    """The same points with signs at random: what is proposed leans to one side."""
    out = dict(points)
    for node, values in points.items():
        if _either_sign(finder, node):
            out[node] = np.where(rng.random(len(values)) < 0.5, -values, values)
    return out


def _moved(
    finder: Finder, points: Mapping[Node, Array], count: int, least: float, rng: np.random.Generator
) -> dict[Node, Array]:
    """Each coordinate changed by a random part of itself, of a size that is drawn for each point."""
    chosen = rng.integers(0, _size(points), count)
    size = 10.0 ** rng.uniform(least, SPREAD[1], count)
    out: dict[Node, Array] = {}
    for node, values in points.items():
        start = values[chosen]
        if finder.tape.symbol_at(node).is_integer:
            out[node] = start
            continue
        factor = np.exp(np.minimum(size, 2.0) * rng.standard_normal(count))
        if np.iscomplexobj(start):
            factor = factor * np.exp(1j * size * rng.standard_normal(count))
        elif _either_sign(finder, node):
            factor = np.where(rng.random(count) < FLIPPED, -factor, factor)
        out[node] = start * factor
    return out


def _inside(finder: Finder, points: Mapping[Node, Array], functions: Mapping[str, ChosenFunction]) -> dict[Node, Array]:
    """Those of the points at which every requirement holds by more than its rounding."""
    kept = np.ones(_size(points), dtype=bool)
    for values in points.values():
        kept &= np.isfinite(values)
    place = evaluate_many(finder.tape, finder.conditions, points, functions)
    for requirement in finder.region.requirements:
        kept &= satisfied(requirement, [place[node] for node in requirement.nodes])
    return {node: values[kept] for node, values in points.items()}


def satisfied(requirement: Requirement, terms: Sequence[Rounded]) -> Array:
    """Where a requirement holds by more than the rounding of its terms."""
    value, bound = terms[0]
    kind = requirement.kind
    nonzero = np.abs(value) > bound
    if kind == "nonzero":
        return nonzero
    if kind == "slit" and np.iscomplexobj(value):
        return (np.real(value) > bound) | (np.abs(np.imag(value)) > bound)
    if np.iscomplexobj(value):
        return np.zeros(np.shape(value), dtype=bool)
    if kind in ("positive", "slit"):
        return value > bound
    if kind == "uncut":
        return nonzero | (terms[1][0] > terms[1][1])
    return np.isfinite(value) & np.isfinite(bound)
