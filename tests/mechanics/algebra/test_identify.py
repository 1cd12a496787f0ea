"""Which algebra it is: families of matrices recognised, mutants and neighbours told apart."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.algebra.complex_type import ComplexType, complex_type
from canon.mechanics.algebra.from_matrices import Dependent, NotClosed, algebra_of_matrices
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.identity import isomorphic
from canon.mechanics.algebra.lie_algebra import structure
from canon.mechanics.algebra.names import read_name
from canon.mechanics.algebra.rescaling import rescaled
from canon.mechanics.algebra.semisimple import cartan_subalgebra
from canon.mechanics.algebra.standard import euclidean, hermitian, orthogonal, special_linear, symplectic, unit
from tests.mechanics.algebra.test_lie_algebra import EPSILON, two_vectors

NAMED = {
    "so(3)": orthogonal(3), "so(2,1)": orthogonal(2, 1), "so(4)": orthogonal(4), "so(3,1)": orthogonal(3, 1),
    "so(2,2)": orthogonal(2, 2), "so(5)": orthogonal(5), "so(4,1)": orthogonal(4, 1), "so(3,2)": orthogonal(3, 2),
    "so(6)": orthogonal(6), "so(4,2)": orthogonal(4, 2), "so(5,2)": orthogonal(5, 2), "so(8)": orthogonal(8),
    "so(7)": orthogonal(7), "sp(2,R)": symplectic(1), "sp(4,R)": symplectic(2), "sp(6,R)": symplectic(3),
    "su(2)": hermitian(2), "su(3)": hermitian(3), "u(3)": hermitian(3, trace=True), "sl(3,R)": special_linear(3),
    "sl(2,C)": special_linear(2, complex_field=True), "sl(3,C)": special_linear(3, complex_field=True),
    "e(2)": euclidean(2), "e(3)": euclidean(3), "iso(1,1)": euclidean(1, 1), "poincare": euclidean(3, 1),
    "e(4)": euclidean(4), "iso(2,1)": euclidean(2, 1),
}  # fmt: skip
FOUND = {name: algebra_of_matrices(matrices) for name, matrices in NAMED.items()}
SAME = {frozenset(pair) for pair in (
    ("so(3)", "su(2)"), ("so(2,1)", "sp(2,R)"), ("so(3,2)", "sp(4,R)"), ("so(3,1)", "sl(2,C)"),
)}  # fmt: skip


@pytest.mark.parametrize("name", NAMED)
def test_matrices_are_recognised_and_told_from_all_others(name):
    identity = identify(FOUND[name].algebra).identity
    for other in NAMED:
        expected = other == name or frozenset((name, other)) in SAME
        assert isomorphic(identity, read_name(other)) is expected, other
    assert FOUND[name].physicists == (name in ("su(2)", "su(3)", "u(3)"))


def galilei(mass=None, wrong=1):
    """Galilei's algebra; with its mass as a central element."""
    table = {}
    for (i, j), k in EPSILON.items():
        table[f"J{i},J{j}"] = {f"J{k}": 1}
        for X in "KP":
            table[f"J{i},{X}{j}"] = {f"{X}{k}": 1}
            table[f"J{j},{X}{i}"] = {f"{X}{k}": -1}
    for i in range(3):
        table[f"K{i},H"] = {f"P{i}": wrong}
        if mass:
            table[f"K{i},P{i}"] = {"M": mass}
    names = [f"{X}{i}" for X in "JKP" for i in range(3)]
    return structure([*names, "H", *(["M"] if mass else [])], table)


def test_algebras_that_are_no_direct_sums_of_simple_ones():
    assert identify(galilei()).identity.name == "galilei"
    assert identify(galilei(mass=-2)).identity.name == "bargmann"
    assert identify(galilei(wrong=0)).identity.name not in ("galilei", "bargmann")
    heisenberg = structure(("q", "x", "p", "y", "one"), {"q,p": {"one": 1}, "x,y": {"one": 3}})
    assert identify(heisenberg).identity.name == "heisenberg(2)"
    assert identify(structure(("a", "b", "c"), {"a,b": {"b": 1}})).identity.name == "aff(1) + u(1)"
    assert identify(structure(("a", "b"), {})).identity.name == "u(1)^2"


def test_so4_is_split_by_the_sum_and_difference_of_its_vectors():
    """(M ± D)/2, found by itself: course sec-13.12-h."""
    first, second = identify(two_vectors(1)).ideal_bases()
    assert {first, second} == {("J0 + K0", "J1 + K1", "J2 + K2"), ("J0 - K0", "J1 - K1", "J2 - K2")}


def test_ideals_over_the_reals_that_are_none_over_the_rationals():
    """[K, K] = 2 J needs √2 to be taken apart: still so(4), and with −3 still so(3,1)."""
    for sign, name in ((2, "so(4)"), (-3, "so(3,1)")):
        assert identify(two_vectors(sign)).identity.name == name


def test_real_forms_over_a_real_field_are_told_one_by_one():
    """so of x² + y² + √2 z² and of its conjugate x² + y² − √2 z²: so(3) + sl(2,R), by restriction of scalars."""
    table = {}
    for a, b, c, root in (("x", "y", "z", False), ("y", "z", "x", True), ("z", "x", "y", True)):
        # [a, b] = w c with w = 1 or √2, over Q(√2) with basis 1, s: s² = 2
        for s, t in ((0, 0), (0, 1), (1, 0), (1, 1)):
            power = s + t + root
            table[f"{a}{s},{b}{t}"] = {f"{c}{power % 2}": 2 ** (power // 2)}
    g = structure([f"{v}{s}" for v in "xyz" for s in (0, 1)], table)
    assert (
        identify(g).identity
        == identify(
            structure("xyzuvw", {"x,y": "z", "y,z": "x", "z,x": "y", "u,v": "w", "v,w": "-u", "w,u": "-v"})
        ).identity
    )


def test_parameters_are_scaled_away_where_their_sign_is_known():
    """Kepler's 2 m E with E < 0, = 0 (no bracket), > 0; of unknown sign nothing is said."""
    m, E = sp.Symbol("m", positive=True), sp.Symbol("E", negative=True)
    names = {sign: identify(rescaled(two_vectors(sign)).algebra).identity.name for sign in (-2 * m * E, 2 * m * E)}
    assert names == {-2 * m * E: "so(4)", 2 * m * E: "so(3,1)"}
    assert rescaled(two_vectors(sp.Symbol("E", real=True))) is None
    found = rescaled(two_vectors(sp.sqrt(2) * m))
    assert identify(found.algebra).identity.name == "so(4)"


def test_b_and_c_of_one_rank_are_told_apart_by_the_spectrum():
    for name, kind in (("so(7)", "B"), ("sp(6,R)", "C")):
        g = FOUND[name].algebra
        x, _ = cartan_subalgebra(g)
        assert complex_type(21, 3, g.adjoint_of(x)) == ComplexType(kind, 3)
    with pytest.raises(ArithmeticError, match="B3 or C3"):
        complex_type(21, 3, None)


def test_what_does_not_close_and_what_depends_is_named():
    with pytest.raises(NotClosed, match=r"\[a, b\] leaves the real span") as caught:
        algebra_of_matrices({"a": unit(2, (0, 1, 1)), "b": unit(2, (1, 0, 1))})
    assert caught.value.value == [["1", "0"], ["0", "-1"]]
    with pytest.raises(Dependent, match="= 0") as dependent:
        algebra_of_matrices({"a": [[0, 1], [0, 0]], "b": [[0, 2], [0, 0]]})
    assert dependent.value.relation in ("a - b/2", "-2*a + b")
    with pytest.raises(InputError, match="square"):
        algebra_of_matrices({"a": [[0, 1]]})


@pytest.mark.parametrize("text", ["so", "so(-1)", "su(2)(", "e(1,2)", "sp(3,R)", "g(2)", "e(3) + f(2)", "so(99)", ""])
def test_names_that_are_none(text):
    with pytest.raises(InputError):
        read_name(text)


def test_names_of_one_algebra_agree():
    for names in (
        ("so(4)", "so(3) + su(2)", "su(2)^2"), ("so(6)", "su(4)"), ("so(3,3)", "sl(4,R)"), ("u(2)", "su(2) + u(1)"),
        ("so*(6)", "su(3,1)"), ("so*(8)", "so(6,2)"), ("iso(3,1)", "poincare"), ("so(5,1)", "su*(4)"),
        ("usp(4)", "so(5)"), ("gl(2,C)", "sl(2,C) + u(1)^2"), ("so(4,C)", "sl(2,C)^2"), ("so(2)", "u(1)"),
        ("so(3)", "sp(2,R)")[:1], ("e(1) + so(2)", "u(1)^2"),
    ):  # fmt: skip
        assert len({read_name(name) for name in names}) == 1, names


def test_an_ambiguous_real_form_is_not_guessed():
    """so(12,6) and so*(18) have maximal compact subalgebras of one dimension, 81."""
    assert isomorphic(read_name("so(12,6)"), read_name("so*(18)")) is None
