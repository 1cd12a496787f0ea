"""Points of the region: proposed at random, repaired where they miss a condition, certified by balls.

Every point that leaves this file is certified: each condition of the region holds there by a ball
that excludes the contrary, the conditions on names that the residual doesn't contain included.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb

from canon.budget import Budget, BudgetExceeded
from canon.decide.arbitrary import ChosenFunction, choose_functions
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.one_sign import have_one_sign
from canon.decide.proposal import Coordinate, proposed
from canon.decide.region import Region, Requirement, admits, bounds, holds
from canon.decide.relaxation import relax
from canon.decide.sample import Sample, ball_point
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import EmptyDomain
from canon.sign import declared

if TYPE_CHECKING:
    from canon.decide.surface import Choice

REPAIRS = 24


def samples(
    tape: Tape,
    targets: Sequence[Node],
    region: Region,
    rng: random.Random,
    *,
    count: int,
    bits: int = 64,
    tries: int = 60,
    budget: Budget,
    nice: bool = False,
    at: Mapping[Node, Fraction] | None = None,
) -> Iterator[Sample]:
    """Up to `count` certified points of the region at which the targets are defined too.

    `at`: values that some names are tried at first; they may be moved to meet a condition.
    """
    finder = Finder(tape, targets, region, rng, budget, at or {})
    found = 0
    for attempt in range(tries * max(1, count)):
        budget.check()
        sample = finder.attempt(bits, nice=nice and attempt < 4, effort=attempt)
        if sample is not None:
            found += 1
            yield sample
            if found >= count:
                return


def some_point(tape: Tape, region: Region, rng: random.Random, budget: Budget) -> list[Sample]:
    """A certified point of the region by itself, whatever is asked there; none where it can't be looked for.

    **Raises:** `EmptyDomain` where none is found.
    """
    try:
        for sample in samples(tape, [], region, rng, count=1, bits=256, tries=120, budget=budget):
            return [sample]
    except Unsupported:
        return []
    except BudgetExceeded:
        pass
    words = [requirement.text for requirement in region.requirements]
    raise EmptyDomain(
        f"no point of the domain was found{' on the surface' if region.surface else ''}, it seems empty"
        + (f": {'; '.join(words[:6])}" if words else "")
    )


class Finder:
    """The search for points of one region at which the targets are defined, as long as the `budget` lasts."""

    def __init__(
        self,
        tape: Tape,
        targets: Sequence[Node],
        region: Region,
        rng: random.Random,
        budget: Budget,
        at: Mapping[Node, Fraction] | None = None,
    ) -> None:
        self.tape, self.region, self.rng, self.budget, self.at = tape, region, rng, budget, at or {}
        self.conditions = tape.reach(region.nodes())
        self.everything = tape.reach([*region.nodes(), *targets])
        inside = set(self.everything) | set(region.symbols)
        self.symbols = sorted(node for node in inside if tape.ops[node][0] == "s")
        self.bounds = bounds(tape, region)
        self.orders = {r: tape.reach(r.nodes) for r in region.requirements}
        self.signs: dict[Node, bool] = {}
        self.choices: list[Choice] | None = None

    def attempt(self, bits: int, *, nice: bool, effort: int) -> Sample | None:
        """One proposal, repaired if need be; None where it could not be certified."""
        functions = choose_functions(self.tape, self.everything, self.rng)
        point = {n: self.at[n] if n in self.at else self.propose(n, nice, effort) for n in self.symbols}
        if self.region.surface:
            from canon.decide.surface import onto_surface

            placed = onto_surface(self, point, functions, bits, effort)
            if placed is None:
                return None
            exact, solved = placed
            return self.certify(exact, solved, functions, bits)
        sample = self.certify(point, {}, functions, bits)
        if sample is not None or not self.region.requirements or (effort >= REPAIRS and effort % 8):
            return sample
        repaired = self.repair(point, functions)
        return None if repaired is None else self.certify(repaired, {}, functions, bits)

    def certify(
        self,
        point: Mapping[Node, Coordinate],
        solved: Mapping[Node, Ball],
        functions: Mapping[str, ChosenFunction],
        bits: int,
    ) -> Sample | None:
        """The sample, if every requirement and every target is certified there."""
        with precision(bits):
            place = ball_point(point, solved)
            try:
                if not all(admits(self.tape.symbol_at(node), ball) for node, ball in place.items()):
                    return None
                balls = evaluate(self.tape, self.everything, place, functions)
            except (OutOfDomain, ZeroDivisionError, OverflowError):
                return None
            if not all(holds(requirement, balls) for requirement in self.region.requirements):
                return None
            if not have_one_sign(self.tape, self.region.requirements, balls):
                return None
        self.signs = self.signs or {n: v > 0 for n, v in point.items() if isinstance(v, Fraction)}
        return Sample(dict(point), dict(solved), functions, balls)

    def propose(self, node: Node, nice: bool, effort: int) -> Coordinate:
        """A random value that satisfies the symbol's assumptions and its own bounds."""
        facts = declared(self.tape.symbol_at(node))
        bounds = self.bounds.get(node, (-math.inf, math.inf))
        return proposed(facts, bounds, self.rng, nice=nice, effort=effort, seen_positive=self.signs.get(node))

    # -- repair ---------------------------------------------------------------------------------

    def violation(
        self, point: Mapping[Node, Coordinate], functions: Mapping[str, ChosenFunction]
    ) -> tuple[float, list[Requirement]]:
        """How far the point is from the region, and the requirements that it misses."""
        missed: list[Requirement] = []
        total = 0.0
        with precision(64):
            place = ball_point(point, {})
            balls: dict[Node, Ball] = {}
            for requirement in self.region.requirements:
                try:
                    evaluate(self.tape, self.orders[requirement], place, functions, balls)
                except (OutOfDomain, ZeroDivisionError, OverflowError):
                    missed.append(requirement)
                    total += 3.0
                    continue
                if not holds(requirement, balls):
                    missed.append(requirement)
                    first = balls[requirement.nodes[0]]
                    size = float(first.mid()) if isinstance(first, arb) else 1.0
                    total += 1.0 + math.atan(abs(size))
        return total, missed

    def repair(
        self, point: Mapping[Node, Coordinate], functions: Mapping[str, ChosenFunction]
    ) -> dict[Node, Coordinate] | None:
        """A random descent towards the region, changing the symbols of the requirements that are missed."""
        best = dict(point)
        score, missed = self.violation(best, functions)
        for step in range(60):
            if not missed:
                return best
            names = sorted(set().union(*(self.tape.support(n) for r in missed for n in r.nodes)))
            if not names:
                return None
            node = self.rng.choice(names)
            trial = dict(best)
            trial[node] = self._moved(node, best[node], step)
            new_score, new_missed = self.violation(trial, functions)
            if new_score <= score:
                best, score, missed = trial, new_score, new_missed
        if not missed:
            return best
        return relax(self, best, functions) or self.across_the_edge(best, missed, functions)

    def across_the_edge(
        self, point: Mapping[Node, Coordinate], missed: Sequence[Requirement], functions: Mapping[str, ChosenFunction]
    ) -> dict[Node, Coordinate] | None:
        """For thin regions: Newton onto the zero of a missed condition, then small steps to either side of it."""
        requirement = self.rng.choice(list(missed))
        names = [n for n in self.tape.support(requirement.nodes[0]) if self.tape.symbol_at(n).is_real]
        names = [n for n in names if not self.tape.symbol_at(n).is_integer]
        if not names:
            return None
        node = self.rng.choice(sorted(names))
        at = self._root(requirement, node, point, functions)
        if at is None:
            return None
        for power in range(1, 12):
            for side in (1, -1):
                trial = dict(point)
                trial[node] = at * (1 + Fraction(side, 8**power))
                if not self.violation(trial, functions)[1]:
                    return trial
        return None

    def _root(
        self,
        requirement: Requirement,
        node: Node,
        point: Mapping[Node, Coordinate],
        functions: Mapping[str, ChosenFunction],
    ) -> Fraction | None:
        """A zero of the requirement's expression in one coordinate, by the secant method."""
        target, order = requirement.nodes[0], self.orders[requirement]

        def look(value: Fraction) -> Fraction | None:
            try:
                with precision(128):
                    ball = evaluate(self.tape, order, ball_point({**point, node: value}, {}), functions)[target]
            except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError):
                return None
            middle = float(ball.mid()) if isinstance(ball, arb) else math.nan
            return Fraction(middle) if math.isfinite(middle) else None

        start = point[node]
        if isinstance(start, tuple):
            return None
        a, b = start, start * Fraction(21, 20) + Fraction(1, 100)
        fa, fb = look(a), look(b)
        for _ in range(40):
            if fa is None or fb is None or fa == fb:
                return None
            a, b = b, (b - fb * (b - a) / (fb - fa)).limit_denominator(10**15)
            fa, fb = fb, look(b)
            if fb is not None and abs(b - a) <= abs(b) * Fraction(1, 10**12):
                return b
        return None

    def _moved(self, node: Node, value: Coordinate, step: int) -> Coordinate:
        symbol = self.tape.symbol_at(node)
        if symbol.is_integer or isinstance(value, tuple) or step % 3 == 0:
            return self.propose(node, False, 2)
        factor = Fraction(self.rng.choice((1, 2, 3, 5, 10, 30)), self.rng.choice((1, 2, 3, 4, 10, 30)))
        moved = value * factor
        free = not (symbol.is_nonnegative or symbol.is_nonpositive)
        return -moved if free and self.rng.random() < 0.3 else moved
