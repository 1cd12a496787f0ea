"""Constraints in one small file: what is shown, near misses, and claims that no file could state."""

from typing import Any

import pytest

from canon.checker import alone_constraints, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["x", "y", "z"], "p": ["px", "py", "pz"]}}
NAMES = {"R": "positive", "m": "positive", "g": "positive", "k": "real", "F": "function", "S": "function"}
KINETIC = "m*(u**2 + v**2 + w**2)/2"
SKATE = "u*sin(z) - v*cos(z)"
SPHERE = "x**2 + y**2 + z**2 - R**2"
FALL = {"L": f"{KINETIC} - m*g*z", "qddot": ["0", "0", "0"], "multipliers": ["m*g"]}
ALONG = "(u*cos(z) + v*sin(z))"
BLADE = {"L": KINETIC, "qddot": [f"-w*{ALONG}*sin(z)", f"w*{ALONG}*cos(z)", "0"], "multipliers": [f"-m*w*{ALONG}"]}


def answer(keys: Any, **sections: Any) -> str:
    """The answer about a claim with these keys: constraints of x, y, z, whose velocities are u, v, w."""
    claim = {"kind": "constraint", "velocities": ["u", "v", "w"], **keys}
    tables = {**SPACE, "symbols": NAMES, "claim": claim, **sections}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}, {}]}
    return alone_constraints.checked(resealed(data))[0]


@pytest.mark.parametrize("keys", [
    {"functions": [SPHERE], "holonomic": True, "stationary": True},
    {"functions": ["z - F(x, y, t)"], "holonomic": True},
    {"functions": ["z - k - t"], "stationary": False},
    {"functions": ["z - S(x, t)"], "possible": ["1", "0", "D(S(x, t), x) + D(S(x, t), t)"]},
    {"functions": ["z - S(x, t)"], "virtual": ["1", "0", "D(S(x, t), x)"]},
    {"functions": ["x - y"], "virtual": ["x", "y", "0"]},
    {"functions": ["z"], **FALL}, {"functions": ["2*z - 2"], **FALL, "multipliers": ["m*g/2"]},
    {"functions": ["z - k"], **FALL, "forces": ["0", "0", "z - k"]},
    {"functions": ["z"], **FALL, "determined": True},
    {"functions": ["z", "k*z"], "L": KINETIC, "determined": False},
    {"forms": [SKATE], "holonomic": False}, {"forms": [SKATE], "virtual": ["cos(z)", "sin(z)", "k"]},
    {"forms": [SKATE], **BLADE},
    {"forms": [SKATE], "L": KINETIC, "determined": True}, {"forms": [SKATE], "stationary": True},
    {"forms": ["t*u - v"], "stationary": False}, {"forms": ["u - 1"], "stationary": False},
    {"forms": ["y*u - x*v"], "holonomic": True, "integrals": ["y/x"]},
    {"forms": ["u - v", "v - w"], "holonomic": True, "integrals": ["x - y", "(y - z)**3"]},
    {"forms": ["w - y*u"], "holonomic": False}, {"forms": ["w - y*u", "v"], "holonomic": True},
])  # fmt: skip
def test_a_claim_is_shown(keys: Any) -> None:
    assert answer(keys) == "shown"


@pytest.mark.parametrize("keys", [
    {"functions": [SPHERE], "holonomic": False}, {"functions": [SPHERE], "stationary": False},
    {"functions": ["z - F(x, y, t)"], "stationary": True}, {"functions": ["z - k*t"], "stationary": False},
    {"functions": ["z - S(x, t)"], "possible": ["1", "0", "D(S(x, t), x)"]},
    {"functions": ["z - S(x, t)"], "virtual": ["1", "0", "D(S(x, t), x) + D(S(x, t), t)"]},
    {"functions": ["x - y"], "virtual": ["x", "-y", "0"]}, {"functions": ["x - y"], "virtual": ["u", "v", "0"]},
    {"functions": ["z"], **FALL, "multipliers": ["-m*g"]}, {"functions": ["z"], **FALL, "qddot": ["0", "0", "-g"]},
    {"functions": ["z"], **FALL, "forces": ["0", "0", "z + 1"]},
    {"functions": ["z"], "L": KINETIC, "qddot": ["0", "0", "1"], "multipliers": ["m"]},
    {"functions": ["2*z - 2"], **FALL}, {"functions": ["z"], **FALL, "determined": False},
    {"functions": ["z", "z + x*y"], "L": KINETIC, "determined": False},
    {"functions": ["z"], "L": "m*u**2/2", "determined": True}, {"functions": ["z"], "L": "z", "determined": True},
    {"functions": ["z"], "L": f"{KINETIC} + k*u*v", "determined": True},
    {"forms": [SKATE], "holonomic": True}, {"forms": [SKATE], "stationary": False},
    {"forms": ["t*u - v"], "stationary": True}, {"forms": ["u - 1"], "stationary": True},
    {"forms": [SKATE], "virtual": ["sin(z)", "cos(z)", "0"]},
    {"forms": [SKATE], **BLADE, "multipliers": [f"m*w*{ALONG}"]}, {"forms": [SKATE], **BLADE, "qddot": ["0", "0", "0"]},
    {"forms": ["w - k*y*u"], "holonomic": False}, {"forms": ["w - (sqrt(y**2) + y)*u"], "holonomic": False},
    *({"forms": [f"w - (sqrt((y - {n})**2) + y)*u"], "holonomic": False} for n in range(4)),
    {"forms": ["w - S(y)*u"], "holonomic": False}, {"forms": ["w - S(y)*u"], "holonomic": True},
    {"forms": ["y*u - x*v"], "holonomic": True, "integrals": ["x*y"]},
    {"forms": ["y*u - x*v"], "integrals": ["3"]}, {"forms": ["y*u - x*v"], "integrals": ["y/x", "y/x"]},
    {"forms": ["u - v", "v - w"], "integrals": ["x - y", "2*x - 2*y"]},
    {"forms": ["u - v", "v - w"], "integrals": ["x - y", "k*(y - z)"]},
    {"forms": ["w*x - u"], "L": "m*(u**2 + v**2)/2", "determined": True},
])  # fmt: skip
def test_what_is_false_isnt_shown(keys: Any) -> None:
    assert answer(keys) == "not shown"


@pytest.mark.parametrize("keys", [
    {"functions": ["x**2 + y**2 + 1"], "holonomic": True}, {"functions": ["x**2"], "holonomic": True},
    {"functions": ["x", "x*y"], "holonomic": True}, {"functions": ["x", "x + 1"], "L": KINETIC, "determined": False},
    {"functions": ["x + R"], "holonomic": True, "symbols": {**NAMES, "x": "positive"}},
    {"functions": ["x + 1 + y**2"], "holonomic": True, "symbols": {**NAMES, "x": "positive"}},
    {"functions": ["x - 1"], "holonomic": True, "hamiltonian": {"H": "log(-x)"}},
    {"functions": ["x"], "holonomic": True, "domain": {"where": ["x > 0"]}},
    {"forms": ["u"], "holonomic": True, "domain": {"where": ["x**2 < 0"]}},
    {"forms": ["u"], "holonomic": True, "domain": {"where": ["u > 0"]}},
    {"forms": ["u", "2*u"], "holonomic": True}, {"forms": ["k*u"], "holonomic": True}, {"forms": ["0*u"]},
    {"forms": ["t"], "holonomic": True}, {"forms": ["u**2"], "holonomic": True}, {"forms": ["u", "u - 1"]},
    {"forms": ["sqrt(u**2)"], "holonomic": True}, {"forms": ["u*v"], "holonomic": False}, {"forms": []},
    {"forms": ["u"], "functions": ["x"], "holonomic": True}, {"functions": ["u"], "holonomic": True},
    {"forms": ["px*u"], "holonomic": True}, {"forms": ["u"]}, {"forms": ["u"], "holonomic": "true"},
    {"forms": ["u"], "holonomic": True, "qddot": ["0", "0", "0"]}, {"forms": ["u"], "determined": True},
    {"forms": ["u"], "holonomic": True, "L": "u"}, {"forms": ["u"], "holonomic": True, "order": 2},
    {"forms": ["u"], "virtual": ["0", "1"]},
    {"forms": ["u"], "velocities": ["u", "v"], "holonomic": True}, {"forms": ["u"], "holonomic": 1},
    {"forms": ["u"], "velocities": ["x", "v", "w"], "holonomic": True}, {"forms": "u", "holonomic": True},
    {"forms": ["u"], "velocities": ["u", "u", "w"], "holonomic": True},
    {"forms": ["u"], "holonomic": True, "determined": False, "L": "0"},
    {"forms": ["u", "2*u"], "L": KINETIC, "determined": False},
    {"forms": ["D(u*x, u)*u/x"], "holonomic": True, "definitions": {"x": "1"}},
    {"forms": ["u"], "holonomic": True, "transformation": {"Q": ["x"], "P": ["px"]}},
])  # fmt: skip
def test_what_no_file_could_state_isnt_shown(keys: Any) -> None:
    sections = {key: keys[key] for key in keys if key in ("symbols", "hamiltonian", "domain", "definitions")}
    sections |= {"transformation": keys["transformation"]} if "transformation" in keys else {}
    assert answer({key: x for key, x in keys.items() if key not in sections}, **sections) == "not shown"


def test_it_is_asked_of_a_certificate_of_several_cases() -> None:
    data = certified('[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\n',
        'kind = "constraint"\nvelocities = ["u", "v"]\nforms = ["u - y*v"]\n'
        'holonomic = true\nstationary = true')  # fmt: skip
    assert len(data["cases"]) > 1
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["stationary"] = False
    assert alone_together.checked(data)[0] == "wrong"
    assert alone_together.checked(resealed(data))[0] == "not shown"
    assert alone_constraints.checked(resealed({**data, "verdict": "refuted"}))[0] == "not shown"
