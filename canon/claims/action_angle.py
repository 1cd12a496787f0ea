"""Action and angle variables: a canonical map to momenta on which alone H depends, and angles that close up.

Of a map given as old variables in new ones the cycle of an angle is the curve along which it alone grows. It must close
after `angle_period`, and not before: a curve that is gone round k times has winding numbers divisible by k, so that a
winding number ±1 round one point of one plane, certified by balls, shows that k = 1; or else one of the coordinates
grows by 2π on the way, being an angle on which H depends periodically. A map given forward, or by a generating
function, is inverted first; the inverse is verified, and is only one branch of it.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.generating_function import generated
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.question import Question
from canon.claims.transformation import canonical
from canon.decide.cells import cells_of
from canon.decide.derivative import derivative, substitute
from canon.decide.region import Region, Requirement
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported
from canon.decide.winding import winding_number
from canon.domain import Condition, Domain
from canon.errors import InputError
from canon.mechanics.action_angle import linear_edge

if TYPE_CHECKING:
    from canon.mechanics import Transformation

MOST_TURNS = 3
POINTS = 4


def action_angle(question: Question) -> Outcome:
    """`action_angle`: canonical, K of the momenta alone, each angle advances by `angle_period` round its cycle."""
    question.square_map()
    H, space = question.hamiltonian(), question.space
    period = question.key("angle_period")
    length: Any = sp.S.One if period is None else period.expr
    given = question.map
    written = [given.generating_function.F] if given.generating_function is not None else given.formulas
    for formula in (H, *written):
        if space.t in formula.expr.free_symbols:
            raise InputError("action and angle variables are those of an H and a map without time")
    if length.free_symbols & {*space.old, *space.new, space.t} or length.is_zero:
        raise InputError("a period is an expression in parameters, and not 0", "key 'angle_period'")
    outcome = canonical(question)
    if outcome.status == "refuted":
        return outcome
    backward, grounds = question, [outcome]
    if given.direction != "backward":
        inverse = _inverted(question, length)
        if inverse is None:
            return Outcome("undecided", outcome.method, note="the map wasn't inverted, so that its cycles aren't known")
        backward, verified = inverse
        grounds.append(verified)
    depends = backward.decide(_slopes(backward), _whole_cycle(backward))
    if depends.status == "refuted":
        return depends.with_detail(fails=f"K depends on an angle: {depends.detail.get('fails', '')}")
    if given.direction != "backward" and combined(grounds).status not in ("proved", "supported"):
        return combined(grounds)
    cycles = [_cycle(backward, angle, length) for angle in space.Q]
    return combined([*grounds, depends, *cycles])


def _inverted(question: Question, length: Any) -> tuple[Question, Outcome] | None:
    """A question about the map given backward, with the outcome that it is the map's inverse; None where none is found.

    It is verified where the angles lie within a part of one turn: elsewhere the map's angles are on other branches.
    """
    given = question.map
    for branch in range(2):
        try:
            inverse = given.backward(branch)
        except (InputError, NotImplementedError):
            return None
        subject = replace(question.subject, generating_function=None, transformation=inverse)
        other = Question(replace(question.claim, subject=subject), question.budget, question.seed, question.method)
        found = [_is_inverse(other, given, *part) for part in ((sp.S.Zero, length / 4), (-length / 2, length / 2))]
        best = next((verified for verified in found if verified.status == "proved"), found[0])
        if best.status in ("proved", "supported"):
            return other, best
    return None


def _is_inverse(other: Question, given: Transformation, low: Any, high: Any) -> Outcome:
    if given.direction == "implicit":
        assert given.generating_function is not None
        return generated(other, given.generating_function)
    tape, chart, space = other.tape, other.chart, other.space
    along = [chart.pull(tape.load(formula.expr)) for formula in given.formulas]
    residuals = (
        Residual(f"{x} of the inverse", tape.minus(value, tape.symbol(x)))
        for x, value in zip(space.new, along, strict=True)
    )
    turn = [Requirement("positive", (tape.load(e),), f"{e} > 0") for x in space.Q for e in (x - low, high - x)]
    return other.decide(residuals, other.region(*given.formulas).also(*turn))


def _slopes(question: Question) -> Iterator[Residual]:
    """∂K/∂(angle)."""
    tape, chart = question.tape, question.chart
    K = chart.pull(question.load(question.hamiltonian()))
    for angle in question.space.Q:
        slope = derivative(tape, K, tape.symbol(angle))
        yield Residual(f"dK/d{angle}", slope, slope)


def _whole_cycle(question: Question) -> Region:
    """The domain without bounds on the angles themselves: a cycle goes all round."""
    angles = set(question.space.Q)

    def bounds_an_angle(condition: Condition) -> bool:
        return any(linear_edge(angle, condition) is not None for angle in angles)

    asked = question.subject.domain
    kept = tuple(c for c in asked.conditions if not bounds_an_angle(c))
    domain = Domain(kept, asked.surface)
    for formula in question.sections():
        domain = domain & formula.conditions
    return question.region(domain=domain)


def _cycle(question: Question, angle: sp.Symbol, length: Any) -> Outcome:
    """The old variables come back after the period of this angle, and not before."""
    tape, chart = question.tape, question.chart
    region = _whole_cycle(question)
    turn = tape.load(length)
    ahead = {tape.symbol(angle): tape.plus(tape.symbol(angle), turn)}
    changes = [tape.minus(substitute(tape, node, ahead), node) for node in chart.old]
    outcome = question.decide(
        (
            Residual(f"{x} after a period of {angle}", change, change)
            for x, change in zip(question.space.old, changes, strict=True)
        ),
        region,
    )
    if outcome.status == "proved":
        return combined([outcome, _gone_round_once(question, angle, turn, region)])
    turned = _rotation(question, angle, changes, region)
    return turned or outcome


def _rotation(question: Question, angle: sp.Symbol, changes: list[Node], region: Region) -> Outcome | None:
    """One coordinate, in which H has the period 2π, grows by ±2π while the others come back; None where not."""
    tape, space = question.tape, question.space
    full = tape.scaled(tape.constant("pi"), Fraction(2))
    H = question.load(question.hamiltonian())
    for sign in (1, -1):
        for i, x in enumerate(space.q):
            wanted = [full if j == i else tape.zero for j in range(len(changes))]
            residuals = [
                Residual(f"{y} after a period of {angle}", tape.minus(change, tape.scaled(target, sign)))
                for y, change, target in zip(space.old, changes, wanted, strict=True)
            ]
            shifted = substitute(tape, H, {tape.symbol(x): tape.plus(tape.symbol(x), full)})
            residuals.append(Residual(f"H at {x} + 2 pi", question.chart.pull(tape.minus(shifted, H))))
            outcome = question.decide(residuals, region)
            if outcome.status == "proved":
                return outcome.with_detail(**{f"cycle of {angle}": f"{x} grows by {'' if sign > 0 else '-'}2*pi"})
    return None


def _gone_round_once(question: Question, angle: sp.Symbol, turn: Node, region: Region) -> Outcome:
    tape, chart = question.tape, question.chart
    moving = tape.symbol(angle)
    for k in range(2, MOST_TURNS + 1):
        part = tape.plus(moving, tape.scaled(turn, Fraction(1, k)))
        residuals = [
            Residual(f"{x} after 1/{k} of the period", tape.minus(substitute(tape, node, {moving: part}), node))
            for x, node in zip(question.space.old, chart.old, strict=True)
        ]
        early = question.decide(residuals, region)
        if early.status == "proved":
            why = f"the cycle of {angle} is closed after 1/{k} of the period already"
            return replace(question.refuted_exactly(region, why), everywhere=True).with_detail(fails=why)
    if question.method == "numeric":
        return Outcome("supported", "sampling", note=f"the cycle of {angle} isn't closed after a half or a third of it")
    cells = cells_of(tape, region, list(chart.old), question.budget)
    if not cells or not all(cell.connected for cell in cells):
        cells = cells_of(tape, region, list(chart.old), question.budget, finer=True)
    whole = bool(cells) and all(cell.connected for cell in cells or ())
    places = [cell.region for cell in cells] if cells and whole else [region]
    found = [_winding(question, moving, turn, place) for place in places]
    if any(plane is None for plane in found):
        return Outcome("supported", "periods", note=f"that the cycle of {angle} is gone round only once isn't shown")
    planes = ", ".join(dict.fromkeys(plane for plane in found if plane))
    step = {"winding number": f"1 or -1 in the plane {planes}", "cycle of": str(angle)}
    if not whole:
        return Outcome("supported", "winding number", note="at one point of a domain not shown to be connected")
    return Outcome("proved", "winding number", arguments=(step,), detail={f"cycle of {angle}": f"closed in {planes}"})


def _winding(question: Question, moving: Node, turn: Node, region: Region) -> str | None:
    """A plane of two old variables in which the cycle goes round a point once, at some point of the region."""
    tape, chart, rng = question.tape, question.chart, random.Random(question.seed)
    names = question.space.old
    n = len(names) // 2
    planes = [(i, i + n) for i in range(n)]
    planes += [pair for pair in combinations(range(2 * n), 2) if pair not in planes]
    try:
        found = samples(tape, list(chart.old), region, rng, count=POINTS, budget=question.budget, nice=True)
        for sample in found:
            point = {node: value for node, value in sample.point.items() if isinstance(value, Fraction)}
            if len(point) < len(sample.point) or sample.functions:
                continue
            point.setdefault(moving, Fraction(1, 7))
            for i, j in planes:
                if winding_number(tape, (chart.old[i], chart.old[j]), moving, turn, point) in (1, -1):
                    return f"({names[i]}, {names[j]})"
    except Unsupported:
        return None
    return None


KINDS = {"action_angle": action_angle}
