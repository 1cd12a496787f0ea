"""Does the cycle of an angle close after its period, and not before?

The old variables come back, or grow by whole multiples of 2π, being angles on which H depends with that period. Which
multiples is read off a point at which they don't come back, and then decided for the whole domain: a curve on a torus
may go round several angles at once (angles may be combined by unimodular matrices of integers), and on each part of a
domain in another sense. Refuted is what doesn't close at a certified point, or closes early everywhere.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from math import gcd
from typing import TYPE_CHECKING, Any, Final

from flint import acb, arb

from canon.claims.outcome import Outcome, Residual, combined
from canon.decide.cells import cells_of
from canon.decide.derivative import substitute
from canon.decide.implied import without_implied
from canon.decide.sample import evaluate_again
from canon.decide.search import samples
from canon.decide.tape import Unsupported
from canon.decide.winding import winding_number
from canon.sign import declared

if TYPE_CHECKING:
    import sympy as sp

    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node

MOST_TURNS: Final = 3
POINTS: Final = 4
BITS: Final = 128
PRIMITIVE = "a curve gone round k times has numbers of turns that k divides"
ONE_SIGN = "{} turns by multiples of 2 pi, as an angle does, and is said to be of one sign, as no angle is"
PARTS = "whole turns, but others in other parts of the domain"

Turns = tuple[int, ...]


@dataclass(frozen=True)
class Cycle:
    """The curve along which one angle grows by its period, on the tape: `turn` is the period, `region` the domain."""

    question: Question
    angle: sp.Symbol
    turn: Node
    region: Region

    def change(self, share: Fraction = Fraction(1)) -> list[Node]:
        """By how much each old variable changes along that share of the cycle."""
        tape, moving = self.question.tape, self.question.tape.symbol(self.angle)
        ahead = {moving: tape.plus(moving, tape.scaled(self.turn, share))}
        return [tape.minus(substitute(tape, node, ahead), node) for node in self.question.chart.old]

    def missed(self, turns: Turns, share: Fraction = Fraction(1)) -> list[Residual]:
        """What is left of those changes without so many turns by 2π."""
        tape = self.question.tape
        when = f"a period of {self.angle}" if share == 1 else f"{share} of the period of {self.angle}"
        return [
            Residual(f"{x} after {when}", tape.minus(change, tape.scaled(tape.constant("pi"), Fraction(2 * k))), change)
            for x, change, k in zip(self.question.space.old, self.change(share), turns, strict=True)
        ]

    def in_words(self, turns: Turns) -> str:
        """Such as "theta grows by 2*pi"."""
        grown = [(x, k) for x, k in zip(self.question.space.old, turns, strict=True) if k]
        return ", ".join(f"{x} grows by {2 * k}*pi" for x, k in grown)


def closes(cycle: Cycle) -> Outcome:
    """The old variables come back after the period of this angle, as points of phase space, and not before."""
    question = cycle.question
    still = (0,) * len(question.space.old)
    back = question.decide(cycle.missed(still), cycle.region)
    if back.status != "refuted":
        return _once(cycle, back, still)
    turns = _turns_at(cycle, back)
    if turns == still:  # something has changed at the witness, though by less than a turn
        return back
    if not isinstance(turns, tuple):
        return _not_closed(back, turns)
    if signed := [x for x, k in zip(question.space.old, turns, strict=True) if k and _has_a_sign(x)]:
        return Outcome("undecided", note=ONE_SIGN.format(signed[0]))
    periodic = question.decide(_periods(cycle, turns), cycle.region)
    if periodic.status == "refuted":
        return back
    turned = question.decide(cycle.missed(turns), cycle.region)
    if turned.status == "refuted":
        elsewhere = _turns_at(cycle, turned)
        return _not_closed(turned, None if elsewhere == turns else elsewhere)
    return _once(cycle, combined([periodic, turned]), turns)


def _has_a_sign(symbol: sp.Symbol) -> bool:
    facts = declared(symbol)
    return any(facts.get(word) is not None for word in ("positive", "negative"))


def _not_closed(outcome: Outcome, turns: Turns | str | None) -> Outcome:
    """Refuted where the changes at the witness certainly are no whole turns."""
    if turns is None:
        return outcome
    return Outcome("undecided", note=PARTS if isinstance(turns, tuple) else turns)


def _periods(cycle: Cycle, turns: Turns) -> list[Residual]:
    """H has the period 2π in each variable that turns."""
    question, tape = cycle.question, cycle.question.tape
    H = question.load(question.hamiltonian())
    full = tape.scaled(tape.constant("pi"), Fraction(2))
    residuals = []
    for x, k in zip(question.space.old, turns, strict=True):
        if k:
            shifted = substitute(tape, H, {tape.symbol(x): tape.plus(tape.symbol(x), full)})
            residuals.append(Residual(f"H at {x} + 2 pi", question.chart.pull(tape.minus(shifted, H))))
    return residuals


def _turns_at(cycle: Cycle, outcome: Outcome) -> Turns | str | None:
    """How often each variable has turned at a refutation's witness: None if that is no whole number for one of them.

    Words where it isn't known. That a ball holds a whole number proves nothing: it is what is decided next.
    """
    failed = outcome.failed
    sample = failed.answer.witness.sample if failed is not None and failed.answer.witness is not None else None
    unknown = f"how far the old variables are moved by a period of {cycle.angle} isn't known at a point"
    if sample is None:
        return unknown
    changes = cycle.change()
    try:
        balls = evaluate_again(cycle.question.tape, changes, sample, BITS)
    except (ArithmeticError, Unsupported, KeyError):
        return unknown
    turns: list[int] = []
    for node in changes:
        ball: Any = balls[node]
        if isinstance(ball, acb):
            if not ball.imag.contains(0):
                return None
            ball = ball.real
        counted = ball / (2 * arb.pi())
        if not counted.is_finite():
            return unknown
        whole = counted.unique_fmpz()
        if whole is None and not counted.contains_integer():
            return None
        if whole is None:
            return unknown
        turns.append(int(whole))
    return tuple(turns)


# -- once, and not several times -------------------------------------------------------------------------------------


def _once(cycle: Cycle, closed: Outcome, turns: Turns) -> Outcome:
    """The cycle, which closes, is gone round once."""
    if closed.status not in ("proved", "supported"):
        return closed
    if any(turns):
        closed = closed.with_detail(**{f"cycle of {cycle.angle}": cycle.in_words(turns)})
    common = gcd(*turns)
    if common == 1:
        step = {"theorem": PRIMITIVE, "cycle of": str(cycle.angle)}
        return replace(closed, arguments=(*closed.arguments, step))
    for k in range(2, max(MOST_TURNS, common) + 1):
        if common % k:
            continue
        part = tuple(count // k for count in turns)
        early = cycle.question.decide(cycle.missed(part, Fraction(1, k)), cycle.region)
        why = f"the cycle of {cycle.angle} is closed after 1/{k} of the period already"
        if early.status == "proved":
            outcome = cycle.question.refuted_exactly(cycle.region, why)
            return replace(outcome, everywhere=outcome.status == "refuted").with_detail(fails=why)
        if early.status == "supported":
            seems = f"it seems that {why}"
            return Outcome("undecided", early.method, numeric=early.numeric, detail={"fails": why}, note=seems)
    if closed.status == "supported" or cycle.question.method == "numeric":
        note = f"the cycle of {cycle.angle} isn't closed after a half or a third of it"
        return closed.with_status("supported", note)
    if common:
        note = f"that the cycle of {cycle.angle} is gone round only once isn't shown"
        return closed.with_status("supported", note)
    return combined([closed, _winds_once(cycle)])


def _winds_once(cycle: Cycle) -> Outcome:
    """A winding number ±1 round one point of one plane, on each component of the domain."""
    question, tape, chart = cycle.question, cycle.question.tape, cycle.question.chart
    region = without_implied(tape, cycle.region, question.budget)
    nodes = [*chart.old, cycle.turn]
    cells = cells_of(tape, region, nodes, question.budget)
    if not cells or not all(cell.connected for cell in cells):
        cells = cells_of(tape, region, nodes, question.budget, finer=True)
    whole = bool(cells) and all(cell.connected for cell in cells or ())
    places = [cell.region for cell in cells] if cells and whole else [region]
    found = [_plane(cycle, place) for place in places]
    if any(plane is None for plane in found):
        return Outcome(
            "supported", "periods", note=f"that the cycle of {cycle.angle} is gone round only once isn't shown"
        )
    planes = ", ".join(dict.fromkeys(plane for plane in found if plane))
    if not whole:
        return Outcome("supported", "winding number", note="at one point of a domain not shown to be connected")
    step = {"winding number": f"1 or -1 in the plane {planes}", "cycle of": str(cycle.angle)}
    words = {f"cycle of {cycle.angle}": f"closed in {planes}"}
    return Outcome("proved", "winding number", arguments=(step,), detail=words)


def _plane(cycle: Cycle, region: Region) -> str | None:
    """A plane of two old variables in which the cycle goes round a point once, at some point of the region."""
    question, tape = cycle.question, cycle.question.tape
    chart, moving, rng = question.chart, tape.symbol(cycle.angle), random.Random(question.seed)
    names = question.space.old
    n = len(names) // 2
    planes = [(i, i + n) for i in range(n)]
    planes += [pair for pair in combinations(range(2 * n), 2) if pair not in planes]
    try:
        nodes = [*chart.old, cycle.turn]
        found = samples(tape, nodes, region, rng, count=POINTS, budget=question.budget, nice=True)
        for sample in found:
            point = {node: value for node, value in sample.point.items() if isinstance(value, Fraction)}
            if len(point) < len(sample.point) or sample.functions:
                continue
            point.setdefault(moving, Fraction(1, 7))
            for i, j in planes:
                if winding_number(tape, (chart.old[i], chart.old[j]), moving, cycle.turn, point) in (1, -1):
                    return f"({names[i]}, {names[j]})"
    except Unsupported:
        return None
    return None
