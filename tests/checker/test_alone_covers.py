"""Inequalities in one variable by pieces of its range: what is shown, near misses, ends, zeros inside, functions."""

from typing import Any

import pytest

from canon.checker import alone_covers, alone_signs, alone_together
from tests.checker.certified import certified, resealed

NAMES = {"a": "positive", "n": "nonnegative", "m": "nonnegative", "V": "function", "x": "real"}


def answer(lhs: str, relation: str, rhs: str, *where: str, by: Any = alone_covers, **sections: Any) -> str:
    claim = {"kind": "inequality", "lhs": lhs, "relation": relation, "rhs": rhs}
    tables = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": NAMES, "domain": {"where": [*where]}}
    data = {"certificate": 1, "tables": {**tables, **sections, "claim": claim}, "verdict": "proved", "witness": None}
    return by.checked(resealed({**data, "cases": [{}]}))[0]


SHOWN = [
    ("q**2*(1 - cos(q))", "<", "2*((q - sin(q))**2 + (1 - cos(q))**2)", "1/4 < q", "q < 25/4"),
    ("sin(x)", "<", "x", "0 < x < 2"),
    ("sin(x)", "<=", "x", "0 <= x <= 2"),
    ("cos(x)", ">", "0", "-3/2 < x", "3/2 > x"),
    ("x**4 - x**2 + 1", ">", "7/10", "-2 <= x", "x <= 2"),
    ("1 - x", ">", "0", "0 <= x < 1"),
    ("1 - x", ">=", "0", "0 <= x <= 1"),
    ("exp(x) - 1 - x", ">", "0", "0 < x < 3"),
    ("x*(1 - x)", ">", "0", "0 < x < 1"),
    ("sin(x)", ">=", "0", "0 <= x < pi/2"),
    ("log(x)", "<", "x - 1/2", "1/10 < x < 5"),
    ("w", ">", "0", "1/10 < x < 3"),
    ("-a**2*n", "<=", "0"),
    ("n*m + a", ">", "0"),
    ("-(n + m)**2", "<=", "n"),
    ("sqrt(x)", "<", "2", "1 < x < 7/2"),
]

MISSES = [
    ("q**2*(1 - cos(q))", "<", "19/10*((q - sin(q))**2 + (1 - cos(q))**2)", "1/4 < q < 1"),
    ("q**2*(1 - cos(q))", "<", "2*((q - sin(q))**2 + (1 - cos(q))**2)", "-1/4 < q", "q < 1"),
    ("sin(x)", "<", "x", "0 <= x < 2"),
    ("sin(x)", "<", "x", "-1/100 < x < 2"),
    ("sin(x)", "<", "x", "0 < x"),
    ("sin(x)", "<", "x", "2 > x"),
    ("sin(x)", "<", "x", "0 != x", "x < 2"),
    ("sin(x)", "<", "x", "2 < x < 0"),
    ("1 - x", ">", "0", "0 <= x <= 1"),
    ("1 - x", ">=", "0", "0 <= x < 2"),
    ("x**4 - x**2 + 1", ">", "3/4", "-2 <= x", "x <= 2"),
    ("(x - 1/3)**2", ">", "0", "0 < x < 1"),
    ("x*(1 - x)", ">", "0", "0 <= x < 1"),
    ("x*(1 - x)", ">", "0", "0 < x <= 1"),
    ("x*(x - 1)", "<=", "-1/4", "0 < x < 1"),
    ("1/x", ">", "-5", "-1 < x < 1"),
    ("log(x)", "<", "x - 1/2", "-1 < x < 5"),
    ("sqrt(x)", "<", "2", "-1 < x < 3"),
    ("x - sin(x)", ">", "x**3/6", "0 < x < 2"),
    ("V(x)", ">", "0", "0 < x < 1"),
    ("V(1)", ">", "0"),
    ("V(1) + x", ">", "0", "0 < x < 1"),
    ("D(V(x), x)", ">", "-10", "0 < x < 1"),
    ("x*a", ">", "-1", "0 < x < 1"),
    ("a**2*n", ">", "0"),
    ("-n", "<", "0"),
    ("n - m", ">=", "0"),
    ("n*x", ">=", "0"),
    ("n - 1", ">=", "0"),
    ("sqrt(n) - n", "<=", "0"),
    ("sin(x)", ">", "0", "0 < x < pi*2"),
    ("sin(x)", "<", "1", "0 < x < 3"),
    ("x", "<", "1", "0 < x < a"),
    ("1 - y", ">", "0", "0 < x < 1"),
    ("w - 1", ">", "0", "1/10 < x < 3"),
    ("x - q", "<", "1", "0 < x < 1"),
]


@pytest.mark.parametrize("given", SHOWN)
def test_an_inequality_is_shown(given: Any) -> None:
    assert answer(*given, definitions={"w": "x**2"}) == "shown"


@pytest.mark.parametrize("given", MISSES)
def test_what_is_false_or_of_other_names_is_not(given: Any) -> None:
    assert answer(*given, definitions={"w": "x**2"}) == "not shown"


def test_a_value_of_a_function_may_be_any() -> None:
    """In intervals one that is declared would be an exponential."""
    for by in (alone_covers, alone_signs, alone_together):
        assert answer("V(1)", ">", "0", by=by) == "not shown"
        assert answer("V(1)", "<", "5", by=by, symbols={"V": ["function", "positive"]}) == "not shown"
        assert answer("D(V(1), q)", ">", "-1", by=by) == "not shown"
    assert answer("V(1)", ">", "0", by=alone_signs, symbols={"V": ["function", "positive"]}) == "shown"
    assert answer("pi", "<", "22/7", by=alone_signs) == "shown"


def test_it_is_asked_of_a_certificate() -> None:
    text, claim = (
        '[phase_space]\nq = ["q"]\np = ["p"]\n[domain]\nwhere = ["1/2 < q", "q < 2"]\n',
        "kind = 'inequality'\nlhs = 'cos(q)'\nrelation = '>'\nrhs = '1 - q**2/2'",
    )
    data = certified(text, claim)
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["rhs"] = "1 - q**2/3"
    assert alone_together.checked(resealed(data))[0] == "not shown"
