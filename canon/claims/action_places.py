"""Places at which an action is enclosed: values of the constants and of the energy, and a point inside the orbit.

First through points of phase space at random, where the energy is theirs; then, as those seldom lie in a small well, at
energies between the bottom of a well and its barrier, or above all barriers for a rotation.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.action_orbits import Example
from canon.claims.chart import chart_of
from canon.decide.arbitrary import rational
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.libration import BITS, Integrand
from canon.decide.region import Region, admits
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported
from canon.domain import Domain
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.action_region import Setting
    from canon.claims.question import Question

TRIES, ALIKE = 24, 3
"""Points of phase space, and how many of them with the same energy and constants: they lie on the same few orbits."""
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)
PARTS = (Fraction(1, 2), Fraction(1, 5), Fraction(4, 5))


@dataclass(frozen=True)
class Place:
    """One choice of constants, and the orbit through one of its points."""

    integrand: Integrand
    inside: Fraction
    energy: Node | None


def places(question: Question, setting: Setting) -> Iterator[Place]:
    """Constants at which an orbit of the domain passes a point; the energy is that point's where it is free."""
    tape = question.tape
    builder = _Builder(question, setting)
    free = isinstance(setting.energy, sp.Symbol) and setting.level is None
    H, level = question.load(setting.H), tape.load(setting.energy)
    targets = [H, *sorted(builder.names - {level})]
    rng = random.Random(question.seed)
    region = _phase_region(question, setting)
    seen: dict[tuple[tuple[Node, Fraction], ...], int] = {}
    try:
        for sample in samples(tape, targets, region, rng, count=TRIES, budget=question.budget, nice=True):
            values = {n: v for n, v in sample.point.items() if isinstance(v, Fraction)}
            if sample.functions or builder.q not in values:
                continue
            height = float(sample.balls[H].mid())
            if not math.isfinite(height):
                continue
            energy = Fraction(height).limit_denominator(10**6) if free else None
            place = builder.place(values, values[builder.q], energy)
            if place is None:
                continue
            here = tuple(sorted(place.integrand.point.items()))
            seen[here] = seen.get(here, 0) + 1
            if seen[here] <= ALIKE:
                yield place
    except Unsupported:
        return


def places_by_wells(question: Question, setting: Setting, branch: str, here: Example | None) -> Iterator[Place]:
    """Orbits in the wells of a potential of which a map is there, or over its barriers."""
    if here is None:
        return
    tape, nodes = question.tape, here.motion.nodes
    builder = _Builder(question, setting)
    values = {tape.symbol(name): Fraction(int(v.p), int(v.q)) for name, v in here.values.items()}
    free = isinstance(setting.energy, sp.Symbol) and setting.level is None
    with precision(BITS):
        tops = [float(node.value()) for node in nodes if node.kind < 0]
        wells = [(float(node), float(node.value())) for node in nodes if node.kind > 0]
    tops = [top for top in tops if math.isfinite(top)]
    for bottom, depth in wells:
        if not (math.isfinite(bottom) and math.isfinite(depth)):
            continue
        inside = Fraction(bottom).limit_denominator(10**9)
        if not free:
            levels: list[Fraction | None] = [None]
        elif branch == "rotation":
            top = max(tops, default=depth)
            levels = [Fraction(top + (1 + abs(top)) * float(part)).limit_denominator(10**6) for part in PARTS]
        else:
            top = min((t for t in tops if t > depth), default=depth + 1 + abs(depth))
            levels = [Fraction(depth + (top - depth) * float(part)).limit_denominator(10**6) for part in PARTS]
        for energy in levels:
            place = builder.place(values, inside, energy)
            if place is not None:
                yield place


class _Builder:
    """Puts places together: what the integrand needs at given values of the constants."""

    def __init__(self, question: Question, setting: Setting) -> None:
        motion = setting.motion
        self.question, self.setting = question, setting
        self.square, self.mean = question.load(motion.square), question.load(motion.mean)
        self.q, self.p = question.tape.symbol(setting.q), question.tape.symbol(setting.p)
        tape = question.tape
        given = (e for e in (setting.period, setting.well) if e is not None)
        loaded = (question.load(setting.H), self.square, *map(question.load, (setting.equals, *setting.also, *given)))
        self.names = set().union(*(tape.support(node) for node in loaded)) - {self.q, self.p}

    def place(self, values: Mapping[Node, Fraction], inside: Fraction, energy: Fraction | None) -> Place | None:
        """The place with the energy, or the one that is fixed; None where something isn't known, or not allowed."""
        question, setting, motion = self.question, self.setting, self.setting.motion
        point = {n: v for n, v in values.items() if n in self.names}
        name: Node | None = None
        if isinstance(setting.energy, sp.Symbol):
            name = question.tape.symbol(setting.energy)
            energy = energy if setting.level is None else self._fixed_level(values)
            if energy is None:
                return None
            with precision(BITS):
                if not admits(setting.energy, arb(rational(energy))):
                    return None
            point[name] = energy
        if not self.names <= set(point):
            return None
        if setting.well is not None:
            found = number_at(question, question.load(setting.well), point)
            if found is None:
                return None
            inside = found
        low, high = (_edge(question, e, point) for e in (motion.low, motion.high))
        if (low is not None and inside <= low) or (high is not None and inside >= high):
            return None  # the point that is named isn't in the domain
        return Place(Integrand(question.tape, self.q, self.square, self.mean, point, low, high), inside, name)

    def _fixed_level(self, values: Mapping[Node, Fraction]) -> Fraction | None:
        tape = self.question.tape
        rules: Any = {tape.symbol_at(n): sp.Rational(v.numerator, v.denominator) for n, v in values.items()}
        value = replaced(self.setting.level, rules)
        return Fraction(int(value.p), int(value.q)) if isinstance(value, sp.Rational) else None


def _phase_region(question: Question, setting: Setting) -> Region:
    """The domain in (q, p) and constants; what speaks of the energy is looked at later."""
    tape, space = question.tape, question.space
    hidden = {setting.energy} if isinstance(setting.energy, sp.Symbol) else set()
    kept = tuple(c for c in setting.conditions if not any(t.free_symbols & hidden for t in c.terms))
    named = set().union(setting.H.free_symbols, setting.equals.free_symbols, {setting.q, setting.p})
    named |= {name for condition in kept for term in condition.terms for name in term.free_symbols}
    images = {tape.symbol(x): tape.zero for x in space.old if x not in named}
    plain = chart_of(tape, space, None)
    return question.region(domain=Domain(kept), images=images, chart=plain, assumed=False, regular=False)


def number_at(question: Question, node: Node, point: Mapping[Node, Fraction]) -> Fraction | None:
    """A rational number near the value of a node at a place."""
    values = {n: arb(rational(v)) for n, v in point.items()}
    with precision(BITS):
        try:
            ball = evaluate(question.tape, question.tape.reach([node]), values)[node]
            return Fraction(float(ball.mid())).limit_denominator(10**12)
        except (*FAILURES, KeyError, AttributeError):
            return None


def _edge(question: Question, edge: Any, point: Mapping[Node, Fraction]) -> Fraction | None:
    return None if edge in (sp.oo, -sp.oo) else number_at(question, question.load(edge), point)
