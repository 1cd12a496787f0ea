"""Integrals by an antiderivative: what is shown, near misses, and antiderivatives that jump, or aren't there."""

from typing import Any

import pytest

from canon.checker import alone_integrals, alone_together
from tests.checker.certified import certified, resealed

PLANE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}}
NAMES = {"a": "positive", "b": "positive", "k": "real", "u": "function"}


def answer(f: str, start: str, end: str, equals: str, antiderivative: str, *where: str, **sections: Any) -> str:
    """The answer about ∫ f dx by this antiderivative."""
    claim = {"kind": "integral", "f": f, "variable": "x", "from": start, "to": end, "equals": equals}
    tables = {**PLANE, "symbols": NAMES, "domain": {"where": [*where]}, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "known": {"antiderivative": antiderivative}, "verdict": "proved",
            "witness": None, "cases": [{}]}  # fmt: skip
    return alone_integrals.checked(resealed(data))[0]


SHOWN = [
    ("x**2", "0", "a", "a**3/3", "x**3/3"), ("cos(k*x)*k", "0", "pi", "sin(k*pi)", "sin(k*x)"),
    ("sin(x)", "0", "pi", "2", "-cos(x)"), ("1/x", "a", "2*a", "log(2)", "log(x/a)"),
    ("1/sqrt(a**2 - x**2)", "-a", "a", "pi", "asin(x/a)"), ("1/sqrt(x)", "0", "a", "2*sqrt(a)", "2*sqrt(x)"),
    ("exp(-a*x)", "0", "infinity", "1/a", "-exp(-a*x)/a"), ("1/x**2", "a", "infinity", "1/a", "-1/x"),
    ("x*exp(a*x)", "-infinity", "0", "-1/a**2", "(x/a - 1/a**2)*exp(a*x)"),
    ("x*exp(-x**2)", "-infinity", "infinity", "0", "-exp(-x**2)/2"),
    ("u(x) + x*D(u(x), x)", "0", "a", "a*u(a) - 0*u(0)", "x*u(x)"),
    ("sqrt(x - b)", "b", "a", "2*(a - b)**(3/2)/3", "2*(x - b)**(3/2)/3", "b < a"),
    ("1/(1 + x**2)", "-1", "1", "pi/2", "atan(x)"),
    ("1/sin(x)**2", "a", "pi/2", "cos(a)/sin(a)", "-cos(x)/sin(x)", "a < pi/2"),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_an_integral_is_shown(given: Any) -> None:
    assert answer(*given) == "shown"


MISSES = [
    ("1/(1 + cos(x))", "0", "3*pi/2", "-1", "sin(x)/(1 + cos(x))"), ("1/(1 + cos(2*x))", "0", "pi", "0", "tan(x)/2"),
    ("1/(1 - sin(x))", "0", "pi", "-2", "cos(x)/(1 - sin(x))"), ("0*x", "0", "2*pi", "-2*pi", "2*atan(tan(x/2)) - x"),
    ("x**2", "0", "a", "1001/1000*a**3/3", "x**3/3"), ("x**2", "0", "a", "a**3/3", "x**3/2"),
    ("sin(x)", "0", "pi", "-2", "-cos(x)"), ("1/x**2", "-1", "1", "-2", "-1/x"),
    ("1/x", "-1", "1", "0", "log(x**2)/2"), ("1/x", "a", "b", "log(b/a)", "log(x)"),
    ("1/x", "k", "k + 1", "log((k + 1)/k)", "log(x)"), ("1/sqrt(a**2 - x**2)", "-b", "b", "2*asin(b/a)", "asin(x/a)"),
    ("x/sqrt(x**2 - b**2)", "-a", "a", "0", "sqrt(x**2 - b**2)", "b < a"),
    ("(1 + tan(x)**2)/(1 + 4*tan(x)**2)", "0", "pi", "0", "atan(2*tan(x))/2"),
    ("3/(5 + 4*cos(x))", "0", "2*pi", "0", "2*atan(tan(x/2)/3)"),
    ("1/(x**2 + a**2)", "-a", "a", "-pi/(2*a)", "-atan(a/x)/a"), ("-x/sqrt(x**2)", "-1", "1", "-2", "-sqrt(x**2)"),
    ("exp(a*x)", "0", "infinity", "-1/a", "exp(a*x)/a"), ("exp(-k*x)", "0", "infinity", "1/k", "-exp(-k*x)/k"),
    ("cos(x)", "0", "infinity", "0", "sin(x)"), ("1", "0", "infinity", "0", "x"),
    ("1/x**2", "0", "infinity", "0", "-1/x"), ("2*x*exp(x**2)", "-infinity", "0", "1", "exp(x**2)"),
    ("x", "b", "a", "(a**2 - b**2)/2", "x**2/2"), ("x", "infinity", "0", "0", "x*exp(-x)"),
    ("x", "0", "-infinity", "0", "0*x + x**2/2"), ("D(u(x), x)", "0", "a", "u(a)", "u(x)"),
    ("u(x) + x*D(u(x), x)", "0", "a", "a*u(a)", "x*u(x)"), ("0*x", "0", "a", "0", "sqrt(k)"),
    ("1", "0", "a", "a", "x + 0*sqrt(x - a)"), ("1", "0", "a", "a", "x + 0*log(k)"),
    ("1", "0", "a", "a", "x + 0*u(k)"), ("x", "0", "x", "x**2/2", "x**2/2"), ("1", "0", "a", "x", "x"),
    ("1", "0", "a", "a", "x", "x > b"), ("1/x", "0", "a", "log(a)", "log(x)"), ("k**x", "0", "1", "k - 1", "k**x"),
    ("0*x", "0", "a", "1", "sin(x)**2 + cos(x)**2"), ("1", "0", "a", "a", "x + _to - a"), ("1", "0", "1j", "1j", "x"),
    ("0*x", "0", "2*a", "pi", "atan(a/(a - x)) + atan((x - a)/a)"), ("0*x", "-a", "a", "2*pi", "atan2(0*x, x)*2"),
    ("0*x", "-a", "a", "-pi", "acos(x/sqrt(x**2))"),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_another_value_or_an_antiderivative_that_jumps_shows_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


@pytest.mark.parametrize("sections", [
    {"symbols": {"x": "positive", "a": "positive"}}, {"symbols": {"x": "function", "a": "positive"}},
    {"symbols": {"x": ["real", "nonzero"], "a": "positive"}}, {"definitions": {"x": "1"}},
    {"symbols": {"a": "positive", "infinity": "real"}},
    {"hamiltonian": {"H": "log(x - a)"}}, {"domain": {"on": ["k - x"]}}, {"constraints": {}},
])  # fmt: skip
def test_the_variable_is_free_along_the_range(sections: Any) -> None:
    assert answer("1", "-a", "a", "2*a", "x") == "shown"
    assert answer("1", "-a", "a", "2*a", "x", **sections) == "not shown"


def test_a_certificate_carries_it() -> None:
    keys = "kind = 'integral'\nvariable = 'x'\nf = 'x/sqrt(1 - x**2)'\nfrom = '0'\nto = '1'\nequals = '1'"
    data = certified('[phase_space]\nq = ["q"]\np = ["p"]\n', keys)
    assert alone_together.checked(data) == ("shown", "")
    for changed in ({"antiderivative": "-sqrt(1 - x**2) + x"}, {"antiderivative": "_lhs"}, {}):
        assert alone_together.checked(resealed({**data, "known": changed}))[0] == "not shown"
    assert alone_together.checked({**data, "known": {}})[0] == "wrong"
