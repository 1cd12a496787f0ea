"""Lie series to an order, dimensions step by step, and names in exponents, each in one small file."""

from typing import Any

import pytest

from canon.checker import alone_powers, alone_series, alone_together, alone_units
from tests.checker.certified import certified, resealed

NAMES = {"m": "positive", "k": "real", "n": "real", "r": "positive", "V": "function", "S": "function", "W": "function"}
SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": NAMES}


def answer(file: Any, claim: Any, **sections: Any) -> str:
    data = {"certificate": 1, "tables": {**SPACE, "claim": claim, **sections}, "verdict": "proved", "witness": None}
    return file.checked(resealed({**data, "cases": [{}]}))[0]


def series(generator: str, f: str, order: Any, equals: str, parameter: str = "s", **sections: Any) -> str:
    claim = {"kind": "lie_series", "generator": generator, "f": f, "order": order, "equals": equals}
    return answer(alone_series, {**claim, "parameter": parameter}, **sections)


@pytest.mark.parametrize("given", [
    ("p", "q", 1, "q + s"), ("p", "q", 3, "q + s"), ("p**2/2 + V(q)", "q", 2, "q + s*p - s**2*D(V(q), q)/2"),
    ("(q**2 + p**2)/2", "q", 4, "q*(1 - s**2/2 + s**4/24) + p*(s - s**3/6)"), ("q*p", "q", 2, "q*(1 + s + s**2/2)"),
    ("p", "sqrt(q)", 2, "sqrt(q) + s/(2*sqrt(q)) - s**2/(8*q**(3/2))"), ("V(q, p)", "V(q, p)", 2, "V(q, p)"),
])  # fmt: skip
def test_series_are_shown(given: Any) -> None:
    assert series(*given) == "shown"


@pytest.mark.parametrize("given", [
    ("p", "q", 1, "q - s"), ("p", "q", 1, "q"), ("p", "q", 1, "q + s + s**2"), ("p", "q**2", 1, "(q + s)**2"),
    ("p**2/2 + V(q)", "q", 2, "q + s*p + s**2*D(V(q), q)/2"), ("q*p", "q", 2, "q*(1 + s + s**2)"),
    ("q*p", "q", 2, "q*exp(s)"), ("q*p", "q", 2, "q*(1 + s + s**2/2) + 0/s"), ("q*p", "q", 2, "q*(1 + s)"),
    ("q*p", "q", 2, "q*(1 + s + s**2/2)*V(s)/V(s)"), ("q*p", "q", 2, "q*(1 + s + s**2/2) + sqrt(s**2) - s"),
    ("q*p", "q", 0, "q"), ("q*p", "q", 2, "1 + q*(1 + s + s**2/2)"), ("s*p", "q", 2, "q + s**2"),
    ("p", "q*s", 1, "q*s"),
    ("p", "q", True, "q + s"), ("p", "q", "1", "q + s"), ("p", "q", 41, "q + s"), ("p", "q", 1, "q + s", "q"),
    ("t*p", "q", 2, "q + t**2/2", "t"), ("p", "q + t", 2, "q + 2*t", "t"),
    ("p", "q", 1, "q + t", "t"), ("1j*p", "q", 1, "q + 1j*s"), ("p", "q", 1, "q + m*s", "m"),
])  # fmt: skip
def test_other_series_arent_shown(given: Any) -> None:
    assert series(*given) == ("shown" if given == ("p", "q", 1, "q + t", "t") else "not shown")


def test_series_beside_other_sections() -> None:
    given = ("p", "q", 1, "q + s")
    assert series(*given, domain={"where": ["s > 0"]}, symbols={"s": "real"}) == "not shown"
    assert series(*given, symbols={"s": "positive"}) == "not shown"
    both: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
    assert series(*given, **both, transformation={"Q": ["q"], "P": ["p"]}) == "shown"
    assert series(*given, **both, transformation={"q": ["Q"], "p": ["Q"]}) == "not shown"
    assert series(*given, definitions={"s": "1"}) == "not shown"


UNITS = {"q": "L", "p": "M*L/T", "m": "M", "t": "T"}


def unit(*functions: str, equals: str, dimensions: Any = UNITS, base: Any = None, **sections: Any) -> str:
    claim = {"kind": "dimension", "functions": [*functions], "dimensions": dimensions, "equals": equals}
    return answer(alone_units, claim | ({"base": base} if base else {}), **sections)


CALLED = {**UNITS, "V": ["M*L**2/T**2", "L"], "S": ["M*L**2/T", "L", "T"]}


@pytest.mark.parametrize(("function", "equals"), [
    ("p**2/(2*m)", "M*L**2/T**2"), ("sqrt(p**2/m)", "M**(1/2)*L/T"), ("q + p*t/m", "L"), ("V(q)", "M*L**2/T**2"),
    ("D(V(q), q)", "M*L/T**2"), ("D(S(q, t), t) + V(q)", "M*L**2/T**2"), ("sin(q*m/(p*t))", "1"), ("0*q + 1", "1"),
    ("atan2(q, p*t/m)", "1"), ("1", "1"), ("q/q", "1"), ("exp(k)*q", "L"), ("D(q, q)", "1"), ("q/(M*1)", "L"),
    ("q**-2", "1/(L*L)"), ("q**-2", "L**-2"), ("p", "M*L/(T)"), ("W(k)*q", "L"),
])  # fmt: skip
def test_dimensions_are_shown(function: str, equals: str) -> None:
    expected = "not shown" if "*1" in function or "0*" in function else "shown"  # a name that isn't declared; a sum
    assert unit(function, equals=equals, dimensions=CALLED) == expected


@pytest.mark.parametrize(("function", "equals"), [
    ("p**2/(2*m)", "M*L**2/T"), ("q + p", "L"), ("q + 1", "L"), ("sin(q)", "1"), ("q**k", "L"), ("log(q)", "1"),
    ("V(p)", "M*L**2/T**2"), ("V(q)", "M*L**2"), ("D(V(q), q)", "M*L**2/T**2"), ("W(q)", "1"), ("D(V(2), q)", "1"),
    ("atan2(q, p)", "1"), ("S(q)", "M*L**2/T"), ("q", "L/T*T*T"), ("q", "2*L"), ("q", "L + L"), ("q", "L**k"),
    ("q", "1"),
    ("sqrt(q)", "L"), ("exp(q)*q", "L"), ("V(q) + S(q, t)", "M*L**2/T**2"), ("q", "Q"), ("q", "l"), ("q", ""),
])  # fmt: skip
def test_other_dimensions_arent_shown(function: str, equals: str) -> None:
    assert unit(function, equals=equals, dimensions=CALLED) == "not shown"


def test_what_dimensions_are_of() -> None:
    assert unit("q", "p*t/m", equals="L") == "shown"
    assert unit("q", "p", equals="L") == unit(equals="L") == "not shown"
    assert unit("q", equals="X", dimensions={"q": "X"}, base=["X"]) == "shown"
    assert unit("q", equals="X", dimensions={"q": "X"}) == unit("q", equals="L", base=["X"]) == "not shown"
    assert unit("q", equals="L", base=["L", "L", "M", "T"]) == unit("q", equals="L", base="LMT") == "not shown"
    for table in ({"q": ["L"]}, {"q": "L", "V": "L"}, {"q": "L", "x": "L"}, {"q": "L", "n": 1}, {"q": "L**0.5"}):
        assert unit("q", equals="L", dimensions=table) == "not shown"
    assert unit("n*q", equals="L", dimensions={"q": "L", "n": "1"}, symbols={"n": "integer"}) == "not shown"
    assert unit("a", equals="L", dimensions={"a": "L"}, definitions={"a": "q"}) == "not shown"
    assert unit("q", equals="L", transformation={"Q": ["q"], "P": ["p"]}) == "not shown"
    assert unit("q", equals="L", domain={"on": ["q - 1"]}) == "not shown"


def lagrange(L: str, *equations: str, **sections: Any) -> str:
    claim = {"kind": "euler_lagrange", "L": L, "velocities": ["v"], "accelerations": ["a"], "equations": [*equations]}
    return answer(alone_powers, claim, **sections)


@pytest.mark.parametrize(("L", "equation"), [
    ("r**n*v**2/2", "r**n*a"), ("(1 + v**2)**n", "2*n*(1 + v**2)**(n - 1)*(a + 2*(n - 1)*v**2*a/(1 + v**2))"),
    ("r**(n*t)*v", "n*log(r)*r**(n*t)"), ("(1 + q**2)**n", "-2*n*q*(1 + q**2)**(n - 1)"),
    ("r**(n + 1/2)*v**2/2", "sqrt(r)*r**n*a"), ("r**(2*n)*v**2/2", "(r**n)**2*a"),
])  # fmt: skip
def test_names_in_exponents(L: str, equation: str) -> None:
    assert lagrange(L, equation) == "shown"
    assert lagrange(L, f"{equation} + r**n") == lagrange(L, f"{equation}*2") == "not shown"


def test_powers_of_what_may_be_negative_and_whole_numbers() -> None:
    assert lagrange("(q**2)**n", "-2*n*q*(q**2)**(n - 1)") == lagrange("q**n", "-n*q**(n - 1)") == "not shown"
    assert lagrange("q**n", "-n*q**(n - 1)", domain={"where": ["q > 0"]}) == "shown"
    assert lagrange("q**n", "-n*q**(n - 1)", domain={"where": ["q >= 0"]}) == "not shown"
    assert lagrange("q**n", "-n*q**(n - 1)", domain={"where": ["q != 0"]}) == "not shown"
    assert lagrange("r**n*v**2/2", "r**n*a", symbols={"r": "positive", "n": "integer"}) == "not shown"
    assert lagrange("r**n*v**2/2", "r**k*a") == lagrange("r**n*v**2/2", "m**n*a") == "not shown"


def test_whole_turns() -> None:
    claim = {"kind": "solves", "solution": {"W(q)": "1 + k*cos(m*q)"}, "equations": ["W(2*pi/m) - W(0)"]}
    assert answer(alone_powers, claim) == "shown"
    assert answer(alone_powers, {**claim, "equations": ["W(pi/m) - W(0)"]}) == "not shown"
    assert answer(alone_powers, {**claim, "equations": ["W(2*pi) - W(0)"]}) == "not shown"
    assert answer(alone_powers, {**claim, "kind": "identity"}) == "not shown"


def test_they_are_asked_of_certificates() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\nm = "positive"\n'
    data = certified(
        text, 'kind = "lie_series"\ngenerator = "q*p"\nparameter = "s"\nf = "q"\norder = 1\nequals = "q + q*s"'
    )
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["order"] = 2
    assert alone_together.checked(resealed(data))[0] == "not shown"
    data = certified(text.replace('m = "positive"', 'V = "function"'),
        'kind = "dimension"\nfunctions = ["V(q)"]\nequals = "M"\ndimensions = { q = "L", V = ["M", "L"] }')  # fmt: skip
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["equals"] = "L"
    assert alone_together.checked(resealed(data))[0] == "not shown"
