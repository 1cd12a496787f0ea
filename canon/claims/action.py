"""Actions J = ∮ p dq and frequencies dE/dJ of one degree of freedom, proved by standard integrals.

The closed form is found in `canon.mechanics`; what it rests on is decided here: that p² is what the standard integral
has under its root, that such a motion exists wherever the claim is made, and that the claimed formula equals it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims import solved_orbits
from canon.claims.action_evidence import METHOD, by_quadrature, on_separatrix
from canon.claims.action_orbits import example, why_not
from canon.claims.action_places import places, places_by_wells
from canon.claims.action_region import (
    Setting,
    along,
    assumed,
    constants_region,
    existing,
    is_positive,
    not_implied,
    only_one_forward,
    oriented,
)
from canon.claims.chart import chart_of
from canon.claims.idle_keys import none_idle
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.own_names import is_free_of
from canon.claims.show import is_steep
from canon.deadline import within
from canon.domain import Condition, Domain, unique
from canon.errors import EmptyDomain, InputError
from canon.expression import Formula
from canon.mechanics.action_angle import ClosedAction, NotQuadratic, one_degree
from canon.mechanics.closed_actions import librations
from canon.mechanics.elliptic_actions import elliptic
from canon.mechanics.formulas import assumed_of
from canon.mechanics.solved_momentum import solved_momentum
from canon.mechanics.standard_actions import cosine, rotation
from canon.mechanics.substitutions import integrands
from canon.sign import declared
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question


def action(question: Question) -> Outcome:
    """`action`: ∮ p d(coordinate) over one period at the energy is `equals`."""
    return _decided(question, lambda setting, closed: ("J", setting.equals - closed.value))


def frequency(question: Question) -> Outcome:
    """`frequency`: dE/dJ is `equals`, in cycles in unit time."""
    return _decided(question, lambda setting, closed: ("dE/dJ", setting.equals * _period(setting, closed) - 1))


def _period(setting: Setting, closed: ClosedAction) -> Any:
    return closed.value.diff(setting.energy) if closed.period is None else closed.period


Statement = Callable[[Setting, ClosedAction], tuple[str, Any]]


def _decided(question: Question, statement: Statement) -> Outcome:
    try:
        setting = setting_of(question)
    except NotQuadratic as reason:
        return Outcome("undecided", note=str(reason))
    branch = branch_of(question, setting)
    if setting.period is not None and setting.period.is_positive is False:
        raise InputError(f"{question.key('period')} is no period: it is above 0", "key 'period'")
    reasons: list[str] = []
    try:
        proved = _by_closed_form(question, setting, branch, statement, reasons)
    except EmptyDomain as error:
        raise why_not(question, setting, branch, example(question, setting)) or error from error
    if proved is not None:
        return proved
    _check_period(question, setting)
    found = by_quadrature(question, setting, branch, places(question, setting))
    if found is None:
        here = example(question, setting)
        found = by_quadrature(question, setting, branch, places_by_wells(question, setting, branch, here))
        if found is None:
            reason = why_not(question, setting, branch, here)
            if here is not None and reason is not None and not here.values:
                raise reason
            found = on_separatrix(question, setting, branch, here)
            if found is None:
                reasons.append("no such orbit was found at the energies that were tried")
                reasons += [reason.message] if reason is not None else []
                found = Outcome("undecided", METHOD)
    return found.with_status(found.status, "; ".join(dict.fromkeys(reasons))) if reasons else found


def _by_closed_form(
    question: Question, setting: Setting, branch: str, statement: Statement, reasons: list[str]
) -> Outcome | None:
    """What a standard integral says; None where none suits, with the `reasons` why not."""
    for found in _closed_forms(question, setting, branch):
        exists = (*found.exists, *solved_orbits.where_it_exists(setting, found))
        unsigned = replace(found, exists=tuple(map(setting.at_level, exists)))
        region = existing(question, setting, unsigned)
        if not all(is_positive(question, region, setting.at_level(need)) for need in found.needs):
            reasons.append(f"{found.method}: the order of the roots isn't known")
            continue
        closed = oriented(question, setting, unsigned, region, branch)
        if closed is None:
            reasons.append(f"the sign of {setting.motion.leading}, with which the orbit is run through, isn't known")
            continue
        gaps = not_implied(question, setting, region, closed)
        if gaps:
            reasons.append(f"the orbit may leave the domain: {gaps[0]}")
            continue
        if branch == "rotation" and not only_one_forward(question, setting, region):
            reasons.append("whether one of the two branches has p > 0, or both have, isn't known")
            continue
        checks = [Residual(name, question.load(setting.at_level(e))) for name, e in closed.vanishes]
        # for all constants of the domain, and not only where the closed form says that there are orbits
        everywhere = along(question, setting, constants_region(question, setting))
        grounds = [question.decide(checks, everywhere)] if checks else []
        if setting.solved is not None:
            found_square = solved_orbits.grounds(question, setting, closed, region)
            if found_square is None:
                reasons.append(f"{closed.method}: not verified that this is an orbit of H")
                continue
            grounds.append(found_square)
        if any(ground.status != "proved" for ground in grounds) and question.method != "numeric":
            reasons.append(f"{closed.method}: not verified")
            continue
        label, residual = statement(setting, closed)
        left = setting.at_level(residual)
        if left.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
            reasons.append(f"{closed.method}: not finite at this energy")
            continue
        outcome = question.decide([Residual(label, question.load(left))], region)
        slope = setting.at_level(_period(setting, closed)) if label != "J" else None
        value = question.load(closed.value if slope is None else 1 / slope)
        outcome = outcome.with_detail(value=question.show(value), by=closed.method)
        if outcome.status == "refuted" and any(ground.status != "proved" for ground in grounds):
            continue  # only numbers say that the closed form is the action
        return outcome if outcome.status == "refuted" else combined([*grounds, outcome])
    return None


# -- what is claimed ----------------------------------------------------------------------------------


def _fixed(question: Question) -> dict[sp.Symbol, Formula]:
    return dict(question.key("fixed") or {})


def setting_of(question: Question, *also: Formula) -> Setting:
    """What the claim is about; `also` are formulas of it besides `equals`.

    **Raises** `InputError` where the coordinate doesn't separate from the others, or time occurs."""
    space, H = question.space, question.hamiltonian()
    q = question.key("coordinate")
    if q not in space.q:
        raise InputError(f"a coordinate is expected: one of {', '.join(map(str, space.q))}", "key 'coordinate'")
    p = space.p[space.q.index(q)]
    fixed = _fixed(question)
    rules: Any = {name: formula.expr for name, formula in fixed.items()}
    for name in (q, p, space.t):
        if name in rules:
            raise InputError(f"{name} moves: it can't be fixed", "key 'fixed'")
    named = question.key("energy")
    is_free_of(H, [named], "H", "key 'energy'")
    for name, formula in fixed.items():
        if question.claim.kind == "frequency" and name != named and named in formula.symbols:
            raise InputError(
                f"{name} is held fixed while a frequency differentiates by {named}, so it can't be given by {named}: "
                "write a constant of its own for it",
                "key 'fixed'",
            )
    period, well = (question.key(word) for word in ("period", "well"))
    if question.claim.kind == "frequency" and period is not None and named in period.symbols:
        raise InputError(f"a frequency differentiates by {named}, and a period doesn't change with it", "key 'period'")
    moved: Any = replaced(H.expr, rules)
    timed = H.symbols & {space.t}
    for symbol in sorted((moved.free_symbols | timed) & ({*space.q, space.t} - {q}), key=str):
        raise InputError(
            f"H depends on {symbol}, so that {q} alone has no action: separate the variables first, or fix {symbol}",
            "key 'coordinate'",
        )
    unreal = any(not symbol.is_real for symbol in moved.free_symbols)
    if unreal or (moved.has(sp.I) and sp.expand(moved).has(sp.I)):
        raise InputError(f"H is complex: {_what(question)} is one of a real Hamiltonian", "[hamiltonian]")
    energy, level = question.key("energy"), None
    if question.claim.kind in ("frequency", "average"):
        level = rules.get(energy)
    else:
        energy = rules.get(energy, energy)
    equals = question.key("equals")
    if equals is None:
        raise InputError(f"a claim of kind {question.claim.kind!r} needs the key 'equals'")
    for symbol in sorted(equals.symbols & {q, p, space.t, *space.new}, key=str):
        raise InputError(f"{_what(question)} is a function of energy and constants, not of {symbol}", "key 'equals'")
    written = (H, equals, *also, *(given for given in (period, well) if given is not None))
    used = {named, *space.old, *(symbol for formula in written for symbol in formula.symbols)}
    for name in sorted({*fixed} - used, key=str):
        raise InputError(f"{name} is held fixed, but nothing here depends on it", "key 'fixed'")
    others = {*space.new}
    asked = question.subject.domain
    if asked.surface:
        raise InputError(f"{_what(question)} is one on the whole phase space, not on a surface")
    conditions = [c for c in asked.conditions if not any(term.free_symbols & others for term in c.terms)]
    for formula in written:
        conditions += formula.conditions
    held = [c for name, formula in fixed.items() for c in (*formula.conditions, *_as_assumed(name, formula))]
    stated = (*assumed(q, sign=False), *assumed(p, sign=True))  # the sign of q is an end of its range
    here = unique((c.substitute(rules) for c in conditions), held, stated)
    if question.key("branch") == "rotation":  # has p > 0 by convention
        here = tuple(c for c in here if c.kind not in ("positive", "nonzero") or c.terms[0] != p)
    others_too = tuple(replaced(formula.expr, rules) for formula in also)
    try:
        motion, solved = within(question.budget.share(0.5), lambda: one_degree(moved, q, p, energy, here)), None
    except NotQuadratic:
        solved = solved_momentum(moved, q, p, energy, here)
        motion = solved.motion
    length, inside = (None if given is None else replaced(given.expr, rules) for given in (period, well))
    value = replaced(equals.expr, rules)
    return Setting(q, p, moved, energy, value, here, motion, level, solved, others_too, length, inside)


def _as_assumed(name: sp.Symbol, formula: Formula) -> Iterator[Condition]:
    """What is assumed of a name must hold of the value at which it is fixed: formulas are simplified by it.

    **Raises:** `InputError` where it doesn't, or isn't seen to be an integer, or real, as the name is.
    """
    value, said = sp.expand(formula.expr), declared(name)
    for word in ("integer", "real"):
        real = word == "real" and not value.has(sp.I) and all(symbol.is_real for symbol in value.free_symbols)
        if said.get(word) and not (real or getattr(value, f"is_{word}")):  # it is real wherever it has a value
            raise InputError(f"{name} is assumed to be {word}, and {formula} is not seen to be", "key 'fixed'")
    for condition in assumed_of(name, formula.expr):
        if condition.terms[0].is_nonpositive if condition.kind == "positive" else condition.terms[0].is_zero:
            raise InputError(f"{name} can't be fixed at {formula}: its assumptions exclude it", "key 'fixed'")
        yield condition


def _what(question: Question) -> str:
    return "an average over an orbit" if question.claim.kind == "average" else "an action"


def branch_of(question: Question, setting: Setting) -> str:
    """**Raises** `InputError` for a branch that isn't there, and where there are two and none is named."""
    branch = question.key("branch")
    if branch not in (None, "libration", "rotation"):
        raise InputError(f"a branch is 'libration' or 'rotation', not {branch!r}", "key 'branch'")
    if branch is None and cosine(setting.motion.square, setting.q) is not None:
        raise InputError("H is periodic in the coordinate: say whether the branch is 'libration' or 'rotation'")
    if branch is None and not setting.motion.square.has(setting.q):
        raise InputError(f"H doesn't depend on {setting.q}: there is a rotation only, with a 'period'", "key 'branch'")
    if branch == "rotation":
        none_idle(question, "a libration", "well")
    return branch or "libration"


def _check_period(question: Question, setting: Setting) -> None:
    """**Raises** `InputError` where the stated period is none of H."""
    stated = setting.period
    if stated is None:
        return
    moved: Any = replaced(setting.H, {setting.q: setting.q + stated})
    region = question.region(domain=Domain(setting.conditions), chart=chart_of(question.tape, question.space, None))
    if question.decide([Residual("H after a period", question.load(moved - setting.H))], region).status == "refuted":
        raise InputError(f"{stated} is not a period of H in {setting.q}", "key 'period'")


def _closed_forms(question: Question, setting: Setting, branch: str) -> Iterator[ClosedAction]:
    motion = setting.motion
    if is_steep(motion.square):  # no standard integral has powers as high as that, and they would be multiplied out
        return
    if branch == "rotation":
        yield from rotation(motion, setting.period)
        return
    if setting.period is not None:
        raise InputError("a period is one of a rotation's coordinate", "key 'period'")
    inside, region = setting.well, constants_region(question, setting)

    def positive(expression: Any) -> bool:
        return is_positive(question, region, expression)

    if setting.level is not None and setting.level.free_symbols:  # roots may be given, and the energy by them
        level = replace(motion, square=setting.at_level(motion.square))
        rate = setting.at_level(motion.square.diff(setting.energy))
        yield from elliptic(level, integrands(level), positive, inside, rate)
    yield from librations(motion, positive, inside)


KINDS = {"action": action, "frequency": frequency}
