"""Exact zeros of expressions: "yes" by normal form, "no" by balls, however small, and neither where it isn't known."""

import pytest
import sympy as sp

from canon.mechanics.vanishing import sign_at_a_point, vanishes

a, b = sp.symbols("a b", positive=True)
x, y = sp.symbols("x y", real=True)
n = sp.Symbol("n", integer=True)
w = sp.Symbol("w")
root = sp.sqrt


@pytest.mark.parametrize(
    "expression",
    [
        root(3 + 2 * root(2)) - 1 - root(2),
        sp.cbrt(2 + root(5)) - sp.cbrt(root(5) - 2) - 1,
        1 / (1 + root(2)) - root(2) + 1,
        (a + b) ** 2 - a**2 - 2 * a * b - b**2,
        1 / (x - 1) - (x + 1) / (x**2 - 1),
        1 / (root(a) + root(b)) - (root(a) - root(b)) / (a - b),
        (1 + sp.I) ** 2 - 2 * sp.I,
        sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1,
        sp.cosh(x) ** 2 - sp.sinh(x) ** 2 - 1,
        sp.CRootOf(w**5 - w - 1, 0) ** 5 - sp.CRootOf(w**5 - w - 1, 0) - 1,
        sp.CRootOf(w**3 - w - 1, 1) ** 3 - sp.CRootOf(w**3 - w - 1, 1) - 1,  # a complex one
    ],
)
def test_zeros(expression):
    assert vanishes(expression) is True


@pytest.mark.parametrize(
    "expression",
    [
        root(3 + 2 * root(2)) + 1 - root(2),  # 0 for another branch
        root(3 + 2 * root(2)) - 1 - root(2) + sp.Rational(1, 10**90),
        sp.cbrt(2 + root(5)) - sp.cbrt(root(5) - 2) - 1 - sp.Rational(1, 10**300),
        a / 10**80,
        10**60 * (root(2) + root(3)) - sp.floor(10**60 * (root(2) + root(3))),  # below 1, its conjugates are long
        (10**60 * (root(2) + root(3)) - sp.floor(10**60 * (root(2) + root(3)))) / 10**60,
        (10**70 * sp.cbrt(5) - sp.floor(10**70 * sp.cbrt(5))) * (root(7) - 2),
        root(x**2) - x,
        root((x - y) ** 2) - (x - y),
        (-1) ** n + 1,
        sp.sin(x) ** 2 + sp.cos(x) ** 2 - sp.Rational(1001, 1000),
        sp.pi - sp.Rational(355, 113),
        sp.CRootOf(w**5 - w - 1, 0) - sp.Rational(11673, 10000),
    ],
)
def test_what_is_no_zero(expression):
    assert vanishes(expression) is False


@pytest.mark.parametrize(
    "expression", [sp.sin(2 * x) - 2 * sp.sin(x) * sp.cos(x), sp.Function("f")(x), sp.Float("1e-30")]
)
def test_what_is_not_known(expression):
    assert vanishes(expression) is None


def test_signs_are_certified():
    assert sign_at_a_point(root(2) + root(3) - sp.Rational(31462643699419723423, 10**19)) == 1
    assert sign_at_a_point(root(3 + 2 * root(2)) - 1 - root(2)) is None
    assert sign_at_a_point(-a) == -1
    for number, low in ((sp.E, "2.718281828"), (sp.pi, "3.141592653")):
        assert sign_at_a_point(number - sp.Rational(low)) == 1
        assert sign_at_a_point(number - sp.Rational(low) - sp.Rational(1, 10**8)) == -1
    assert sign_at_a_point(2 + sp.I) is None
