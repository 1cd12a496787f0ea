"""Matrices that keep a metric, and families of matrices that a composition of parameters makes a group."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from canon.claims.chart import required_in_place_of
from canon.claims.outcome import Outcome, Residual
from canon.claims.own_names import is_free_of
from canon.claims.show import with_value
from canon.decide.derivative import substitute
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

Rows = tuple[tuple[Node, ...], ...]


def invariant_interval(question: Question) -> Outcome:
    """`invariant_interval`: ΛᵀgΛ = g, and Λ times `inverse` is 1, where one is given.

    With g = diag(1, −1, −1, −1) Λ is a Lorentz transformation, with g = 1 a rotation or reflection, with J a symplectic
    matrix (Jackson, eq. 11.85).
    """
    tape = question.tape
    matrix, metric = question.key("matrix"), question.key("metric")
    if len(matrix) != len(metric):
        raise InputError(f"{len(metric)} rows, but the matrix has {len(matrix)}", "key 'metric'")
    L, g = _loaded(question, matrix), _loaded(question, metric)
    residuals = _differences("transpose(matrix)*metric*matrix", tape, _product(tape, _transpose(L), g, L), g)
    inverse = question.key("inverse")
    if inverse is not None:
        if len(inverse) != len(matrix):
            raise InputError(f"{len(inverse)} rows, but the matrix has {len(matrix)}", "key 'inverse'")
        one = tuple(tuple(tape.number(int(i == j)) for j in range(len(L))) for i in range(len(L)))
        residuals += _differences("matrix*inverse", tape, _product(tape, L, _loaded(question, inverse)), one)
    region = question.region(*(entry for part in (matrix, metric, inverse or ()) for row in part for entry in row))
    return with_value(question, question.decide(_pulled(question, residuals), region))


def matrix_group(question: Question) -> Outcome:
    """`matrix_group`: M(a) M(b) = M(θ(a, b)), with `composition` θ of the parameters `first`, a, and `second`, b.

    `matrix` is M(a). With `inverse`, formulas of a, M(a) times M(inverse) is 1 besides.
    """
    tape, matrix = question.tape, question.key("matrix")
    first, second = (question.nodes(question.key(word)) for word in ("first", "second"))
    theta = question.formulas("composition", len(first), side="both")
    if len(second) != len(first) or set(first) & set(second):
        raise InputError(f"{len(first)} other names are expected", "key 'second'")
    inverse = question.formulas("inverse", len(first), side="both") if question.key("inverse") is not None else ()
    M = _loaded(question, matrix)
    entries = [entry for row in matrix for entry in row]
    for entry in entries:
        is_free_of(entry, question.key("second"), "the matrix", "key 'second'")

    def at(values: Sequence[Node]) -> Rows:
        images = dict(zip(first, values, strict=True))
        return tuple(tuple(substitute(tape, node, images) for node in row) for row in M)

    together = [question.load(f) for f in theta]
    residuals = _differences("M(a)*M(b)", tape, _product(tape, M, at(second)), at(together))
    region = question.region(*entries, *theta, *inverse)
    places = [(second, "second"), (together, "composition")]
    if inverse:
        back = [question.load(f) for f in inverse]
        one = tuple(tuple(tape.number(int(i == j)) for j in range(len(M))) for i in range(len(M)))
        residuals += _differences("M(a)*M(inverse)", tape, _product(tape, M, at(back)), one)
        places.append((back, "inverse"))
    for place, word in places:
        moved = question.region(*entries, images=dict(zip(first, place, strict=True)), assumed=False)
        granted = [
            r
            for symbol, node in zip(question.key("first"), place, strict=True)
            for r in required_in_place_of(tape, symbol, question.chart.pull(node), f"key {word!r}")
        ]
        region = region.also(*(r for r in (*moved.requirements, *granted) if r not in region.requirements))
    return with_value(question, question.decide(_pulled(question, residuals), region))


def _loaded(question: Question, matrix: Sequence[Sequence[Formula]]) -> Rows:
    return tuple(tuple(question.load(entry) for entry in row) for row in matrix)


def _pulled(question: Question, residuals: Sequence[Residual]) -> list[Residual]:
    pull = question.chart.pull
    return [Residual(r.label, pull(r.node), None if r.actual is None else pull(r.actual)) for r in residuals]


def _transpose(matrix: Rows) -> Rows:
    return tuple(zip(*matrix, strict=True))


def _product(tape: Tape, *matrices: Rows) -> Rows:
    total = matrices[0]
    for matrix in matrices[1:]:
        columns = _transpose(matrix)
        total = tuple(
            tuple(tape.plus(*(tape.times(a, b) for a, b in zip(row, column, strict=True))) for column in columns)
            for row in total
        )
    return total


def _differences(name: str, tape: Tape, left: Rows, right: Rows) -> list[Residual]:
    return [
        Residual(f"row {i}, column {j} of {name}", tape.minus(a, b), a)
        for i, (some, others) in enumerate(zip(left, right, strict=True), 1)
        for j, (a, b) in enumerate(zip(some, others, strict=True), 1)
    ]


KINDS = {"invariant_interval": invariant_interval, "matrix_group": matrix_group}
