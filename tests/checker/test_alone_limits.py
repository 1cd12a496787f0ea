"""Limits by what vanishes: what is shown, near misses, and what depends on a side or on a parameter."""

from typing import Any

import pytest

from canon.checker import alone_limits, alone_together
from tests.checker.certified import certified, resealed

PLANE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}}
NAMES = {"a": "positive", "b": "positive", "k": "real", "V": "function"}


def answer(f: str, to: str, equals: str, side: str = "", *where: str, **sections: Any) -> str:
    """The answer about the limit of f as x tends to something."""
    claim = {"kind": "limit", "f": f, "variable": "x", "to": to, "equals": equals, **({"side": side} if side else {})}
    tables = {**PLANE, "symbols": NAMES, "domain": {"where": [*where]}, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_limits.checked(resealed(data))[0]


SHOWN = [
    ("sin(k*x)/x", "0", "k"), ("(1 - cos(x))/x**2", "0", "1/2"), ("x**2 + a", "b", "a + b**2"),
    ("1/x", "0", "infinity", "+"), ("1/x", "0", "-infinity", "-"), ("1/x**2", "0", "infinity"),
    ("1/x", "infinity", "0"), ("a*x/(x + b)", "infinity", "a"), ("(sqrt(x + a) - sqrt(a))/x", "0", "1/(2*sqrt(a))"),
    ("x**3", "-infinity", "-infinity"), ("(exp(k*x) - 1)/x", "0", "k"), ("(x**2 - a**2)/(x - a)", "a", "2*a"),
    ("(V(k) + x)*x", "0", "0"), ("x**2 - x", "infinity", "infinity"), ("sqrt(x)", "a", "sqrt(a)", "+", "x < 2*a"),
    ("1/(x - a)", "a", "infinity", "+", "x > a"), ("a/x**2 - b/x", "0", "infinity", "+"), ("log(1 + x)/x", "0", "1"),
    ("cos(x)", "pi", "-1"), ("atan(1/x)", "infinity", "0"),
]  # fmt: skip

MISSES = [
    ("sin(k*x)/x", "0", "1"), ("(1 - cos(x))/x**2", "0", "1001/2000"), ("1/x", "0", "infinity"),
    ("1/x", "0", "infinity", "-"), ("1/x", "0", "0"), ("x**2 + a", "b", "a - b**2"), ("a*x/(x + b)", "infinity", "b"),
    ("k*x", "infinity", "infinity"), ("k/x", "0", "infinity", "+"), ("x/(k*x)", "0", "0"),
    ("sin(k*x)/(k*x)", "0", "1"), ("x/(x**2 + k*x)", "0", "1/k"), ("sqrt(x)*V(x)", "0", "0", "+"),
    ("V(x)", "0", "V(k)"), ("sqrt(x**2)/x", "0", "1", "+"), ("sqrt(x**2)/x", "0", "0"), ("atan(1/x)", "0", "pi/2"),
    ("sin(1/x)", "0", "0"), ("exp(1/x)", "0", "infinity"), ("exp(-1/x**2)/x", "0", "1"), ("x", "x", "x"),
    ("x", "a", "x"), ("x*q", "0", "0", "", "x > 1"), ("x", "0", "0", "-", "x > 0"), ("x", "0", "0", "", "x > 0"),
    ("1/x", "infinity", "0", "", "x < 1"), ("x", "infinity", "0"), ("x**2", "-infinity", "-infinity"),
    ("0*log(x)", "0", "0"), ("x**k", "0", "0"), ("(x - x)/x", "0", "1"), ("D(sqrt(x), x)", "0", "infinity", "+"),
    ("1/V(x)", "0", "1/V(0)"), ("1/sin(x)", "pi", "infinity"), ("1/(x**2 - 2*x*a + a**2)", "a", "-infinity"),
    ("x", "0", "1j"), ("x", "0", "0", "*"), ("(sqrt(x**2 + a**2) - a)/x**2", "0", "1/a"), ("log(x)", "0", "0"),
    ("V(1/x)", "infinity", "V(0)"), ("a*x**2 - x**3", "infinity", "infinity"), ("x + k*x**2", "infinity", "infinity"),
    ("1/(k - x)", "k", "infinity"),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_a_limit_is_shown(given: Any) -> None:
    assert answer(*given) == "shown"


@pytest.mark.parametrize("given", MISSES)
def test_another_value_or_side_shows_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


def test_the_domain_comes_up_to_the_limit() -> None:
    assert answer("x", "a", "a", "", "0 < x", "x < 3*a") == "shown"
    assert answer("x", "a", "a", "", "w < 3*a", definitions={"w": "x"}) == "shown"
    for given in (("0 < x", "x < a"), ("x < a/2",), ("V(x) > 0",), ("x > b",)):
        assert answer("x", "a", "a", "", *given) == "not shown"
    assert answer("x", "0", "0", "+", symbols={"x": "positive"}) == "shown"
    for to, side in (("0", ""), ("0", "-"), ("-1", ""), ("-infinity", "")):
        assert answer("x**2", to, "infinity" if "inf" in to else "0", side, symbols={"x": "positive"}) == "not shown"
    assert answer("x", "0", "0", hamiltonian={"H": "log(x)"}) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text, claim = (
        '[phase_space]\nq = ["q"]\np = ["p"]\n',
        "kind = 'limit'\nvariable = 'x'\nf = 'sin(x)/x'\nto = '0'\nequals = '1'",
    )
    data = certified(text, claim)
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["equals"] = "2"
    assert alone_together.checked(resealed(data))[0] == "not shown"
    names = {f"a{k + 1}": f"a{k}*b{k}" for k in range(60)} | {f"b{k + 1}": f"a{k} + b{k}" for k in range(60)}
    assert answer("x", "0", "0", "", "a60 > 0", definitions={"a0": "x", "b0": "p", **names}) == "not shown"
