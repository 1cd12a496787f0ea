"""Structure constants of matrices under the commutator, by exact linear algebra over the rationals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_mat

from canon.errors import InputError
from canon.expected import instance_of, listed, shown, table
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.coefficients import Number
from canon.mechanics.algebra.lie_algebra import LieAlgebra

Entry = Fraction | int | sp.Expr | tuple[Fraction, Fraction]
"""A rational number, a pair (real part, imaginary part), or a sympy number with rational parts."""
Rows = Sequence[Sequence[Entry]] | sp.MatrixBase


@dataclass(frozen=True, slots=True)
class MatrixAlgebra:
    """What matrices span under their bracket.

    **Arguments:** `algebra`; `physicists`, whether the bracket is −i[A, B], since the real span doesn't close under the
    commutator (hermitian generators).
    """

    algebra: LieAlgebra
    physicists: bool

    def _repr_latex_(self) -> str:
        bracket = r"[A, B] = -i\,(A B - B A)" if self.physicists else "[A, B] = A B - B A"
        return self.algebra._repr_latex_().replace(r"\begin{aligned}", rf"{bracket}\colon\quad \begin{{aligned}}", 1)


class NotClosed(InputError):
    """A bracket that leaves the real span: `pair`, the names, and `value`, the commutator's entries."""

    def __init__(self, pair: tuple[str, str], value: list[list[str]]) -> None:
        text = "[" + ", ".join("[" + ", ".join(row) + "]" for row in value) + "]"
        super().__init__(f"the bracket [{pair[0]}, {pair[1]}] leaves the real span of the basis: it is {text}")
        self.pair = pair
        self.value = value


class Dependent(InputError):
    """Matrices that are linearly dependent over the reals: `relation`, as a formula that is 0."""

    def __init__(self, relation: str) -> None:
        super().__init__(f"the generators are linearly dependent: {relation} = 0")
        self.relation = relation


def algebra_of_matrices(matrices: Mapping[str, Rows]) -> MatrixAlgebra:
    """The real Lie algebra that square matrices of (Gaussian) rational entries span.

    The bracket is the commutator where the real span closes under it; where it doesn't but closes under −i[A, B], that
    is the bracket: physicists' generators J with [J_1, J_2] = i J_3.

    **Raises:** `Dependent`, `NotClosed`, or `InputError` where the matrices aren't square of one size.
    """
    table(matrices, "matrices", "matrices")
    names = tuple(matrices)
    real, imaginary = _parts(matrices)
    size = real[0].nrows()
    vectors = linear.matrix((_flat(a, b) for a, b in zip(real, imaginary, strict=True)), 2 * size * size)
    _check_independent(names, vectors)
    pairs = list(combinations(range(len(names)), 2))
    complex_ones = any(entry != 0 for b in imaginary for entry in b.entries())
    commutators = [_commutator(real, imaginary, i, j, complex_ones) for i, j in pairs]
    plain = linear.matrix((_flat(a, b) for a, b in commutators), 2 * size * size)
    physicists = False
    try:
        found = linear.coordinates(vectors, plain)
    except ValueError:
        turned = linear.matrix((_flat(b, -a) for a, b in commutators), 2 * size * size)
        try:
            found, physicists = linear.coordinates(vectors, turned), True
        except ValueError:
            k = _first_outside(vectors, plain)
            i, j = pairs[k]
            raise NotClosed((names[i], names[j]), _shown(*commutators[k])) from None
    constants: dict[tuple[int, int], dict[int, Number]] = {}
    for pair, row in zip(pairs, linear.rows(found), strict=True):
        values: dict[int, Number] = {c: linear.fraction(value) for c, value in enumerate(row) if value != 0}
        if values:
            constants[pair] = values
    return MatrixAlgebra(LieAlgebra(names, constants), physicists)


def real_matrices(matrices: Mapping[str, Rows]) -> list[fmpq_mat]:
    """The matrices where all are real, or M for physicists' generators iM; **raises** `InputError` else."""
    real, imaginary = _parts(matrices)
    for kept, gone in ((real, imaginary), (imaginary, real)):
        if not any(entry != 0 for values in gone for entry in values.entries()):
            return kept
    raise InputError("real matrices are expected, or imaginary ones")


def _parts(matrices: Mapping[str, Rows]) -> tuple[list[fmpq_mat], list[fmpq_mat]]:
    real, imaginary = [], []
    if not matrices:
        raise InputError("no matrices are given")
    size = 0
    for name, given in matrices.items():
        where = f"matrices, {shown(name)}"
        instance_of(name, str, where)
        rows = given.tolist() if isinstance(given, sp.MatrixBase) else listed(given, "rows", where)
        rows = [listed(row, "entries", where) for row in rows]
        size = size or len(rows)
        if not rows or len(rows) != size or any(len(row) != size for row in rows):
            raise InputError(f"square matrices of one size are expected: {name} isn't {size} by {size}")
        entries = [_complex_parts(entry) for row in rows for entry in row]
        real.append(fmpq_mat(size, size, [_rational(a) for a, _ in entries]))
        imaginary.append(fmpq_mat(size, size, [_rational(b) for _, b in entries]))
    return real, imaginary


def _complex_parts(entry: Any) -> tuple[Any, Any]:
    if isinstance(entry, sp.Expr):
        real, imaginary = entry.as_real_imag()
        if not (isinstance(real, sp.Rational) and isinstance(imaginary, sp.Rational)):
            raise InputError(f"{entry} is no rational number, nor one times i: a claim 'matrix_algebra' takes others")
        return Fraction(real.p, real.q), Fraction(imaginary.p, imaginary.q)
    if isinstance(entry, tuple) and len(entry) != 2:
        raise InputError(f"a pair (real part, imaginary part) is expected, not {entry!r}")
    return entry if isinstance(entry, tuple) else (entry, 0)


def _rational(value: Fraction | int) -> fmpq:
    if not isinstance(value, (Fraction, int)):
        raise InputError(f"{value!r} is no exact number: give whole numbers or fractions")
    return linear.rational(value)


def _flat(a: fmpq_mat, b: fmpq_mat) -> list[fmpq]:
    return [*a.entries(), *b.entries()]


def _commutator(
    real: list[fmpq_mat], imaginary: list[fmpq_mat], i: int, j: int, complex_ones: bool
) -> tuple[fmpq_mat, fmpq_mat]:
    a, c = real[i], real[j]
    if not complex_ones:
        return a * c - c * a, imaginary[i]
    b, d = imaginary[i], imaginary[j]
    return a * c - b * d - (c * a - d * b), a * d + b * c - (c * b + d * a)


def _check_independent(names: tuple[str, ...], vectors: fmpq_mat) -> None:
    relations = linear.rows(linear.null_space(vectors.transpose()))
    if relations:
        zero = LieAlgebra(names, {})
        raise Dependent(zero.show({c: linear.fraction(v) for c, v in enumerate(relations[0]) if v != 0}))


def _first_outside(vectors: fmpq_mat, products: fmpq_mat) -> int:
    space = linear.span(linear.rows(vectors), vectors.ncols())
    return next(k for k, row in enumerate(linear.rows(products)) if not linear.contains(space, row))


def _shown(a: fmpq_mat, b: fmpq_mat) -> list[list[str]]:
    def entry(u: fmpq, v: fmpq) -> str:
        if v == 0:
            return str(u)
        turning = "1j" if v == 1 else "-1j" if v == -1 else f"{v}*1j"
        return turning if u == 0 else f"{u} + {turning}"

    return [[entry(u, v) for u, v in zip(x, y, strict=True)] for x, y in zip(a.tolist(), b.tolist(), strict=True)]
