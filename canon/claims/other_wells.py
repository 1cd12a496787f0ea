"""Is an orbit the only one of the domain at its energy? A claim that names no well is one about the only orbit.

Other wells are looked for among a hundred points on either side of the orbit and, before anything is refuted, on a map
of the potential. One that leaves the domain at a certified point is none of the domain's: with q² < 4 the well at 10
isn't meant. Where no map shows the orbit that was found, nothing is refuted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.action_places import FAILURES
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, certainly_positive, evaluate, excludes_zero, precision
from canon.decide.libration import BITS, Integrand, Orbit, covered
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.action_places import Place
    from canon.claims.action_region import Setting
    from canon.claims.question import Question
    from canon.numeric.actions.motion import Motion

FAR = 60
LOOKS = 40
"""Points of another orbit at which it is asked whether it is in the domain."""
WELL = "key 'well'"
"""Where the answer says that several wells may be meant."""
UNKNOWN = "it isn't known whether this is the only well at its energy: name a `well`"


def translation(square: sp.Expr, q: sp.Symbol) -> Fraction | None:
    """A little less than a period of the square in q that shows at sight; None where none does."""
    for length in (sp.pi / 2, sp.pi, 2 * sp.pi, 4 * sp.pi):
        if sp.expand(sp.expand(square.xreplace({q: q + length})) - sp.expand(square)) == 0:  # type: ignore[operator]
            return Fraction(float(length)) * Fraction(10**9 - 1, 10**9)
    return None


def _period_there(question: Question, setting: Setting, integrand: Integrand) -> Fraction | None:
    """A little less than a period of the square at these constants, as that of tan²(a q) at a = 2/5; else None."""
    from canon.numeric.actions.period import least_period

    period = least_period(setting.motion.square.xreplace(_at(question, integrand)), setting.q)
    if period is None:
        return None
    with precision(BITS):
        length = float(period())
    return Fraction(length) * Fraction(10**9 - 1, 10**9) if 0 < length < math.inf else None


def _at(question: Question, integrand: Integrand) -> dict[Any, Any]:
    """The constants at which the orbit is looked at, as sympy's numbers."""
    return {question.tape.symbol_at(n): sp.Rational(v.numerator, v.denominator) for n, v in integrand.point.items()}


def check_one_well(question: Question, setting: Setting, integrand: Integrand, orbit: Orbit) -> None:
    """**Raises** `InputError` where another well shows at the same energy, among a hundred points on either side.

    Of a square with a period the wells between the orbit and its next images count: the images are the same well.
    """
    length = translation(setting.motion.square, setting.q) or _period_there(question, setting, integrand)
    width = orbit.right - orbit.left
    beside = list[tuple[Fraction, Fraction]]()  # stretches of wells that aren't in the domain
    for k in range(1, 101):
        for where in (orbit.outer[0] - width * k / 20, orbit.outer[1] + width * k / 20):
            if length is not None and not orbit.outer[1] - length < where < orbit.outer[0] + length:
                continue
            if (integrand.low is not None and where <= integrand.low) or (
                integrand.high is not None and where >= integrand.high
            ):
                continue
            if any(low <= where <= high for low, high in beside):
                continue
            if integrand.sign(where) <= 0 or _leads_away(integrand, where, orbit):
                continue
            stretch = _stretch_out_of_domain(question, setting, integrand, where, width / 20)
            if stretch is not None:
                beside.append(stretch)
                continue
            raise InputError(
                f"there is more than one well, near {float((orbit.left + orbit.right) / 2):.3g} and "
                f"{float(where):.3g}, at {_words(question, integrand)}: name a point of the one that is meant, or "
                "restrict the domain",
                WELL,
            )


def _stretch_out_of_domain(
    question: Question, setting: Setting, integrand: Integrand, where: Fraction, step: Fraction
) -> tuple[Fraction, Fraction] | None:
    """From a place to another one of the same orbit that certainly isn't in the domain; None where none is seen."""
    if leaves(question, setting, integrand, [where]):
        return where, where
    for direction in (1, -1):
        reached = where
        for _ in range(LOOKS):
            ahead = reached + direction * step
            low, high = min(reached, ahead), max(reached, ahead)
            with precision(BITS):
                if integrand.sign(ahead) <= 0 or not covered(low, high, question.budget, _positive(integrand)):
                    break
            reached = ahead
            if leaves(question, setting, integrand, [ahead]):
                return min(where, ahead), max(where, ahead)
    return None


def _positive(integrand: Integrand) -> Callable[[Ball], bool]:
    return lambda where: certainly_positive(integrand.at(integrand.square, where))


def is_only_well(question: Question, setting: Setting, place: Place) -> bool:
    """Whether a map of the potential at these constants shows the orbit through a place, and no other one in the
    domain: a refutation is one of the orbit that is meant. True where the claim names the well, or rotates.

    **Raises** `InputError` where it shows several.
    """
    if setting.well is not None or question.key("branch") == "rotation":
        return True
    integrand = place.integrand
    symbols = {question.tape.symbol_at(node): value for node, value in integrand.point.items()}
    values: dict[Any, Any] = {name: sp.Rational(v.numerator, v.denominator) for name, v in symbols.items()}
    for H, level in _forms(setting, values):
        found = _wells(setting, H, level, values)
        if found is None:
            continue
        orbits, wells = found
        meant = [ends for ends in wells if not leaves(question, setting, integrand, _within(*ends))]
        if len(meant) > 1:
            places = ", ".join(f"{float(left + right) / 2:.6g}" for left, right in meant)
            raise InputError(
                f"at {_words(question, integrand)} {len(meant)} wells have orbits: choose one with well = {places}",
                WELL,
            )
        if len(meant) == 1 and _holds(meant[0], place.inside, orbits):
            return True
    return False


def check_images(question: Question, setting: Setting, place: Place) -> None:
    """**Raises** `InputError` where an average isn't the same in all images of a well, and none of them is named.

    Under a period of H the images of a well have the same action, but not the same average of q.
    """
    from canon.numeric.actions.period import least_period

    motion, integrand = setting.motion, place.integrand
    if setting.well is not None or not (motion.low.is_infinite or motion.high.is_infinite):
        return
    period = least_period(motion.square.xreplace(_at(question, integrand)), setting.q)
    if period is None:
        return
    tape, (f, *_) = question.tape, setting.also
    node, momentum = question.load(f), tape.symbol(setting.p)
    constants = {name: arb(rational(value)) for name, value in integrand.point.items()}
    with precision(BITS):
        here, length = arb(rational(place.inside)), period()
        try:
            p = integrand.at(integrand.mean, here) + integrand.at(integrand.square, here).sqrt()
            values = [
                evaluate(tape, tape.reach([node]), {**constants, integrand.coordinate: x, momentum: p})[node]
                for x in (here, here + length)
            ]
        except (*FAILURES, KeyError):
            return
        if excludes_zero(values[1] - values[0]):
            raise InputError(
                f"{f} has other averages in the images of the well, a period of H apart: name a point of the one that "
                "is meant, or restrict the domain",
                WELL,
            )


def _forms(setting: Setting, values: dict[Any, Any]) -> Sequence[tuple[Any, Any]]:
    """H with its energy; and p² − square with 0, that of the same orbits: of a negative mass, or one with poles."""
    level = setting.energy if setting.level is None else setting.level
    square: Any = setting.at_level(setting.motion.square)
    return (
        (setting.H.xreplace(values), level.xreplace(values)),
        (setting.p**2 - square.xreplace(values), sp.S.Zero),
    )


def _wells(
    setting: Setting, H: Any, level: Any, values: dict[Any, Any]
) -> tuple[Motion, list[tuple[Fraction, Fraction]]] | None:
    """The map, and between which places the librations run at the level; None where there is no map."""
    from canon.numeric.actions.motion import motion

    edges: tuple[Any, ...] = (setting.motion.low, setting.motion.high)
    low, high = (end.xreplace(values) for end in edges)
    try:
        ends = None if (low, high) == (-sp.oo, sp.oo) else (float(low), float(high))
        orbits = motion(H, setting.q, setting.p, domain=ends)
        return orbits, [(Fraction(left), Fraction(right)) for left, right in orbits.librations(level)]
    except (InputError, TypeError, ValueError, OverflowError):
        return None


def _within(left: Fraction, right: Fraction) -> list[Fraction]:
    return [left + (right - left) * Fraction(2 * k + 1, 2 * LOOKS) for k in range(LOOKS)]


def _holds(ends: tuple[Fraction, Fraction], inside: Fraction, orbits: Motion) -> bool:
    """Whether a point lies between the ends, or one of its images does."""
    left, right = ends
    if orbits.domain.period is not None:
        period = Fraction(float(orbits.domain.period()))
        inside = left + (inside - left) % period
    return left <= inside <= right


def leaves(question: Question, setting: Setting, integrand: Integrand, places: Sequence[Fraction]) -> bool:
    """Whether an orbit through these places certainly has a point outside of the domain."""
    tape, variables = question.tape, {setting.q, setting.p}
    asked = [c.terms[0] for c in setting.conditions if c.kind == "positive" and c.terms[0].free_symbols & variables]
    if setting.solved is not None:
        asked += setting.solved.guards
    if not asked:
        return False
    nodes, momentum = [tape.load(term) for term in asked], tape.symbol(setting.p)
    constants = {node: arb(rational(value)) for node, value in integrand.point.items()}
    with precision(BITS):
        for place in places:
            where = arb(rational(place))
            try:
                square = integrand.at(integrand.square, where)
                if not certainly_positive(square):
                    continue
                for sign in (1, -1):
                    p = integrand.at(integrand.mean, where) + sign * square.sqrt()
                    point = {**constants, integrand.coordinate: where, momentum: p}
                    balls = evaluate(tape, tape.reach(nodes), point)
                    if any(certainly_positive(-balls[node]) for node in nodes):
                        return True
            except (*FAILURES, KeyError):
                continue
    return False


def _leads_away(integrand: Integrand, where: Fraction, orbit: Orbit) -> bool:
    """Whether the square stays positive at places farther and farther out: a motion there isn't bound in a well."""
    step = where - (orbit.left if where < orbit.left else orbit.right)
    edge = integrand.low if step < 0 else integrand.high
    if edge is not None:
        return False
    return all(integrand.sign(where + step * Fraction(2**k)) > 0 for k in range(FAR))


def _words(question: Question, integrand: Integrand) -> str:
    named = ((question.tape.symbol_at(node), value) for node, value in sorted(integrand.point.items()))
    return ", ".join(f"{name} = {value}" for name, value in named) or "this energy"
