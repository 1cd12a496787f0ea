"""Functions and signs that the small checker of identities knows: what is shown, and branches that it mustn't take."""

from typing import Any

import pytest

from tests.checker.identities import answer

FUNCTIONS: Any = [
    ("cos(pi/2 - x)", "sin(x)", "-sin(x)"), ("sin(x + pi)", "-sin(x)", "sin(x)"), ("cos(3*pi/2)", "0", "1"),
    ("cos(atan2(y, x))", "x/sqrt(x**2 + y**2)", "-x/sqrt(x**2 + y**2)"), ("tan(atan2(y, x))", "y/x", "x/y"),
    ("cos(atan2(y, x)/2)**2", "(1 + x/sqrt(x**2 + y**2))/2", "(1 - x/sqrt(x**2 + y**2))/2"),
    ("cos(atan2(y, x)/2)", "sqrt((1 + x/sqrt(x**2 + y**2))/2)", "-sqrt((1 + x/sqrt(x**2 + y**2))/2)"),
    ("sin(2*atan(x))", "2*x/(1 + x**2)", "2*x/(1 - x**2)"), ("cos(asin(x))", "sqrt(1 - x**2)", "-sqrt(1 - x**2)"),
    ("sin(acos(x)/2)", "sqrt((1 - x)/2)", "-sqrt((1 - x)/2)"), ("sin(asin(x) + acos(x))", "1", "x"),
    ("exp(log(x)/2)", "sqrt(x)", "-sqrt(x)"), ("sinh(asinh(x))", "x", "-x"), ("cosh(acosh(x))", "x", "-x"),
    ("sinh(acosh(x))", "sqrt(x**2 - 1)", "-sqrt(x**2 - 1)"), ("tanh(atanh(x))", "x", "-x"),
    ("D(m**n, m)", "n*m**(n - 1)", "m**(n - 1)"), ("m**n*m**l", "m**(n + l)", "m**(n*l)"),
    ("sqrt(m**(2*n))", "m**n", "-m**n"),
    ("D(sqrt(x**2 + 1)**n, x)", "n*x*sqrt(x**2 + 1)**(n - 2)", "n*x*sqrt(x**2 + 1)**n"),
    ("jacobi_sn(x, y)**2", "1 - jacobi_cn(x, y)**2", "1 + jacobi_cn(x, y)**2"),
    ("D(jacobi_dn(2*x, y), x)", "-2*y*jacobi_sn(2*x, y)*jacobi_cn(2*x, y)", "-y*jacobi_sn(2*x, y)*jacobi_cn(2*x, y)"),
    ("jacobi_dn(x, y)**2 - jacobi_cn(x, y)**2", "(1 - y)*jacobi_sn(x, y)**2", "(1 - y)*jacobi_sn(x, k)**2"),
    ("D(D(jacobi_sn(x, y), y), x)", "D(jacobi_cn(x, y)*jacobi_dn(x, y), y)", "D(jacobi_cn(x, k)*jacobi_dn(x, y), y)"),
]  # fmt: skip


@pytest.mark.parametrize("given", FUNCTIONS)
def test_what_functions_are(given: Any) -> None:
    lhs, right, wrong = given
    assert (answer(lhs, right), answer(lhs, wrong)) == ("shown", "not shown")


MISSES: Any = [
    ("sqrt(x**2)", "x"), ("sqrt(x**2)", "-x"), ("asin(sin(x))", "x"), ("acos(cos(x))", "x"),
    ("exp(log(x**2)/2)", "x"),
    ("atan(y/x)", "atan2(y, x)"), ("sin(n*pi)", "1"), ("cos(n*pi)", "1"), ("cos(pi*x)", "-1"),
    ("x**n*x**l", "x**(n + 2*l)"),
    ("sqrt((x**n)**2)", "x**n"), ("sqrt((c**b)**2)", "c**b"), ("(c**2)**(b/2)", "c**b"), ("(-1)**n", "1"),
    ("x**n", "m**n"),
    ("D(m**x, x)", "x*m**(x - 1)"), ("sqrt(1 - jacobi_sn(x, y)**2)", "jacobi_cn(x, y)"),
    ("jacobi_dn(x, 1)", "jacobi_cn(x, 1)"),
    ("sqrt(1 - y*jacobi_sn(x, y)**2)", "jacobi_dn(x, y)"), ("jacobi_dn(x, 0)", "-1"),
    ("jacobi_sn(x, y)", "jacobi_sn(x, k)"),
    ("jacobi_cn(y, x)", "jacobi_cn(x, y)"), ("jacobi_sn(x)", "jacobi_sn(x)"), ("jacobi_am(x, y)", "jacobi_am(x, y)"),
    ("D(jacobi_sn(x, y), y)", "0"), ("sqrt((x**2 - y**2)**2)", "x**2 - y**2"),
    ("sqrt((cosh(x) - 2)**2)", "cosh(x) - 2"),
    ("sqrt((cos(y) - cosh(x))**2)", "cos(y) - cosh(x)"), ("sqrt((1 + cos(n*pi))**2)", "-1 - cos(n*pi)"),
    ("x", "1j*x"),
    ("atan2(x, y) + atan2(y, x)", "pi/2"), ("asin(x) - acos(x)", "pi/2"), ("sqrt(sin(x)**2)", "sin(x)"),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_branches_and_signs_show_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


POSITIVE: Any = [
    ("sqrt(x**2)", "x", ("x > 0",), ("x < 0",)), ("sqrt((x - y)**2)", "x - y", ("x > y",), ("x < y",)),
    ("sqrt((x**2 + y**2)**2)", "x**2 + y**2", (), None), ("sqrt((m + x**2)**2)", "m + x**2", (), None),
    ("sqrt((1 - x)**2)", "1 - x", ("0 < x < 1",), ("0 < x", "x > 1")),
    ("sqrt((1 - x)**2)", "1 - x", ("x < 1/2",), ("x < 2",)), ("sqrt((1 - x*y)**2)/sqrt(1 - x**2)/sqrt(1 - y**2)",
        "(1 - x*y)/sqrt(1 - x**2)/sqrt(1 - y**2)", (), None), ("sqrt(sin(x)**2)", "sin(x)", ("0 < x < pi",),
        ("0 < x < 2*pi",)),
    ("sqrt(sin(x)**2)", "-sin(x)", ("-pi < x < 0",), ("-pi < x < 1",)),
    ("sqrt(cos(x)**2)", "-cos(x)", ("pi/2 < x < 3*pi/2",), ("pi/2 < x < 5*pi/3",)),
    ("sqrt(tan(x)**2)", "tan(x)", ("0 < x < pi/2",), ("-pi/2 < x < 0",)),
    ("asin(sin(x))", "x", ("-pi/2 < x < pi/2",), ("0 < x < pi",)), ("asin(sin(x))", "pi - x", ("pi/2 < x < pi",),
    ("0 < x < pi",)),
    ("asin(sin(x))", "x - 2*pi", ("3*pi/2 < x < 2*pi",), ("3*pi/2 < x < 3*pi",)),
    ("acos(cos(x))", "x", ("0 < x < pi",), ("-1 < x < pi",)), ("acos(cos(x))", "-x", ("-pi < x < 0",),
    ("-pi < x < 1",)),
    ("acos(cos(x))", "2*pi - x", ("pi < x < 2*pi",), ("pi < x < 7",)),
    ("sqrt((cosh(x) - cos(y))**2)", "cosh(x) - cos(y)", ("x > 0",), None),
    ("sqrt(1 - k*jacobi_sn(x, k)**2)", "jacobi_dn(x, k)", ("k < 1",), ("k < 2",)),
]  # fmt: skip


@pytest.mark.parametrize("given", POSITIVE)
def test_what_is_positive_in_the_domain(given: Any) -> None:
    lhs, rhs, where, other = given
    assert answer(lhs, rhs, *where) == "shown"
    assert other is None or answer(lhs, rhs, *other) == "not shown"
    assert answer(lhs, f"-({rhs})", *where) == "not shown"


def test_many_conditions_are_met() -> None:
    where = ("m > 3", "x > m", "x < 2*m", "y > x", "y < 3*m", "u > y", "u < 4*m", "v > u", "k > v")
    assert answer("sqrt((k - v)**2)", "k - v", *where) == "shown"
    assert answer("sqrt((k - v)**2)", "v - k", *where) == "not shown"
