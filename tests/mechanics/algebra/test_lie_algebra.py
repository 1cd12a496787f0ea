"""Structure constants as a value: verified on construction, transformed, with their classical invariants."""

import copy
import random
from fractions import Fraction
from typing import Any

import pytest
import sympy as sp
from flint import fmpq

from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.ideals import (
    centre,
    derived_series,
    is_ideal,
    lower_central_series,
    quotient,
    radical,
)
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.levi import levi_decomposition
from canon.mechanics.algebra.lie_algebra import LieAlgebra, structure

SO3 = {"x,y": {"z": 1}, "y,z": {"x": 1}, "z,x": {"y": 1}}
EPSILON = {(0, 1): 2, (1, 2): 0, (2, 0): 1}


def two_vectors(sign):
    """[J, J] = J, [J, K] = K, [K, K] = sign J: so(4), e(3) or so(3,1)."""
    table = {}
    for (i, j), k in EPSILON.items():
        table[f"J{i},J{j}"] = {f"J{k}": 1}
        table[f"J{i},K{j}"] = {f"K{k}": 1}
        table[f"J{j},K{i}"] = {f"K{k}": -1}
        table[f"K{i},K{j}"] = {f"J{k}": sign}
    return structure(("J0", "J1", "J2", "K0", "K1", "K2"), table)


def test_brackets_are_bilinear_and_antisymmetric():
    g = structure("xyz", SO3)
    assert g.bracket({"x": 2, "y": 1}, {"z": 3}) == {"x": 3, "y": -6}
    assert g.bracket({"z": 3}, {"x": 2, "y": 1}) == {"x": -3, "y": 6}
    assert hash(g) == hash(structure("xyz", {"x,y": "z", "z,y": "-x", "z,x": "y"}))


def test_a_violation_of_jacobis_identity_names_the_triple():
    """Course sec-7.8-c: a spoiled table of so(4) is no Lie algebra."""
    with pytest.raises(InputError, match=r"Jacobi's identity fails for x, y, h.*add up to -?z"):
        structure("xyzh", {**SO3, "x,h": {"x": 1}})
    a = sp.Symbol("a", positive=True)
    for value in (a, a / 10**50, sp.sqrt(2) / 10**60):  # however small
        with pytest.raises(InputError, match="Jacobi"):
            structure("xyzh", {**SO3, "x,h": {"x": value}})


def test_constants_that_hide_zeros():
    """√(3 + 2√2) − 1 − √2 is 0 and not nearly 0: no bracket; the same number written twice is no contradiction."""
    zero = sp.sqrt(3 + 2 * sp.sqrt(2)) - 1 - sp.sqrt(2)
    g = structure("xyzh", {**SO3, "x,h": {"x": zero}, "y,x": {"z": zero - 1}})
    assert g.bracket_of(0, 3) == {}
    with pytest.raises(InputError, match="fails for x, y, h"):
        structure("xyzh", {**SO3, "x,h": {"x": zero + sp.Rational(1, 10**70)}})
    with pytest.raises(InputError, match="twice, differently"):
        structure("xyzh", {**SO3, "y,x": {"z": zero - 1 - sp.Rational(1, 10**70)}})


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"x,w": {"z": 1}}, "a pair of the basis"),
        ({"x,y": {"w": 1}}, "none of the basis"),
        ({"x,x": {"z": 1}}, "with itself is 0"),
        ({"x,y": {"z": 1}, "y,x": {"z": 1}}, "stated twice"),
        ({"x,y": {"z": 0.5}}, "no exact number"),
        ({"x,y": "z**2"}, "a linear combination"),
    ],
)
def test_what_is_no_table_is_refused(table, message):
    with pytest.raises(InputError, match=message):
        structure("xyz", table)


def test_killing_forms_tell_real_forms():
    """Signature of K: compact so(4), so(3,1), and e(3), whose translations it doesn't see."""
    for sign, signature in ((1, (0, 6, 0)), (-1, (3, 3, 0)), (0, (0, 3, 3))):
        assert linear.signature(two_vectors(sign).killing_form()) == signature


def test_a_change_of_basis_takes_so4_apart():
    g = two_vectors(1)
    half = linear.rational(Fraction(1, 2))
    rows = [[half * (k == i) + s * half * (k == i + 3) for k in range(6)] for s in (1, -1) for i in range(3)]
    split = g.in_basis(linear.matrix(rows, 6), ("a0", "a1", "a2", "b0", "b1", "b2"))
    assert list(split.rows()) == [
        ("a0", "a1", "a2"), ("a0", "a2", "-a1"), ("a1", "a2", "a0"),
        ("b0", "b1", "b2"), ("b0", "b2", "-b1"), ("b1", "b2", "b0"),
    ]  # fmt: skip
    with pytest.raises(InputError, match="make a subalgebra"):
        g.in_basis(linear.matrix(rows[1:3], 6))


def test_series_of_a_solvable_and_of_a_nilpotent_algebra():
    plane = structure(("L", "x", "y"), {"L,x": {"y": 1}, "L,y": {"x": -1}})
    heisenberg = structure(("q", "p", "one"), {"q,p": {"one": 1}})
    assert [s.nrows() for s in derived_series(plane)] == [3, 2, 0]
    assert [s.nrows() for s in lower_central_series(plane)] == [3, 2]
    assert [s.nrows() for s in lower_central_series(heisenberg)] == [3, 1, 0]
    assert centre(heisenberg).nrows() == 1
    assert centre(plane).nrows() == 0


def test_levi_subalgebra_of_a_twisted_basis():
    """e(3) with J_i + P_i in place of J_i, and J_1 + 2 P_2: the subalgebra has to be found again."""
    g = two_vectors(0)
    rows = [[int(k == i) for k in range(6)] for i in range(6)]
    rows[0][4], rows[1][5], rows[2][3] = 2, -3, 5
    twisted = g.in_basis(linear.matrix([[linear.rational(v) for v in row] for row in rows], 6))
    S, R = levi_decomposition(twisted)
    assert (S.nrows(), R.nrows()) == (3, 3)
    assert list(twisted.in_basis(S).killing_form().rref())[1] == 3
    assert is_ideal(twisted, R)
    assert radical(twisted) == R
    assert not is_ideal(twisted, S)
    assert quotient(twisted, R).dimension == 3


def test_it_is_a_value():
    """Neither its constants nor a bracket can be written to; a copy is equal, with the same hash."""
    so3 = LieAlgebra.of(("a", "b", "c"), {"a,b": "c", "b,c": "a", "c,a": "b"})
    rows: list[Any] = [so3.constants, so3.constants[0, 1], so3.bracket_of(1, 0), so3.bracket_of(0, 0)]
    for row in rows:
        with pytest.raises(TypeError):
            row[2] = 5
    again = copy.deepcopy(so3)
    assert (again, hash(again), repr(again)) == (so3, hash(so3), repr(so3))
    one, other = (LieAlgebra.of(("a", "b"), {"a,b": row}) for row in ({"a": 1, "b": 2}, {"b": 2, "a": 1}))
    assert (one, hash(one)) == (other, hash(other))


def test_a_change_of_basis_by_nested_lists():
    g = structure("xyz", SO3)
    turned = g.in_basis([[1, 1, 0], [1, -1, 0], [0, 0, Fraction(1, 2)]], "uvw")
    assert list(turned.rows()) == [("u", "v", "-4*w"), ("u", "w", "v/2"), ("v", "w", "-u/2")]
    with pytest.raises(InputError, match="basis: 3 components are expected"):
        g.in_basis([[1, 1]])
    with pytest.raises(InputError, match="subalgebra"):
        g.in_basis([[1, 0, 0], [0, 1, 0]])


@pytest.mark.parametrize(
    ("constants", "message"),
    [
        ({(0, 5): {1: 1}}, "positions"), ({(0, 1): {7: 1}}, "positions"), ({(0, -1): {0: 1}}, "positions"),
        ({(0, 1): {1: sp.oo}}, "no number"), ({(0, 1): {1: sp.nan}}, "no number"), ({(0, 1): {1: sp.I}}, "isn't real"),
        ({(0, 1): {1: 0.5}}, "no exact number"), ({(0, 1): {1: "x"}}, "no exact number"),
    ],
)  # fmt: skip
def test_constants_that_are_none(constants, message):
    with pytest.raises(InputError, match=message):
        LieAlgebra(("x", "y"), constants)


def test_a_full_table_is_verified_and_named_like_a_sparse_one():
    """so(4) in a basis chosen at random, and with one constant changed by a little: some triple fails."""
    rng, n = random.Random(0), 6
    g = two_vectors(1)
    full = g.in_basis([[rng.randint(-3, 3) for _ in range(n)] for _ in range(n)])
    assert sum(len(row) for row in full.constants.values()) > 60
    assert identify(full).identity.name == "so(4)"
    x, y = [fmpq(1), fmpq(2), *[fmpq(0)] * 4], [fmpq(k) for k in range(n)]
    assert full.killing_form() == linear.matrix(full_killing(full), n)
    assert full.product(x, y) == [-v for v in full.product(y, x)]
    table = {pair: dict(row) for pair, row in full.constants.items()}
    pair, row = next(iter(table.items()))
    table[pair] = {c: value + Fraction(1, 10**30) for c, value in row.items()}
    with pytest.raises(InputError, match="Jacobi's identity fails"):
        LieAlgebra(full.names, table)


def full_killing(g):
    """The Killing form by its definition, entry by entry."""
    n = g.dimension
    ad = [
        [[linear.rational(g.bracket_of(a, b).get(c, Fraction(0))) for b in range(n)] for c in range(n)]
        for a in range(n)
    ]
    return [[sum(ad[a][i][j] * ad[b][j][i] for i in range(n) for j in range(n)) for b in range(n)] for a in range(n)]
