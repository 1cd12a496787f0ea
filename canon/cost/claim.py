"""What certainty costs for a claim: its residuals in floats, in balls of more and more bits, and the exact proof.

In floats a residual that vanishes is rounding, and a defect as small as that rounding would not be seen. What could
hide is the error here: with a proof, nothing can.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.budget import Budget
from canon.claim import Claim
from canon.claims.kinds import kind_named
from canon.claims.outcome import Residual
from canon.claims.question import Question
from canon.claims.verify import verify
from canon.cost.clock import Timing, timed
from canon.cost.in_pairs import evaluate_in_pairs
from canon.cost.study import Point, Study
from canon.decide.enclosure import OutOfDomain
from canon.decide.floating import UNIT, Rounded, evaluate_many
from canon.decide.region import Region
from canon.decide.sample import Sample, evaluate_again
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import BudgetExceeded
from canon.numeric import pairs
from canon.numeric.lower import lower
from canon.numeric.precision import UNIT_32

POINTS: Final = 8
BITS: Final = (64, 100, 300, 1000)
"""Of balls."""
FLOATS: Final = (
    ("float32", np.float32, 24, UNIT_32),
    ("float64", np.float64, 53, UNIT),
    ("double-double", None, 106, pairs.UNIT),
)
"""Names, types (none of numpy's for pairs of doubles), bits and unit roundoffs."""


@dataclass(frozen=True)
class Stated:
    """Residuals that are not 0 as they stand, and certified points at which to look at them."""

    nodes: tuple[Node, ...]
    points: tuple[Sample, ...]


def cost_of_claim(claim: Claim, *, budget: float = 10.0, seed: int = 0) -> Study:
    """The relative defect that could hide in a claim's residuals, against the seconds that it takes to look.

    A defect is relative to the size of the terms that cancel in its residual, the worst of `POINTS` points counts.
    """
    heard: list[tuple[Sequence[Residual], Region]] = []
    messages: list[str] = []
    question = Question(claim, Budget(budget), seed, listen=lambda found, region: heard.append((found, region)))
    try:
        kind_named(claim.kind)(question)
    except (BudgetExceeded, Unsupported, RecursionError) as reason:
        messages.append(f"not all of what the claim states was heard: {reason}")
    stated = [found for each in heard if (found := _stated(question.tape, *each, seed, messages)) is not None]
    if not stated:
        messages.append("nothing is left to compute: its residuals are 0 as they stand, or it states none")
    points = [*_floats(question.tape, stated, messages), *_balls(question.tape, stated, messages)]
    verdict, timing = timed(lambda: verify(claim, budget=budget, seed=seed), cap=budget / 3)
    exact = verdict.status in ("proved", "refuted")
    note = f"{verdict.status}: {verdict.method}" if exact else verdict.status
    points.append(_point("exact", None, 0.0 if exact else None, timing, note))
    return Study(
        "verify", claim.title or claim.kind, "bits", "relative: a defect as large could hide", "0, by the claim", 0.0,
        tuple(points), {}, tuple(dict.fromkeys(messages)),
    )  # fmt: skip


def _point(method: str, bits: int | None, error: float | None, timing: Timing, note: str) -> Point:
    return Point(method, bits, error, timing.median, timing.least, timing.first, timing.runs, note=note)


def _stated(tape: Tape, residuals: Sequence[Residual], region: Region, seed: int, messages: list[str]) -> Stated | None:
    nodes = tuple(dict.fromkeys(r.node for r in residuals if r.node != tape.zero))
    if not nodes:
        return None
    found: list[Sample] = []
    try:
        found += samples(tape, nodes, region, random.Random(seed), count=POINTS, budget=Budget(2.0))
    except (BudgetExceeded, Unsupported) as reason:
        messages.append(f"points of the domain: {reason}")
    return Stated(nodes, tuple(found)) if found else None


def _floats(tape: Tape, stated: Sequence[Stated], messages: list[str]) -> Iterator[Point]:
    """Residuals in single and double precision and in pairs of doubles, beside a bound of their rounding."""
    usable = [each for each in stated if not any(sample.solved or sample.functions for sample in each.points)]
    if len(usable) < len(stated):
        messages.append("floats leave out what is stated on a surface or of an arbitrary function: they have no points")
    for name, kind, bits, unit in FLOATS:
        seen, hidden, total = False, list[float](), Timing(0.0, 0.0, 0.0, 1)
        for each in usable:
            try:
                values, timing = _in_pairs(tape, each) if kind is None else _in_floats(tape, each, kind)
                rounded = evaluate_many(tape, tape.reach(each.nodes), _columns(each.points, np.float64))
            except (Unsupported, OverflowError, TypeError, ValueError) as reason:
                messages.append(f"{name}: {reason}")
                continue
            total = _added(total, timing)
            for node, value in zip(each.nodes, values, strict=True):
                bound = np.real(rounded[node][1]) * (unit / UNIT)
                with np.errstate(all="ignore"):
                    part = (np.abs(value) + bound) / _size(tape, node, rounded)
                seen = seen or bool(np.any(np.abs(value) > bound))
                hidden.append(float(np.max(np.where(np.isfinite(part), part, np.inf))))
        if hidden:
            yield _point(name, bits, max(hidden), total, "beyond its rounding" if seen else "rounding alone")


def _in_floats(tape: Tape, stated: Stated, kind: Any) -> tuple[list[Any], Timing]:
    nodes = [node for node in tape.reach(stated.nodes) if tape.ops[node][0] == "s"]
    symbols = tuple(tape.symbol_at(node) for node in nodes)
    function = lower(tuple(tape.to_sympy(node) for node in stated.nodes), symbols)
    columns = _columns(stated.points, kind)
    arguments = [columns[node] for node in nodes]

    def look() -> list[Any]:
        with np.errstate(all="ignore"):
            return list(function(*arguments, numbers=np))

    return timed(look, cap=1.0)


def _in_pairs(tape: Tape, stated: Stated) -> tuple[list[Any], Timing]:
    order, columns = tape.reach(stated.nodes), _columns(stated.points, np.float64)

    def look() -> list[Any]:
        place = evaluate_in_pairs(tape, order, columns)
        return [place[node].high for node in stated.nodes]

    return timed(look, cap=1.0)


def _balls(tape: Tape, stated: Sequence[Stated], messages: list[str]) -> Iterator[Point]:
    """Residuals in balls: what they enclose is certain, and so is a defect that they exclude."""
    for bits in BITS:
        seen, hidden, total = False, list[float](), Timing(0.0, 0.0, 0.0, 1)
        for each in stated:

            def look(each: Stated = each, bits: int = bits) -> list[Mapping[Node, Any]]:
                return [evaluate_again(tape, each.nodes, sample, bits) for sample in each.points]

            try:
                found, timing = timed(look, cap=1.0)
            except (Unsupported, OutOfDomain, ZeroDivisionError, OverflowError) as reason:
                messages.append(f"balls of {bits} bits: {reason}")
                continue
            total = _added(total, timing)
            for sample, balls in zip(each.points, found, strict=True):
                sizes = {node: (abs(complex(ball.mid())), 0.0) for node, ball in sample.balls.items()}
                for node in each.nodes:
                    size = _size(tape, node, sizes)
                    hidden.append(_log_ratio(balls[node].abs_upper(), size))
                    seen = seen or bool(balls[node].abs_lower() > 0)
        if hidden:
            note = "a defect, for certain" if seen else "0 is enclosed"
            yield _point("balls", bits, max(hidden), total, note)


def _log_ratio(upper: Any, size: float) -> float:
    """upper / size as a double, at least the smallest one that isn't 0."""
    ratio = float(upper / size) if size else float(upper)
    return max(ratio, 1e-307) if upper > 0 else 0.0


def _columns(points: Sequence[Sample], kind: Any) -> dict[Node, Any]:
    """The points' coordinates, one array for each symbol."""
    columns: dict[Node, Any] = {}
    for node in points[0].point:
        values = [sample.point[node] for sample in points]
        if any(isinstance(value, tuple) for value in values):
            raise Unsupported("complex coordinates are left to balls")
        columns[node] = np.array([float(value) for value in values], dtype=kind)  # pyright: ignore[reportArgumentType]
    return columns


def _size(tape: Tape, node: Node, place: Mapping[Node, Rounded]) -> Any:
    """The size of the terms that cancel in a node: their absolute values, summed."""
    op = tape.ops[node]
    if op[0] == "+":
        return abs(float(op[1])) + sum(
            abs(float(coefficient)) * np.abs(place[child][0]) for child, coefficient in op[2]
        )
    if op[0] == "*":
        product: Any = 1.0
        for child, exponent in op[1]:
            product = product * _size(tape, child, place) ** exponent
        return product
    return np.abs(place[node][0])


def _added(total: Timing, more: Timing) -> Timing:
    return Timing(total.first + more.first, total.least + more.least, total.median + more.median, more.runs)
