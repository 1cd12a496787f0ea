"""`algebra`: functions on phase space whose Poisson brackets close as a Lie algebra.

The brackets are decided one by one, {f_a, f_b} − Σ_c C^c_ab f_c = 0, with constants that are stated or were found at
sample points; the functions must be linearly independent over the reals; then Jacobi's identity holds for the
constants, and the algebra is identified from them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.algebra_identity import identity_outcome
from canon.claims.algebra_in_balls import refuted_by_signature
from canon.claims.algebra_independence import independent_outcome
from canon.claims.bracket import bracket_of, keys_domain, tensor_of
from canon.claims.fixed_parameters import unfolded
from canon.claims.matrix_algebra import Brackets, stated
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.structure_constants import Found, find_constants
from canon.claims.structure_search import CHOSEN
from canon.decide.answer import Witness
from canon.decide.derivative import substitute
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.algebra.coefficients import as_sympy
from canon.mechanics.algebra.given_table import NotReal
from canon.mechanics.algebra.lie_algebra import LieAlgebra

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node

Pair = tuple[int, int]
IF_THEY_HOLD = "the algebra differs, if the brackets hold, which was only sampled"


@dataclass(frozen=True)
class Basis:
    """The functions of a claim on the tape, pulled back to its chart, with their brackets."""

    names: tuple[str, ...]
    nodes: tuple[Node, ...]
    brackets: Mapping[Pair, Node]
    variables: tuple[Node, ...]


def algebra(question: Question) -> Outcome:
    """The basis closes under the bracket with that algebra, or those structure constants, and is independent."""
    given: Mapping[str, Formula] = question.key("basis")
    brackets: Brackets | None = question.key("brackets")
    equals: str | None = question.key("equals")
    if brackets is None and equals is None:
        raise InputError("a claim of kind 'algebra' needs 'equals', the name of an algebra, or 'structure'")
    coefficients = [] if brackets is None else [v for row in brackets.values() for v in row.values()]
    region = keys_domain(question, *given.values(), *coefficients)
    basis = basis_of(question, given)
    if brackets is not None:
        return _with_constants(question, region, basis, brackets, equals)
    found = find_constants(question, region, basis.nodes, list(basis.brackets.values()), basis.variables)
    if found.outside is not None:
        return _outside(question, region, basis, found)
    if found.dependent is not None:
        return _dependent(question, region, basis, found.dependent)
    if found.unknown is not None or found.nothing:
        pair = list(basis.brackets)[found.unknown] if found.unknown is not None else None
        words = _label(basis, pair) if pair is not None else ""
        note = f"the structure constants of {words} were not recognised: state them as 'structure'" if words else ""
        return Outcome("undecided", note=note or found.nothing or "no structure constants were found")
    return decided_outcome(question, region, basis, found, equals)[0]


def basis_of(question: Question, given: Mapping[str, Formula]) -> Basis:
    """The functions and the brackets of their pairs, in the variables of the claim's bracket."""
    tape, chart = question.tape, question.chart
    has_tensor = question.key("tensor") is not None
    variables = question.nodes(tensor_of(question)[1] if has_tensor else question.space.old)
    bracket = bracket_of(question)
    nodes = [question.load(question.checked(f, f"basis, {name}", "old") if not has_tensor else f)
             for name, f in given.items()]  # fmt: skip
    pairs = {(a, b): chart.pull(bracket(nodes[a], nodes[b])) for a, b in combinations(range(len(nodes)), 2)}
    return Basis(tuple(given), tuple(chart.pull(f) for f in nodes), pairs, tuple(variables) or (tape.zero,))


def _label(basis: Basis, pair: Pair) -> str:
    return f"{{{basis.names[pair[0]]}, {basis.names[pair[1]]}}}"


# -- constants that are stated ----------------------------------------------------------------------------------


def _with_constants(
    question: Question, region: Region, basis: Basis, brackets: Brackets, equals: str | None
) -> Outcome:
    tape, position = question.tape, {name: k for k, name in enumerate(basis.names)}

    def residuals() -> Iterator[Residual]:
        for (a, b), value in basis.brackets.items():
            claimed = stated(question, brackets, basis.names[a], basis.names[b])
            terms = [tape.times(c, basis.nodes[position[name]]) for name, c in claimed.items()]
            yield Residual(_label(basis, (a, b)), tape.minus(value, tape.plus(*terms)), value)

    closed = _closed(question, residuals(), region)
    if closed.failed is not None:
        pair = next(pair for pair in basis.brackets if _label(basis, pair) == closed.failed.residual.label)
        return closed.with_detail(value=_true_value(question, region, basis, pair))
    return _conclusion(question, region, basis, closed, stated_constants(basis, brackets), equals, stated=True)[0]


def stated_constants(basis: Basis, brackets: Brackets) -> dict[Pair, dict[int, Any]]:
    """The table of a claim by positions."""
    position = {name: k for k, name in enumerate(basis.names)}
    constants: dict[Pair, dict[int, Any]] = {}
    for pair, row in brackets.items():
        a, b = (position[name] for name in pair.split(","))
        constants[a, b] = {position[name]: v.expr for name, v in row.items()}
    return constants


def _closed(question: Question, residuals: Iterator[Residual], region: Region) -> Outcome:
    """Do the residuals vanish? On surfaces H = E of every energy E, with H in place of E throughout the space."""
    graph = unfolded(question, region)
    if graph is None:
        return question.decide(residuals, region)
    images, open_region = graph
    moved = (Residual(r.label, substitute(question.tape, r.node, images), r.actual) for r in residuals)
    return question.decide(moved, open_region)


def _true_value(question: Question, region: Region, basis: Basis, pair: Pair) -> str:
    """A bracket as a combination of the basis where it is one, else as a function."""
    found = find_constants(question, region, basis.nodes, [basis.brackets[pair]], basis.variables)
    if found.constants:
        return str(as_sympy(found.constants[0], basis.names))
    return multiple_of_the_basis(question, region, basis, pair) or question.show(basis.brackets[pair])


# -- constants that are found -----------------------------------------------------------------------------------


def decided_outcome(
    question: Question, region: Region, basis: Basis, found: Found, equals: str | None
) -> tuple[Outcome, LieAlgebra | None]:
    """Do the brackets have the constants that were found, and what algebra is it?"""
    tape = question.tape
    constants = dict(zip(basis.brackets, found.constants, strict=True))

    def residuals() -> Iterator[Residual]:
        for (a, b), row in constants.items():
            terms = [tape.times(question.load(value), basis.nodes[c]) for c, value in row.items()]
            value = basis.brackets[a, b]
            yield Residual(_label(basis, (a, b)), tape.minus(value, tape.plus(*terms)), value)

    closed = _closed(question, residuals(), region)
    if closed.status == "refuted":  # of a guess: no bracket of the claim's own is refuted by it
        label = closed.failed.residual.label if closed.failed is not None else "a bracket"
        return Outcome("undecided", note=f"the structure constants of {label} were not found: state 'structure'"), None
    return _conclusion(question, region, basis, closed, constants, equals)


def _conclusion(
    question: Question,
    region: Region,
    basis: Basis,
    closed: Outcome,
    constants: Mapping[Pair, Mapping[int, Any]],
    equals: str | None,
    *,
    stated: bool = False,
) -> tuple[Outcome, LieAlgebra | None]:
    """The outcome of the closed brackets, of independence and of the identification together.

    Constants that are `stated` with a name that isn't theirs are refuted whether or not the brackets have them.
    """
    try:
        value = LieAlgebra(basis.names, {pair: dict(row) for pair, row in constants.items()})
    except NotReal as error:
        return Outcome("undecided", note=f"the brackets hold, but {error.message}", numeric=closed.numeric), None
    except InputError as error:
        note = f"the brackets hold, but {error.message}: the basis must be linearly dependent"
        return Outcome("undecided", note=note, numeric=closed.numeric), None
    independent = independent_outcome(question, region, basis.nodes, basis.variables, value)
    identity = identity_outcome(question, region, value, equals)
    if identity.status == "refuted" and closed.status != "proved" and not stated:  # of constants that were guessed
        assert equals is not None
        certain = refuted_by_signature(question, region, basis.nodes, basis.brackets, basis.variables, equals)
        identity = certain or Outcome("undecided", detail=identity.detail, note=IF_THEY_HOLD)
    if region.surface:
        closed = closed.with_detail(closes="on the surface alone: brackets are computed first, and restricted then")
    if independent.status == "refuted":
        return independent, value
    step = {"structure": {f"{a},{b}": row for a, b, row in value.rows()}}
    whole = combined([closed, independent, identity])
    return replace(whole, arguments=(*whole.arguments, step)), value


def _outside(question: Question, region: Region, basis: Basis, found: Found) -> Outcome:
    """A refutation: the points show that a bracket is no combination of the basis with constant coefficients."""
    assert found.outside is not None
    number, place = found.outside
    pair = list(basis.brackets)[number]
    tape = question.tape
    point = dict(place.point.items())
    sample = Witness.of(tape, place, place.balls[next(iter(place.balls))]).as_table()
    sample |= {str(tape.symbol_at(x)): str(v) for x, v in found.values.items() if x not in point}
    if found.chosen:
        names = question.tape.functions_of([*basis.nodes, *region.nodes()])
        sample |= dict.fromkeys(sorted(names), CHOSEN)
    value = multiple_of_the_basis(question, region, basis, pair) or question.show(basis.brackets[pair])
    theorem = "no constant coefficients satisfy the linear equations at certified points of the domain"
    label = f"{_label(basis, pair)} in the span of the basis"
    return Outcome(
        "refuted", method="balls at several points", witness=sample, detail={"fails": label, "value": value},
        arguments=({"theorem": theorem},), numeric=found.missed,
    )  # fmt: skip


def multiple_of_the_basis(question: Question, region: Region, basis: Basis, pair: Pair) -> str:
    """The bracket as a combination with the Hamiltonian in its coefficients, as Kepler's −2 m H M; else ""."""
    H = question.subject.hamiltonian
    if H is None or question.key("tensor") is not None:
        return ""
    energy = question.chart.pull(question.load(H))
    wider = [*basis.nodes, *(question.tape.times(energy, f) for f in basis.nodes)]
    names = [*basis.names, *(f"H*{name}" for name in basis.names)]
    found = find_constants(question, region, wider, [basis.brackets[pair]], basis.variables)
    if not found.constants:
        return ""
    symbols = [sp.Mul(*(sp.Symbol(word) for word in name.split("*"))) for name in names]
    return str(sp.Add(*(value * symbols[c] for c, value in found.constants[0].items())))


def _dependent(question: Question, region: Region, basis: Basis, relation: Mapping[int, Any]) -> Outcome:
    """A refutation, if the relation that the points suggest holds throughout the domain."""
    tape = question.tape
    terms = [tape.times(question.load(value), basis.nodes[c]) for c, value in relation.items()]
    words = f"{as_sympy(dict(relation), basis.names)} = 0"
    outcome = question.decide([Residual("independence over the reals", tape.plus(*terms))], region)
    if outcome.status != "proved":
        return Outcome("undecided", note=f"the basis seems to be dependent: {words}")
    theorem = "the functions are linearly dependent over the reals"
    return question.refuted_exactly(region, theorem, fails="independence over the reals", relation=words)


KINDS = {"algebra": algebra}
