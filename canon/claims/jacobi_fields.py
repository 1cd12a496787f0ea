"""Jacobi's condition: fields of solutions of the second variation's equations, and points that are conjugate.

The second variation along an extremal is ∫ (η'·P η' + 2 η·R η' + η·Q η) dt, P = ∂²L/∂v², R = ∂²L/∂q∂v, Q = ∂²L/∂q².
Its equations are d/dt (P u' + Rᵀ u) = R u' + Q u. With P positive, n solutions that are conjoined, u·(P w' + Rᵀ w) =
w·(P u' + Rᵀ u), and independent at every time inside make it a square, hence positive for all variations that vanish
near the ends; a solution with two zeros inside takes this from it (Gelfand & Fomin, Calculus of Variations, § 29;
Reid, Ordinary Differential Equations, ch. VII).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.along_a_range import Range, Unproved, holds, is_positive
from canon.claims.determinant import determinant, dot
from canon.claims.outcome import Residual
from canon.decide.derivative import derivative, substitute
from canon.decide.nowhere_zero import factors
from canon.decide.region import Requirement
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

LONGEST = 200
"""Nodes of a determinant that is still simplified."""

Matrix = Sequence[Sequence[Node]]
Fields = Sequence[Sequence[Formula]]


@dataclass(frozen=True)
class Accessory:
    """P, R and Q along the path: matrices of second derivatives of L."""

    P: Matrix
    R: Matrix
    Q: Matrix


@dataclass(frozen=True)
class _Field:
    """A field with its rate and its momentum P u' + Rᵀ u."""

    u: Sequence[Node]
    slope: Sequence[Node]
    momentum: Sequence[Node]


def classified_by_fields(
    question: Question, span: Range, second: Accessory, fields: Fields
) -> tuple[bool, dict[str, Any]]:
    """Whether the second variation, whose P is positive definite, is positive for all variations that vanish near the
    ends (else it takes both signs), and the argument.

    **Raises:** `Unproved`; `InputError` where a field solves another equation, or the fields aren't conjoined.
    """
    n, listed = len(second.P), [_said(row) for row in fields]
    solved = as_claimed(question, span, second, fields)
    conjugate = question.key("conjugate")
    if conjugate is not None:
        zeros = [str(c) for c in conjugate]
        return False, {"theorem": "Jacobi: a field with two zeros inside", "field": listed[0], "at": zeros}
    if len(solved) != n:
        raise InputError(f"{n} fields are expected, one for each coordinate, or one with `conjugate`", "key 'field'")
    if _independent(question, span, determinant(question.tape, [field.u for field in solved])):
        said = "a field without a zero inside" if n == 1 else "conjoined fields, independent all along"
        return True, {"theorem": f"Jacobi: {said}", "field": "; ".join(listed)}
    what = "the field isn't shown to have no zero inside" if n == 1 else "the fields aren't shown to be independent"
    raise Unproved(f"{what}: where one has two zeros, name them under `conjugate`")


def _said(row: Sequence[Formula]) -> str:
    return f"({', '.join(map(str, row))})" if len(row) > 1 else str(row[0])


def as_claimed(question: Question, span: Range, second: Accessory, fields: Fields) -> list[_Field]:
    """The fields, shown to solve Jacobi's equations, and to be conjoined or to have the zeros that are named.

    **Raises:** `Unproved`; `InputError` where a field solves another equation, or the fields aren't conjoined.
    """
    solved = [_solution(question, span, second, row, _said(row)) for row in fields]
    conjugate = question.key("conjugate")
    if conjugate is None:
        _conjoined(question, span, solved)
        return solved
    if len(solved) > 1:
        raise InputError("the zeros are those of one field", "key 'field'")
    _two_zeros(question, span, solved[0], conjugate)
    return solved


def _solution(question: Question, span: Range, second: Accessory, row: Sequence[Formula], said: str) -> _Field:
    """The field, shown to solve Jacobi's equations."""
    tape, t = question.tape, question.tape.symbol(span.x)
    u = [question.load(component) for component in row]
    slope = [derivative(tape, x, t) for x in u]
    columns = list(zip(*second.R, strict=True))
    momentum = [
        tape.plus(dot(tape, p, slope), dot(tape, r, u)) for p, r in zip(second.P, columns, strict=True)
    ]  # P u' + Rᵀ u
    push = [tape.plus(dot(tape, r, slope), dot(tape, q, u)) for r, q in zip(second.R, second.Q, strict=True)]
    residuals = [
        Residual("Jacobi's equation", tape.minus(derivative(tape, m, t), f))
        for m, f in zip(momentum, push, strict=True)
    ]
    found = question.decide(residuals, span.inside)
    if found.status == "refuted":
        raise InputError(f"{said} doesn't solve Jacobi's equation d/dt (P u' + R^T u) = R u' + Q u", "key 'field'")
    if found.status != "proved":
        raise Unproved("Jacobi's equation was not shown for the field")
    return _Field(u, slope, momentum)


def _conjoined(question: Question, span: Range, fields: Sequence[_Field]) -> None:
    """u·(P w' + Rᵀ w) = w·(P u' + Rᵀ u) for each pair: what is constant in time is 0."""
    tape = question.tape
    residuals = [
        Residual("conjoined", tape.minus(dot(tape, a.u, b.momentum), dot(tape, b.u, a.momentum)))
        for a, b in combinations(fields, 2)
    ]
    if not residuals:
        return
    found = question.decide(residuals, span.inside)
    if found.status == "refuted":
        raise InputError(
            "the fields aren't conjoined, u.(P w' + R^T w) = w.(P u' + R^T u): fields that are all 0 at one time are",
            "key 'field'",
        )
    if found.status != "proved":
        raise Unproved("the fields aren't shown to be conjoined")


def _independent(question: Question, span: Range, frame: Node) -> bool:
    """Whether the fields' determinant is shown to be nowhere 0 inside, as it is or as a product that equals it."""
    tape = question.tape
    return any(
        tape.value(form) != 0
        and all(
            holds(question, Requirement("nonzero", (factor,), ""), span.inside, span) for factor in factors(tape, form)
        )
        for form in (frame, *_products(question, span, frame))
    )


def _products(question: Question, span: Range, frame: Node) -> Iterator[Node]:
    """The determinant as a product, with 1 ± cos as squares of half angles or without, verified."""
    tape = question.tape
    if tape.functions_of([frame]) or len(tape.reach([frame])) > LONGEST:
        return
    plain: Any = sp.trigsimp(tape.to_sympy(frame))
    halved: Any = plain.replace(sp.cos, lambda u: 1 - 2 * sp.sin(u / 2) ** 2)
    candidates: tuple[Any, ...] = (sp.factor(plain), sp.factor(sp.expand(halved)))
    for candidate in candidates:
        node = question.load(candidate)
        if question.decide([Residual("determinant", tape.minus(frame, node))], span.inside).status == "proved":
            yield node


def _two_zeros(question: Question, span: Range, field: _Field, conjugate: Sequence[Formula]) -> None:
    """Whether a field that isn't 0 has these two zeros inside. **Raises:** `Unproved`; `InputError` if it hasn't."""
    tape, t = question.tape, question.tape.symbol(span.x)
    if len(conjugate) != 2 or isinstance(span.low, str) or isinstance(span.high, str):
        raise InputError("two zeros inside a bounded range are expected", "key 'conjugate'")
    places = [question.load(e) for e in (span.low, *conjugate, span.high)]
    for a, b, names in zip(places, places[1:], ("from < first", "first < second", "second < to"), strict=False):
        if not is_positive(question, tape.minus(b, a), span.others):
            raise Unproved(f"it isn't shown of the zeros that {names}")
    values = [Residual(f"field at {c}", substitute(tape, x, {t: question.load(c)})) for c in conjugate for x in field.u]
    vanishes = question.decide(values, span.others).status
    if vanishes == "refuted":
        raise InputError("the field doesn't vanish at the points under `conjugate`", "key 'conjugate'")
    if vanishes != "proved":
        raise Unproved("the field isn't shown to vanish at the points under `conjugate`")
    steep = [substitute(tape, x, {t: places[1]}) for x in field.slope]
    if not any(holds(question, Requirement("nonzero", (x,), ""), span.others) for x in steep):
        raise Unproved("the field's slope isn't shown to differ from 0 at its zero")
