"""Averages over time: by a virial and along a motion, near misses, motions that are none, time that turns round."""

import json
from typing import Any

import pytest

from canon.checker import alone_averages, alone_together
from tests.checker.certified import certified, resealed

WELL: Any = {
    "phase_space": {"q": ["q"], "p": ["p"]},
    "symbols": {"m": "positive", "w": "positive", "A": "positive", "k": "real"},
    "definitions": {"T": "p**2/(2*m)", "V": "m*w**2*q**2/2"},
    "hamiltonian": {"H": "T + V"},
}
VIRIAL = {"kind": "average", "f": "2*T", "equals": "T + V", "virial": "q*p/2", "bound": "(T + V)/w"}
MOTION: Any = {
    "kind": "average",
    "f": "q**2",
    "equals": "A**2/2",
    "parameter": "t",
    "from": "0",
    "to": "2*pi/w",
    "motion": {"q": "A*cos(w*t)", "p": "-m*A*w*sin(w*t)"},
    "antiderivative": "A**2*(t/2 + sin(2*w*t)/(4*w))",
}
ORBIT: Any = {
    "phase_space": {"q": ["r"], "p": ["s"]},
    "symbols": {"r": "positive", "m": "positive", "a": "positive", "k": "positive", "e": "nonnegative"},
    "domain": {"where": ["e < 1"]},
    "definitions": {"M2": "m*k*a*(1 - e**2)", "T": "s**2/(2*m) + M2/(2*m*r**2)"},
    "hamiltonian": {"H": "T - k/r"},
}
KEPLER: Any = {
    "kind": "average",
    "f": "-k/r",
    "equals": "-k/a",
    "antiderivative": "-sqrt(m*a**3/k)*k/a*u",
    "parameter": "u",
    "from": "0",
    "to": "2*pi",
    "motion": {
        "r": "a*(1 - e*cos(u))",
        "s": "sqrt(m*k/a)*e*sin(u)/(1 - e*cos(u))",
        "t": "sqrt(m*a**3/k)*(u - e*sin(u))",
    },
}


def answer(tables: Any, claim: Any, by: Any = alone_averages, **change: Any) -> str:
    claim = {**claim, **{key: x for key, x in change.items() if key not in tables or key == "kind"}}
    tables = {**tables, **{key: x for key, x in change.items() if key in tables and key != "kind"}, "claim": claim}
    known = {"antiderivative": claim["antiderivative"]} if "antiderivative" in claim else {}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}], "known": known}
    return by.checked(resealed(data))[0]


def test_averages_are_shown() -> None:
    assert answer(WELL, VIRIAL) == "shown"
    assert answer(WELL, VIRIAL, f="2*V", virial="-q*p/2") == "shown"
    assert answer(WELL, MOTION) == "shown"
    assert answer(ORBIT, KEPLER) == "shown"
    twice = "sqrt(m*a**3/k)*(k/a*u - k/(2*a)*(u - e*sin(u)))"
    assert answer(ORBIT, KEPLER, f="T", equals="k/(2*a)", antiderivative=twice) == "shown"
    del (free := {**WELL})["hamiltonian"]
    assert answer(free, MOTION, motion={"q": "A*cos(w*t)"}) == "shown"


@pytest.mark.parametrize(
    "change",
    [
        {"f": "T"},
        {"equals": "T"},
        {"equals": "2*T"},
        {"equals": "T + V + 1"},
        {"virial": "q*p"},
        {"virial": "-q*p/2"},
        {"bound": "(T + V)/(3*w)"},
        {"bound": "T/w + V"},
        {"bound": "q**2 + p**2"},
        {"bound": "k*(T + V)"},
        {"bound": "-1"},
        {"f": "2*T + 0/q"},
        {"f": "2*T + sqrt(q**2) - q"},
        {"equals": "T + V + t"},
        {"virial": "q*p/2 + t"},
        {"hamiltonian": {"H": "T + V + q**4"}},
        {"hamiltonian": {"H": "T + V + q*sqrt(q**2)"}},
        {"hamiltonian": {"H": "T + V + t"}},
        {"hamiltonian": {"H": "T - V"}},
        {"symbols": {**WELL["symbols"], "q": "positive"}},
        {"definitions": {"T": "p**2/(2*m) + 0/q", "V": "m*w**2*q**2/2"}},
        {"symbols": {**WELL["symbols"], "w": "real"}},
        {"other": "1"},
        {"motion": {"q": "0"}},
    ],
)
def test_what_is_no_virial_is_not(change: Any) -> None:
    assert answer(WELL, VIRIAL, **change) == "not shown"


def test_conditions_on_what_moves_are_not_looked_at() -> None:
    for claim in (VIRIAL, MOTION):
        assert answer({**WELL, "domain": {"where": ["k < 1"]}}, claim) == "shown"
        for where in ("q < 1", "T < 1", "t > 0"):
            assert answer({**WELL, "domain": {"where": [where]}}, claim) == "not shown"


MOVED: Any = MOTION["motion"]


@pytest.mark.parametrize(
    "change",
    [
        {"equals": "A**2"},
        {"equals": "A**2/2 + t"},
        {"equals": "q"},
        {"f": "q"},
        {"to": "pi/(3*w)"},
        {"to": "-2*pi/w"},
        {"to": "0"},
        {"to": "infinity"},
        {"antiderivative": "A**2*t/2"},
        {"motion": {**MOVED, "p": "m*A*w*sin(w*t)"}},
        {"motion": {"q": MOVED["q"]}},
        {"motion": {**MOVED, "q": "2*A*cos(w*t)"}},
        {"motion": {**MOVED, "t": "t"}},
        {"parameter": "u"},
        {"from": "t"},
        {"motion": {**MOVED, "q": "q"}},
        {"motion": {**MOVED, "k": "1"}},
        {"hamiltonian": {"H": "T + 2*V"}},
        {"hamiltonian": {"H": "T + V + t*q"}},
        {"symbols": {**WELL["symbols"], "q": "positive"}},
        {"to": "2*pi/k"},
        {"f": "q**2 + 1/q", "antiderivative": MOTION["antiderivative"] + " + log(1/cos(w*t) + tan(w*t))/(A*w)"},
    ],
)
def test_what_is_no_motion_or_another_average_is_not(change: Any) -> None:
    assert answer(WELL, MOTION, **change) == "not shown"


ROUND: Any = KEPLER["motion"]


@pytest.mark.parametrize(
    "change",
    [
        {"equals": "-k/(2*a)"},
        {"domain": {"where": ["e < 2"]}},
        {"symbols": {**ORBIT["symbols"], "e": "real"}},
        {"domain": {"where": ["e > 1"]}},
        {"motion": {**ROUND, "t": "sqrt(m*a**3/k)*u"}},
        {"symbols": {**ORBIT["symbols"], "s": "positive"}},
        {"motion": {**ROUND, "t": "sqrt(m*a**3/k)*(u + e*sin(u))"}},
        {"motion": {**ROUND, "r": "a*(1 + e*cos(u))"}},
        {"motion": {**ROUND, "s": "-sqrt(m*k/a)*e*sin(u)/(1 - e*cos(u))"}},
        {"to": "pi/2"},
        {"from": "2*pi", "to": "0"},
        {"motion": {x: y for x, y in ROUND.items() if x != "t"}},
        {"definitions": {**ORBIT["definitions"], "M2": "m*k*a"}},
    ],
)
def test_another_orbit_is_not(change: Any) -> None:
    if change.get("to") == "pi/2":  # the integrand's average is the same over every part of the orbit but for its time
        change = {**change, "f": "r", "equals": "a*(1 + e**2/2)"}
    assert answer(ORBIT, KEPLER, **change) == "not shown"


def test_time_that_turns_round_is_none() -> None:
    """Without a Hamiltonian any curve is a motion; time has to grow."""
    del (free := {**WELL})["hamiltonian"]
    claim = {**MOTION, "parameter": "u", "to": "2", "f": "q", "equals": "0", "antiderivative": "0"}
    assert answer(free, {**claim, "motion": {"q": "0", "t": "u**3 + u"}}) == "shown"
    for time in ("u**3 - u", "-u", "u**2 - 2*u", "k*u", "1"):
        assert answer(free, {**claim, "motion": {"q": "0", "t": time}}) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = "[phase_space]\nq = ['q']\np = ['p']\n[symbols]\nw = 'positive'\n[hamiltonian]\nH = 'p**2/2 + w**2*q**2/2'\n"
    keys = {"kind": "average", "f": "p**2", "equals": "p**2/2 + w**2*q**2/2", "virial": "q*p/2"}
    data = certified(text, "\n".join(f"{key} = {json.dumps(x)}" for key, x in keys.items())
                     + "\nbound = '(p**2 + w**2*q**2)/(2*w)'")  # fmt: skip
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["bound"] = "(p**2 + w**2*q**2)/(5*w)"
    assert alone_together.checked(resealed(data))[0] == "not shown"
