"""Where an action's claim is made: the constants for which the motion exists, and the range that its orbit covers."""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.chart import chart_of
from canon.decide.implied import follows
from canon.decide.intervals import intervals_of
from canon.decide.region import Region, Requirement
from canon.decide.search import samples
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Unsupported
from canon.domain import Condition, Domain, nonzero
from canon.errors import InputError
from canon.mechanics.action_angle import NOT_NEGATIVE, ClosedAction, OneDegree, at_most, linear_edge
from canon.mechanics.solved_momentum import SolvedMomentum
from canon.sign import known_sign
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question

MOST_GIVEN, LONGEST_SUM = 8, 3


@dataclass(frozen=True)
class Setting:
    """What an action's claim is about.

    **Arguments:** the coordinate and its momentum; `H`, with what is fixed put in; `energy`; `equals`, likewise;
    `conditions`, all of the domain; `motion`, the orbits H = energy; `level`, the value that an energy with a name has
    in the end, where that is fixed (a frequency is a derivative by it); `solved`, how the square was found where H
    isn't quadratic in p; `also`, other formulas that the claim is about; `period` of a rotation's coordinate, and
    `well`, a point inside, where they are given.
    """

    q: sp.Symbol
    p: sp.Symbol
    H: Any
    energy: Any
    equals: Any
    conditions: tuple[Condition, ...]
    motion: OneDegree
    level: Any = None
    solved: SolvedMomentum | None = None
    also: tuple[Any, ...] = ()
    period: Any = None
    well: Any = None

    def at_level(self, expression: Any) -> Any:
        """A formula in the energy at the value that is fixed, if there is one."""
        return expression if self.level is None else replaced(expression, {self.energy: self.level})


def assumed(name: sp.Symbol, *, sign: bool) -> tuple[Condition, ...]:
    """What is assumed of a variable, as conditions: that it isn't 0, or with `sign`, on which side of 0 it is."""
    if name.is_extended_nonnegative or name.is_extended_nonpositive:
        return (Condition("positive", (name if name.is_extended_nonnegative else -name,)),) if sign else ()
    return (Condition("nonzero", (name,)),) if name.is_nonzero else ()


def constants_region(question: Question, setting: Setting) -> Region:
    """The constants, in the domain."""
    tape = question.tape
    variables = {setting.q, setting.p}
    kept = tuple(c for c in setting.conditions if not any(term.free_symbols & variables for term in c.terms))
    square = setting.at_level(setting.motion.square)
    given = (e for e in (setting.period, setting.well) if e is not None)
    named = set().union(square.free_symbols, setting.equals.free_symbols, *(e.free_symbols for e in given))
    named |= {name for condition in kept for term in condition.terms for name in term.free_symbols}
    images = {tape.symbol(x): tape.zero for x in question.space.old if x in variables or x not in named}
    plain = chart_of(tape, question.space, None)
    return question.region(domain=Domain(kept), images=images, chart=plain, assumed=False, regular=False)


def existing(question: Question, setting: Setting, closed: ClosedAction) -> Region:
    """The constants for which such a motion exists, in the domain."""
    tape, region = question.tape, constants_region(question, setting)
    square = setting.at_level(setting.motion.square)
    wanted = [(e, "such a motion exists") for e in closed.exists if known_sign(e) != "positive"]
    if setting.well is not None:
        inside: Any = replaced(square, {setting.q: setting.well})
        wanted.append((inside, f"{setting.well} lies inside"))
        ends = (setting.well - setting.motion.low, setting.motion.high - setting.well)
        wanted += [(e, f"{setting.well} is in the domain") for e in ends if not e.is_infinite and not e.is_positive]
    if setting.period is not None and known_sign(setting.period) != "positive":
        wanted.append((setting.period, "a period is above 0"))
    return region.also(*(Requirement("positive", (tape.load(e),), f"{e} > 0 ({why})") for e, why in wanted))


def is_positive(question: Question, region: Region, expression: Any) -> bool:
    """Whether an expression in the constants is positive throughout their region."""
    known = known_sign(expression)
    if known is not None and known not in ("real", "nonzero"):
        return known == "positive"
    plain: Any = sp.factor(expression)
    requirement = Requirement("positive", (question.tape.load(plain),), plain)
    if follows(question.tape, requirement, region, question.budget):
        return True
    given = [r.said.terms[0] for r in region.requirements if r.kind == "positive" and isinstance(r.said, Condition)]
    return _is_sum(sp.expand(expression), given[:MOST_GIVEN], LONGEST_SUM)


def _is_sum(rest: Any, given: list[Any], most: int) -> bool:
    """Whether something linear is a sum of conditions, as b of b − a > 0 and a > 0, and of what isn't negative."""
    names = sorted(rest.free_symbols, key=str)
    if not names or not rest.is_polynomial(*names) or sp.Poly(rest, *names).total_degree() > 1:
        return False
    for condition in (c for c in given if most and c.free_symbols & set(names)):
        left = sp.expand(rest - condition)
        if len(left.free_symbols) <= len(rest.free_symbols) and (
            known_sign(left) in NOT_NEGATIVE or _is_sum(left, given, most - 1)
        ):
            return True
    return False


def oriented(
    question: Question, setting: Setting, closed: ClosedAction, region: Region, branch: str
) -> ClosedAction | None:
    """The action with the motion's own sense: dq/dt has the sign of ∂H/∂p, so that ∮ p dq < 0 for a negative mass."""
    if branch == "rotation":
        return closed  # p > 0 by convention
    leading = setting.motion.leading
    sign = sign_in_range(question, setting.motion, leading, along(question, setting, region))
    if sign not in ("positive", "negative"):
        return None
    if sign == "positive":
        return closed
    return replace(closed, value=-closed.value, period=None if closed.period is None else -closed.period)


def only_one_forward(question: Question, setting: Setting, region: Region) -> bool:
    """Whether of a rotation's two branches one alone has p > 0. **Raises** `InputError` where both have somewhere."""
    tape, motion = question.tape, setting.motion
    if known_sign(motion.mean) in ("zero", "negative", "nonpositive"):
        return True
    square, mean = setting.at_level(motion.square), setting.at_level(motion.mean)
    apart = Requirement("positive", (tape.load(square - mean**2),), "one branch has p < 0")
    if follows(tape, apart, region, question.budget):
        return True
    lower = tape.load(mean - sp.sqrt(square))
    both = region.also(Requirement("positive", (lower,), "both branches have p > 0"))
    for sample in samples(
        tape, [lower], both, random.Random(question.seed), count=1, budget=question.budget, nice=True
    ):
        where = ", ".join(f"{tape.symbol_at(n)} = {v}" for n, v in sorted(sample.point.items())) or "this energy"
        raise InputError(
            f"both branches of the rotation have p > 0 at {where}: restrict the domain to energies at which one has, "
            f"{sp.sstr(square)} > {sp.sstr(mean**2)}",
            "key 'branch'",
        )
    return False


def along(question: Question, setting: Setting, region: Region) -> Region:
    """The coordinate's range beside the constants: where the integrand is compared."""
    tape, motion = question.tape, setting.motion
    q = motion.q
    edges = [q - motion.low] if motion.low != sp.S.NegativeInfinity else []
    edges += [motion.high - q] if motion.high != sp.S.Infinity else []
    wanted = [Requirement("positive", (tape.load(e),), f"{e} > 0") for e in edges]
    return replace(region.also(*wanted), symbols=(*region.symbols, tape.symbol(q)))


def not_implied(question: Question, setting: Setting, region: Region, closed: ClosedAction) -> list[Condition]:
    """Conditions on the coordinate or momentum that the coordinate's range doesn't imply; that the coefficient of p²
    isn't 0 in it is one of them."""
    motion = setting.motion
    whole = along(question, setting, region)
    leading = nonzero(motion.leading) if motion.leading.has(setting.q) else ()
    found = []
    kink = (setting.q, sp.Abs(setting.q)) if closed.passes_zero else ()
    passed = [c for c in setting.conditions if not (c.kink and c.terms[0].as_base_exp()[0] in kink)]
    for condition in (*passed, *leading):
        names = set().union(*(term.free_symbols for term in condition.terms))
        term = condition.terms[0]
        if not names & {setting.q, setting.p}:
            continue
        edge = None if setting.p in names else linear_edge(setting.q, condition)
        if edge is not None and (at_most(edge[0], motion.low) if edge[1] else at_most(motion.high, edge[0])):
            continue
        sign = None
        if setting.p not in names and condition.kind in ("positive", "nonzero", "slit"):
            sign = sign_in_range(question, motion, term, whole)
        if sign != "positive" and not (condition.kind == "nonzero" and sign == "negative"):
            found.append(condition)
    return found


def sign_in_range(question: Question, motion: OneDegree, term: Any, whole: Region) -> str | None:
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
