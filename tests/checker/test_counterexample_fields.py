"""Refutations of field equations: what is shown, and that no true claim is, nor one of another form."""

from typing import Any

import pytest

from canon.checker import counterexample_fields, refutations
from canon.checker.alone import Stop
from tests.checker.certified import resealed

STRING: Any = {
    "phase_space": {"q": ["q"], "p": ["p"]},
    "symbols": {"x": "real", "a": "real", "c": "positive", "u": "function", "v": "function", "V": "function"},
}
L = "D(u(x, t), t)**2/2 - c**2*D(u(x, t), x)**2/2 - a*u(x, t)**3"
RIGHT = "-D(u(x, t), t, 2) + c**2*D(u(x, t), x, 2) - 3*a*u(x, t)**2"


def refutes(lagrangian: str, fields: list[str], equations: list[str], **sections: Any) -> bool:
    tables = {**STRING, **sections}
    tables["claim"] = {"kind": "field_equations", "L": lagrangian, "fields": fields, "equations": equations}
    data = {"certificate": 1, "tables": tables, "verdict": "refuted", "known": {}, "cases": [], "method": ""}
    witness = {"x": "2/3", "t": "-1/2", "a": "3/4", "c": "7/5", "q": "1", "p": "2", "u": "a1**5 + a1*a2 + 2*a2**2 + 1",
               "v": "a1*a2**3 - a1", "V": "a**3 + a"}  # fmt: skip
    try:
        found = counterexample_fields.refuted(*refutations.renamed(refutations.said(tables), witness))[0] == "shown"
    except (Stop, ValueError, KeyError):
        found = False
    assert (refutations.checked(resealed({**data, "witness": witness}))[0] == "shown") == found
    return found


TRUE = [
    (L, ["u(x, t)"], [RIGHT]),
    ("D(u(x, t), x, 2)**2/2", ["u(x, t)"], ["D(u(x, t), x, 4)"]),
    ("D(u(x, t), x, 2)*D(u(x, t), t)", ["u(x, t)"], ["0"]),
    ("D(u(x, t), x)*u(x, t)**2", ["u(x, t)"], ["0"]),
    ("x*D(u(x, t), x)", ["u(x, t)"], ["-1"]),
    (
        "V(u(x, t)) + D(u(x, t), x)*v(x, t)",
        ["u(x, t)", "v(x, t)"],
        ["D(V(u(x, t)), x)/D(u(x, t), x) - D(v(x, t), x)", "D(u(x, t), x)"],
    ),
    ("D(u(x, t)*v(x, t), x)", ["u(x, t)", "v(x, t)"], ["0", "0"]),
]
FALSE = [
    (L, ["u(x, t)"], [RIGHT.replace("3*", "2*")]),
    (L, ["u(x, t)"], [RIGHT + " + x/1000"]),
    (L, ["u(x, t)"], ["-(" + RIGHT + ")"]),
    ("D(u(x, t), x, 2)**2/2", ["u(x, t)"], ["-D(u(x, t), x, 4)"]),
    ("x*D(u(x, t), x)", ["u(x, t)"], ["0"]),
    ("D(u(x, t), x)*v(x, t)", ["u(x, t)", "v(x, t)"], ["-D(v(x, t), x)", "-D(u(x, t), x)"]),
]
OTHERS = [
    (L, ["u(x, x)"], ["0"]),
    (L, ["u(x, 2*t)"], ["0"]),
    (L, ["u(x, t)", "u(x, t)"], ["0", "0"]),
    (L.replace("u(x, t)**3", "u(t, x)"), ["u(x, t)"], ["0"]),
    (L.replace("u(x, t)**3", "u(0, t)"), ["u(x, t)"], ["0"]),
    (L, ["u(x, t)"], ["0", "0"]),
    (L, ["c"], ["0"]),
    (L, ["w(x, t)"], ["0"]),
    ("log(-1 - x**2)", ["u(x, t)"], ["1"]),
]


@pytest.mark.parametrize("given", TRUE)
def test_equations_that_are_the_fields_are_not_refuted(given: Any) -> None:
    assert not refutes(*given)


@pytest.mark.parametrize("given", FALSE)
def test_other_equations_are(given: Any) -> None:
    assert refutes(*given)


@pytest.mark.parametrize("given", OTHERS)
def test_fields_of_another_form_are_left_alone(given: Any) -> None:
    assert not refutes(*given)


def test_the_point_lies_in_the_domain() -> None:
    wrong = (L, ["u(x, t)"], [RIGHT + " + x"])
    for where in ("x > 1", "a < 0", "x + t < 0"):
        assert not refutes(*wrong, domain={"where": [where]})
    assert refutes(*wrong, domain={"where": ["x > 0"]})
    assert not refutes(*wrong, domain={"on": ["x"]})
    assert not refutes(*wrong, symbols={**STRING["symbols"], "x": "negative"})
