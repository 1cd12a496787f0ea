"""`group` by matrices: M(θ) near 0 is a group of matrices with θ for coordinates, and its structure constants.

With M(0) = 1 and X_i = ∂_i M(0) independent over the reals it is one, if and only if M⁻¹ ∂_i M lies in the real span of
the X_j for all θ near 0 (the form of Maurer and Cartan): then ∂M = M X integrates to a subgroup, of which M is a chart,
and the second-order coefficients of θ(a, b) in M(a) M(b) = M(θ(a, b)) are f^i_jk X_i = X_j X_k − ∂_j ∂_k M(0), so that
C^i_jk X_i = −[X_j, X_k]. Helgason, Differential Geometry, Lie Groups, and Symmetric Spaces (1978), II.2 and II.7.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.fixed_parameters import fixed_region
from canon.claims.group import germ
from canon.claims.matrix_algebra import COMMUTATOR, closings, independent_entries
from canon.claims.outcome import Outcome, Residual
from canon.claims.scaled_matrices import scaled_matrices, unscaled
from canon.claims.show import neat
from canon.decide.derivative import derivative, substitute
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.mechanics.algebra.coefficients import times
from canon.mechanics.algebra.from_matrices import Dependent, NotClosed, algebra_of_matrices
from canon.mechanics.algebra.lie_algebra import LieAlgebra

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

Rows = list[list[Node]]
LARGEST = 12
"""The largest matrices, as real ones, of which the inverse is found where none is given."""


class NoChart(InputError):
    """Matrices whose derivatives at the identity don't make a basis of a Lie algebra."""


def outcomes(question: Question) -> tuple[list[Outcome], Region]:
    """What is to be shown but the constants, one after the other; and the region at the identity.

    **Raises:** `NoChart` where the derivatives at 0 are dependent.
    """
    tape, names = question.tape, question.nodes(question.key("first"))
    entries = [entry for key in ("matrix", "inverse") for row in question.key(key) or () for entry in row]
    region = question.region(*entries)
    zero = dict.fromkeys(names, tape.zero)
    at_zero = fixed_region(tape, region, zero)
    if at_zero is None:
        raise InputError("the matrix isn't smooth at the identity, where all parameters are 0")
    M = _loaded(question, "matrix")
    size = len(M)
    one = [[tape.number(int(i == j)) for j in range(size)] for i in range(size)]
    start = [[substitute(tape, node, zero) for node in row] for row in M]
    found = [question.decide(_differences(tape, "M(0)", start, one), at_zero)]
    if question.key("inverse") is not None:
        back = _loaded(question, "inverse")
        if len(back) != size:
            raise InputError(f"{len(back)} rows, but the matrix has {size}", "key 'inverse'")
        residuals = _differences(tape, "M times its inverse", _product(tape, M, back), one)
        found.append(germ(question, residuals, [region], names, at_zero))
    elif size > LARGEST:
        raise InputError(f"state the inverse of a matrix of {size} real rows as 'inverse'", "key 'matrix'")
    else:
        back = _adjugate(tape, M)  # the inverse but for a factor, the determinant, which isn't 0 near the identity
    if any(outcome.status == "refuted" for outcome in found):
        return found, at_zero
    scaled = scaled_matrices(_generators(question))
    try:
        if scaled is not None:
            algebra_of_matrices(scaled[1])
    except Dependent as error:
        where = "independence of the derivatives at the identity"
        return [question.refuted_exactly(at_zero, error.message, fails=where)], at_zero
    except NotClosed:
        pass  # the form of Maurer and Cartan shows it too
    found.append(germ(question, list(_outside(question, M, back, names)), [region], names, at_zero))
    return found, at_zero


def constants(question: Question) -> LieAlgebra:
    """C^i_jk with C^i_jk X_i = −[X_j, X_k]. **Raises:** `NoChart` where the X_j are dependent or don't close."""
    names = tuple(symbol.name for symbol in question.key("first"))
    generators = _generators(question)
    try:
        scaled = scaled_matrices(generators)
        if scaled is not None:
            found = algebra_of_matrices(scaled[1])
            if found.physicists:
                raise NoChart("the derivatives at the identity don't close under the commutator")
            algebra = unscaled(found.algebra, scaled[0])
        else:
            region = question.region(*(entry for row in question.key("matrix") for entry in row))
            known = [a for _, a, words in closings(question, region, generators) if words == COMMUTATOR]
            if not known or known[0] is None:
                raise NoChart("it isn't known that the derivatives at the identity close under the commutator")
            algebra = known[0]
    except (Dependent, NotClosed) as error:
        raise NoChart(error.message) from None
    turned = {pair: {c: times(v, Fraction(-1)) for c, v in row.items()} for pair, row in algebra.constants.items()}
    return LieAlgebra(names, turned)


def _generators(question: Question) -> dict[str, list[list[Any]]]:
    """∂_i M(0) by the names of the parameters."""
    tape, names = question.tape, question.nodes(question.key("first"))
    zero = dict.fromkeys(names, tape.zero)
    M = _loaded(question, "matrix")
    return {
        symbol.name: [[neat(tape.to_sympy(substitute(tape, derivative(tape, e, x), zero))) for e in row] for row in M]
        for symbol, x in zip(question.key("first"), names, strict=True)
    }


def _outside(question: Question, M: Rows, back: Rows, names: Sequence[Node]) -> list[Residual]:
    """M⁻¹ ∂_i M less the combination of the X_j that agrees with it in as many entries as there are of them."""
    tape, size = question.tape, len(M)
    generators = list(_generators(question).values())
    flat = [[entry for row in rows for entry in row] for rows in generators]
    columns = independent_entries(flat)
    if columns is None:
        raise NoChart("the derivatives of the matrix at the identity are linearly dependent, or not seen not to be")
    inverse: Any = sp.Matrix([[row[k] for k in columns] for row in flat]).inv()
    weights = [[question.load(inverse[k, j]) for j in range(len(flat))] for k in range(len(columns))]
    basis = [[question.load(entry) for entry in row] for row in flat]
    residuals = []
    for symbol, x in zip(question.key("first"), names, strict=True):
        form = _product(tape, back, [[derivative(tape, entry, x) for entry in row] for row in M])
        values = [entry for row in form for entry in row]
        coordinates = [
            tape.plus(*(tape.times(values[k], weights[n][j]) for n, k in enumerate(columns))) for j in range(len(basis))
        ]
        for k in range(size * size):
            if k not in columns:
                inside = tape.plus(*(tape.times(c, row[k]) for c, row in zip(coordinates, basis, strict=True)))
                label = f"row {k // size + 1}, column {k % size + 1} of M⁻¹ ∂M/∂{symbol.name}, outside the span"
                residuals.append(Residual(label, tape.minus(values[k], inside)))
    return residuals


def _loaded(question: Question, key: str) -> Rows:
    """The matrix as a real one: z = x + i y as [[x, −y], [y, x]]."""
    parts = [[_real_and_imaginary(entry.expr) for entry in row] for row in question.key(key)]
    if not any(y != 0 for row in parts for _, y in row):
        return [[question.load(x) for x, _ in row] for row in parts]
    upper = [[*(question.load(x) for x, _ in row), *(question.load(-y) for _, y in row)] for row in parts]
    lower = [[*(question.load(y) for _, y in row), *(question.load(x) for x, _ in row)] for row in parts]
    return [*upper, *lower]


def _real_and_imaginary(value: Any) -> tuple[Any, Any]:
    if value.is_real or not (value.has(sp.I) or any(not symbol.is_real for symbol in value.free_symbols)):
        return value, sp.S.Zero
    real, imaginary = value.as_real_imag()
    if real.has(sp.re, sp.im) or imaginary.has(sp.re, sp.im):
        expanded = sp.expand(value, complex=True)
        imaginary = expanded.coeff(sp.I)
        real = sp.expand(expanded - sp.I * imaginary)
    if real.has(sp.I, sp.re, sp.im) or imaginary.has(sp.I, sp.re, sp.im):
        raise InputError(f"the real and imaginary parts of {value} aren't seen: write it as x + 1j*y", "key 'matrix'")
    return real, imaginary


def _product(tape: Tape, a: Rows, b: Rows) -> Rows:
    columns = list(zip(*b, strict=True))
    return [
        [tape.plus(*(tape.times(x, y) for x, y in zip(row, column, strict=True))) for column in columns] for row in a
    ]


def _adjugate(tape: Tape, M: Rows) -> Rows:
    """By cofactors, each minor of the last rows once."""
    size = len(M)
    known: dict[tuple[tuple[int, ...], tuple[int, ...]], Node] = {}

    def minor(rows: tuple[int, ...], columns: tuple[int, ...]) -> Node:
        if not rows:
            return tape.one
        if (rows, columns) not in known:
            terms = []
            for k, j in enumerate(columns):
                if M[rows[0]][j] != tape.zero:
                    inner = minor(rows[1:], (*columns[:k], *columns[k + 1 :]))
                    terms.append(tape.scaled(tape.times(M[rows[0]][j], inner), (-1) ** k))
            known[rows, columns] = tape.plus(*terms)
        return known[rows, columns]

    def without(k: int) -> tuple[int, ...]:
        return tuple(i for i in range(size) if i != k)

    return [[tape.scaled(minor(without(j), without(i)), (-1) ** (i + j)) for j in range(size)] for i in range(size)]


def _differences(tape: Tape, name: str, left: Rows, right: Rows) -> list[Residual]:
    return [
        Residual(f"row {i}, column {j} of {name}", tape.minus(a, b), a)
        for i, (some, others) in enumerate(zip(left, right, strict=True), 1)
        for j, (a, b) in enumerate(zip(some, others, strict=True), 1)
    ]
