"""What the checker concludes for the whole of a domain: exact forms, independence, inequalities between two numbers."""

from typing import Any

import pytest

from canon.checker.kinds import obligations
from canon.checker.positive import is_positive
from canon.checker.statement import Statement

PLANE = {"q": ["x", "y"], "p": ["px", "py"], "Q": ["X", "Y"], "P": ["PX", "PY"]}
WINDING = {
    "phase_space": PLANE,
    "hamiltonian": {"H": "x"},
    "transformation": {"Q": ["x", "y"], "P": ["px - y/(x**2 + y**2)", "py + x/(x**2 + y**2)"]},
    "claim": {"kind": "cartan_invariant", "K": "X"},
}
POLAR = {
    "phase_space": {**PLANE, "Q": ["r", "phi"], "P": ["pr", "L"]},
    "symbols": {"r": "positive"},
    "hamiltonian": {"H": "x*py - y*px"},
    "transformation": {
        "q": ["r*cos(phi)", "r*sin(phi)"],
        "p": ["pr*cos(phi) - L*sin(phi)/r", "pr*sin(phi) + L*cos(phi)/r"],
    },
    "claim": {"kind": "cartan_invariant", "K": "L"},
}
EXACT: dict[str, tuple[dict[str, Any], bool]] = {
    "half of a plane": ({**WINDING, "domain": {"where": ["x > 0"]}}, True),
    "a strip off the origin": ({**WINDING, "domain": {"where": ["1 < x + 2*y < 3", "x > 0", "y > 0"]}}, True),
    "round a hole": (WINDING, False),
    "round a hole that is said": ({**WINDING, "domain": {"where": ["x**2 + y**2 > 1"]}}, False),
    "a strip with the hole": ({**WINDING, "domain": {"where": ["-1 < y < 1"]}}, False),
    "without a line": ({**WINDING, "domain": {"where": ["x != 0"]}}, False),
    "polar coordinates": (POLAR, True),
    "of half of the plane": ({**POLAR, "symbols": {"r": "positive", "x": "positive"}}, False),
    "off an angle": ({**POLAR, "domain": {"where": ["cos(phi) > 0"]}}, False),
}
INDEPENDENT: dict[str, tuple[list[str], bool]] = {
    "a parameter that isn't 0": (["x + a*px", "y"], True),
    "exponentials": (["exp(x - y) + px**2", "exp(a*px)*y"], True),
    "over what is 0 somewhere": (["px/sin(x)", "py*sqrt(b)"], True),
    "any function, but of one variable": (["px + V(x)", "py"], True),
    "a parameter that may be 0": (["c*x", "y"], False),
    "a parameter that may be 1": (["x*(b - 1)", "y"], False),
    "0 on a half": (["abs(x) + x", "y"], False),
    "0 on a half, by a root": (["sqrt(x**2) + x", "y"], False),
    "an essential singularity": (["exp(1/x) + x", "y"], False),
    "any function": (["V(x)", "y"], False),
    "a value that c makes a pole": (["x/(x - c)", "y"], False),
}
WHERE = ["0 < x < pi", "pi/2 < y < 3*pi/2", "-pi < z < 0", "1/4 < w < 25/4", "u < v < pi"]
HOLD = [
    "sin(x)", "-cos(y)", "-sin(z)", "a - cos(y)*sin(x)", "sin(v)", "1 + a - sin(pi/2)", "cos(pi/2) + a", "-cos(3*pi)",
    "exp(w) - 2*w - 3/5",
    "2*((w - sin(w))**2 + (1 - cos(w))**2) - w**2*(1 - cos(w))",
]  # fmt: skip
FAIL = [
    "cos(x)", "-sin(x)", "sin(y)", "cos(y)", "sin(z)", "cos(z)", "sin(2*x)", "sin(u + v)", "cos(pi/2)", "-sin(5*pi/2)",
    "exp(w) - 2*w - 31/50", "1 + sin(w)", "w - 1001/4000", "exp(a) - 2*a - 3/5", "log(w)", "V(w)", "1/(w - 3)",
]  # fmt: skip


def trusted(tables: dict[str, Any]) -> str:
    (case,) = obligations(Statement(tables, {}, "proved"))
    return case.trusted


@pytest.mark.parametrize("name", EXACT)
def test_a_closed_form_is_exact_on_a_convex_domain(name: str) -> None:
    tables, holds = EXACT[name]
    assert trusted(tables) == ("" if holds else "that the form, which is closed, is exact")


@pytest.mark.parametrize("name", INDEPENDENT)
def test_one_value_speaks_of_all_components(name: str) -> None:
    functions, holds = INDEPENDENT[name]
    tables = {
        "phase_space": {"q": ["x", "y"], "p": ["px", "py"]},
        "symbols": {"a": "positive", "b": "positive", "c": "real", "V": "function"},
        "claim": {"kind": "independent", "functions": functions},
    }
    assert (trusted(tables) == "") == holds


@pytest.mark.parametrize("text", [*HOLD, *FAIL])
def test_inequalities_by_angles_and_between_numbers(text: str) -> None:
    symbols = {"a": "positive", "u": "positive", "v": "real", "V": "function", **dict.fromkeys("xyzw", "real")}
    claim = {"kind": "identity", "lhs": "0", "rhs": "0"}
    tables = {"phase_space": {"q": [], "p": []}, "symbols": symbols, "claim": claim, "domain": {"where": WHERE}}
    s = Statement(tables, {}, "proved")
    assert is_positive(s, s.f.read(text, s.names), strict=True, real=True) == (text in HOLD)
