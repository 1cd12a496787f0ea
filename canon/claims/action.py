"""Actions J = ∮ p dq and frequencies dE/dJ of one degree of freedom, proved by standard integrals.

The closed form is found in `canon.mechanics`; what it rests on is decided here: that p² is what the standard integral
has under its root, that such a motion exists wherever the claim is made, and that the claimed formula equals it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.chart import chart_of
from canon.claims.outcome import Outcome, Residual, combined
from canon.decide.intervals import intervals_of
from canon.decide.region import Region, Requirement
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Unsupported
from canon.domain import Condition, Domain, nonzero
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.action_angle import ClosedAction, NotQuadratic, OneDegree, at_most, linear_edge, one_degree
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.residues import by_residues
from canon.mechanics.standard_actions import cosine, pendulum_like, power_well, rotation
from canon.sign import known_sign

if TYPE_CHECKING:
    from canon.claims.question import Question


@dataclass(frozen=True)
class Setting:
    """What an action's claim is about.

    **Arguments:** the coordinate and its momentum; `H`, with what is fixed put in; `energy`; `equals`, likewise;
    `conditions`, all of the domain; `motion`, the orbits H = energy.
    """

    q: sp.Symbol
    p: sp.Symbol
    H: Any
    energy: Any
    equals: Any
    conditions: tuple[Condition, ...]
    motion: OneDegree


def action(question: Question) -> Outcome:
    """`action`: ∮ p d(coordinate) over one period at the energy is `equals`."""
    return _decided(question, lambda setting, closed: ("J", setting.equals - closed.value))


def frequency(question: Question) -> Outcome:
    """`frequency`: dE/dJ is `equals`, in cycles in unit time."""
    symbol = question.key("energy")
    if symbol in _fixed(question):
        raise InputError("a frequency is dE/dJ: it needs the energy as a name", "key 'fixed'")
    return _decided(question, lambda setting, closed: ("dE/dJ", setting.equals * closed.value.diff(setting.energy) - 1))


Statement = Callable[[Setting, ClosedAction], tuple[str, Any]]


def _decided(question: Question, statement: Statement) -> Outcome:
    try:
        setting = _setting(question)
    except NotQuadratic as reason:
        return Outcome("undecided", note=str(reason))
    branch = _branch(question, setting)
    reasons: list[str] = []
    for unsigned in _closed_forms(question, setting, branch):
        region = _region(question, setting, unsigned)
        closed = _oriented(question, setting, unsigned, region, branch)
        if closed is None:
            reasons.append(f"the sign of {setting.motion.leading}, with which the orbit is run through, isn't known")
            continue
        gaps = _not_implied(question, setting, region, closed)
        if gaps:
            reasons.append(f"the orbit may leave the domain: {gaps[0]}")
            continue
        checks = [Residual(name, question.load(expression)) for name, expression in closed.vanishes]
        grounds = [question.decide(checks, _along(question, setting, region))] if checks else []
        if any(ground.status != "proved" for ground in grounds) and question.method != "numeric":
            reasons.append(f"{closed.method}: not verified")
            continue
        label, residual = statement(setting, closed)
        outcome = question.decide([Residual(label, question.load(residual))], region)
        slope = closed.value.diff(setting.energy) if label != "J" else None
        value = question.load(closed.value if slope is None else 1 / slope)
        outcome = outcome.with_detail(value=question.show(value), by=closed.method)
        return outcome if outcome.status == "refuted" else combined([*grounds, outcome])
    from canon.claims.action_evidence import by_quadrature

    sampled = by_quadrature(question, setting, branch, wants_frequency=question.claim.kind == "frequency")
    return sampled.with_status(sampled.status, "; ".join(dict.fromkeys(reasons))) if reasons else sampled


# -- what is claimed ----------------------------------------------------------------------------------


def _fixed(question: Question) -> dict[sp.Symbol, Formula]:
    return dict(question.key("fixed") or {})


def _setting(question: Question) -> Setting:
    """**Raises** `InputError` where the coordinate doesn't separate from the others, or time occurs."""
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
    moved: Any = H.expr.xreplace(rules)
    for symbol in sorted(moved.free_symbols & ({*space.q, space.t} - {q}), key=str):
        raise InputError(
            f"H depends on {symbol}, so that {q} alone has no action: separate the variables first, or fix {symbol}",
            "key 'coordinate'",
        )
    energy = question.key("energy")
    level: Any = rules.get(energy, energy)
    equals = question.key("equals")
    if equals is None:
        raise InputError(f"a claim of kind {question.claim.kind!r} needs the key 'equals'")
    for symbol in sorted(equals.expr.free_symbols & {q, p, space.t, *space.new}, key=str):
        raise InputError(f"an action is a function of energy and constants, not of {symbol}", "key 'equals'")
    others = {*space.new}
    asked = question.subject.domain
    if asked.surface:
        raise InputError("an action is one on the whole phase space, not on a surface")
    conditions = [c for c in asked.conditions if not any(term.free_symbols & others for term in c.terms)]
    for formula in (H, equals, *fixed.values()):
        conditions += formula.conditions
    here = tuple(dict.fromkeys(c.substitute(rules) for c in conditions))
    motion = one_degree(moved, q, p, level, here)
    return Setting(q, p, moved, level, equals.expr.xreplace(rules), here, motion)


def _branch(question: Question, setting: Setting) -> str:
    """**Raises** `InputError` for a branch that isn't there, and where there are two and none is named."""
    branch = question.key("branch")
    if branch not in (None, "libration", "rotation"):
        raise InputError(f"a branch is 'libration' or 'rotation', not {branch!r}", "key 'branch'")
    if branch is None and cosine(setting.motion.square, setting.q) is not None:
        raise InputError("H is periodic in the coordinate: say whether the branch is 'libration' or 'rotation'")
    if branch is None and not setting.motion.square.has(setting.q):
        raise InputError(f"H doesn't depend on {setting.q}: there is a rotation only, with a 'period'", "key 'branch'")
    return branch or "libration"


def _closed_forms(question: Question, setting: Setting, branch: str) -> Iterator[ClosedAction]:
    motion = setting.motion
    period = question.key("period")
    if branch == "rotation":
        yield from rotation(motion, None if period is None else period.expr)
        return
    if period is not None:
        raise InputError("a period is one of a rotation's coordinate", "key 'period'")
    yield from by_residues(motion)
    yield from pendulum_like(motion)
    yield from power_well(motion)
    yield from quartic_wells(motion)


# -- where it is claimed ------------------------------------------------------------------------------


def _region(question: Question, setting: Setting, closed: ClosedAction) -> Region:
    """The constants for which such a motion exists, in the domain."""
    tape = question.tape
    variables = {setting.q, setting.p}
    kept = tuple(c for c in setting.conditions if not any(term.free_symbols & variables for term in c.terms))
    named = set().union(setting.motion.square.free_symbols, setting.equals.free_symbols)
    named |= {name for condition in kept for term in condition.terms for name in term.free_symbols}
    images = {tape.symbol(x): tape.zero for x in question.space.old if x in variables or x not in named}
    plain = chart_of(tape, question.space, None)
    region = question.region(domain=Domain(kept), images=images, chart=plain, assumed=False, regular=False)
    wanted = [(e, "such a motion exists") for e in closed.exists if known_sign(e) != "positive"]
    well = question.key("well")
    if well is not None:
        inside: Any = setting.motion.square.xreplace({setting.q: well.expr})
        wanted.append((inside, f"{well} lies inside"))
    return region.also(*(Requirement("positive", (tape.load(e),), f"{e} > 0 ({why})") for e, why in wanted))


def _oriented(
    question: Question, setting: Setting, closed: ClosedAction, region: Region, branch: str
) -> ClosedAction | None:
    """The action with the motion's own sense: dq/dt has the sign of ∂H/∂p, so that ∮ p dq < 0 for a negative mass."""
    if branch == "rotation":
        return closed  # p > 0 by convention
    leading = setting.motion.leading
    sign = _sign_in_range(question, setting.motion, leading, _along(question, setting, region))
    if sign not in ("positive", "negative"):
        return None
    return closed if sign == "positive" else replace(closed, value=-closed.value)


def _along(question: Question, setting: Setting, region: Region) -> Region:
    """The coordinate's range beside the constants: where the integrand is compared."""
    tape, motion = question.tape, setting.motion
    q = motion.q
    edges = [q - motion.low] if motion.low != sp.S.NegativeInfinity else []
    edges += [motion.high - q] if motion.high != sp.S.Infinity else []
    wanted = [Requirement("positive", (tape.load(e),), f"{e} > 0") for e in edges]
    return replace(region.also(*wanted), symbols=(*region.symbols, tape.symbol(q)))


def _not_implied(question: Question, setting: Setting, region: Region, closed: ClosedAction) -> list[Condition]:
    """Conditions on the coordinate or momentum that the coordinate's range doesn't imply; that the coefficient of p²
    isn't 0 in it is one of them."""
    motion = setting.motion
    whole = _along(question, setting, region)
    leading = nonzero(motion.leading) if motion.leading.has(setting.q) else ()
    found = []
    passes = closed.passes_zero and question.hamiltonian().expr.has(sp.Abs)
    kink = (setting.q, sp.Abs(setting.q)) if passes else ()
    passed = [c for c in setting.conditions if c.terms[0] not in kink]
    for condition in (*passed, *leading):
        names = set().union(*(term.free_symbols for term in condition.terms))
        term = condition.terms[0]
        if not names & {setting.q, setting.p}:
            continue
        edge = linear_edge(setting.q, condition)
        if edge is not None and (at_most(edge[0], motion.low) if edge[1] else at_most(motion.high, edge[0])):
            continue
        sign = None
        if setting.p not in names and condition.kind in ("positive", "nonzero", "slit"):
            sign = _sign_in_range(question, motion, term, whole)
        if sign != "positive" and not (condition.kind == "nonzero" and sign == "negative"):
            found.append(condition)
    return found


def _sign_in_range(question: Question, motion: OneDegree, term: Any, whole: Region) -> str | None:
    """The sign of a function of the coordinate throughout its range, where it shows."""
    known = known_sign(term)
    if known in ("positive", "negative"):
        return known
    base = term.base if isinstance(term, sp.Pow) else term
    if isinstance(base, (sp.sin, sp.cos)):
        rate = sp.expand(base.args[0]).diff(motion.q)
        if known_sign(rate) == "positive" and sp.expand(base.args[0] - rate * motion.q) == 0:
            quarter = sp.pi / 2 / rate
            ends = (sp.S.Zero, 2 * quarter) if isinstance(base, sp.sin) else (-quarter, quarter)
            if motion.spans(*ends):
                return "positive"
    tape = question.tape
    try:
        sign = definite_sign(tape, tape.load(term), intervals_of(tape, whole), question.budget)
    except Unsupported:
        return None
    return {"pos": "positive", "neg": "negative"}.get(sign or "")


KINDS = {"action": action, "frequency": frequency}
