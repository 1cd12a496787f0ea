"""`matrix_algebra`: matrices under the commutator, their structure constants and the Lie algebra that they span.

Every matrix is a real scale times a matrix of Gaussian rationals, or (with parameters inside) the coefficients are
found from some entries and decided for all of them. Where the real span doesn't close under [A, B], −i[A, B] is the
bracket: the generators are physicists' ones, and the answer says so.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import fmpq

from canon.claims.agreement import ALARM
from canon.claims.algebra_identity import identity_outcome
from canon.claims.matrix_numbers import bracket_evidence
from canon.claims.outcome import Outcome, Residual, combined, exact
from canon.claims.scale import never_zero
from canon.claims.scaled_matrices import scaled_matrices, unscaled
from canon.domain import Condition
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.coefficients import Number
from canon.mechanics.algebra.from_matrices import Dependent, MatrixAlgebra, NotClosed, algebra_of_matrices
from canon.mechanics.algebra.lie_algebra import LieAlgebra

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

Brackets = Mapping[str, Mapping[str, Formula]]
COMMUTATOR = "[A, B] = AB − BA"
PHYSICISTS = "−i[A, B]: the real span doesn't close under [A, B] itself (physicists' generators)"


def matrix_algebra(question: Question) -> Outcome:
    """The matrices close under their bracket with that algebra, and are independent over the reals."""
    basis: Mapping[str, Any] = question.key("basis")
    brackets: Brackets | None = question.key("brackets")
    equals = question.key("equals")
    if brackets is None and equals is None:
        raise InputError("a claim of kind 'matrix_algebra' needs 'equals', the name of an algebra, or 'structure'")
    entries = [entry for rows in basis.values() for row in rows for entry in row]
    coefficients = [] if brackets is None else [v for row in brackets.values() for v in row.values()]
    region = question.region(*entries, *coefficients)
    matrices = entries_of(basis)
    outcome, algebra = _decided(question, region, matrices, brackets, equals)
    if question.method != "numeric":
        return outcome
    return _with_numbers(question, region, matrices, outcome, _constants(question, tuple(matrices), algebra, brackets))


def _decided(
    question: Question, region: Region, matrices: Mapping[str, Any], brackets: Brackets | None, equals: str | None
) -> tuple[Outcome, LieAlgebra | None]:
    """The outcome by linear algebra, and the algebra where the matrices make one."""
    scaled = scaled_matrices(matrices)
    if scaled is None:
        return _with_parameters(question, region, matrices, brackets, equals)
    scales, plain = scaled
    try:
        found = algebra_of_matrices(plain)
    except (Dependent, NotClosed) as error:
        return question.refuted_exactly(region, error.message, **_failure(error)), None
    algebra = unscaled(found.algebra, scales)
    outcome = identity_outcome(question, region, algebra, equals).with_detail(bracket=_bracket_words(found))
    if brackets is not None:
        outcome = combined([compared(question, region, algebra, brackets), outcome])
    return outcome, algebra


def _constants(
    question: Question, names: Sequence[str], algebra: LieAlgebra | None, brackets: Brackets | None
) -> dict[tuple[int, int], dict[int, int]] | None:
    """The nodes of the structure constants, by positions: those stated, else those found; None without any."""
    if brackets is not None:
        position = {name: k for k, name in enumerate(names)}
        rows = {(a, b): stated(question, brackets, names[a], names[b]) for a, b in combinations(range(len(names)), 2)}
        return {pair: {position[c]: node for c, node in row.items()} for pair, row in rows.items()}
    if algebra is None:
        return None
    return {pair: {c: question.load(_sympy(v)) for c, v in row.items()} for pair, row in algebra.constants.items()}


def _with_numbers(
    question: Question, region: Region, matrices: Mapping[str, Any], outcome: Outcome, constants: Any
) -> Outcome:
    """The outcome with the brackets in floating-point numbers; an alarm where they deny what was proved."""
    physicists = outcome.detail.get("bracket") == PHYSICISTS
    evidence = bracket_evidence(question, region, matrices, constants, physicists=physicists)
    outcome = replace(outcome, numeric=evidence)
    if evidence is not None and outcome.status == "proved" and evidence.max_residual > evidence.bound:
        return outcome.with_status("undecided").with_detail(alarm=ALARM)
    return outcome


def entries_of(basis: Mapping[str, Any]) -> dict[str, list[list[Any]]]:
    """The entries of a claim's matrices as sympy expressions."""
    return {name: [[entry.expr for entry in row] for row in rows] for name, rows in basis.items()}


def _failure(error: Dependent | NotClosed) -> dict[str, Any]:
    if isinstance(error, Dependent):
        return {"fails": "independence over the reals", "relation": f"{error.relation} = 0"}
    return {"fails": f"[{', '.join(error.pair)}] in the real span", "value": error.value}


def _bracket_words(found: MatrixAlgebra) -> str:
    return PHYSICISTS if found.physicists else COMMUTATOR


def compared(question: Question, region: Region, algebra: LieAlgebra, brackets: Brackets) -> Outcome:
    """Are these the structure constants? The first bracket that differs is named, with its true value."""
    residuals = list(_differences(question, algebra, brackets))
    if not residuals:
        return exact("proved", "the structure constants are those that are stated")
    first, value = residuals[0]
    if question.tape.value(first.node) is not None:  # a number, and not 0
        return question.refuted_exactly(region, "linear algebra", fails=first.label, value=value)
    outcome = question.decide((r for r, _ in residuals), region)
    if outcome.failed is not None:
        pair = outcome.failed.residual.label
        value = next(value for r, value in residuals if r.label == pair)
        return outcome.with_detail(fails=pair, value=value)
    return outcome


def _differences(question: Question, algebra: LieAlgebra, brackets: Brackets) -> Iterator[tuple[Residual, str]]:
    """The constants that aren't obviously those stated, each as a residual, with the bracket's true value."""
    tape, names = question.tape, algebra.names
    for a, b in combinations(range(algebra.dimension), 2):
        true = algebra.bracket_of(a, b)
        for c in range(algebra.dimension):
            difference = tape.minus(
                question.load(_sympy(true.get(c, Fraction(0)))),
                stated(question, brackets, names[a], names[b]).get(names[c], tape.zero),
            )
            if difference != tape.zero:
                yield Residual(f"[{names[a]}, {names[b]}]", difference), algebra.show(true)


def stated(question: Question, brackets: Brackets, a: str, b: str) -> dict[str, int]:
    """The nodes of the coefficients that are claimed of a bracket: none where the pair isn't listed."""
    if f"{a},{b}" in brackets:
        return {name: question.load(value) for name, value in brackets[f"{a},{b}"].items()}
    if f"{b},{a}" in brackets:
        return {name: question.tape.negative(question.load(v)) for name, v in brackets[f"{b},{a}"].items()}
    return {}


def _sympy(value: Number) -> sp.Expr:
    return sp.Rational(value.numerator, value.denominator) if isinstance(value, Fraction) else value


def _with_parameters(
    question: Question, region: Region, matrices: Mapping[str, Any], brackets: Brackets | None, equals: str | None
) -> tuple[Outcome, LieAlgebra | None]:
    """Coefficients from entries that are independent for all values of the parameters, decided for all entries."""
    outcomes = []
    for closed, algebra, words in closings(question, region, matrices):
        outcomes.append(closed)
        if algebra is not None:
            outcome = identity_outcome(question, region, algebra, equals).with_detail(bracket=words)
            stated_too = [] if brackets is None else [compared(question, region, algebra, brackets)]
            return combined([closed, *stated_too, outcome]), algebra
    if not outcomes:
        return Outcome("undecided", note="no entries were found by which the matrices are independent throughout"), None
    if all(outcome.status == "refuted" for outcome in outcomes):
        return outcomes[0], None
    return Outcome("undecided", note="whether the real span closes wasn't decided"), None


def closings(
    question: Question, region: Region, matrices: Mapping[str, Any]
) -> Iterator[tuple[Outcome, LieAlgebra | None, str]]:
    """Whether the real span closes under [A, B], and under −i[A, B], with the algebra where that is proved."""
    names = tuple(matrices)
    basis = [sp.Matrix(rows) for rows in matrices.values()]
    entries = [[entry for row in rows for entry in row] for rows in matrices.values()]
    columns = independent_entries(entries, question.domain().conditions)
    if columns is None:
        return
    inverse = sp.Matrix([[row[k] for k in columns] for row in entries]).inv()
    for factor, words in ((sp.S.One, COMMUTATOR), (-sp.I, PHYSICISTS)):
        residuals, constants = list[Residual](), dict[tuple[int, int], dict[int, Any]]()
        for a, b in combinations(range(len(names)), 2):
            bracket = ((basis[a] * basis[b] - basis[b] * basis[a]) * factor).applyfunc(sp.expand)
            row = (sp.Matrix([[bracket[k] for k in columns]]) * inverse).applyfunc(sp.cancel)
            constants[a, b] = {c: _short(value) for c, value in enumerate(row) if value != 0}
            rest = bracket - sum((v * basis[c] for c, v in constants[a, b].items()), start=sp.zeros(*bracket.shape))
            label = f"[{names[a]}, {names[b]}] in the span"
            unreal = [sp.im(v) for v in constants[a, b].values() if not v.is_real]
            residuals += [Residual(label, question.load(e)) for e in rest if sp.expand(e) != 0]
            residuals += [Residual(f"{label}, a real coefficient", question.load(v)) for v in unreal]
        closed = question.decide(residuals, region) if residuals else exact("proved", "linear algebra")
        sampled = question.method == "numeric" and closed.status == "supported"
        yield closed, LieAlgebra(names, constants) if closed.status == "proved" or sampled else None, words


def _short(value: Any) -> Any:
    """A number with its roots above the line, and formulas as they are."""
    return value if value.free_symbols else sp.expand(sp.radsimp(value))


def independent_entries(entries: list[list[Any]], conditions: Sequence[Condition] = ()) -> list[int] | None:
    """Positions at which the entries' determinant is nowhere 0 where conditions hold; None where none were found."""
    size, width = len(entries), len(entries[0])
    filled = [k for k in range(width) if any(row[k] != 0 for row in entries)]
    first = [tuple(pivots)] if len(pivots := _pivots(entries)) == size else []
    for columns in (*first, *_some(combinations(filled, size))):
        determinant: Any = sp.Matrix([[row[k] for k in columns] for row in entries]).det(method="berkowitz")
        factored: Any = sp.factor(determinant)
        if determinant != 0 and never_zero(factored, conditions):
            return list(columns)
    return None


def _pivots(entries: list[list[Any]]) -> list[int]:
    """Independent columns at some values of the parameters; none where the entries aren't rational there."""
    names = sorted({symbol for row in entries for e in row for symbol in e.free_symbols}, key=str)
    some = {s: sp.Rational(7 + 4 * k, -3 if s.is_negative else 3) for k, s in enumerate(names)}
    rows = [[e.xreplace(some) for e in row] for row in entries]
    if not all(e.is_Rational for row in rows for e in row):
        return []
    return linear.pivots(linear.span(([fmpq(int(e.p), int(e.q)) for e in row] for row in rows), len(rows[0])))


def _some(choices: Iterator[tuple[int, ...]], most: int = 200) -> Iterator[tuple[int, ...]]:
    for _, choice in zip(range(most), choices, strict=False):
        yield choice


KINDS = {"matrix_algebra": matrix_algebra}
