"""Refutations of paths with an open end: what is shown, and that no path that solves the equations is."""

from typing import Any

import pytest

from canon.checker import counterexample_open_paths, refutations
from canon.checker.alone import Stop
from tests.checker.certified import resealed

FALL: Any = {
    "phase_space": {"q": ["x"], "p": ["px"], "time": "z"},
    "symbols": {"a": "positive", "g": "positive", "h": "positive", "k": "real"},
    "domain": {"where": ["h < 2*a"]},
}
CYCLOID, LIGHT = "a*acos(1 - z/a) - sqrt(2*a*z - z**2)", "sqrt(1 + v**2)/sqrt(2*g*z)"
WITNESS = {"a": "15/4", "g": "11/2", "h": "5", "z": "11/3", "k": "1"}


def refutes(path: str, lagrangian: str = LIGHT, witness: Any = WITNESS, **change: Any) -> bool:
    claim = {"kind": "stationary", "L": lagrangian, "velocities": ["v"], "path": [path], "from": "0", "to": "h"}
    claim |= {key: x for key, x in change.items() if key not in FALL}
    tables = {**FALL, **{key: x for key, x in change.items() if key in FALL}, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "refuted", "known": {}, "cases": [], "witness": witness}
    try:
        found = counterexample_open_paths.refuted(*refutations.renamed(refutations.said(tables), witness))[0] == "shown"
    except (Stop, ValueError):
        found = False
    if found:
        assert refutations.checked(resealed(data))[0] == "shown"
    return found


@pytest.mark.parametrize("path", ["z", f"1001/1000*{CYCLOID}", f"{CYCLOID} + z/1000", "sqrt(z)", "a*acos(1 - z/a)"])
def test_a_path_that_isnt_stationary_is_refuted(path: str) -> None:
    assert refutes(path)


@pytest.mark.parametrize("path", [CYCLOID, f"{CYCLOID} + k", f"-({CYCLOID})", "k", "0", "a"])
def test_a_path_that_is_stationary_is_not(path: str) -> None:
    for z in ("11/3", "1/100", "49/10"):
        assert not refutes(path, witness={**WITNESS, "z": z})


def test_the_path_has_values_all_the_way() -> None:
    for path in (
        "sqrt(z - 1)",
        "log(z - 1/2)",
        "1/(z - 2)",
        "z + 0*log(z - 1)",
        "sqrt((z - 2)**2)",
        "a*acos(1 - 2*z/a)",
        "x",
        "v",
    ):
        assert not refutes(path)
    for lagrangian in ("sqrt(v - 2)*z", "log(x - 1)*v**2", "v**2/(z - 1)"):
        assert not refutes("z", lagrangian)
    assert refutes("z", "v**2/2 + x**2/2")
    assert not refutes("exp(z)", "v**2/2 + x**2/2")


def test_the_time_and_the_domain_are_looked_at() -> None:
    for witness in ({**WITNESS, "z": "6"}, {**WITNESS, "z": "-1"}, {**WITNESS, "h": "8"}, {**WITNESS, "a": "-1"}, None):
        assert not refutes("z", witness=witness)
    changes: list[Any] = [
        {"from": "h", "to": "0"},
        {"extremum": "minimum"},
        {"domain": {"where": ["x > 0"]}},
        {"to": "infinity"},
        {"domain": {"where": ["h < 2*a", "z < 1"]}},
        {"domain": {"where": ["v > 2"]}},
        {"from": "-h"},
        {"symbols": {**FALL["symbols"], "x": "positive"}},
        {"symbols": {**FALL["symbols"], "z": "positive"}},
    ]
    for change in changes:
        assert not refutes("z", **change)
