"""Identities of old and new variables, and on surfaces: what is shown, and near misses."""

from typing import Any

import pytest

from canon.checker import alone_related, alone_together
from tests.checker.certified import certified, resealed
from tests.checker.identities import NAMES, SPACE, answer

FORWARD: Any = {"transformation": {"Q": ["x + y**2", "y"], "P": ["u", "v - 2*y*u"]}}
BACKWARD: Any = {"transformation": {"q": ["X - Y**2", "Y"], "p": ["U", "V + 2*Y*U"]}}
SINGULAR: Any = {"transformation": {"q": ["X", "X"], "p": ["U", "V"]}}
SQUARE: Any = {"transformation": {"Q": ["x**2", "y"], "P": ["u/(2*x)", "v"]}}
FEWER: Any = {
    "phase_space": {**SPACE["phase_space"], "Q": ["X"], "P": ["U"]}, "transformation": {"Q": ["x*y"], "P": ["u/y"]},
}  # fmt: skip
TWO: Any = {"generating_function": {"type": 2, "F": "x*U + y*V + y**2*U"}}
FLAT: Any = {"generating_function": {"type": 2, "F": "(x + y)*(U + V)"}}

RELATED: Any = [
    (FORWARD, "X - Y**2", "x"), (FORWARD, "V + 2*y*U", "v"), (FORWARD, "D(F(X, Y), Y)", "D(F(x + y**2, Y), Y)"),
    (FORWARD, "D(F(x + y**2, y), y)", "D(F(X, Y), Y) + 2*y*D(F(X, Y), X)"), (FORWARD, "D(x*X, x)", "x + y**2"),
    (FORWARD, "bracket(x, u)*X", "X"), (BACKWARD, "x + y**2", "X"), (BACKWARD, "D(x*Y, Y)", "x"),
    (BACKWARD, "D(F(x + Y**2), x)", "D(F(X), X)"), (FEWER, "X*U", "x*u"), (FEWER, "D(X*x, x)", "x*y"),
    (TWO, "X", "x + y**2"), (TWO, "v", "V + 2*y*U"), (TWO, "D(y**2*U, U)", "Y**2"),
    (SQUARE, "2*x*sqrt(X)*U", "u*sqrt(x**2)"),
]  # fmt: skip


@pytest.mark.parametrize("given", RELATED)
def test_old_and_new_variables(given: Any) -> None:
    by, lhs, rhs = given
    assert answer(lhs, rhs, by=by) == "shown"
    assert {answer(lhs, f"{rhs} + x/1000", by=by), answer(lhs, f"-({rhs})", by=by)} == {"not shown"}


UNRELATED: Any = [
    (FORWARD, "D(X, x)", "0"), (FORWARD, "D(X, x)", "1"), (FORWARD, "D(x, X)", "0"), (FORWARD, "D(x*X, x)", "X + x"),
    (FORWARD, "bracket(X, U)", "0"), (FORWARD, "bracket(X, U)", "1"), (FORWARD, "bracket(x*X, u)", "X"),
    (FORWARD, "X", "Y"),
    (FORWARD, "D(X*m, m)", "X + 1"), (SINGULAR, "x", "y"), (SINGULAR, "X", "Y"), (SQUARE, "sqrt(X)", "x"),
    (FLAT, "u", "v"), (FLAT, "X", "Y"), ({"transformation": {"Q": ["x", "y"]}}, "X", "x"), (TWO, "U", "v"),
    (TWO, "u", "-U"),
    ({"generating_function": {"type": 1, "F": "x*X + y*Y"}}, "U", "x"), (None, "X", "x"), (FORWARD, "X", "X + 0*Z"),
    ({"generating_function": {"type": 2, "F": "x*U + y*V + u"}}, "u", "U"), ({**FORWARD, **TWO}, "U", "v"),
    ({"transformation": {"Q": ["x + m*X", "y"], "P": ["u", "v"]}}, "X - m*X", "x"), (FEWER, "Y", "y"),
    ({"transformation": {"Q": ["x + m", "y"], "P": ["u", "v"]}}, "D(X, m)", "0"),
    ({"transformation": {"Q": ["x + t", "y"], "P": ["u", "v"]}}, "D(X, t)", "0"),
    ({**FORWARD, "definitions": {"X": "x"}}, "X", "x"), ({**FORWARD, "definitions": {"given0x": "0"}}, "X", "0"),
    ({**FORWARD, "claim": 0, "phase_space": {**SPACE["phase_space"], "Q": ["x", "Y"]}}, "x", "x + y**2"),
]  # fmt: skip


@pytest.mark.parametrize("given", UNRELATED)
def test_what_a_map_doesnt_say_shows_nothing(given: Any) -> None:
    by, lhs, rhs = given
    assert answer(lhs, rhs, by=by) == "not shown"


def test_a_condition_on_new_variables_and_their_words() -> None:
    assert answer("sqrt(X**2)", "X", "X > 0", by=SQUARE) == "shown"
    assert answer("sqrt(Y**2)", "Y", "Y > 0", by=SQUARE) == "shown"
    assert answer("sqrt(Y**2)", "Y", "X > 0", by=SQUARE) == "not shown"
    assert answer("sqrt(Y**2)", "y", by=SQUARE, Y="positive") == "shown"
    assert answer("sqrt(Y**2)", "y", by=SQUARE, Y="negative") == "not shown"
    assert answer("sqrt(x**2)", "x", "D(X*x, x) > 0", by=SQUARE) == "not shown"


ON: Any = [
    ("x - y", "x**2", "y**2", "-y**2"), ("x - y", "exp(x)", "exp(y)", "exp(-y)"), ("m*x - k", "x", "k/m", "m/k"),
    ("x*y - 1", "x", "1/y", "y"), ("x*u + y*v", "x*u", "-y*v", "y*v"), ("x**2 - y**2", "x**4", "y**4", "-y**4"),
    ("x**2 + y**2 - 1", "1 - x**2", "y**2", "-y**2"), ("x - y", "D(F(x), x)", "D(F(y), y)", "D(F(x), y)"),
    ("u/m - sqrt(v**2)", "u**2/m", "m*v**2", "m*v"), ("x**2 - 4", "x**3", "4*x", "8"),
    ("m - x", "sqrt(x**2)", "x", "-x"), ("x/y", "x", "0", "y"),
]  # fmt: skip


@pytest.mark.parametrize("given", ON)
def test_on_a_surface(given: Any) -> None:
    on, lhs, right, wrong = given
    assert (answer(lhs, right, on=on), answer(lhs, wrong, on=on)) == ("shown", "not shown")
    assert answer(lhs, right) == "not shown"


OFF: Any = [
    ("x*u", "x", "0"), ("x*u", "u", "0"), ("k*x", "x", "0"), ("x*y - y", "x", "1"), ("x*y - y*u", "x", "u"),
    ("x*y*u - u", "x", "1/y"),
    ("(x - y)*u", "u", "0"), ("(x - y)*u", "x", "y"), ("x**2 - y**2", "x", "y"), ("x**2 - y**2", "x", "-y"),
    ("x**2 - y**2", "sqrt(x**2)", "sqrt(y**2)"), ("x*y - 1", "sqrt(x**2)", "x"), ("x**2*y - y", "x**2", "1"),
    ("x - y", "D(x, x)", "D(y, x)"), ("x - y", "exp(D(F(x, y), x))", "exp(D(F(y, x), x))"),
    ("x - y", "cos(D(F(x, y), x))", "cos(D(F(y, x), x))"), ("x - y", "bracket(x, u)", "bracket(y, u)"),
    ("x - sqrt(y**2)", "x", "y"),
    (["x", "y"], "x", "0"), ("x - X", "x", "X"), ("sin(x)", "sin(x)", "0"), ("x - exp(x)", "x", "exp(x)"),
    ("x + (y**2 - y*abs(y))*u", "x", "0"), ("", "x", "0"), ("x*y + 0*u", "x", "0"), ("x**3 - y**3", "x", "y"),
    ("x**2 - 4", "x", "2"), ("x**2 - 4", "x", "-2"),
]  # fmt: skip


@pytest.mark.parametrize("given", OFF)
def test_parts_of_a_surface_that_would_be_left_out_show_nothing(given: Any) -> None:
    on, lhs, rhs = given
    assert answer(lhs, rhs, on=on) == "not shown"


def test_a_surface_beside_maps() -> None:
    assert answer("X", "0", on="x + y**2", by=FORWARD) == "shown"
    assert answer("X", "x", on="x + y**2", by=FORWARD) == "not shown"
    assert answer("X", "0", on="X", by=FORWARD) == "not shown"
    assert answer("X", "0", on="x + y**2", by=BACKWARD) == "not shown"


def test_other_kinds_of_claims_know_the_same() -> None:
    def told(claim: Any, **sections: Any) -> str:
        tables = {"phase_space": {"q": ["x"], "p": ["u"]}, "symbols": NAMES, **sections, "claim": claim}
        data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
        return alone_related.checked(resealed(data))[0]

    bracket = {"kind": "bracket", "f": "sqrt(x**2 + 1)**n", "g": "u", "equals": "n*x*sqrt(x**2 + 1)**(n - 2)"}
    assert told(bracket) == "shown"
    assert told({**bracket, "equals": "n*sqrt(x**2 + 1)**(n - 2)"}) == "not shown"
    lorentz = [["1/sqrt(1 - r**2)", "r/sqrt(1 - r**2)"], ["r/sqrt(1 - r**2)", "1/sqrt(1 - r**2)"]]
    group = {
        "kind": "matrix_group",
        "matrix": lorentz,
        "first": ["r"],
        "second": ["s"],
        "composition": ["(r + s)/(1 + r*s)"],
    }
    assert told(group) == "shown"
    assert told({**group, "composition": ["(r + s)/(1 - r*s)"]}) == "not shown"
    assert told({**group, "composition": ["r + s"]}) == "not shown"


@pytest.mark.parametrize(("tables", "claim"), [
    ('[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\nQ = ["r", "a"]\nP = ["pr", "M"]\n[transformation]\n'
     'Q = ["sqrt(x**2 + y**2)", "atan2(y, x)"]\nP = ["(x*px + y*py)/sqrt(x**2 + y**2)", "x*py - y*px"]',
     "kind = 'identity'\nlhs = 'D(atan2(y, x), y)'\nrhs = 'D(pr*sin(a) + M*cos(a)/r, M)'"),
    ('[phase_space]\nq = ["x"]\np = ["u"]\n[domain]\non = ["x*u - 1"]', "kind = 'identity'\nlhs = 'x'\nrhs = '1/u'"),
    ('[phase_space]\nq = ["x"]\np = ["u"]\nQ = ["X"]\nP = ["U"]\n[transformation]\nQ = ["2*x"]\nP = ["u/2"]',
     "kind = 'identity'\nlhs = 'D(x*X, x)'\nrhs = '2*x'"),
])  # fmt: skip
def test_it_is_asked_of_a_certificate(tables: str, claim: str) -> None:
    data = certified(tables, claim)
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["rhs"] += " + x"
    assert alone_together.checked(resealed(data))[0] == "not shown"
