"""Averages over time: of a constant of the motion plus a rate of something bounded, or along a motion that is given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.along_a_range import Range, Unproved, holds, is_positive, range_of
from canon.claims.average_orbit import over_orbits
from canon.claims.eternal import goes_on_for_ever, leaves_by, some_motion_lasts
from canon.claims.idle_keys import none_idle
from canon.claims.integral import integral_is
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import with_value
from canon.decide.derivative import derivative, poisson_bracket
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.formulas import as_formula, replaced

if TYPE_CHECKING:
    from canon.claims.question import Question

OWN = {
    "virial": ("bound",),
    "motion": ("parameter", "from", "to", "antiderivative"),
    "coordinate": ("energy", "branch", "well", "fixed"),
}
"""The keys of each of the ways in which an average is stated."""

RATE = "the long-time average of the rate of something bounded is 0"


def average(question: Question) -> Outcome:
    """`average`: the average of f over time is `equals`.

    With `virial` G and `bound` B, along every motion of H that stays in the domain, for ever: f − {G, H} − ∂G/∂t is a
    constant of the motion, and |G| ≤ B, a constant too, so that it is the average (Clausius' virial theorem; Goldstein
    § 3.4). With `motion`, formulas for coordinates, momenta and time in a `parameter`, over the stretch `from`, `to` of
    it: ∫ f dt = `equals` ∫ dt. With a `coordinate` and the name `energy`, over one period of its libration at that
    energy, enclosed at some choices of the constants.
    """
    ways = {"virial": _virial, "motion": _along, "coordinate": _over_orbits}
    given = [word for word in ways if question.key(word) is not None]
    if len(given) != 1:
        raise InputError(
            "give either 'virial' with its 'bound', or a 'motion' in a 'parameter', 'from' and 'to', or a 'coordinate' "
            "with the name of its 'energy'"
        )
    for way, words in OWN.items():
        if way != given[0]:
            none_idle(question, repr(way), *words)
    return ways[given[0]](question)


def _needed(question: Question, *words: str) -> None:
    for word in words:
        if question.key(word) is None:
            raise InputError(f"the key {word!r} is missing")


def _over_orbits(question: Question) -> Outcome:
    _needed(question, "energy")
    question.hamiltonian()
    return over_orbits(question)


def _virial(question: Question) -> Outcome:
    _needed(question, "bound")
    tape, space = question.tape, question.space
    formulas = [question.formula(word) for word in ("f", "virial", "bound", "equals")]
    region = question.region(*formulas)
    if question.chart.images:
        raise InputError("an average is one along motions in the old variables: the file has a map", "key 'kind'")
    f, G, bound, claimed = (question.load(formula) for formula in formulas)
    H = question.load(question.hamiltonian())
    q, p, t = question.nodes(space.q), question.nodes(space.p), tape.symbol(space.t)

    def rate(node: Node) -> Node:
        return tape.plus(poisson_bracket(tape, node, H, q, p), derivative(tape, node, t))

    mean = tape.minus(f, rate(G))
    constant = question.decide([Residual("rate of f - dG/dt", rate(mean), mean)], region)
    steady = question.decide([Residual("rate of the bound", rate(bound))], region)
    if constant.status == "refuted":
        raise InputError(f"f - d({formulas[1]})/dt is {question.show(mean)}: no constant of the motion", "key 'virial'")
    if steady.status == "refuted":
        raise InputError(f"{formulas[2]} is no constant of the motion", "key 'bound'")
    outcome = with_value(question, question.decide([Residual("average", tape.minus(mean, claimed), mean)], region))
    outcome = outcome.with_detail(average=question.show(mean))
    if question.method == "numeric" and outcome.status != "refuted":
        return combined([constant, steady, outcome])
    sides = [tape.minus(bound, G), tape.plus(bound, G)]
    held = all(is_positive(question, node, region, strict=False) for node in sides)
    if not held:
        return outcome.with_status("undecided", f"it isn't shown that |{formulas[1]}| <= {formulas[2]}")
    if outcome.status == "refuted":
        known = replace(question, method="symbolic")  # a refutation rests on what is shown, and not on samples
        rates = [Residual("rate of f - dG/dt", rate(mean)), Residual("rate of the bound", rate(bound))]
        shown = constant.status == steady.status == "proved"
        if not shown and known.decide(rates, region).status != "proved":
            note = f"it isn't shown that f - d({formulas[1]})/dt and {formulas[2]} are constants of the motion"
            return outcome.with_status("undecided", note)
        if not goes_on_for_ever(known, H, region):
            note = "it isn't shown that motions stay in the domain for ever, and the claim is about those that do"
            return outcome.with_status("undecided", note)
    parts = combined([constant, steady, outcome])
    wall = leaves_by(question, H, region) if parts.status == "proved" else None
    if wall is not None:
        return parts.with_status("undecided", f"motions may all leave {wall.text}: the claim is about those that stay")
    if parts.status == "proved" and not some_motion_lasts(question, H, region):
        return parts.with_status("undecided", "it isn't shown that any motion goes on for ever, as the claim's do")
    steps = (*parts.arguments, {"theorem": RATE, "G": str(formulas[1]), "bound": str(formulas[2])})
    return replace(parts, arguments=steps if parts.status == "proved" else parts.arguments)


def _along(question: Question) -> Outcome:
    _needed(question, "parameter", "from", "to")
    motion: Mapping[sp.Symbol, Formula] = question.key("motion")
    space, u = question.space, question.key("parameter")
    f, claimed = question.formula("f"), question.formula("equals")
    moving = {*space.old, space.t}
    ends = [question.key(word) for word in ("from", "to")]
    given = [("to", end) for end in ends if isinstance(end, Formula)]
    if u in claimed.symbols:
        raise InputError(f"{u} runs through the stretch: its average doesn't depend on it", "key 'equals'")
    for word, formula in (("equals", claimed), *given, *(("motion", m) for m in motion.values())):
        for symbol in sorted(formula.symbols & (moving - {u}), key=str):
            raise InputError(f"{symbol} moves: write it as a formula of {u}", f"key {word!r}")
    missing = [str(s) for s in f.symbols & moving if s not in motion and s != u]
    if missing:
        raise InputError(f"the motion of {', '.join(sorted(missing))} is missing", "key 'motion'")
    for symbol in motion:
        if symbol not in moving:
            raise InputError(f"{symbol} doesn't move", "key 'motion'")
    if u != space.t and space.t not in motion:
        raise InputError(f"time as a formula of {u} is missing: {space.t} = ...", "key 'motion'")
    try:
        span = range_of(question, u, question.key("from"), question.key("to"), (claimed, *motion.values()))
    except Unproved as reason:
        return Outcome("undecided", note=str(reason))
    clock: Any = motion[space.t].expr if u != space.t else u
    growth = question.load(sp.diff(clock, u))
    if not holds(question, Requirement("positive", (growth,), ""), span.inside, span):
        return Outcome("undecided", note=f"it isn't shown that {space.t} grows with {u} all along the stretch")
    beyond = _beyond(question, f, motion, u, span)
    if beyond is not None:
        return Outcome("undecided", note=f"it isn't shown that {beyond.text} all along the motion")
    solved = _solves(question, motion, u, span.inside)
    images = {s: m.expr for s, m in motion.items()}
    integrand = as_formula(replaced(f.expr, images) * sp.diff(clock, u))
    if any(isinstance(end, str) for end in ends):
        raise InputError("an average is one over a bounded stretch", "key 'to'")
    stretch = replaced(clock, {u: ends[1].expr}) - replaced(clock, {u: ends[0].expr})
    total = question.tape.times(question.load(claimed), question.load(stretch))
    outcome = integral_is(question, span, integrand, question.load(integrand), total, question.key("antiderivative"))
    if solved is None:
        return outcome
    if outcome.status == "refuted" and solved.status != "proved":
        solved = _solves(replace(question, method="symbolic"), motion, u, span.inside)
        if solved is None or solved.status != "proved":
            return outcome.with_status("undecided", "it isn't shown that the motion solves Hamilton's equations")
    return combined([solved, outcome])


def _beyond(
    question: Question, f: Formula, motion: Mapping[sp.Symbol, Formula], u: sp.Symbol, span: Range
) -> Requirement | None:
    """What the file demands of the variables, or assumes of them, and isn't shown to hold along the motion."""
    tape, space = question.tape, question.space
    images = {tape.symbol(x): question.load(formula) for x, formula in motion.items()}
    left = {tape.symbol(x) for x in space.old if x not in motion}
    formulas = (f,) if question.subject.hamiltonian is None else (f, question.hamiltonian())
    known = {(r.kind, r.nodes) for r in span.inside.requirements}
    for r in question.region(*formulas, images=images).requirements:
        if (r.kind, r.nodes) in known:
            continue
        named = {name for n in r.nodes for name in tape.support(n)}
        if left & named:  # whatever the others do, of which the claim says nothing, but for what relates them to these
            if tape.symbol(u) in named:
                return r
            continue
        if not holds(question, r, span.inside, span):
            return r
    return None


def _solves(question: Question, motion: Mapping[sp.Symbol, Formula], u: sp.Symbol, region: Region) -> Outcome | None:
    """Whether the motion solves Hamilton's equations, where the file has H and the motion all variables."""
    space = question.space
    if question.subject.hamiltonian is None:
        return None
    missing = [s.name for s in space.old if s not in motion]
    if missing:
        raise InputError(f"the motion of {', '.join(missing)} is missing: H is given", "key 'motion'")
    H: Any = question.hamiltonian().expr
    images = {s: m.expr for s, m in motion.items()}
    clock = motion[space.t].expr if u != space.t else u
    residuals = []
    for x, other, sign in (*((a, b, 1) for a, b in zip(space.q, space.p, strict=True)),
                           *((b, a, -1) for a, b in zip(space.q, space.p, strict=True))):  # fmt: skip
        slope = replaced(sp.diff(H, other), images)
        rest = sp.diff(motion[x].expr, u) - sign * slope * sp.diff(clock, u)
        residuals.append(Residual(f"motion of {x}", question.load(rest)))
    found = question.decide(residuals, region)
    if found.status == "refuted":
        raise InputError(f"the motion doesn't solve Hamilton's equations: {found.detail.get('fails')}", "key 'motion'")
    return found


KINDS = {"average": average}
