"""Lagrange's equations and Noether's theorem, off shell: identities in coordinates, velocities and accelerations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from canon.claims.bracket import names as names_of
from canon.claims.chart import chart_of
from canon.claims.flat_parts import regular_in_parts
from canon.claims.independence import full_rank
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.own_names import is_free_of
from canon.claims.show import with_value
from canon.claims.velocities import Motion, motion, region_in_velocities
from canon.decide.derivative import derivative, gradient, substitute
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question


def euler_lagrange(question: Question) -> Outcome:
    """`euler_lagrange`: d/dt ∂L/∂v − ∂L/∂q + ∂R/∂v − Q are `equations`, or vanish for the accelerations `qddot`.

    R is Rayleigh's function (`dissipation`), Q the generalised forces (`forces`). With `qddot`, det ∂²L/∂v² is not
    identically 0 besides, so that the equations determine these accelerations (Goldstein, eqs 1.53, 1.70).
    """
    L = _lagrangian(question)
    given = [word for word in ("equations", "qddot") if question.key(word) is not None]
    if len(given) != 1:
        raise InputError("give either 'equations', the expressions that vanish, or 'qddot', the accelerations")
    n = question.space.n
    claimed = question.formulas(given[0], n)
    dissipation = question.key("dissipation")
    forces = question.formulas("forces", n) if question.key("forces") is not None else ()
    jets = motion(question)
    for name, formula in (("L", L), ("dissipation", dissipation), *(("forces", f) for f in forces)):
        if formula is not None:
            is_free_of(formula, names_of(question.key("accelerations")), name, "key 'accelerations'")
    region = region_in_velocities(question, L, *claimed, *forces, *([dissipation] if dissipation else []))
    left = _left_sides(question, jets, L, dissipation, forces)
    names = [str(x) for x in question.space.q]
    if given == ["equations"]:
        tape = question.tape
        residuals = [
            Residual(f"equation of {x}", tape.minus(node, question.load(f)), node)
            for x, node, f in zip(names, left, claimed, strict=True)
        ]
        return with_value(question, question.decide(residuals, region))
    images = dict(zip(jets.a, (question.load(f) for f in claimed), strict=True))
    solved = [substitute(question.tape, node, images) for node in left]
    residuals = [Residual(f"equation of {x}", node) for x, node in zip(names, solved, strict=True)]
    outcome = question.decide(residuals, region)
    if outcome.status == "refuted":
        return outcome.with_detail(equations=[question.show(node) for node in left])
    rows = [
        [derivative(question.tape, derivative(question.tape, question.load(L), x), y) for y in jets.v] for x in jets.v
    ]
    chart = chart_of(question.tape, question.space, None)
    regular = full_rank(question, rows, list(jets.v), region, everywhere=False, chart=chart)
    if regular.status == "refuted":
        regular = regular.with_detail(hessian="det d2L/dv2 is identically 0")
    return combined([outcome, regular_in_parts(question, rows, region, regular)])


def _lagrangian(question: Question) -> Formula:
    L = question.formula("L")
    for symbol in sorted(L.symbols & set(question.space.p), key=str):
        raise InputError(f"L is a function of coordinates and velocities, not of {symbol}", "key 'L'")
    return L


def _left_sides(
    question: Question, jets: Motion, L: Formula, dissipation: Formula | None, forces: tuple[Formula, ...]
) -> list[Node]:
    tape, node = question.tape, question.load(L)
    left = [jets.expression(node, i) for i in range(len(jets.q))]
    if dissipation is not None:
        R = question.load(dissipation)
        left = [tape.plus(e, derivative(tape, R, v)) for e, v in zip(left, jets.v, strict=True)]
    if forces:
        left = [tape.minus(e, question.load(f)) for e, f in zip(left, forces, strict=True)]
    return left


def noether(question: Question) -> Outcome:
    """`noether`: t → t + ε τ, q → q + ε ξ changes L dt by ε df, off shell; the charge is ∂L/∂v ξ − (v ∂L/∂v − L) τ − f.

    For every motion, whether it solves the equations or not, ∂L/∂t τ + ∂L/∂q ξ + ∂L/∂v (ξ' − v τ') + L τ' = f' (the
    identity of Rund and Trautman); it makes the charge's rate −Σ E (ξ − v τ), with E the Euler–Lagrange expressions
    (Noether 1918; Rund, Utilitas Mathematica 2, 1972). `dq` is ξ, `dt` is τ, and `f` is 0 where left out.
    """
    L, xi = _lagrangian(question), question.formulas("dq", question.space.n)
    others = {word: question.key(word) for word in ("dt", "f", "charge")}
    jets, tape = motion(question), question.tape
    region = region_in_velocities(question, L, *xi, *(f for f in others.values() if f is not None))
    node, steps = question.load(L), [question.load(f) for f in xi]
    tau, f = (tape.zero if others[w] is None else question.load(others[w]) for w in ("dt", "f"))
    momenta = gradient(tape, node, jets.v)
    stretch = jets.rate(tau)
    change = [tape.times(derivative(tape, node, jets.t), tau), tape.times(node, stretch)]
    for x, v, p, step in zip(jets.q, jets.v, momenta, steps, strict=True):
        change.append(tape.times(derivative(tape, node, x), step))
        change.append(tape.times(p, tape.minus(jets.rate(step), tape.times(v, stretch))))
    total = tape.plus(*change)
    residuals = [Residual("change of L - df/dt", tape.minus(total, jets.rate(f)), total)]
    energy = tape.minus(tape.plus(*(tape.times(v, p) for v, p in zip(jets.v, momenta, strict=True))), node)
    drift = [tape.times(p, step) for p, step in zip(momenta, steps, strict=True)]
    charge = tape.minus(tape.minus(tape.plus(*drift), tape.times(energy, tau)), f)
    if others["charge"] is not None:
        residuals.append(Residual("charge", tape.minus(charge, question.load(others["charge"])), charge))
    outcome = with_value(question, question.decide(residuals, region))
    return outcome.with_detail(charge=question.show(charge))


KINDS = {"euler_lagrange": euler_lagrange, "noether": noether}
