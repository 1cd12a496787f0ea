"""Actions and frequencies without a closed form: certified quadrature at a few energies.

Each value is a ball that certainly holds the action at one choice of constants. One that doesn't meet the claimed
formula's ball refutes the claim; if all of them do, the claim is supported, and the evidence is the largest difference
against the width of its ball.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.action_places import FAILURES
from canon.claims.action_region import constants_region
from canon.claims.other_wells import UNKNOWN, check_one_well, is_only_well
from canon.claims.outcome import Outcome
from canon.claims.solved_orbits import guarded, square_is_right
from canon.decide.answer import show_ball
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, evaluate, precision
from canon.decide.libration import BITS, Integrand, Orbit, libration, stays
from canon.decide.orbit_quadrature import action, backward_too, period, turn
from canon.decide.region import Requirement, holds
from canon.decide.tape import Node
from canon.domain import nonzero
from canon.errors import InputError
from canon.mechanics.action_angle import linear_edge
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.action_orbits import Example
    from canon.claims.action_places import Place
    from canon.claims.action_region import Setting
    from canon.claims.question import Question

PLACES = 6
METHOD = "certified quadrature"


def by_quadrature(question: Question, setting: Setting, branch: str, where: Iterable[Place]) -> Outcome | None:
    """The claim at a few choices of the constants: refuted by one of them, or supported; None where no orbit is found.

    **Raises** `InputError` where a well or branch is ambiguous at one of them.
    """
    tape, wants_frequency = question.tape, question.claim.kind == "frequency"
    if setting.solved is not None:
        square = square_is_right(question, setting, constants_region(question, setting))
        if square.status != "proved":
            return Outcome("undecided", METHOD, note="H isn't quadratic in p, and was not seen to be solved for p")
    found: list[tuple[float, float]] = []
    equals = question.load(setting.equals)
    for place in where:
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
                if not is_only_well(question, setting, place):
                    return Outcome("undecided", METHOD, note=UNKNOWN)
                return _refuted(question, place, actual, difference)
            found.append((abs(float(difference.mid())), float(difference.rad())))
        if len(found) >= PLACES:
            break
    if not found:
        return None
    worst = max(found, key=lambda pair: pair[0] / pair[1] if pair[1] else 0.0)
    evidence = Evidence(len(found), worst[0], worst[1], BITS)
    return Outcome("supported", METHOD, numeric=evidence, note="no closed form was recognised")


def on_separatrix(question: Question, setting: Setting, branch: str, here: Example | None) -> Outcome | None:
    """The action at an energy exactly at a barrier, whose double turning point no sign encloses: by numbers alone."""
    variables = {setting.q, setting.p}
    cut = [c for c in setting.conditions if {*variables} & set().union(*(t.free_symbols for t in c.terms))]
    if (
        here is None
        or question.claim.kind != "action"
        or any(linear_edge(setting.q, c) is None or c.terms[0].has(setting.p) for c in cut)
    ):
        return None
    try:
        inside = None if setting.well is None else here.number(setting.well)
        found = here.motion.orbit(energy=here.number(setting.energy), well=inside, branch=branch)
        claimed = Fraction(float(sp.Float(here.number(setting.equals), 40)))
    except (InputError, OverflowError, TypeError, ValueError):
        return None
    if found.period is not None:
        return None
    half = 2 if branch == "rotation" else 1  # of the loop there and back a rotation has one way
    value, bound = found.action.value / half, found.action.bound + abs(found.action.value) * 2.0**-52
    difference = abs(float(claimed) - value)
    note = "the energy is exactly that of a separatrix, where the integral isn't enclosed but computed"
    if difference > 4 * bound:
        return Outcome("undecided", METHOD, note=f"{note}: about {value:.15g}", detail={"value": f"{value:.15g}"})
    return Outcome("supported", METHOD, numeric=Evidence(1, difference, 4 * bound, 53), note=note)


def _refuted(question: Question, place: Place, actual: Ball, difference: Ball) -> Outcome:
    tape = question.tape
    witness = {str(tape.symbol_at(node)): str(value) for node, value in sorted(place.integrand.point.items())}
    detail = {"fails": "the integral", "residual": show_ball(difference), "value": show_ball(actual)}
    step = {"theorem": "quadrature with an enclosure of its error", "at": witness, "integral": show_ball(actual)}
    return Outcome("refuted", METHOD, witness=witness, detail=detail, arguments=(step,))


# -- how much -------------------------------------------------------------------------------------------


def _value(question: Question, setting: Setting, place: Place, branch: str, wants_frequency: bool) -> Ball | None:
    integrand = place.integrand
    energy = place.energy if wants_frequency else None
    if not constants_hold(question, setting, integrand):
        return None
    if branch == "rotation":
        return _rotation(question, setting, place, energy)
    orbit = certified_orbit(question, setting, place)
    if orbit is None:
        return None
    value = action(integrand, orbit) if energy is None else period(integrand, orbit, energy)
    with precision(BITS):
        leading = integrand.at(question.load(setting.motion.leading), arb(rational(place.inside)))
    return value if value is None or leading > 0 else -value


def _rotation(question: Question, setting: Setting, place: Place, energy: Node | None) -> Ball | None:
    """∫ p dq over a period of the coordinate. **Raises** `InputError` where both branches have p > 0."""
    integrand, budget = place.integrand, question.budget
    with precision(BITS):
        length = _turn_length(question, setting, integrand)
        if length is None:
            return None
        end = place.inside + Fraction(float(length.lower())) * Fraction(10**12 - 1, 10**12)
        rest = arb(rational(place.inside)) + length - arb(rational(end))
    beyond = Fraction(float(rest.upper())) * 2 + end
    if not stays_inside(question, setting, integrand, place.inside, beyond):
        return None
    with precision(BITS):
        if not guarded(question, setting, integrand, [place.inside]):
            return None
    if backward_too(integrand, place.inside, beyond, budget):
        where = _at(question, integrand)
        raise InputError(
            f"both branches of the rotation have p > 0 at {where}: restrict the domain to energies at which one has",
            "key 'branch'",
        )
    return turn(integrand, place.inside, (end, rest), budget, energy)


def _turn_length(question: Question, setting: Setting, integrand: Integrand) -> Ball | None:
    """The stated period at this place, or the least one that shows in sines and cosines."""
    if setting.period is not None:
        point = {node: arb(rational(value)) for node, value in integrand.point.items()}
        node = question.load(setting.period)
        try:
            length = evaluate(question.tape, question.tape.reach([node]), point)[node]
        except (*FAILURES, KeyError):
            return None
        return length if length > 0 else None
    from canon.numeric.actions.period import least_period

    tape = question.tape
    rules: Any = {tape.symbol_at(n): sp.Rational(v.numerator, v.denominator) for n, v in integrand.point.items()}
    found = least_period(setting.H.xreplace(rules), setting.q)
    return None if found is None else found()


def _at(question: Question, integrand: Integrand) -> str:
    return ", ".join(f"{question.tape.symbol_at(n)} = {v}" for n, v in sorted(integrand.point.items())) or "this energy"


def certified_orbit(question: Question, setting: Setting, place: Place) -> Orbit | None:
    """The libration at a place, where it is certified to stay in the domain; None where it is not.

    **Raises:** `InputError` where no `well` is named and there is another one.
    """
    integrand = place.integrand
    orbit = libration(integrand, place.inside, question.budget)
    if orbit is None or not stays_inside(question, setting, integrand, *orbit.outer):
        return None
    if setting.well is None:
        check_one_well(question, setting, integrand, orbit)
    with precision(BITS):
        if not guarded(question, setting, integrand, [place.inside, (orbit.left + orbit.right) / 2]):
            return None
    return orbit


def constants_hold(question: Question, setting: Setting, integrand: Integrand) -> bool:
    """The conditions on constants, the energy among them, certified."""
    variables = {setting.q, setting.p}
    wanted = [c for c in setting.conditions if not any(t.free_symbols & variables for t in c.terms)]
    return _all_hold(question, wanted, {n: arb(rational(v)) for n, v in integrand.point.items()})


def stays_inside(question: Question, setting: Setting, integrand: Integrand, left: Fraction, right: Fraction) -> bool:
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
