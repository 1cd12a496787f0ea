"""Refutations of angles without a point, of complete integrals on an image, of integrals to infinity: what is shown,
and that no true claim is."""

from typing import Any

import pytest

from canon.checker import counterexample_cycles, counterexample_endless, counterexample_hamilton_jacobi, refutations
from canon.checker.alone import Stop
from canon.checker.counterexample import Open
from tests.checker.certified import resealed

TURN: Any = {
    "phase_space": {"q": ["q"], "p": ["p"], "Q": ["w"], "P": ["J"]},
    "symbols": {"J": "positive", "m": "positive"},
}
WELL: Any = {**TURN, "hamiltonian": {"H": "(p**2 + q**2)/2"}}
PLANE: Any = {
    "phase_space": {"q": ["r", "a"], "p": ["s", "L"], "Q": ["u", "v"], "P": ["J", "K"]},
    "symbols": {"r": "positive"},
    "hamiltonian": {"H": "s**2/2 + L**2/(2*r**2) + r**2/2"},
}


def ask(by: Any, tables: Any, claim: Any, witness: Any = None, known: Any = None) -> str:
    try:
        return by.refuted(*refutations.renamed(refutations.said({**tables, "claim": claim}), witness), known or {})[0]
    except (Stop, Open):
        return "not shown"


def back(period: str, q: str = "sqrt(2*J)*sin(w)", p: str = "sqrt(2*J)*cos(w)", **sections: Any) -> str:
    tables = {**WELL, "transformation": {"q": [q], "p": [p]}, **sections}
    return ask(counterexample_cycles, tables, {"kind": "action_angle", "angle_period": period})


def test_a_map_given_backward_comes_back_sooner() -> None:
    for period in ("4*pi", "6*pi", "-4*pi", "8*pi", "10*pi"):
        assert back(period) == "shown"
    for period in ("2*pi", "-2*pi", "pi", "3*pi", "1", "0", "2*pi*J", "4*pi*w", "4", "22/7", "0*pi"):
        assert back(period) == "not shown"
    assert back("4*pi", definitions={"q1": "sqrt(2*J)*sin(w)"}, q="q1") == "shown"
    assert back("2*pi", definitions={"q1": "sqrt(2*J)*sin(w)"}, q="q1") == "not shown"
    assert back("4*pi", q="sqrt(2*J)*sin(w/2)") == "not shown"
    assert back("4*pi", q="w") == "not shown"
    assert back("4*pi", q="sqrt(2*J)*sin(w + t)") == "not shown"
    assert back("4*pi", domain={"where": ["J < 0"]}) == "not shown"
    assert back("4*pi", domain={"where": ["J < 100000"]}) == "shown"
    assert back("2", q="sqrt(J/pi)*sin(2*pi*w)", p="sqrt(J/pi)*cos(2*pi*w)") == "shown"
    assert back("1", q="sqrt(J/pi)*sin(2*pi*w)", p="sqrt(J/pi)*cos(2*pi*w)") == "not shown"
    assert back("2*m", q="sqrt(2*J)*sin(2*pi*w/m)", p="sqrt(2*J)*cos(2*pi*w/m)") == "shown"
    assert back("m", q="sqrt(2*J)*sin(2*pi*w/m)", p="sqrt(2*J)*cos(2*pi*w/m)") == "not shown"


def forward(period: str | None, **sections: Any) -> str:
    tables = {**PLANE, "transformation": {"Q": ["atan2(r*s, L)", "a + s/r"], "P": ["s**2/2 + r**2/2", "L"]}, **sections}
    return ask(counterexample_cycles, tables, {"kind": "action_angle", **({"angle_period": period} if period else {})})


def test_one_angle_grows_with_a_coordinate() -> None:
    for period in ("4*pi", "pi", None, "1", "44/7", "-4*pi"):
        assert forward(period) == "shown"
    for period in ("2*pi", "-2*pi", "2*pi*m", "2*pi*L", "2*pi + 0*r"):
        assert forward(period) == "not shown"
    assert forward("1", hamiltonian={"H": "s**2/2 + L**2/(2*r**2) + r**2/2 + cos(a)"}) == "not shown"
    assert forward("1", symbols={"r": "positive", "a": "positive"}) == "not shown"
    for where in (["0 < a"], ["b < 1"], ["r < 0"]):
        assert forward("1", domain={"where": where}, definitions={"b": "a"}) == "not shown"
    for angles in (["atan2(r*s, L) + a", "a"], ["atan2(r*s, L)", "2*a"], ["atan2(r*s, L)", "a**2"], ["r", "s"],
                   ["atan2(r*s, L)", "a + t"]):  # fmt: skip
        assert forward("1", transformation={"Q": angles, "P": ["s", "L"]}) == "not shown"
    assert forward("1", transformation={"Q": ["r", "a"], "P": ["s", "L + a"]}) == "not shown"
    assert forward("1", hamiltonian={"H": "s**2/2 + t"}) == "not shown"


def test_one_angle_grows_by_a_generating_function() -> None:
    def generated(period: str, F: str, kind: Any = 2) -> str:
        tables = {**PLANE, "generating_function": {"type": kind, "F": F}}
        return ask(counterexample_cycles, tables, {"kind": "action_angle", "angle_period": period})

    assert generated("1", "K*a + r*J + K**2*r") == "shown"
    assert generated("1", "r*J + K**2*r - K*a", [2, 2]) == "shown"
    for period, F, kind in (("2*pi", "K*a + r*J", 2), ("1", "2*K*a + r*J", 2), ("1", "K*a + r*J", 1), ("1", "K*a*r", 2),
                            ("1", "K*a + r*J + t*K", 2), ("1", "K*a**2 + r*J", 2)):  # fmt: skip
        assert generated(period, F, kind) == "not shown"


ENERGY = {"kind": "hamilton_jacobi", "constants": ["J"], "energy": "J"}


def test_a_complete_integral_fails_on_the_image() -> None:
    by, W = counterexample_hamilton_jacobi, "J*asin(q/sqrt(2*J)) + q*sqrt(2*J - q**2)/2"
    tables = {**WELL, "transformation": {"q": ["sqrt(2*J)*sin(w)"], "p": ["sqrt(2*J)*cos(w)"]}}
    assert ask(by, tables, {**ENERGY, "W": f"{W} + q/1000"}, {"m": "1"}) == "shown"
    assert ask(by, tables, {**ENERGY, "W": W}, {"m": "1"}) == "not shown"
    inside = "sqrt((q**2 - J)**2) - J + q**2"  # 0 where q² < J
    other = {**tables, "transformation": {"q": ["sqrt(J)*sin(w)/2"], "p": ["sqrt(J)*cos(w)"]}}
    assert ask(by, tables, {**ENERGY, "W": f"{W} + {inside}"}, {}) == "shown"
    assert ask(by, other, {**ENERGY, "W": f"{W} + {inside}"}, {}) == "not shown"
    singular = {**tables, "transformation": {"q": ["sqrt(2*J)"], "p": ["J"]}}
    assert ask(by, singular, {**ENERGY, "W": f"{W} + q/1000"}, {}) == "not shown"


def test_a_complete_integral_beside_a_generating_function() -> None:
    by, F = counterexample_hamilton_jacobi, "2*sqrt(2)*(J - q)**(3/2)/3"
    tables = {**TURN, "hamiltonian": {"H": "p**2/2 + q"}, "generating_function": {"type": 2, "F": F}}
    assert ask(by, tables, {**ENERGY, "W": F}, {}) == "not shown"
    assert ask(by, tables, {**ENERGY, "W": f"{F} + q"}, {}) == "shown"
    assert ask(by, tables, {**ENERGY, "W": f"{F} + sqrt((J - q)**2) - J + q"}, {}) == "not shown"
    for section in ({"domain": {"where": ["q > 0"]}}, {"generating_function": {"type": 3, "F": "p*J"}},
                    {"generating_function": {"type": 2, "F": "q + J"}}):  # fmt: skip
        assert ask(by, {**tables, **section}, {**ENERGY, "W": f"{F} + q"}, {}) == "not shown"


LINE: Any = {
    "phase_space": {"q": ["q"], "p": ["p"]},
    "symbols": {"a": "positive", "k": "real", "V": "function", "x": "real"},
}
RANGE = {"kind": "integral", "variable": "x", "from": "-infinity", "to": "infinity"}


@pytest.mark.parametrize(
    ("claim", "right", "wrong"),
    [
        ({**RANGE, "f": "exp(-a*x**2)*cos(k*x)"}, "sqrt(pi/a)*exp(-k**2/(4*a))", "sqrt(pi/a)*exp(-k**2/(2*a))"),
        ({**RANGE, "f": "exp(-a*x)", "from": "0", "antiderivative": "-exp(-a*x)/a"}, "1/a", "2/a"),
        ({**RANGE, "f": "exp(-x)*cos(k*x)", "from": "k",
          "antiderivative": "exp(-x)*(k*sin(k*x) - cos(k*x))/(1 + k**2)"},
         "exp(-k)*(cos(k**2) - k*sin(k**2))/(1 + k**2)", "exp(-k)*(cos(k**2) + k*sin(k**2))/(1 + k**2)"),
    ],
)  # fmt: skip
def test_an_integral_to_infinity_has_another_value(claim: Any, right: str, wrong: str) -> None:
    by, witness = counterexample_endless, {"a": "3/2", "k": "2/3"}
    assert ask(by, LINE, {**claim, "equals": wrong}, witness) == "shown"
    assert ask(by, LINE, {**claim, "equals": right}, witness) == "not shown"
    assert ask(by, LINE, {**claim, "equals": wrong}) == "not shown"
    assert ask(by, {**LINE, "domain": {"where": ["a > 2"]}}, {**claim, "equals": wrong}, witness) == "not shown"
    assert ask(by, {**LINE, "domain": {"where": ["x > 0"]}}, {**claim, "equals": wrong}, witness) == "not shown"
    assert ask(by, LINE, {**claim, "equals": wrong}, {"a": "-1"}) == "not shown"
    if "antiderivative" in claim:
        other = {**claim, "equals": right, "antiderivative": f"2*({claim['antiderivative']})"}
        assert ask(by, LINE, other, witness) == "not shown"
        jump = claim["antiderivative"] + " + (x - 1)/sqrt((x - 1)**2)"
        assert ask(by, LINE, {**claim, "equals": right, "antiderivative": jump}, witness) == "not shown"


def test_they_are_asked_of_a_certificate() -> None:
    tables = {**WELL, "transformation": {"q": ["sqrt(2*J)*sin(w)"], "p": ["sqrt(2*J)*cos(w)"]}}
    claims = {"action_angle": {"kind": "action_angle", "angle_period": "4*pi"}}
    claims["hamilton_jacobi"] = {**ENERGY, "W": "J*asin(q/sqrt(2*J)) + q*sqrt(2*J - q**2)/2 + q"}
    for kind, claim in claims.items():
        data = {"certificate": 1, "tables": {**tables, "claim": claim}, "verdict": "refuted", "known": {}, "cases": []}
        witness = None if kind == "action_angle" else {"J": "2"}
        assert refutations.checked(resealed({**data, "witness": witness}))[0] == "shown"


def test_an_antiderivative_that_jumps_says_nothing() -> None:
    """−atan(1/(x − 1)) falls by π at 1; without that the integral would be −π/4."""
    claim = {**RANGE, "f": "1/(1 + (x - 1)**2)", "from": "0", "antiderivative": "-atan(1/(x - 1))"}
    for value in ("3*pi/4", "-pi/4"):
        assert ask(counterexample_endless, LINE, {**claim, "equals": value}, {"a": "1", "k": "1"}) == "not shown"
