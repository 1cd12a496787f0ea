"""Numerical evidence: residuals at many points, each beside the bound on its rounding.

A few certified points come first, in balls. From these a cloud of points is spread and evaluated in double precision,
all at once; where a residual there exceeds its bound, or comes nearest to it, balls look again at the very point. So
`refuted` rests on balls alone. Surfaces, and functions that have no rule in double precision, are sampled in balls.
"""

from __future__ import annotations

import contextlib
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from canon.budget import Budget, BudgetExceeded
from canon.decide.answer import Answer, Witness, largest
from canon.decide.enclosure import excludes_zero
from canon.decide.proposal import Coordinate
from canon.decide.region import Region
from canon.decide.sample import Sample
from canon.decide.search import Finder, samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.decide.cloud import Cloud

SEEDS: Final = 8
GROUPS: Final = 4
"""Arbitrary functions are chosen so many times."""

TRIES: Final = 8
LOOKED_AT: Final = 4
"""So many of the worst points of a residual are looked at again, in balls of each of these bits."""

LEAST_BLOCK: Final = 16
MOST_NUMBERS: Final = 5_000_000
"""So many numbers are held at once, one for each node of the tape and each point of a block."""

PRECISIONS: Final = (64, 256)
DENOMINATORS: Final = (100, 10**6)


class Underestimated(Exception):
    """A residual beyond its bound in double precision that balls find to be rounding: the bound can't be trusted."""


def sample(
    tape: Tape,
    nodes: Sequence[Node],
    region: Region,
    *,
    points: int,
    budget: Budget,
    seed: int = 0,
    bits: int = 53,
) -> tuple[Evidence | None, Answer | None]:
    """The residual that is worst against its bound, over random points of the region, and a refutation if there is one.

    **Returns:** (evidence, refutation). A refutation is a ball that excludes 0 at a certified point; its `index` says
    which node. The evidence is None where something is refuted, and where no point could be evaluated.
    """
    rng = random.Random(seed)
    seeds: list[Sample] = []
    finder = Finder(tape, nodes, region, rng, budget)
    try:
        for point in _attempts(finder, bits, min(points, SEEDS), budget):
            seeds.append(point)
            refuted = _refuted(tape, nodes, point, bits)
            if refuted is not None:
                return None, refuted
    except (Unsupported, BudgetExceeded):
        return _evidence_of(seeds, nodes, bits), None
    if not seeds:
        return None, None
    if not region.surface:
        with contextlib.suppress(Unsupported, Underestimated, OverflowError):
            return _by_clouds(finder, nodes, seeds, points, budget, seed)
    return _by_balls(tape, nodes, region, rng, seeds, points, budget, bits)


def _attempts(finder: Finder, bits: int, count: int, budget: Budget) -> Iterator[Sample]:
    found = 0
    for attempt in range(TRIES * max(1, count)):
        if found:
            budget.check()
        point = finder.attempt(bits, nice=attempt < 2, effort=attempt)
        if point is not None:
            found += 1
            yield point
            if found >= count:
                return


def _refuted(tape: Tape, nodes: Sequence[Node], point: Sample, bits: int) -> Answer | None:
    """The first node whose ball excludes 0 at a certified point."""
    for index, node in enumerate(nodes):
        ball = point.balls[node]
        if excludes_zero(ball):
            witness = Witness.of(tape, point, ball)
            return Answer("refuted", f"ball at {bits} bits", witness=witness, index=index, balls=(ball,), bits=bits)
    return None


# -- in double precision -----------------------------------------------------------------------


@dataclass(frozen=True)
class _Suspect:
    """A residual, its bound, and where it is as large as this part of it (`ratio`)."""

    ratio: float
    size: float
    bound: float
    place: Mapping[Node, Coordinate]
    functions: Mapping[str, Any]


@dataclass(frozen=True)
class _Scan:
    """What double precision shows: how many points were evaluated, and the suspects, the worst one first."""

    points: int
    suspects: tuple[_Suspect, ...]


def _by_clouds(
    finder: Finder, nodes: Sequence[Node], seeds: Sequence[Sample], points: int, budget: Budget, seed: int
) -> tuple[Evidence | None, Answer | None]:
    groups = [[s] for s in seeds[:GROUPS]] if seeds[0].functions else [list(seeds)]
    scans = []
    for number, group in enumerate(groups):
        share = points // len(groups) + (number < points % len(groups))
        scans.append(_scanned(finder, nodes, group, share, budget, seed + number))
    found = sum(scan.points for scan in scans)
    if not found:
        return _evidence_of(seeds, nodes, 53), None
    suspects = sorted((s for scan in scans for s in scan.suspects), key=lambda s: s.ratio, reverse=True)
    refuted = _looked_at_in_balls(finder, nodes, suspects)
    if refuted is not None:
        return None, refuted
    if suspects[0].ratio > 1:
        raise Underestimated
    worst = suspects[0]
    return Evidence(found, worst.size, worst.bound, 53), None


def _scanned(
    finder: Finder, nodes: Sequence[Node], seeds: Sequence[Sample], count: int, budget: Budget, seed: int
) -> _Scan:
    """The residuals at a cloud of points, block by block; for each node the points where it is nearest to its bound."""
    from canon.decide.cloud import cloud_around

    cloud = cloud_around(finder, seeds, count, budget, seed)
    block = max(LEAST_BLOCK, MOST_NUMBERS // max(1, len(finder.everything)))
    found, suspects = 0, []
    for start in range(0, cloud.size, block):
        if start and budget.spent():
            break
        usable, near = _block(finder, nodes, cloud, start, min(start + block, cloud.size))
        found += usable
        suspects += near
    return _Scan(found, tuple(suspects))


def _block(finder: Finder, nodes: Sequence[Node], cloud: Cloud, start: int, end: int) -> tuple[int, list[_Suspect]]:
    import numpy as np

    from canon.decide.floating import evaluate_many

    points = {node: values[start:end] for node, values in cloud.points.items()}
    place = evaluate_many(finder.tape, finder.everything, points, cloud.functions)
    found = [place[node] for node in nodes]
    pairs = [(np.broadcast_to(v, end - start), np.broadcast_to(b, end - start)) for v, b in found]
    usable = np.logical_and.reduce([np.isfinite(value) & np.isfinite(bound) for value, bound in pairs])
    suspects = []
    for value, bound in pairs:
        size = np.abs(value)
        with np.errstate(all="ignore"):
            ratio = np.where(usable, np.where(size == 0, 0.0, size / bound), -1.0)
        for k in np.argsort(-ratio, kind="stable")[:LOOKED_AT]:
            if usable[k]:
                at = cloud.exactly(start + int(k))
                suspects.append(_Suspect(float(ratio[k]), float(size[k]), float(bound[k]), at, cloud.functions))
    return int(usable.sum()), suspects


def _looked_at_in_balls(finder: Finder, nodes: Sequence[Node], suspects: Sequence[_Suspect]) -> Answer | None:
    """A refutation at one of the worst points, or better at a short fraction near it."""
    beyond = [suspect for suspect in suspects if suspect.ratio > 1]
    near = [suspect for suspect in suspects if suspect.ratio > 0]
    for suspect in beyond[: 2 * LOOKED_AT] or near[:LOOKED_AT]:
        for bits in PRECISIONS:
            refuted = _at(finder, nodes, suspect.place, suspect.functions, bits)
            if refuted is None:
                continue
            for denominator in DENOMINATORS:
                short = {node: _shortened(value, denominator) for node, value in suspect.place.items()}
                shorter = _at(finder, nodes, short, suspect.functions, bits)
                if shorter is not None:
                    return shorter
            return refuted
    return None


def _at(
    finder: Finder, nodes: Sequence[Node], place: Mapping[Node, Coordinate], functions: Mapping[str, Any], bits: int
) -> Answer | None:
    point = finder.certify(place, {}, functions, bits)
    return None if point is None else _refuted(finder.tape, nodes, point, bits)


def _shortened(value: Coordinate, denominator: int) -> Coordinate:
    if isinstance(value, tuple):
        return value[0].limit_denominator(denominator), value[1].limit_denominator(denominator)
    return value.limit_denominator(denominator)


# -- in balls ------------------------------------------------------------------------------------


def _by_balls(
    tape: Tape,
    nodes: Sequence[Node],
    region: Region,
    rng: random.Random,
    seeds: Sequence[Sample],
    points: int,
    budget: Budget,
    bits: int,
) -> tuple[Evidence | None, Answer | None]:
    found = list(seeds)
    try:
        more = samples(
            tape, nodes, region, rng, count=max(0, points - len(seeds)), bits=bits, tries=TRIES, budget=budget
        )
        for point in more:
            found.append(point)
            refuted = _refuted(tape, nodes, point, bits)
            if refuted is not None:
                return None, refuted
    except (Unsupported, BudgetExceeded):
        pass
    return _evidence_of(found, nodes, bits), None


def _evidence_of(points: Sequence[Sample], nodes: Sequence[Node], bits: int) -> Evidence | None:
    """The residual that is worst against its ball's radius, over certified points."""
    pairs = [largest((point.balls[node],)) for point in points for node in nodes]
    if not pairs:
        return None
    size, bound = max(pairs, key=lambda pair: pair[0] / pair[1] if pair[1] else 0.0)
    return Evidence(len(points), size, bound, bits)
