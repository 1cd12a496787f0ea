"""Field equations: what is shown, other signs and orders, and fields that are none."""

from typing import Any

import pytest

from canon.checker import alone_fields, alone_together
from tests.checker.certified import certified, resealed

NAMES = {"u": "function", "w": "function", "V": "function", "c": "positive", "s": "real", "n": "integer"}


def answer(L: str, equations: Any, fields: Any = ("u(s, t)",), **sections: Any) -> str:
    """The answer about the equations of L."""
    claim = {"kind": "field_equations", "L": L, "fields": [*fields], "equations": [*equations]}
    tables = {"phase_space": {"q": ["x"], "p": ["p"]}, "symbols": NAMES, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_fields.checked(resealed(data))[0]


BOTH = ("u(s, t)", "w(s, t)")
SHOWN: Any = [
    ("D(u(s, t), t)**2/2 - c**2*D(u(s, t), s)**2/2", ["c**2*D(u(s, t), s, 2) - D(u(s, t), t, 2)"]),
    ("D(u(s, t), t)**2/2 + cos(u(s, t))", ["-sin(u(s, t)) - D(u(s, t), t, 2)"]), ("D(V(u(s, t)), t) + s", ["0*s"]),
    ("D(u(s, t), s, 2)**2/2", ["D(u(s, t), s, 4)"]), ("s*D(u(s, t), s)*u(s, t)", ["-u(s, t)"]),
    ("V(D(u(s, t), s))", ["-D(D(V(D(u(s, t), s)), s)/D(u(s, t), s, 2), s)"]),
    ("D(D(u(s, t), s), t)*u(s, t)", ["2*D(D(u(s, t), t), s)"]),
    ("sqrt(1 + D(u(s, t), s)**2)", ["-D(u(s, t), s, 2)/sqrt(1 + D(u(s, t), s)**2)**3"]),
    ("u(s, t)*w(s, t) + D(w(s, t), s)*u(s, t)", ["w(s, t) + D(w(s, t), s)", "u(s, t) - D(u(s, t), s)"], BOTH),
    ("exp(s)*u(s, t)**2", ["2*exp(s)*u(s, t)"]), ("D(u(s, t), s)**3", ["-6*D(u(s, t), s)*D(u(s, t), s, 2)"]),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_equations_of_fields(given: Any) -> None:
    L, equations, *fields = given
    assert answer(L, equations, *fields) == "shown"
    assert answer(f"{L} + u(s, t)/1000", equations, *fields) == "not shown"
    assert answer(f"2*({L}) + s*u(s, t)", [f"-({text})" for text in equations], *fields) == "not shown"


MISSES: Any = [
    ("D(u(s, t), s)**2/2", ["D(u(s, t), s, 2)"]), ("D(u(s, t), s, 2)**2/2", ["-D(u(s, t), s, 4)"]),
    ("u(s, t)**2", ["0"], ("w(s, t)",)),
    ("u(0, t)**2", ["0"]), ("u(s, t)*u(t, s)", ["2*u(t, s)"]), ("u(s, t)*u(t, s)", ["u(t, s) + u(s, t)"]),
    ("u(s, t)*u(t, s)", ["u(t, s)"]),
    ("D(u(s, t), s, 3)**2", ["-2*D(u(s, t), s, 6)"]),
    ("u(s, t)*w(s, t)", ["w(s, t)", "w(s, t)"], BOTH), ("u(s, t)*w(s, t)", ["w(s, t)"], BOTH),
    ("u(s, t)**2", ["2*u(s, t)"], ("u(s, s)",)),
    ("u(s, t)*w(t, s)", ["w(t, s)", "u(s, t)"], ("u(s, t)", "w(t, s)")),
    ("u(s, t)**2", ["2*u(s, t)"] * 2, ("u(s, t)", "u(s, t)")),
    ("c**2", ["2*c"], ("c",)), ("V(s)*u(s, t)", ["0"], ("u(s, t)",)), ("u(s, t)**2", ["2*u(s, t)"], ("u(s, r)",)),
    ("u(s, t)", ["1"], ("u(s, x**2)",)),  ("D(u(s, t), s)*u(s, t)", ["u(s, t)"]), ("u(n, t)", ["1"], ("u(n, t)",)),
    ("u[1, 0](s, t)**2", ["0"]),
    ("sin(u(s, t))", ["sin(u(s, t))"]), ("u(s + 1, t)", ["0"]), ("u(s, t)", ["1"], ("u(field0x, t)",)),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_other_equations_show_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


def test_definitions_and_other_keys() -> None:
    wave = {"definitions": {"slope": "D(u(s, t), s)"}}
    assert answer("slope**2/2", ["-D(slope, s)"], **wave) == "shown"
    assert answer("slope**2/2", ["D(slope, s)"], **wave) == "not shown"
    assert answer("slope**2/2", ["-D(slope, s)"], definitions={"slope": "D(u(s, t), s)", "s": "0"}) == "not shown"
    assert answer("u(s, t)**2", ["2*u(s, t)"], symbols={**NAMES, "s": "function"}) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["x"]\np = ["p"]\n[symbols]\nu = "function"\nm = "real"\n'
    claim = 'kind = "field_equations"\nL = "D(u(x, t), t)**2/2 - m**2*u(x, t)**2/2"\nfields = ["u(x, t)"]\n'
    data = certified(text, f'{claim}equations = ["-D(u(x, t), t, 2) - m**2*u(x, t)"]')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["equations"] = ["D(u(x, t), t, 2) - m**2*u(x, t)"]
    assert alone_together.checked(resealed(data))[0] == "not shown"
