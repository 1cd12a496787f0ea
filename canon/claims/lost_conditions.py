"""Conditions of a claim that went lost when it was written down and read again: another claim, with a larger domain."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from canon.claim import Claim
from canon.domain import Condition, conditions_of, nonzero, positive
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.subject import Subject


def lost_condition(claim: Claim, again: Claim) -> Condition | None:
    """A condition of `claim` that `again` hasn't got: one of its domain, or one that doesn't show in a formula."""
    known = {_normal(condition) for condition in _all(again)}
    for condition in claim.subject.domain.conditions:
        if _normal(condition) not in known and not _holds_anyway(condition):
            return condition
    for formula in _formulas(claim):
        left = [c for c in formula.conditions if _normal(c) not in known and not _holds_anyway(c)]
        shown = {_normal(c) for c in _shown(formula)} if left else set[Any]()
        for condition in left:
            if _normal(condition) not in shown:
                return condition
    return None


def _all(claim: Claim) -> Iterator[Condition]:
    yield from claim.subject.domain.conditions
    for formula in _formulas(claim):
        yield from formula.conditions
        yield from _shown(formula)


def _shown(formula: Formula) -> tuple[Condition, ...]:
    """The conditions that the formula's own form shows."""
    try:
        return conditions_of(formula.expr)
    except InputError:
        return ()


def _formulas(claim: Claim) -> Iterator[Formula]:
    subject: Subject = claim.subject
    if subject.hamiltonian is not None:
        yield subject.hamiltonian
    if subject.transformation is not None and subject.transformation.direction != "implicit":
        yield from subject.transformation.formulas
    for maker in (subject.generating_function, getattr(subject.transformation, "generating_function", None)):
        if maker is not None:
            yield maker.F
    yield from _inside(claim.keys.values())


def _inside(values: Iterable[Any]) -> Iterator[Formula]:
    for value in values:
        if isinstance(value, Formula):
            yield value
        elif isinstance(value, (list, tuple)):
            yield from _inside(value)
        elif isinstance(value, Mapping):
            yield from _inside(value.values())


def _normal(condition: Condition) -> tuple[Any, ...]:
    """The condition without factors that don't matter to it."""
    if condition.kind not in ("positive", "nonzero"):
        return condition.kind, condition.terms
    (term,) = condition.terms
    coefficient, rest = term.as_coeff_Mul()
    if condition.kind == "positive" and coefficient < 0:
        rest = -rest
    return condition.kind, (rest,)


def _holds_anyway(condition: Condition) -> bool:
    make = {"positive": positive, "nonzero": nonzero}.get(condition.kind)
    try:
        return make is not None and not make(condition.terms[0])
    except InputError:
        return False
