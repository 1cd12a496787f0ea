"""Limits within functions, at edges and of exponentials: what is shown, near misses, sides, and special parameters."""

from typing import Any

import pytest

from canon.checker import alone_limits, alone_tending, alone_together
from tests.checker.certified import certified, resealed
from tests.checker.test_alone_limits import MISSES as MISSES_BEFORE

PLANE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}}
NAMES = {"a": "positive", "b": "positive", "k": "real", "V": "function"}


def answer(f: str, to: str, equals: str, side: str = "", *where: str, **sections: Any) -> str:
    """The answer about the limit of f as x tends to something."""
    claim = {"kind": "limit", "f": f, "variable": "x", "to": to, "equals": equals, **({"side": side} if side else {})}
    tables = {**PLANE, "symbols": NAMES, "domain": {"where": [*where]}, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_tending.checked(resealed(data))[0]


SHOWN = [
    ("acos((sqrt(1 - x**2) - 1)/x)", "0", "pi/2", "+"),
    ("acos((sqrt(1 - x**2) - 1)/x)", "1", "pi", "-"),
    ("a/(1 + cos(x))", "pi", "infinity"),
    ("a*cot(x/2)**2", "0", "infinity", "+"),
    ("x/sin(x)", "0", "1"),
    ("(1 + k**2/x**2)**(x/2)", "infinity", "1"),
    ("(1 + k/x)**x", "infinity", "exp(k)"),
    ("cos(x*atan(k/x))", "infinity", "cos(k)"),
    ("elliptic_k(sin(x/2)**2)", "0", "pi/2"),
    ("(elliptic_k(x**2) - pi/2)/x**2", "0", "pi/8"),
    ("tanh(a*x)", "infinity", "1"),
    ("tanh(a*x)", "-infinity", "-1"),
    ("sinh(a*x)*exp(-a*x)", "infinity", "1/2"),
    ("atan(exp(a*x))", "infinity", "pi/2"),
    ("atan(exp(a*x))", "-infinity", "0"),
    ("exp(-x**2)", "infinity", "0"),
    ("exp(a*x) - exp(b*0)", "-infinity", "-1"),
    ("(exp(-(x - W)) - exp(-(x + W)))/(2*W)", "a", "exp(-a)", "+"),
    ("atan(k + 1/x)", "0", "pi/2", "+"),
    ("atan(1/x)", "0", "-pi/2", "-"),
    ("atan(1/x**2)", "0", "pi/2"),
    ("sqrt(x)", "0", "0", "+"),
    ("sqrt(x**2 + a*x)/sqrt(x)", "0", "sqrt(a)", "+"),
    ("log(sin(x)/x)", "0", "0"),
    ("exp(k*sin(a*x)/x)", "0", "exp(a*k)"),
    ("exp(sin(x)/x)", "0", "exp(1)"),
    ("asin(1 - x)", "0", "pi/2", "+"),
    ("acosh(1 + x)", "0", "0", "+"),
    ("exp(2*a*x)/(1 + exp(3*a*x))", "infinity", "0"),
    ("exp(3*a*x)/(1 + exp(2*a*x))", "infinity", "infinity"),
    ("x**x", "1", "1"),
    ("sqrt(x**2)/x", "0", "1", "+"),
    ("cos(sqrt(x))", "0", "1", "+"),
    ("sqrt(1 - cos(x)**2 + x)", "0", "0", "+"),
]

MISSES = [
    *(given for given in MISSES_BEFORE if given != ("sqrt(x**2)/x", "0", "1", "+")),
    ("acos((sqrt(1 - x**2) - 1)/x)", "0", "pi/2 + 1/1000", "+"),
    ("acos((sqrt(1 - x**2) - 1)/x)", "0", "0", "+"),
    ("acos((sqrt(1 - x**2) - 1)/x)", "1", "0", "-"),
    ("acos((sqrt(1 - x**2) - 1)/x)", "1", "pi", "+"),
    ("acos((sqrt(1 - x**2) - 1)/x)", "1", "pi"),
    ("a/(1 + cos(x))", "pi", "-infinity"),
    ("k/(1 + cos(x))", "pi", "infinity"),
    ("a*cot(x/2)", "0", "infinity"),
    ("a*cot(x/2)", "0", "infinity", "-"),
    ("x/sin(k*x)", "0", "1/k"),
    ("sin(a*x)/sin(k*x)", "0", "a/k"),
    ("(1 + k/x)**x", "infinity", "1"),
    ("(1 + k/x)**x", "infinity", "exp(-k)"),
    ("(1 + k*x)**(1/x)", "0", "exp(2*k)"),
    ("elliptic_k(sin(x/2)**2)", "0", "pi/4"),
    ("elliptic_k(cos(x/2)**2)", "0", "pi/2"),
    ("(elliptic_k(x**2) - pi/2)/x**2", "0", "pi/4"),
    ("elliptic_k(x)", "1", "infinity", "-"),
    ("elliptic_k(k*0)", "0", "pi"),
    ("tanh(k*x)", "infinity", "1"),
    ("tanh(a*x)", "infinity", "-1"),
    ("tanh(a*x)", "-infinity", "1"),
    ("atan(exp(k*x))", "infinity", "pi/2"),
    ("atan(exp(a*x))", "infinity", "0"),
    ("atan(exp(a*x))", "infinity", "-pi/2"),
    ("exp(k*x)", "infinity", "infinity"),
    ("exp(-k*x)", "infinity", "0"),
    ("exp(a*x) - exp(b*x)", "infinity", "infinity"),
    ("exp(a*x)", "infinity", "0"),
    ("exp(-a*x)", "-infinity", "0"),
    ("x*exp(-a*x)", "infinity", "1"),
    ("exp(-k*x**2)", "infinity", "0"),
    ("exp(a*x - k*x**2)", "infinity", "infinity"),
    ("sin(exp(x))", "infinity", "0"),
    ("exp(-x**2)", "infinity", "1"),
    ("exp(x**3)", "-infinity", "infinity"),
    ("exp(exp(x))", "infinity", "infinity"),
    ("(exp(-(x - W)) - exp(-(x + W)))/(2*W)", "a", "exp(-a)", "-"),
    ("atan(k + 1/x)", "0", "pi/2"),
    ("(exp(-(x - W)) - exp(-(x + W)))/(2*W)", "a", "exp(-a)"),
    ("atan(k/x)", "0", "pi/2", "+"),
    ("(exp(-(x - W)) - exp(-(x + W)))/(2*W)", "a", "2*exp(-a)", "+"),
    ("atan(-a/x)", "0", "pi/2", "+"),
    ("sqrt(x)", "0", "0"),
    ("sqrt(x)", "0", "0", "-"),
    ("sqrt(x**3 - x**2)", "0", "0", "+"),
    ("sqrt(-x)", "0", "0", "+"),
    ("sqrt(x**2 + a*x)/sqrt(x)", "0", "sqrt(a)", "-"),
    ("sqrt(x**2 + k*x)/sqrt(x)", "0", "sqrt(k)", "+"),
    ("asin(1 + x)", "0", "pi/2", "+"),
    ("asin(1 - x)", "0", "pi/2"),
    ("acosh(1 - x)", "0", "0", "+"),
    ("acosh(1 - x**2)", "0", "0"),
    ("asin(1 + x**2)", "0", "pi/2"),
    ("acos(-1 - x**2)", "0", "pi"),
    ("atanh(1 - x)", "0", "0", "+"),
    ("sqrt(cos(x) - 1)", "0", "0"),
    ("sqrt(x**2)/x", "0", "1", "-"),
    ("log(sin(x)/x)", "0", "1"),
    ("log(sin(k*x)/x)", "0", "log(k)"),
    ("exp(k*sin(a*x)/x)", "0", "exp(k)"),
    ("x**x", "0", "0", "+"),
    ("x**x", "0", "1", "-"),
    ("V(sin(x)/x)", "0", "V(1)"),
    ("V(1/x)", "0", "V(0)"),
    ("exp(sin(x)/x**2)", "0", "0", "-"),
    ("sin(x)/x + log(0*x)", "0", "1"),
    ("cos(sqrt(x))", "0", "1"),
    ("cos(sqrt(x))", "0", "1", "-"),
    ("(1 - cos(sqrt(x)))/x", "0", "1/4", "+"),
    ("(log(1 + x) - x)/(cos(x) - 1)", "0", "1/2"),
    ("1/(sin(x) - x)", "0", "infinity", "+"),
    ("1/(sin(x) - x)", "0", "-infinity"),
    ("sqrt(x - a)*exp(1/(x - a))", "a", "0", "+"),
    ("exp(a*x)*x/exp(a*x)", "infinity", "1"),
    ("sqrt((x - a)*(x - b))", "a", "0", "+"),
    ("x**k", "0", "0", "+"),
    ("(k*x)**x", "0", "1", "+"),
]


@pytest.mark.parametrize("given", SHOWN)
def test_a_limit_is_shown(given: Any) -> None:
    assert answer(*given, definitions={"W": "sqrt(x**2 - a**2)"}) == "shown"


@pytest.mark.parametrize("given", MISSES)
def test_another_value_or_side_shows_nothing(given: Any) -> None:
    assert answer(*given, definitions={"W": "sqrt(x**2 - a**2)"}) == "not shown"


def test_the_domain_comes_up_to_the_limit() -> None:
    for f, to, equals, side in (("sqrt(x - a)", "a", "0", "+"), ("tanh(a*x)", "infinity", "1", "")):
        assert answer(f, to, equals, side) == "shown"
        assert answer(f, to, equals, side, "x < a") == "not shown"
        assert answer(f, to, equals, side, "x > 2*a", "x < 3*a") == "not shown"
    assert answer("sqrt(x - a)", "a", "0", "+", "x > a", "x < 3*a") == "shown"
    assert answer("tanh(a*x)", "infinity", "1", symbols={**NAMES, "x": "positive"}) == "shown"
    assert answer("tanh(a*x)", "-infinity", "-1", symbols={**NAMES, "x": "positive"}) == "not shown"
    for given in ("sqrt(x**3) > x", "sqrt(x) < x", "sqrt(-x) > 0", "sqrt(x) > sqrt(4*x)"):
        assert answer("x", "0", "0", "+", given) == "not shown"


def test_a_condition_with_a_root_that_vanishes_says_nothing_by_its_value_at_the_limit() -> None:
    claim = {"kind": "limit", "f": "x", "variable": "x", "to": "0", "equals": "0", "side": "+"}
    tables = {**PLANE, "domain": {"where": ["sqrt(x**3) > x"]}, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    assert alone_limits.checked(resealed(data))[0] == "not shown"


def test_a_name_of_the_file_is_no_elliptic_integral() -> None:
    assert answer("elliptic_k(x)", "0", "pi/2", symbols={"elliptic_k": "function"}) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text, claim = (
        '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\na = "positive"\n',
        "kind = 'limit'\nvariable = 'x'\nf = 'tanh(a*x)'\nto = 'infinity'\nequals = '1'",
    )
    data = certified(text, claim)
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["symbols"]["a"] = "real"
    assert alone_together.checked(resealed(data))[0] == "not shown"
