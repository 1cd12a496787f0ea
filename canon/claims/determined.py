"""Whether Lagrange's equations with multipliers determine accelerations and reactions.

With W = ∂²L/∂v² and the rows a of the constraints, W v' − aᵀλ = … and a v' = … have one solution where the matrix
(W, −aᵀ; a, 0) is regular; where it is singular they have none, or many (Udwadia & Kalaba, Analytical Dynamics, ch. 6).
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.along_a_range import is_positive
from canon.claims.determinant import determinant
from canon.claims.outcome import Outcome, Residual
from canon.decide.derivative import derivative
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.tape import Node
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.claims.velocities import Motion
    from canon.decide.region import Region

THEOREM = "linear equations have one solution where their determinant isn't 0"


def determined(
    question: Question, jets: Motion, forms: Sequence[Sequence[Node]], lines: Sequence[Node], region: Region
) -> Outcome:
    """Is the determinant of the equations nowhere 0, as `determined = true` claims, or identically 0?

    **Arguments:** `forms`, rows a (and the term without velocities); `lines`, the same as expressions a·v + b;
    `region`, the surface of `functions` included.
    """
    if question.key("L") is None:
        raise InputError("`determined` needs the Lagrangian 'L'", "key 'determined'")
    tape, L = question.tape, question.load(question.formula("L"))
    slopes = [derivative(tape, L, v) for v in jets.v]
    rows = [
        [*(derivative(tape, slope, v) for v in jets.v), *(tape.negative(form[i]) for form in forms)]
        for i, slope in enumerate(slopes)
    ]
    rows += [[*form[:-1], *([tape.zero] * len(forms))] for form in forms]
    det = determinant(tape, rows)
    asked = [det, *(node for r in region.requirements for node in r.nodes)]
    if any(tape.support(node) & {*jets.v} for node in asked):  # then it is one at velocities that the constraints allow
        region = replace(region, surface=(*region.surface, *lines))
    vanishing = question.decide([Residual("determinant of the equations", det, det)], region)
    if question.key("determined") is False:
        step = {"theorem": "equations whose determinant is 0 have no solution, or many"}
        return replace(vanishing, arguments=(*vanishing.arguments, step))
    if vanishing.status == "proved":
        return question.refuted_exactly(region, THEOREM, determinant="identically 0")
    forms_of_it = [det, *_on_the_surface(question, jets, det, region)]
    if any(_nowhere_zero(question, form, region) for form in forms_of_it):
        point = question.decide([Residual("0", tape.zero)], region)
        step = {"theorem": THEOREM, "determinant": question.show(det)}
        return Outcome("proved", "determinant without a zero", numeric=point.numeric, arguments=(step,))
    return Outcome("undecided", note=f"it isn't shown that {question.show(det)} has no zero in the domain")


def _nowhere_zero(question: Question, det: Node, region: Region) -> bool:
    signs = (det, question.tape.negative(det))
    return has_no_zero(question.tape, det, region, question.budget) or any(
        is_positive(question, d, region) for d in signs
    )


def _on_the_surface(question: Question, jets: Motion, det: Node, region: Region) -> Iterator[Node]:
    """The determinant's remainder by the surface's equations, where all are polynomials: equal to it there."""
    tape = question.tape
    if not region.surface or tape.functions_of([det, *region.surface]):
        return
    with contextlib.suppress(sp.PolynomialError):
        names = [*question.space.q, *(tape.symbol_at(v) for v in jets.v)]
        surface = [tape.to_sympy(n) for n in region.surface]
        rest: Any = sp.reduced(tape.to_sympy(det), surface, *names, field=True)[1]
        if not sp.denom(sp.together(rest)).is_number:
            return  # a parameter that may be 0 was divided by
        node = question.load(rest)
        if question.decide([Residual("remainder", tape.minus(det, node))], region).status == "proved":
            yield node
