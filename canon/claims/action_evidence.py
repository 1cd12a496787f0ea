"""Actions and frequencies without a closed form: certified quadrature at a few energies.

Each value is a ball that certainly holds the action at one choice of constants. One that doesn't meet the claimed
formula's ball refutes the claim; if all of them do, the claim is supported, and the evidence is the largest difference
against the width of its ball.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.chart import chart_of
from canon.claims.outcome import Outcome
from canon.decide.answer import show_ball
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.orbit_quadrature import BITS, Integrand, Orbit, action, libration, period, stays, turn
from canon.decide.region import Region, Requirement, admits, holds
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported
from canon.domain import Domain, nonzero
from canon.errors import InputError
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.action_region import Setting
    from canon.claims.question import Question

PLACES, TRIES = 6, 24
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)
METHOD = "certified quadrature"


@dataclass(frozen=True)
class Place:
    """One choice of constants, and the orbit through one of its points."""

    integrand: Integrand
    inside: Fraction
    energy: Node | None


def by_quadrature(question: Question, setting: Setting, branch: str, *, wants_frequency: bool) -> Outcome:
    """The claim at a few choices of the constants: refuted by one of them, or supported."""
    tape = question.tape
    found: list[tuple[float, float]] = []
    equals = question.load(setting.equals)
    for place in _places(question, setting):
        value = _value(question, setting, place, branch, wants_frequency)
        if value is None:
            continue
        integrand = place.integrand
        with precision(BITS):
            point = {node: arb(rational(number)) for node, number in integrand.point.items()}
            try:
                claimed = evaluate(tape, tape.reach([equals]), point)[equals]
                actual = 1 / value if wants_frequency else value
            except FAILURES:
                continue
            difference = claimed - actual
            if not isinstance(difference, arb) or not difference.is_finite():
                continue
            if not difference.contains(0):
                return _refuted(question, place, actual, difference)
            found.append((abs(float(difference.mid())), float(difference.rad())))
        if len(found) >= PLACES:
            break
    if not found:
        return Outcome("undecided", METHOD, note="no such orbit was found at the energies that were tried")
    worst = max(found, key=lambda pair: pair[0] / pair[1] if pair[1] else 0.0)
    evidence = Evidence(len(found), worst[0], worst[1], BITS)
    return Outcome("supported", METHOD, numeric=evidence, note="no closed form was recognised")


def _refuted(question: Question, place: Place, actual: Ball, difference: Ball) -> Outcome:
    tape = question.tape
    witness = {str(tape.symbol_at(node)): str(value) for node, value in sorted(place.integrand.point.items())}
    detail = {"fails": "the integral", "residual": show_ball(difference), "value": show_ball(actual)}
    step = {"theorem": "quadrature with an enclosure of its error", "at": witness, "integral": show_ball(actual)}
    return Outcome("refuted", METHOD, witness=witness, detail=detail, arguments=(step,))


# -- where ----------------------------------------------------------------------------------------------


def _places(question: Question, setting: Setting) -> Iterator[Place]:
    """Constants at which an orbit of the domain passes a point; the energy is that point's where it is free."""
    tape, q, p = question.tape, setting.q, setting.p
    motion = setting.motion
    region = _phase_region(question, setting)
    square, mean, H = (question.load(e) for e in (motion.square, motion.mean, setting.H))
    names = {*tape.support(H), *tape.support(square), *tape.support(question.load(setting.equals))}
    node_q, node_p = tape.symbol(q), tape.symbol(p)
    free = isinstance(setting.energy, sp.Symbol)
    level = tape.load(setting.energy)
    targets = [H, *sorted(names - {level})] if free else [H, *sorted(names)]
    well = question.key("well")
    rng = random.Random(question.seed)
    try:
        for sample in samples(tape, targets, region, rng, count=TRIES, budget=question.budget, nice=True):
            values = {n: v for n, v in sample.point.items() if isinstance(v, Fraction)}
            if sample.functions or node_q not in values:
                continue
            inside = values[node_q]
            if free:
                energy = Fraction(float(sample.balls[H].mid())).limit_denominator(10**6)
                with precision(BITS):
                    if not admits(setting.energy, arb(rational(energy))):
                        continue
                values[level] = energy
            point = {n: v for n, v in values.items() if n not in (node_q, node_p) and n in names}
            if not names - {node_q, node_p} <= set(point):
                continue
            if well is not None:
                inside = _number(question, question.load(well), point)
            if inside is not None:
                low, high = (_edge(question, e, point) for e in (motion.low, motion.high))
                yield Place(Integrand(tape, node_q, square, mean, point, low, high), inside, level if free else None)
    except Unsupported:
        return


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


def _number(question: Question, node: Node, point: Mapping[Node, Fraction]) -> Fraction | None:
    values = {n: arb(rational(v)) for n, v in point.items()}
    with precision(BITS):
        try:
            ball = evaluate(question.tape, question.tape.reach([node]), values)[node]
            return Fraction(float(ball.mid())).limit_denominator(10**12)
        except (*FAILURES, KeyError, AttributeError):
            return None


def _edge(question: Question, edge: Any, point: Mapping[Node, Fraction]) -> Fraction | None:
    return None if edge in (sp.oo, -sp.oo) else _number(question, question.load(edge), point)


# -- how much -------------------------------------------------------------------------------------------


def _value(question: Question, setting: Setting, place: Place, branch: str, wants_frequency: bool) -> Ball | None:
    integrand, budget = place.integrand, question.budget
    energy = place.energy if wants_frequency else None
    if not _constants_hold(question, setting, integrand):
        return None
    if branch == "rotation":
        length = _turn_length(question, setting, integrand)
        if length is None or not _stays(question, setting, integrand, place.inside, place.inside + length):
            return None
        return turn(integrand, place.inside, place.inside + length, budget, energy)
    orbit = libration(integrand, place.inside, budget)
    if orbit is None or not _stays(question, setting, integrand, orbit.left, orbit.right):
        return None
    if question.key("well") is None:
        _check_one_well(question, integrand, orbit, translation(setting.motion.square, setting.q))
    value = action(integrand, orbit) if energy is None else period(integrand, orbit, energy)
    with precision(BITS):
        leading = integrand.at(question.load(setting.motion.leading), arb(rational(place.inside)))
    return value if value is None or leading > 0 else -value


def _turn_length(question: Question, setting: Setting, integrand: Integrand) -> Fraction | None:
    """The period, where it is a rational number at this place; other ones aren't integrated over."""
    stated = question.key("period")
    if stated is None:
        return None
    value = question.tape.value(question.load(stated))
    return value if value is not None and value > 0 else None


def _constants_hold(question: Question, setting: Setting, integrand: Integrand) -> bool:
    """The conditions on constants, the energy among them, certified."""
    variables = {setting.q, setting.p}
    wanted = [c for c in setting.conditions if not any(t.free_symbols & variables for t in c.terms)]
    return _all_hold(question, wanted, {n: arb(rational(v)) for n, v in integrand.point.items()})


def _stays(question: Question, setting: Setting, integrand: Integrand, left: Fraction, right: Fraction) -> bool:
    """The conditions on coordinate and momentum, and that the coefficient of p² isn't 0, certified along the orbit."""
    variables = {setting.q, setting.p}
    leading = nonzero(setting.motion.leading) if setting.motion.leading.free_symbols & variables else ()
    wanted = [c for c in (*setting.conditions, *leading) if any(t.free_symbols & variables for t in c.terms)]
    if not wanted:
        return True
    momentum = question.tape.symbol(setting.p)

    def inside(where: Ball, p: Ball) -> bool:
        values = {n: arb(rational(v)) for n, v in integrand.point.items()}
        return _all_hold(question, wanted, {**values, integrand.coordinate: where, momentum: p})

    return stays(integrand, left, right, question.budget, inside)


def _all_hold(question: Question, conditions: list[Any], point: dict[Node, Ball]) -> bool:
    tape = question.tape
    requirements = [Requirement(c.kind, tuple(tape.load(t) for t in c.terms), c) for c in conditions]
    nodes = [node for requirement in requirements for node in requirement.nodes]
    with precision(BITS):
        try:
            balls = evaluate(tape, tape.reach(nodes), point)
        except (*FAILURES, KeyError):
            return False
    return all(holds(requirement, balls) for requirement in requirements)


def translation(square: sp.Expr, q: sp.Symbol) -> Fraction | None:
    """A little less than a period of the square in q that shows at sight; None where none does."""
    for length in (sp.pi / 2, sp.pi, 2 * sp.pi, 4 * sp.pi):
        if sp.expand(sp.expand(square.xreplace({q: q + length})) - sp.expand(square)) == 0:  # type: ignore[operator]
            return Fraction(float(length)) * Fraction(10**9 - 1, 10**9)
    return None


def _check_one_well(question: Question, integrand: Integrand, orbit: Orbit, length: Fraction | None) -> None:
    """**Raises** `InputError` where another well shows at the same energy, among a hundred points on either side.

    Of a square with a period the wells between the orbit and its next images count: the images are the same well.
    """
    width = orbit.right - orbit.left
    for k in range(1, 101):
        for where in (orbit.outer[0] - width * k / 20, orbit.outer[1] + width * k / 20):
            if length is not None and not orbit.outer[1] - length < where < orbit.outer[0] + length:
                continue
            if (integrand.low is not None and where <= integrand.low) or (
                integrand.high is not None and where >= integrand.high
            ):
                continue
            if integrand.sign(where) > 0:
                place = ", ".join(f"{question.tape.symbol_at(n)} = {v}" for n, v in sorted(integrand.point.items()))
                raise InputError(
                    f"there is more than one well, near {float((orbit.left + orbit.right) / 2):.3g} and "
                    f"{float(where):.3g}, at {place}: name a point of the one that is meant, or restrict the domain",
                    "key 'well'",
                )
