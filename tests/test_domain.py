"""Conditions and domains: what a sympy expression needs, pull-backs, what is outside of the language."""

import pytest
import sympy as sp

from canon.domain import Condition, Domain, conditions_of
from canon.errors import InputError
from canon.sign import known_sign
from canon.special import JacobiCN, JacobiDN, JacobiSN

x, y = sp.symbols("x y", real=True)
m = sp.Symbol("m", positive=True)
z = sp.Symbol("z")


def test_conditions_of_an_expression():
    found = conditions_of(sp.sqrt(x) / y + sp.log(z) + sp.atan2(y, x) + sp.tan(x) + sp.asin(y) + sp.sqrt(m))
    assert {(c.kind, c.terms) for c in found} == {
        ("positive", (x,)),
        ("nonzero", (y,)),
        ("slit", (z,)),
        ("uncut", (y, x)),
        ("nonzero", (sp.cos(x),)),
        ("positive", (1 - y**2,)),
    }


def test_derivatives_of_arbitrary_functions():
    V = sp.Function("V")
    assert conditions_of(V(x).diff(x)) == ()
    assert [str(c) for c in conditions_of(V(sp.sqrt(x)).diff(x))] == ["x > 0"]


@pytest.mark.parametrize(
    "expression",
    [
        0.5 * x,
        sp.Symbol("A", commutative=False),
        sp.Piecewise((x, x > 0), (y, True)),
        sp.Integral(x, x),
        sp.oo,
        sp.zoo,
        sp.nan,
        sp.log(-m),
        sp.acot(x),
    ],
)
def test_what_is_no_formula(expression):
    with pytest.raises(InputError):
        conditions_of(expression)


def test_domains_unite_and_pull_back():
    positive = Condition("positive", (x,), "x > 0")
    one = Domain((positive,), (x - y,))
    both = one & Domain((Condition("positive", (x,), "0 < x"), Condition("nonzero", (y,))), (x - y,))
    assert [str(c) for c in both.conditions] == ["x > 0", "y != 0"]
    assert both.surface == (x - y,)
    swapped = both.substitute({x: y, y: x})
    assert [str(c) for c in swapped.conditions] == ["y > 0", "x != 0"]
    assert swapped.surface == (y - x,)


@pytest.mark.parametrize(
    ("call", "value"), [(sp.elliptic_e(x), 1), (sp.LambertW(x), -sp.exp(-1)), (sp.elliptic_f(sp.pi / 2, x), 1)]
)
def test_a_call_stays_one_where_numbers_are_put_in(call, value):
    """E(1) = 1 is a number, of which it can't be told any more that E isn't analytic there."""
    (condition,) = conditions_of(call)
    (moved,) = condition.substitute({x: value}).terms
    assert isinstance(moved, type(call))
    assert moved.args == (*call.args[:-1], value)


@pytest.mark.parametrize(
    ("expression", "sign"),
    [
        (m * x**2, "nonnegative"),
        (m + x**2, "positive"),
        (-m - 1, "negative"),
        (x * m, None),
        (sp.exp(x), "positive"),
        (sp.exp(z), "nonzero"),
        (z**2, None),
        (sp.I * m, "nonzero"),
        (sp.sqrt(x), "positive"),
        (m**x, "positive"),
        (x**3, None),
        (sp.pi - 3, None),
    ],
)
def test_signs_follow_from_assumptions_alone(expression, sign):
    assert known_sign(expression) == sign


def test_jacobi_functions():
    sn, cn, dn = (f(x, m) for f in (JacobiSN, JacobiCN, JacobiDN))
    assert [f.diff(x) for f in (sn, cn, dn)] == [cn * dn, -sn * dn, -m * sn * cn]
