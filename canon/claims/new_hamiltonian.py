"""The new Hamiltonian: a canonical map with a constant scale takes Hamilton's equations of H into those of K.

With M = ∂Ω/∂ω and M J Mᵀ = c J, the equations transform into each other exactly when
∇[K∘Ω − c H] + MᵀJ ∂Ω/∂t = 0. In a chart u in which old and new variables are explicit this reads
∇ᵤ[K − c H] + DₙᵀJ ∂ₜ(new) − c DₒᵀJ ∂ₜ(old) = 0 with the Jacobians Dₙ, Dₒ: nothing is inverted.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.scale import constant_scale
from canon.decide.derivative import derivative
from canon.decide.region import Region
from canon.decide.tape import Node
from canon.expression import Formula
from canon.mechanics.formulas import substituted

if TYPE_CHECKING:
    from canon.claims.question import Question


def new_hamiltonian(question: Question) -> Outcome:
    """`new_hamiltonian`: the map, canonical with some constant scale, takes the equations of H into those of K."""
    question.square_map()
    H, K = question.hamiltonian(), question.formula("K", "new")
    return _transforms(question, H, K)


def symmetry(question: Question) -> Outcome:
    """`symmetry`: the new Hamiltonian is H with q → Q, p → P, up to a function of time."""
    question.square_map()
    H, space = question.hamiltonian(), question.space
    renamed = {old: Formula(new, (), str(new)) for old, new in zip(space.old, space.new, strict=True)}
    return _transforms(question, H, substituted(H, renamed))


def _transforms(question: Question, H: Formula, K: Formula) -> Outcome:
    region = question.region(H, K)
    constant = constant_scale(question, region)
    if constant.status in ("refuted", "undecided") or constant.node is None:
        return constant.outcome.with_detail(canonical=constant.status)
    found = equations(question, H, K, constant.node, region)
    if found.status == "refuted" and constant.outcome.status != "proved" and constant.actual is not None:
        found = equations(question, H, K, constant.actual, region)
    return combined([constant.complete, found])


def equations(question: Question, H: Formula, K: Formula, scale: Node, region: Region) -> Outcome:
    """The residuals, decided, for a map that is canonical with this scale, which is constant."""
    return question.decide(residuals(question, question.load(H), question.load(K), scale), region)


def residuals(question: Question, H: Node, K: Node, scale: Node) -> Iterator[Residual]:
    """∇ᵤ[K − scale·H] + DₙᵀJ ∂ₜ(new) − scale·DₒᵀJ ∂ₜ(old), component by component.

    A scale that isn't seen to be constant is held fixed.
    """
    tape, chart = question.tape, question.chart
    new, old = chart.pull(K), chart.pull(H)
    fixed = tape.support(scale).isdisjoint(chart.coordinates)
    difference = tape.minus(new, tape.times(scale, old))
    new_rates, old_rates = chart.by_time(chart.new), chart.by_time(chart.old)
    for u in chart.coordinates:
        slope = (
            derivative(tape, difference, u)
            if fixed
            else tape.minus(derivative(tape, new, u), tape.times(scale, derivative(tape, old, u)))
        )
        moving = _dragged(question, chart.new, new_rates, u)
        carried = tape.times(scale, _dragged(question, chart.old, old_rates, u))
        yield Residual(f"d/d{tape.symbol_at(u)}", tape.minus(tape.plus(slope, moving), carried))


def _dragged(question: Question, functions: tuple[Node, ...], rates: list[Node], u: Node) -> Node:
    """One component of DᵀJ ∂ₜ(functions), positions first: Σ ∂ᵤq ∂ₜp − ∂ᵤp ∂ₜq."""
    tape = question.tape
    half = len(functions) // 2
    terms = []
    for i in range(half):
        if tape.value(rates[i + half]) != 0:
            terms.append((tape.times(derivative(tape, functions[i], u), rates[i + half]), 1))
        if tape.value(rates[i]) != 0:
            terms.append((tape.times(derivative(tape, functions[i + half], u), rates[i]), -1))
    return tape.add(terms)


KINDS = {"new_hamiltonian": new_hamiltonian, "symmetry": symmetry}
