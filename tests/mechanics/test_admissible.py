"""Symbols and functions of sympy's of which more is assumed than a claim file could state are refused."""

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, Transformation, conserved, frequency, identity, verify

SPACE = PhaseSpace("q", "p")
q, p = SPACE.old


def refusal(make):
    with pytest.raises(InputError) as caught:
        make()
    return str(caught.value)


@pytest.mark.parametrize(
    "word",
    ["imaginary", "even", "odd", "prime", "composite", "zero", "irrational", "noninteger", "infinite", "algebraic",
     "hermitian", "extended_real", "transcendental", "finite"],
)  # fmt: skip
def test_what_a_file_cannot_state_of_a_name_is_refused(word):
    z = sp.Symbol("z", **{word: True})
    assert f"no claim can state ({word}=True)" in refusal(lambda: identity(SPACE, z * q, z * q))
    assert "no claim can state" in refusal(lambda: PhaseSpace("q", "p", real=[z]))
    assert "no claim can state" in refusal(lambda: PhaseSpace([z], "p"))
    if z.is_real and not z.is_zero:
        assert "no claim can state" in refusal(lambda: SPACE.where(z * q > 0))


def test_the_square_of_an_imaginary_name_is_not_refuted_at_a_real_one():
    z = sp.Symbol("z", imaginary=True)
    assert "imaginary=True" in refusal(lambda: identity(SPACE, abs(z) ** 2 * q, -(z**2) * q))
    assert "imaginary=True" in refusal(lambda: conserved(SPACE, p**2 / 2, abs(z) ** 2 + z**2))


@pytest.mark.parametrize(
    "facts",
    [{}, {"real": True}, {"complex": True}, {"positive": True}, {"negative": True}, {"nonnegative": True},
     {"nonpositive": True}, {"nonzero": True}, {"integer": True}, {"integer": True, "positive": True},
     {"integer": True, "zero": False}, {"complex": True, "zero": False}, {"rational": True}],
)  # fmt: skip
def test_what_a_file_can_state_is_not(facts):
    z = sp.Symbol("z", **facts)
    assert verify(identity(SPACE, (z + q) ** 2, z**2 + 2 * z * q + q**2)).status == "proved"


def test_two_symbols_of_one_name_are_refused_wherever_they_stand():
    a, b = sp.Dummy("a", real=True), sp.Dummy("a", real=True)
    assert "two different symbols are called a" in refusal(lambda: identity(SPACE, a * q, b * q))
    real, positive = sp.Symbol("a", real=True), sp.Symbol("a", positive=True)
    assert "two different symbols are called a" in refusal(lambda: conserved(SPACE, p**2 / 2 + real * q, positive * p))
    space = PhaseSpace("q", "p", new=("Q", "P"))
    moved = Transformation(space, Q=space.symbol("q") + real, P=space.symbol("p") + positive)
    assert "two different symbols are called a" in refusal(moved.canonical)


def test_a_dummy_by_the_name_of_a_coordinate_is_refused():
    assert "this q is a Dummy" in refusal(lambda: identity(SPACE, sp.Dummy("q", real=True), q))


def test_functions_are_real_and_smooth_and_nothing_more():
    plain, real = sp.Function("f"), sp.Function("f", real=True)
    assert verify(identity(SPACE, plain(q), real(q))).status == "proved"
    for word in ("positive", "integer", "imaginary", "zero", "negative", "nonnegative"):
        other = sp.Function("f", **{word: True})
        assert "of the function f more is assumed" in refusal(lambda other=other: identity(SPACE, other(q), q))


def test_a_function_has_one_number_of_arguments():
    f = sp.Function("f")
    assert "called with 1 and with 2 arguments" in refusal(lambda: identity(SPACE, f(q), f(q, p)))
    assert "called with 1 and with 2 arguments" in refusal(lambda: conserved(SPACE, f(q), f(q, p)))


def test_other_branches_and_functions_without_arguments_are_refused():
    assert "only the principal one" in refusal(lambda: identity(SPACE, sp.LambertW(q, -1), q))
    x = sp.Symbol("x")
    assert "is a function: call it" in refusal(lambda: identity(SPACE, sp.Lambda(x, x), q))


def test_derivatives_in_which_sympy_has_left_a_name_are_refused():
    space = PhaseSpace("x", "y", real="a s", functions="F")
    x, y, a, s = (space.symbol(name) for name in ("x", "y", "a", "s"))
    own, sympys = space.function("F"), sp.Function("G")
    for f in (own, sympys):
        first, second = f(x * a, a * s, x + a).diff(a).diff(x), f(x * a, a * s, x + a).diff(x).diff(a)
        if f is own:
            assert verify(identity(space, first, second)).status == "proved"
        else:
            assert "space.function(...)" in refusal(lambda u=first, v=second: identity(space, u, v))
    assert verify(identity(space, sympys(x * y).diff(x), y * sympys(x * y).diff(y) / x)).status == "proved"


@pytest.mark.parametrize(
    "c",
    [
        sp.acos(sp.tanh(9)),
        sp.sec(sp.Rational(288865, 7)),
        sp.acosh(1 + sp.Rational(1, 10**6)),
        sp.tan(sp.Rational(11, 7)),
    ],
)
def test_constants_whose_sign_sympy_misjudges(c):
    space = PhaseSpace("x", "y", positive="E b", real="d")
    x, y, E, b, d = (space.symbol(name) for name in ("x", "y", "E", "b", "d"))
    H, value = y**2 / 2 + (abs(d) + b) ** 2 * x**2 / 2, sp.N(c, 30)
    for rate, expected in ((b + (c if value > 0 else -c), "proved"), (b, "refuted")):
        status = verify(frequency(space, H, x, E, rate / (2 * sp.pi), fixed={d: c})).status
        assert status in (expected, "supported")
