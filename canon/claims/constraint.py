"""Constraints: holonomic or not, stationary or not, displacements that they allow, multipliers and reactions.

A constraint on coordinates and velocities is a differential form a·dq + b dt, written a·v + b. Several of them are
integrable where each dω is a combination of theirs: dω ∧ ω₁ ∧ … ∧ ω_m = 0 (Frobenius; Arnold, Mathematical Methods of
Classical Mechanics, app. 4; Goldstein, §1.3 and 2.4).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

from canon.claims.allowed import are_some, at_velocities
from canon.claims.chart import chart_of
from canon.claims.determinant import determinant
from canon.claims.determined import determined
from canon.claims.idle_keys import none_idle
from canon.claims.independence import full_rank
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import with_value
from canon.claims.velocities import Motion, motion, region_in_velocities
from canon.decide.derivative import derivative, substitute
from canon.decide.region import Requirement
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

Form = tuple[Node, ...]
"""The coefficients of dq₁, …, dq_n and of dt."""

ASKED = ("holonomic", "stationary", "integrals", "possible", "virtual", "multipliers", "determined")
NEED = ("L", "qddot")


def constraint(question: Question) -> Outcome:
    """`constraint`: what is asked of `forms`, expressions a·v + b that vanish, or of `functions` of q and t.

    `holonomic`: integrable almost everywhere (Frobenius), or nowhere on an open set; `stationary`: no term without
    velocities, and no time; `integrals`: functions whose differentials the forms combine; `possible`: velocities that
    the forms allow; `virtual`: displacements, the same with time held fixed; `multipliers` λ, with `L` and the
    accelerations `qddot`: d/dt ∂L/∂v − ∂L/∂q = Σ λ a, and the forms' rates vanish where the forms do. `determined`,
    with `L`: these equations have one solution for accelerations and multipliers at every state, or at none.
    """
    if not any(question.key(word) is not None for word in ASKED):
        raise InputError(f"nothing is claimed of the constraints: add one of {', '.join(ASKED)}")
    written = [word for word in ("forms", "functions") if question.key(word) is not None]
    if len(written) != 1:
        raise InputError("give either 'forms', linear in the velocities, or 'functions' of the coordinates and time")
    if question.key("multipliers") is None:
        none_idle(question, "'multipliers'", "qddot", "forces", *(["L"] if question.key("determined") is None else []))
    given = question.formulas(written[0])
    jets = motion(question)
    region = region_in_velocities(question, *given, *_others(question))
    lines, there = [question.load(formula) for formula in given], region
    if written == ["functions"]:
        there = replace(region, surface=(*region.surface, *lines))
        for formula in given:
            if _moves(question, jets, formula):
                raise InputError(f"{formula} contains velocities: write it under 'forms'", "key 'functions'")
        lines = [jets.rate(node) for node in lines]
    forms = [_coefficients(question, jets, node, region) for node in lines]
    rank = _independent(question, jets, forms, region)
    loose = question.key("determined") is False and sum(question.key(word) is not None for word in ASKED) == 1
    if rank.status == "refuted" and not loose:
        raise InputError(_dependence(rank), f"key {written[0]!r}")
    if written == ["functions"] and not loose and _independent(question, jets, forms, there).status == "refuted":
        raise InputError(
            "where the constraints hold their differentials depend on each other, as that of x**2 is 0 at x = 0: "
            "write them so that they don't, as x",
            "key 'functions'",
        )
    parts = [rank] if question.key("holonomic") is not None or question.key("integrals") is not None else []
    parts += [*_answers(question, jets, forms, region), *_motions(question, jets, forms, lines, there)]
    are_some(question, jets, lines, there)
    return combined(parts)


def _moves(question: Question, jets: Motion, formula: Formula) -> bool:
    """Whether a formula contains velocities, as 0*log(v) does, too, which is for v > 0 alone."""
    return bool(formula.symbols & {question.tape.symbol_at(v) for v in jets.v})


def _dependence(rank: Outcome) -> str:
    """Why constraints that depend on each other, for some parameters or functions at least, are none."""
    words = {"dependent_at": "where", "dependent_for": "where", "dependent_near": "near", "dependent_where": "where"}
    key = next((key for key in words if key in rank.detail), None)
    if key is None:
        return "the constraints depend on each other, or say nothing: leave out those that follow"
    at = rank.detail[key]
    said = at if isinstance(at, str) else " and ".join(f"{name} = {value}" for name, value in at.items())
    advice = "exclude that under [symbols] or [domain]"
    return f"{words[key]} {said} the constraints depend on each other, or say nothing: {advice}"


def _others(question: Question) -> Iterator[Formula]:
    for word in ("integrals", "possible", "virtual", "multipliers", "L", "qddot", "forces"):
        value = question.key(word)
        if isinstance(value, Formula):
            yield value
        elif value is not None:
            yield from value


def _coefficients(question: Question, jets: Motion, node: Node, region: Region) -> Form:
    """a and b of a·v + b; **raises** `InputError` where it isn't linear."""
    tape = question.tape
    rest = dict.fromkeys(jets.v, tape.zero)
    form = (*(substitute(tape, derivative(tape, node, v), rest) for v in jets.v), substitute(tape, node, rest))
    linear = tape.plus(*(tape.times(a, v) for a, v in zip(form, jets.v, strict=False)), form[-1])
    if question.decide([Residual("form", tape.minus(node, linear))], region).status == "refuted":
        raise InputError("a constraint that isn't linear in the velocities is no differential form", "key 'forms'")
    return form


def _independent(question: Question, jets: Motion, forms: Sequence[Form], region: Region) -> Outcome:
    variables = [*jets.q, jets.t]
    chart = chart_of(question.tape, question.space, None)
    found = full_rank(question, forms, variables, region, everywhere=True, chart=chart)
    return replace(found, detail={}) if found.status == "proved" else found


def _regular(question: Question, forms: Sequence[Form]) -> Iterator[Requirement]:
    """That the differentials of constraints are independent: elsewhere they say nothing of displacements."""
    tape, m = question.tape, len(forms)
    minors = [
        determinant(tape, [[form[c] for c in chosen] for form in forms])
        for chosen in combinations(range(question.space.n), m)
    ]
    total = tape.plus(*(tape.power(minor, 2) for minor in minors))
    if tape.value(total) is None:
        yield Requirement("positive", (total,), "the constraints' differentials are independent")


def _answers(question: Question, jets: Motion, forms: Sequence[Form], region: Region) -> Iterator[Outcome]:
    """What is claimed of the forms themselves."""
    if question.key("holonomic") is not None:
        yield _frobenius(question, jets, forms, region)
    if question.key("stationary") is not None:
        yield _stationary(question, jets, forms, region)
    if question.key("integrals") is not None:
        yield _integrals(question, jets, forms, region)


def _motions(
    question: Question, jets: Motion, forms: Sequence[Form], lines: Sequence[Node], region: Region
) -> Iterator[Outcome]:
    """What is claimed of displacements and motions, on the surface that `functions` define."""
    regular = region
    if question.key("functions") is not None:
        regular = region.also(*_regular(question, forms))
    for word in ("possible", "virtual"):
        if question.key(word) is not None:
            yield _displacement(question, jets, forms, regular, word)
    if question.key("multipliers") is not None:
        yield _reactions(question, jets, forms, lines, regular)
    if question.key("determined") is not None:
        yield determined(question, jets, forms, lines, region)


def _wedge(question: Question, jets: Motion, forms: Sequence[Form], index: int) -> Iterator[tuple[str, Node]]:
    """The components of dω ∧ ω₁ ∧ … ∧ ω_m, ω the form of this index, by name."""
    tape, x = question.tape, [*jets.q, jets.t]
    own, m = forms[index], len(forms)
    for chosen in combinations(range(len(x)), m + 2):
        terms = []
        for (k, i), (n, j) in combinations(enumerate(chosen), 2):
            curl = tape.minus(derivative(tape, own[j], x[i]), derivative(tape, own[i], x[j]))
            rest = [c for c in chosen if c not in (i, j)]
            minor = determinant(tape, [[form[c] for c in rest] for form in forms])
            terms.append((tape.times(curl, minor), -1 if (k + n) % 2 == 0 else 1))
        name = " ".join(f"d{tape.symbol_at(x[c])}" for c in chosen)
        yield f"coefficient of {name} in dω ∧ ω, form {index + 1}", tape.add(terms)


def _frobenius(question: Question, jets: Motion, forms: Sequence[Form], region: Region) -> Outcome:
    """Are the forms integrable, as is claimed, or not?"""
    claimed: bool = question.key("holonomic")
    tape = question.tape
    components = [entry for k in range(len(forms)) for entry in _wedge(question, jets, forms, k)]
    kept = [(name, node) for name, node in components if tape.value(node) != 0]
    theorem = "Frobenius: forms are integrable if and only if each dω ∧ ω₁ ∧ … ∧ ω_m = 0"
    if claimed:
        found = question.decide([Residual(name, node, node) for name, node in kept], region)
        return with_value(question, replace(found, arguments=(*found.arguments, {"theorem": theorem})))
    vanishing = question.decide([Residual(name, node) for name, node in kept], region)
    if vanishing.status == "proved":
        return question.refuted_exactly(region, theorem, integrable="dω ∧ ω₁ ∧ … ∧ ω_m is identically 0")
    shown = next(((name, question.show(node)) for name, node in kept), ("", ""))
    found = _nowhere_flat(question, jets, [node for _, node in kept], region, "integrable")
    steps = ({"theorem": theorem}, {"not identically 0": shown[0], "value": shown[1]})
    return replace(found.with_detail(frobenius=f"{shown[0]}: {shown[1]}"), arguments=(*found.arguments, *steps))


def _nowhere_flat(question: Question, jets: Motion, nodes: Sequence[Node], region: Region, word: str) -> Outcome:
    """That the nodes vanish together on no open part of the domain, for no parameters; if they do, where."""
    tape, variables = question.tape, [*jets.q, jets.t, *jets.v]
    names = [variables[i % len(variables)] for i in range(len(nodes))]
    chart = chart_of(tape, question.space, None)
    found = full_rank(question, [nodes], [*names, *variables], region, everywhere=True, chart=chart)
    if found.status == "undecided":
        found = replace(found, note=f"it isn't shown that {question.show(nodes[0])} is 0 on no open part of the domain")
    start = "dependent_"
    kept = {key.replace(start, f"{word}_"): value for key, value in found.detail.items() if key.startswith(start)}
    return replace(found, detail=kept)


def _stationary(question: Question, jets: Motion, forms: Sequence[Form], region: Region) -> Outcome:
    """Neither time nor a term without velocities, as is claimed, or one of them."""
    tape, claimed = question.tape, question.key("stationary")
    names = [str(tape.symbol_at(q)) for q in jets.q]
    residuals = []
    for k, form in enumerate(forms, 1):
        rates = [derivative(tape, a, jets.t) for a in form[:-1]]
        residuals += [
            Residual(f"time in the coefficient of d{x}, form {k}", n) for x, n in zip(names, rates, strict=True)
        ]
        residuals.append(Residual(f"term without velocities, form {k}", form[-1]))
    if claimed:
        return question.decide(residuals, region)
    vanishing = question.decide(residuals, region)
    if vanishing.status == "proved":
        return question.refuted_exactly(region, "no coefficient contains time, and no term is without velocities")
    row = [r.node for r in residuals if tape.value(r.node) != 0]
    found = _nowhere_flat(question, jets, row, region, "stationary")
    return found.with_detail(moves=question.show(row[0])) if found.status == "proved" else found


def _integrals(question: Question, jets: Motion, forms: Sequence[Form], region: Region) -> Outcome:
    """dF is a combination of the forms for each F, and there are as many independent F as forms."""
    tape, x = question.tape, [*jets.q, jets.t]
    functions = question.formulas("integrals", len(forms))
    gradients = []
    for formula in functions:
        node = question.load(formula)
        if _moves(question, jets, formula):
            raise InputError(f"{formula} contains velocities", "key 'integrals'")
        gradients.append([derivative(tape, node, y) for y in x])
    residuals = []
    for formula, gradient in zip(functions, gradients, strict=True):
        for chosen in combinations(range(len(x)), len(forms) + 1):
            minor = determinant(tape, [[row[c] for c in chosen] for row in (gradient, *forms)])
            names = " ".join(f"d{tape.symbol_at(x[c])}" for c in chosen)
            residuals.append(Residual(f"coefficient of {names} in d({formula}) ∧ ω", minor))
    chart = chart_of(tape, question.space, None)
    rank = full_rank(question, gradients, x, region, everywhere=True, chart=chart)
    dependent = rank.status == "refuted"
    rank = rank.with_detail(fails="the integrals depend on each other") if dependent else replace(rank, detail={})
    return combined([question.decide(residuals, region), rank])


def _displacement(question: Question, jets: Motion, forms: Sequence[Form], region: Region, word: str) -> Outcome:
    """Velocities that the forms allow, or displacements at fixed time."""
    tape = question.tape
    steps = [question.load(f) for f in question.formulas(word, question.space.n)]
    if word == "possible":
        region = at_velocities(question, jets, steps, region)
    residuals = []
    for k, form in enumerate(forms, 1):
        total = tape.plus(*(tape.times(a, step) for a, step in zip(form, steps, strict=False)))
        if word == "possible":
            total = tape.plus(total, form[-1])
        residuals.append(Residual(f"{word} displacement in form {k}", total, total))
    return with_value(question, question.decide(residuals, region))


def _reactions(
    question: Question, jets: Motion, forms: Sequence[Form], lines: Sequence[Node], region: Region
) -> Outcome:
    """Lagrange's equations with multipliers, and accelerations that keep the constraints."""
    tape, n = question.tape, question.space.n
    for word in NEED:
        if question.key(word) is None:
            raise InputError(f"multipliers need {word!r}", "key 'multipliers'")
    L = question.load(question.formula("L"))
    multipliers = [question.load(f) for f in question.formulas("multipliers", len(forms))]
    accelerations = [question.load(f) for f in question.formulas("qddot", n)]
    forces = question.formulas("forces", n) if question.key("forces") is not None else ()
    images = dict(zip(jets.a, accelerations, strict=True))
    surface = replace(region, surface=(*region.surface, *lines))
    residuals = []
    for i, x in enumerate(jets.q):
        left = substitute(tape, jets.expression(L, i), images)
        push = tape.plus(*(tape.times(form[i], u) for form, u in zip(forms, multipliers, strict=True)))
        force = question.load(forces[i]) if forces else tape.zero
        total = tape.minus(left, tape.plus(push, force))
        residuals.append(Residual(f"equation of {tape.symbol_at(x)}", total))
    for k, line in enumerate(lines, 1):
        residuals.append(Residual(f"rate of form {k}", substitute(tape, jets.rate(line), images)))
    return question.decide(residuals, surface)


KINDS = {"constraint": constraint}
