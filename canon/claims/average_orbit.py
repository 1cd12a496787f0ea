"""Averages over the orbits of one degree of freedom, without a closed form: certified quadratures at a few energies.

∮ f dt over ∮ dt, where dt = dq/(∂H/∂p): a ball that certainly holds the average at one choice of the constants.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import arb

from canon.claims.action import branch_of, setting_of
from canon.claims.action_evidence import METHOD, certified_orbit, constants_hold
from canon.claims.action_orbits import example, why_not
from canon.claims.action_places import FAILURES, Place, places, places_by_wells
from canon.claims.action_region import Setting
from canon.claims.other_wells import UNKNOWN, check_images, is_only_well
from canon.claims.outcome import Outcome
from canon.decide.answer import show_ball
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, evaluate, precision
from canon.decide.libration import BITS, Values
from canon.decide.orbit_mean import mean
from canon.errors import InputError
from canon.mechanics.action_angle import NotQuadratic
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

AVERAGES = 4
"""Choices of constants at which averages are compared."""


def over_orbits(question: Question) -> Outcome:
    """The average of f over one period of the libration at the energy is `equals`: refuted at one choice of the
    constants, or supported."""
    f, space = question.formula("f"), question.space
    moving = {*space.q, space.t} - {question.key("coordinate")}
    for symbol in sorted(f.symbols & moving, key=str):
        raise InputError(f"{symbol} moves too, and not with the orbit's period: give the `motion`", "key 'f'")
    try:
        setting = setting_of(question, f)
    except NotQuadratic as reason:
        return Outcome("undecided", note=str(reason))
    if branch_of(question, setting) != "libration":
        raise InputError("an average is one over librations: over a rotation give its `motion`", "key 'branch'")
    here = example(question, setting)
    for chosen in (places(question, setting), places_by_wells(question, setting, "libration", here)):
        found: list[tuple[float, float]] = []
        seen: list[Values] = []
        for place in chosen:
            if place.integrand.point in seen:
                continue
            seen.append(place.integrand.point)
            value = _average(question, setting, place)
            if value is not None:
                check_images(question, setting, place)
            gap = None if value is None else _gap(question, setting, place, value)
            if value is None or gap is None:
                continue
            if not gap.contains(0):
                if not is_only_well(question, setting, place):
                    return Outcome("undecided", METHOD, note=UNKNOWN)
                return _refuted(question, place, value, gap)
            found.append((abs(float(gap.mid())), float(gap.rad())))
            if len(found) >= AVERAGES:
                break
        if found:
            worst = max(found, key=lambda pair: pair[0] / pair[1] if pair[1] else 0.0)
            return Outcome("supported", METHOD, numeric=Evidence(len(found), *worst, BITS), note="no closed form")
    reason = why_not(question, setting, "libration", here)
    if here is not None and reason is not None and not here.values:
        raise reason
    note = "no such orbit was found at the energies that were tried"
    return Outcome("undecided", METHOD, note="; ".join([note, *([reason.message] if reason is not None else [])]))


def _average(question: Question, setting: Setting, place: Place) -> Ball | None:
    integrand, tape = place.integrand, question.tape
    if place.energy is None or not constants_hold(question, setting, integrand):
        return None
    orbit = certified_orbit(question, setting, place)
    if orbit is None:
        return None
    parts = mean(integrand, orbit, place.energy, question.load(setting.also[0]), tape.symbol(setting.p))
    if parts is None:
        return None
    with precision(BITS):
        whole, time = parts
        return whole / time if not time.contains(0) else None


def _gap(question: Question, setting: Setting, place: Place, value: Ball) -> Ball | None:
    """What is claimed, less the average."""
    node = question.load(setting.equals)
    with precision(BITS):
        point = {n: arb(rational(number)) for n, number in place.integrand.point.items()}
        try:
            gap = evaluate(question.tape, question.tape.reach([node]), point)[node] - value
        except (*FAILURES, KeyError):
            return None
    return gap if isinstance(gap, arb) and gap.is_finite() else None


def _refuted(question: Question, place: Place, value: Ball, gap: Ball) -> Outcome:
    names = sorted(place.integrand.point.items())
    witness = {str(question.tape.symbol_at(node)): str(number) for node, number in names}
    detail = {"fails": "the average", "residual": show_ball(gap), "value": show_ball(value)}
    step = {"theorem": "quadratures with an enclosure of their errors", "at": witness, "average": show_ball(value)}
    return Outcome("refuted", METHOD, witness=witness, detail=detail, arguments=(step,))
