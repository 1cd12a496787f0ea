"""Classical algebras by the forms that their matrices keep, the names of all real forms, and types by their roots."""

from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpq_mat, fmpz_mat

from canon.mechanics.algebra.complex_type import ComplexType, complex_type
from canon.mechanics.algebra.from_matrices import algebra_of_matrices
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.identity import RealSimple, isomorphic
from canon.mechanics.algebra.names import read_name
from canon.mechanics.algebra.real_forms import compact_dimensions, is_ambiguous, real_form_names
from canon.mechanics.algebra.root_system import positive_roots

Law = Callable[[Any], Any]
"""Of a complex matrix, real-linear; it vanishes for those of the algebra."""


def metric(p: int, q: int = 0) -> Any:
    return np.diag([1] * p + [-1] * q)


def symplectic_form(n: int) -> Any:
    return np.kron([[0, 1], [-1, 0]], np.eye(n, dtype=int))


def bilinear(form: Any) -> Law:
    return lambda X: X.T @ form + form @ X


def hermitian(form: Any) -> Law:
    return lambda X: X.conj().T @ form + form @ X


def is_real(X: Any) -> Any:
    return X - X.conj()


def trace(X: Any) -> Any:
    return np.array([[np.trace(X)]])


def quaternionic(n: int) -> Law:
    return lambda X: X @ symplectic_form(n) - symplectic_form(n) @ X.conj()


def matrices_with(n: int, laws: tuple[Law, ...]) -> dict[str, Any]:
    """A basis over the reals of all complex n × n matrices with these laws, by flint's null space."""
    units = [factor * np.eye(n * n)[k].reshape(n, n) for factor in (1, 1j) for k in range(n * n)]
    columns = []
    for X in units:
        values = np.concatenate([law(X).ravel() for law in laws]) if laws else np.zeros(1)
        columns.append([*map(int, values.real), *map(int, values.imag)])
    null, count = fmpz_mat(columns).transpose().nullspace()
    found = {}
    for k in range(count):
        row = [int(null[i, k]) for i in range(2 * n * n)]
        found[f"x{k}"] = [[(row[n * i + j], row[n * n + n * i + j]) for j in range(n)] for i in range(n)]
    return found


ALGEBRAS: dict[str, tuple[int, tuple[Law, ...]]] = {
    "so(2,1)": (3, (is_real, bilinear(metric(2, 1)))),
    "so(3,2)": (5, (is_real, bilinear(metric(3, 2)))),
    "so(3,3)": (6, (is_real, bilinear(metric(3, 3)))),
    "su(1,1)": (2, (hermitian(metric(1, 1)), trace)),
    "su(2,1)": (3, (hermitian(metric(2, 1)), trace)),
    "su(2,2)": (4, (hermitian(metric(2, 2)), trace)),
    "u(1,1)": (2, (hermitian(metric(1, 1)),)),
    "u(2)": (2, (hermitian(metric(2)),)),
    "su*(2)": (2, (quaternionic(1), trace)),
    "su*(4)": (4, (quaternionic(2), trace)),
    "so*(2)": (2, (bilinear(metric(2)), hermitian(symplectic_form(1)))),
    "so*(4)": (4, (bilinear(metric(4)), hermitian(symplectic_form(2)))),
    "so*(6)": (6, (bilinear(metric(6)), hermitian(symplectic_form(3)))),
    "usp(2)": (2, (bilinear(symplectic_form(1)), hermitian(metric(2)))),
    "usp(4)": (4, (bilinear(symplectic_form(2)), hermitian(metric(4)))),
    "usp(2,2)": (4, (bilinear(symplectic_form(2)), hermitian(np.kron(metric(2), metric(1, 1))))),
    "usp(4,2)": (6, (bilinear(symplectic_form(3)), hermitian(np.kron(metric(2), metric(2, 1))))),
    "sp(2,R)": (2, (is_real, bilinear(symplectic_form(1)))),
    "sp(6,R)": (6, (is_real, bilinear(symplectic_form(3)))),
    "sp(2,C)": (2, (bilinear(symplectic_form(1)),)),
    "sp(4,C)": (4, (bilinear(symplectic_form(2)),)),
    "so(3,C)": (3, (bilinear(metric(3)),)),
    "so(4,C)": (4, (bilinear(metric(4)),)),
    "so(2,C)": (2, (bilinear(metric(2)),)),
    "sl(2,R)": (2, (is_real, trace)),
    "sl(4,R)": (4, (is_real, trace)),
    "sl(2,C)": (2, (trace,)),
    "gl(2,R)": (2, (is_real,)),
    "gl(2,C)": (2, ()),
    "gl(1,C)": (1, ()),
}


@pytest.mark.parametrize("name", ALGEBRAS)
def test_what_keeps_the_forms_has_the_name(name: str) -> None:
    """Helgason's definitions of the classical groups (1978, X.2), as linear equations."""
    algebra = algebra_of_matrices(matrices_with(*ALGEBRAS[name])).algebra
    named = read_name(name)
    found = identify(algebra)
    assert isomorphic(found.identity, named) is True
    assert found.identity.dimension == named.dimension == algebra.dimension
    positive, negative, zero = found.killing_signature
    assert negative == sum(s.compact_dimension for s in named.simple)
    assert (zero, positive + negative) == (named.abelian, sum(s.dimension for s in named.simple))


KINDS = [
    ComplexType(letter, rank)
    for letter, ranks in (("A", range(1, 8)), ("B", range(2, 7)), ("C", range(3, 8)), ("D", range(4, 8)))
    for rank in ranks
]


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_every_real_form_is_read_back_from_each_of_its_names(kind: ComplexType) -> None:
    compact = compact_dimensions(kind)
    for size in compact:
        for name in real_form_names(kind, False, size):
            assert read_name(name).simple == (RealSimple(kind, False, size),), name
        same = str(kind) == "D4" and size == 16  # so(6,2) is so*(8)
        assert is_ambiguous(kind, False, size) == (compact.count(size) > 1 and not same)
    for name in real_form_names(kind, True, kind.dimension):
        assert read_name(name).simple == (RealSimple(kind, True, kind.dimension),)


@pytest.mark.parametrize(
    ("kind", "count"),
    [(("A", 1), 2), (("A", 2), 3), (("A", 3), 5), (("A", 4), 4), (("A", 5), 6), (("B", 2), 3), (("B", 4), 5),
     (("C", 3), 3), (("C", 4), 4), (("D", 5), 7), (("G", 2), 2), (("F", 4), 3), (("E", 6), 5), (("E", 7), 4),
     (("E", 8), 3)],
)  # fmt: skip
def test_there_are_as_many_real_forms_as_cartan_found(kind: tuple[str, int], count: int) -> None:
    """The compact one and the split one among them: characters −dim and rank, all between, all of dim's parity."""
    type_ = ComplexType(*kind)
    characters = [type_.dimension - 2 * compact for compact in compact_dimensions(type_)]
    assert len(characters) == count
    assert (min(characters), max(characters)) == (-type_.dimension, type_.rank)
    assert [characters.count(c) for c in (-type_.dimension, type_.rank)] == [1, 1]
    if kind[0] in "EFG":  # named by their characters
        for compact, character in zip(compact_dimensions(type_), characters, strict=True):
            assert real_form_names(type_, False, compact) == (f"{kind[0].lower()}{kind[1]}({character})",)
        assert real_form_names(type_, True, type_.dimension) == (f"{kind[0].lower()}{kind[1]}(C)",)


@pytest.mark.parametrize(
    "kind", [("B", 3), ("C", 3), ("B", 4), ("C", 4), ("B", 5), ("C", 5), ("B", 6), ("C", 6), ("E", 6)]
)
def test_types_of_one_dimension_are_told_by_the_spectrum(kind: tuple[str, int]) -> None:
    """ad x of an element of the Cartan subalgebra is diagonal, with the roots' values."""
    type_, random = ComplexType(*kind), Random(5)
    x = [random.randint(-9, 9) for _ in range(type_.rank)]
    values = [sum(c * v for c, v in zip(root, x, strict=True)) for root in positive_roots(type_)]
    diagonal = [*values, *(-v for v in values), *[0] * type_.rank]
    n = len(diagonal)
    ad = fmpq_mat(n, n, [fmpq(diagonal[i]) if i == j else fmpq(0) for i in range(n) for j in range(n)])
    assert complex_type(n, type_.rank, ad) == type_
    with pytest.raises(ArithmeticError, match="may be"):
        complex_type(n, type_.rank, None)
