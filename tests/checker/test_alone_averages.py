"""Averages in one small file: what is shown, near misses, and motions that are none."""

from typing import Any

import pytest

from canon.checker import alone_averages, alone_together
from tests.checker.certified import certified, resealed

NAMES = {"m": "positive", "w": "positive", "A": "real", "e": "nonnegative", "V": "function"}
SPACE: Any = {"phase_space": {"q": ["x"], "p": ["p"]}, "symbols": NAMES, "domain": {"where": ["e < 1"]}}
H = {"hamiltonian": {"H": "p**2/(2*m) + m*w**2*x**2/2"}}
VIRIAL = {"f": "p**2/m", "equals": "p**2/(2*m) + m*w**2*x**2/2", "virial": "x*p/2",
    "bound": "(p**2/(2*m) + m*w**2*x**2/2)/w"}  # fmt: skip
MOTION = {"x": "A*cos(w*t)", "p": "-m*w*A*sin(w*t)"}
ROUND = {"f": "x**2", "equals": "A**2/2", "antiderivative": "A**2*(t/2 + sin(2*w*t)/(4*w))", "parameter": "t",
    "from": "0", "to": "2*pi/w", "motion": MOTION}  # fmt: skip
KEPLER = {"f": "1/x", "equals": "1", "antiderivative": "u", "parameter": "u", "from": "0", "to": "2*pi",
    "motion": {"x": "1 - e*cos(u)", "t": "u - e*sin(u)"}}  # fmt: skip


def answer(keys: Any, **sections: Any) -> str:
    tables = {**SPACE, "claim": {"kind": "average", **keys}, **sections}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "known": {}, "cases": [{}]}
    return alone_averages.checked(resealed(data))[0]


def test_averages_are_shown() -> None:
    assert answer(VIRIAL, **H) == answer(ROUND, **H) == answer(ROUND) == answer(KEPLER) == "shown"
    positive = {**SPACE, "symbols": {**NAMES, "x": "positive"}}
    assert answer(KEPLER, **positive) == "shown"


FAR = "5*(p**2/(2*m) + m*w**2*x**2/2)/w"


@pytest.mark.parametrize("changed", [
    {"virial": f"x*p/2 + {FAR}"}, {"virial": f"x*p/2 - {FAR}"},
    {"equals": "p**2/m + m*w**2*x**2"}, {"f": "m*w**2*x**2"}, {"virial": "-x*p/2"}, {"virial": "x*p"},
    {"bound": "(p**2/(2*m) + m*w**2*x**2/2)/(3*w)"}, {"bound": "0"}, {"bound": "-(p**2/(2*m) + m*w**2*x**2/2)/w"},
    {"bound": "x**2*w*m + p**2"}, {"equals": "p**2/m", "virial": "0", "bound": "1"}, {"virial": "x*p/2 + t"},
    {"virial": "x*p/2 + 0/x"}, {"virial": "x*p/2 + 0*V(1/x)"}, {"f": "p**2/m + 0*sqrt(x)"},
    {"virial": "x*p/2 + log(x**2 + 1)"}, {"f": "p**2/m + 1"}, {"parameter": "t"}, {"antiderivative": "x"},
])  # fmt: skip
def test_another_virial_shows_nothing(changed: Any) -> None:
    assert answer({**VIRIAL, **changed}, **H) == "not shown"


def test_motions_that_end_or_leave_the_domain() -> None:
    assert answer(VIRIAL) == "not shown"
    assert answer(VIRIAL, **H, domain={"where": ["x > 0"]}) == "not shown"
    assert answer(VIRIAL, **H, symbols={**NAMES, "x": "positive"}) == "not shown"
    assert answer(VIRIAL, **H, transformation={"Q": ["x"], "P": ["p"]}) == "not shown"
    quartic = {"f": "0", "equals": "0", "virial": "0", "bound": "1"}
    assert answer(quartic, hamiltonian={"H": "p**2/2 - x**4/4"}) == "not shown"  # its motions end
    assert answer(quartic, hamiltonian={"H": "p**2/2 - x**2/2"}) == "shown"
    assert answer(quartic, hamiltonian={"H": "p**2/2 + t*x**2/2"}) == "not shown"


@pytest.mark.parametrize("changed", [
    {"equals": "A**2"}, {"equals": "x**2"}, {"f": "x"}, {"to": "pi/w/3"}, {"antiderivative": "A**2*t/2"},
    {"from": "-A"},
    {"from": "2*pi/w", "to": "0"}, {"motion": {**MOTION, "x": "A*sin(w*t)"}}, {"motion": {"x": "A*cos(w*t)"}},
    {"motion": {**MOTION, "p": "m*w*A*sin(w*t)"}}, {"motion": {**MOTION, "t": "2*t"}}, {"to": "infinity"},
    {"motion": {**MOTION, "y": "0"}}, {"motion": {**MOTION, "x": "A*cos(w*t) + 0*p"}}, {"f": "x**2 + 0*sqrt(x)"},
    {"f": "x**2 + 0*log(x**2)"}, {"motion": {**MOTION, "x": "A*cos(w*t) + 0/(t - 1)"}}, {"to": "0"}, {"bound": "1"},
    {"antiderivative": "A**2*(t/2 + sin(2*w*t)/(4*w)) + atan(tan(w*t)) - w*t"}, {"f": "V(x)"}, {"equals": "t"},
    {"antiderivative": "A**2*(t/2 + sin(2*w*t)/(4*w)) + 0*log(t - pi/w)"},
])  # fmt: skip
def test_another_motion_shows_nothing(changed: Any) -> None:
    assert answer({**ROUND, **changed}, **H) == "not shown"


@pytest.mark.parametrize("changed", [
    {"motion": {"x": "1 - e*cos(u)", "t": "e*sin(u) - u"}}, {"motion": {"x": "1 - e*cos(u)", "t": "u - 2*e*sin(u)"}},
    {"motion": {"x": "1 - 2*e*cos(u)", "t": "u - 2*e*sin(u)"}}, {"motion": {"x": "1 - e*cos(u)"}}, {"equals": "1 + e"},
    {"motion": {"x": "1 - e*cos(u)", "t": "(u - e*sin(u))/u"}}, {"to": "2*pi*A"}, {"parameter": "x"},
    {"motion": {"x": "1 - e*cos(u)", "t": "u - e*sin(u)", "u": "u"}}, {"f": "1/x + 0*sqrt(x - 1)"},
])  # fmt: skip
def test_time_grows_along_the_motion(changed: Any) -> None:
    assert answer({**KEPLER, **changed}) == "not shown"


def test_each_of_hamiltons_equations_and_the_clock() -> None:
    unit = {"parameter": "t", "from": "0", "to": "1"}
    line = {**unit, "f": "x", "antiderivative": "t**2/2", "equals": "1/2", "motion": {"x": "t", "p": "1"}}
    fall = {**unit, "f": "p", "antiderivative": "-t**2/2", "equals": "-1/2", "motion": {"x": "1", "p": "-t"}}
    assert answer(line, hamiltonian={"H": "p"}) == answer(fall, hamiltonian={"H": "x"}) == "shown"
    assert answer(line, hamiltonian={"H": "2*p"}) == answer(fall, hamiltonian={"H": "2*x"}) == "not shown"
    assert answer(line, hamiltonian={"H": "p + x"}) == answer(fall, hamiltonian={"H": "x + p"}) == "not shown"
    back = {**KEPLER, "motion": {"x": "1 - e*cos(u)", "t": "e*sin(u) - u"}, "antiderivative": "-u"}
    assert answer(back) == "not shown"


def test_names_that_may_be_0_or_have_a_sign() -> None:
    at = lambda name, word, **keys: answer(KEPLER, symbols={**NAMES, name: word}, **keys)
    assert at("e", "real") == at("x", "negative") == at("e", "nonnegative", domain={}) == "not shown"
    assert answer({**KEPLER, "f": "1/x + 0/e"}) == answer(KEPLER, domain={"where": ["e < 1", "x > 1"]}) == "not shown"
    assert answer({**KEPLER, "equals": "1 + 0*sqrt(A)"}) == "shown"  # where it has a value


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["x"]\np = ["p"]\n[hamiltonian]\nH = "(p**2 + x**2)/2"\n'
    keys = 'f = "p**2"\nequals = "(p**2 + x**2)/2"\nvirial = "x*p/2"\nbound = "(p**2 + x**2)/4"'
    data = certified(text, f'kind = "average"\n{keys}')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["f"] = "2*p**2"
    assert alone_together.checked(resealed(data))[0] == "not shown"
