"""Several angles by the cycles of a torus, by a small file: what is shown, near misses, and what the torus isn't."""

import copy
from typing import Any

import pytest

from canon.catalogue import files
from canon.checker import alone_together, alone_tori
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from tests.checker.certified import resealed

PLANE: Any = {"phase_space": {"q": ["r", "theta"], "p": ["pr", "G0"], "Q": ["l", "g"], "P": ["L", "G"]},
    "symbols": {"k": "positive", "r": "positive", "e": "real"},
    "definitions": {"E0": "pr**2/2 + G0**2/(2*r**2) - k/r", "L0": "k/sqrt(-2*E0)", "a": "1 - r*k/L0**2",
                    "b": "r*pr/L0", "l0": "atan2(b, a) - b", "g0": "theta - atan2(G0*pr/k, G0**2/(k*r) - 1)"},
    "domain": {"where": ["G0 > 0", "2*k/r > pr**2 + G0**2/r**2"]}, "hamiltonian": {"H": "E0"},
    "transformation": {"Q": ["l0", "g0"], "P": ["L0", "G0"]},
    "claim": {"kind": "action_angle", "angle_period": "2*pi"}}  # fmt: skip
RADIAL: Any = {"coordinate": "r", "H": "pr**2/2 + G0**2/(2*r**2) - k/r", "level": "level_1",
    "action": "2*pi*(k/sqrt(-2*level_1) - G0)"}  # fmt: skip
AROUND: Any = {"coordinate": "theta", "action": "2*pi*G0"}
TORUS: Any = {"cycles": [AROUND, RADIAL], "turns": [[1, 1], [1, 0]]}


def answer(tables: Any = PLANE, torus: Any = TORUS, by: Any = alone_tori, cases: Any = 1) -> str:
    """The answer about a claim, whatever a certificate says of it."""
    data = {"certificate": 1, "tables": tables, "known": {"torus": torus}, "verdict": "proved", "witness": None,
            "cases": [{}] * cases}  # fmt: skip
    return by.checked(resealed(data))[0]


def other(of: Any = PLANE, **changes: Any) -> Any:
    """The same with other sections; of those that are tables, with other entries."""
    made = copy.deepcopy(of)
    for section, value in changes.items():
        made[section] = {**made.get(section, {}), **value}
    return made


def test_delaunay_s_variables_in_the_plane_are_shown() -> None:
    assert answer(by=alone_together) == "shown"
    assert answer(cases=0) == "shown"
    assert answer(cases=2) == "not shown"


SHOWN: Any = {
    "the radial action and another angle": ({"transformation": {"Q": ["l0", "g0 + l0"], "P": ["L0 - G0", "G0"]}},
        [[0, 1], [1, 0]], "2*pi"),
    "the angle the other way": ({"transformation": {"Q": ["-l0", "g0"], "P": ["-L0", "G0"]}}, [[-1, -1], [1, 0]],
        "2*pi"),
    "actions without 2 pi": ({"transformation": {"Q": ["l0/(2*pi)", "g0/(2*pi)"], "P": ["2*pi*L0", "2*pi*G0"]}},
        [[1, 1], [1, 0]], "1"),
    "a range": ({"symbols": {"r": "real"}, "domain": {"where": ["r > 0", *PLANE["domain"]["where"]]}},
        [[1, 1], [1, 0]], "2*pi"),
    "other conditions": ({"domain": {"where": ["pr > 0", *PLANE["domain"]["where"], "r*pr < 5"]}}, [[1, 1], [1, 0]],
        "2*pi"),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_other_maps_to_angles_are_shown(name: str) -> None:
    changes, turns, period = SHOWN[name]
    tables = other(**changes, claim={"angle_period": period})
    assert answer(tables, {**TORUS, "turns": turns}) == "shown"


@pytest.mark.parametrize("period", ["4*pi", "pi", "1", "-2*pi", "0", "2*pi + e", "2*pi*G0/G0", "6*pi", "2*pi*L/L"])
def test_another_period_is_not_shown(period: str) -> None:
    tables = other(claim={"angle_period": period})
    for turns in ([[1, 1], [1, 0]], [[2, 2], [2, 0]], [[-1, -1], [-1, 0]], [[0, 0], [0, 0]]):
        assert answer(tables, {**TORUS, "turns": turns}) == "not shown"


MAPS: Any = {
    "half an angle": ({"transformation": {"Q": ["l0/2", "g0"], "P": ["2*L0", "G0"]}}, [[2, 2], [1, 0]]),
    "twice an angle": ({"transformation": {"Q": ["2*l0", "g0"], "P": ["L0/2", "G0"]}}, [[1, 1], [1, 0]]),
    "not canonical": ({"transformation": {"Q": ["l0", "g0 + r"]}}, [[1, 1], [1, 0]]),
    "another momentum": ({"transformation": {"Q": ["l0", "g0"], "P": ["L0 + G0/1000", "G0"]}}, [[1, 1], [1, 0]]),
    "e turns": ({"transformation": {"Q": ["l0", "g0 - e*l0"], "P": ["L0 + e*G0", "G0"]}}, [[1, 1], [1, 0]]),
    "with time": ({"transformation": {"Q": ["l0 + t", "g0"]}}, [[1, 1], [1, 0]]),
    "H with time": ({"hamiltonian": {"H": "E0 + t"}}, [[1, 1], [1, 0]]),
    "another H": ({"hamiltonian": {"H": "E0 + e/r**2"}}, [[1, 1], [1, 0]]),
    "a pole of H": ({"hamiltonian": {"H": "E0 + 0/(r - 1)"}}, [[1, 1], [1, 0]]),
    "a logarithm in H": ({"hamiltonian": {"H": "E0 + 0*log(r - 1)"}}, [[1, 1], [1, 0]]),
    "a root in H": ({"hamiltonian": {"H": "E0 + sqrt((pr - 1)**2) - sqrt((1 - pr)**2)"}}, [[1, 1], [1, 0]]),
    "a pole of H on the circle": ({"hamiltonian": {"H": "E0 + 0/sin(theta)"}}, [[1, 1], [1, 0]]),
    "no sign of G0": ({"domain": {"where": PLANE["domain"]["where"][1:]}}, [[1, 1], [1, 0]]),
    "G0 below 0": ({"domain": {"where": ["G0 < 0", PLANE["domain"]["where"][1]]}}, [[1, 1], [1, 0]]),
    "energies without a bound": ({"domain": {"where": PLANE["domain"]["where"][:1]}}, [[1, 1], [1, 0]]),
    "a domain without a point": ({"domain": {"where": [*PLANE["domain"]["where"], "G0 < 0"]}}, [[1, 1], [1, 0]]),
    "a surface": ({"domain": {"on": ["E0 + 1"]}}, [[1, 1], [1, 0]]),
    "a part of the circle": ({"domain": {"where": [*PLANE["domain"]["where"], "theta < 1"]}}, [[1, 1], [1, 0]]),
    "a half of the circle": ({"symbols": {"theta": "positive"}}, [[1, 1], [1, 0]]),
    "a part of the line": ({"symbols": {"r": "real"}}, [[1, 1], [1, 0]]),
    "a half of the orbit": ({"symbols": {"pr": "positive"}}, [[1, 1], [1, 0]]),
    "bounds of angles": ({"symbols": {"l": "positive"}}, [[1, 1], [1, 0]]),
    "momenta below 0": ({"symbols": {"L": "negative"}}, [[1, 1], [1, 0]]),
    "a level of the file": ({"symbols": {"level_1": "real"}}, [[1, 1], [1, 0]]),
    "a level that is defined": ({"definitions": {"level_1": "1"}}, [[1, 1], [1, 0]]),
    "a function": ({"symbols": {"k": "function"}}, [[1, 1], [1, 0]]),
    "a whole number": ({"symbols": {"k": "integer"}}, [[1, 1], [1, 0]]),
    "another key": ({"claim": {"order": 1}}, [[1, 1], [1, 0]]),
    "fewer angles": ({"phase_space": {"Q": ["l"], "P": ["L"]}}, [[1, 1], [1, 0]]),
    "a map given backward": ({"transformation": {"q": ["l0"], "p": ["g0"]}}, [[1, 1], [1, 0]]),
    "two maps": ({"generating_function": {"type": 2, "F": "r*L + theta*G"}}, [[1, 1], [1, 0]]),
    "turns twice": ({}, [[2, 2], [1, 0]]),
    "turns that aren't so": ({}, [[1, 0], [0, 1]]),
    "no turns": ({}, [[0, 0], [1, 0]]),
    "turns that aren't whole": ({}, [[1, 1], [1.0, 0]]),
    "a truth for turns": ({}, [[1, True], [1, 0]]),
    "too few turns": ({}, [[1, 1]]),
}  # fmt: skip


@pytest.mark.parametrize("name", MAPS)
def test_near_misses_are_not_shown(name: str) -> None:
    changes, turns = MAPS[name]
    assert answer(other(**changes), {**TORUS, "turns": turns}) == "not shown"


CYCLES: Any = {
    "another action": [AROUND, {**RADIAL, "action": "2*pi*(k/sqrt(-2*level_1) - 1001/1000*G0)"}],
    "another circle": [{**AROUND, "action": "4*pi*G0"}, RADIAL],
    "another level": [AROUND, {**RADIAL, "H": "pr**2/2 + G0**2/(2*r**2) - 2*k/r"}],
    "twice the level": [AROUND, {**RADIAL, "H": "pr**2 + G0**2/r**2 - 2*k/r"}],
    "a level of another coordinate": [AROUND, {**RADIAL, "H": RADIAL["H"] + " + 0*theta"}],
    "a level of itself": [AROUND, {**RADIAL, "H": RADIAL["H"] + " + 0*level_1"}],
    "a level by definitions": [AROUND, {**RADIAL, "H": "E0"}],
    "another name": [AROUND, {**RADIAL, "level": "E"}],
    "an action with a coordinate": [AROUND, {**RADIAL, "action": RADIAL["action"] + " + 0*r"}],
    "a cycle twice": [AROUND, AROUND],
    "no circle": [RADIAL],
    "a circle too many": [AROUND, RADIAL, AROUND],
    "a circle of r": [{**AROUND, "coordinate": "r", "action": "2*pi*pr"}, {**RADIAL, "coordinate": "theta"}],
    "another key": [AROUND, {**RADIAL, "value": "-1"}],
    "a number": [AROUND, {**RADIAL, "H": 7}],
}  # fmt: skip


@pytest.mark.parametrize("name", CYCLES)
def test_another_torus_is_not_shown(name: str) -> None:
    assert answer(torus={**TORUS, "cycles": CYCLES[name]}) == "not shown"
    assert answer(torus={}) == answer(torus=None) == answer(torus={**TORUS, "cycles": None}) == "not shown"


def test_a_circle_is_gone_round_once() -> None:
    """Else 4 pi would be right, by 4 pi L = 2 I_r + 4 pi G."""
    twice = {"cycles": [{**AROUND, "action": "4*pi*G0"}, RADIAL], "turns": [[1, 2], [1, 0]]}
    assert answer(other(claim={"angle_period": "4*pi"}), twice) == "not shown"


ISOTROPIC: Any = {"phase_space": {"q": ["r", "theta"], "p": ["u", "L"], "Q": ["v", "w"], "P": ["J", "K"]},
    "symbols": {"r": "positive", "J": "positive", "K": "positive"}, "hamiltonian": {"H": "(u**2 + L**2/r**2 + r**2)/2"},
    "definitions": {"N": "2*J + K", "X": "sqrt(2*N*r**2 - r**4 - K**2)"},
    "generating_function": {"type": 2, "F": "K*theta + X/2 + N/2*atan2(r**2 - N, X) - K/2*atan2(N*r**2 - K**2, K*X)"},
    "claim": {"kind": "action_angle", "angle_period": "2*pi"}}  # fmt: skip
OSCILLATING: Any = [{"coordinate": "theta", "action": "2*pi*L", "value": "K"},
    {"coordinate": "r", "H": "u**2/2 + L**2/(2*r**2) + r**2/2", "level": "level_1", "value": "2*J + K",
     "action": "pi*(level_1 - L)"}]  # fmt: skip
FLAT: Any = {"cycles": OSCILLATING, "turns": [[0, 1], [1, 0]]}


@pytest.mark.slow
def test_an_oscillator_by_its_generating_function_is_shown() -> None:
    """J is the radial action over 2π, E = 2 J + K, and F = ∫ p dr + K θ."""
    assert answer(ISOTROPIC, FLAT) == "shown"


GENERATED: Any = {
    "another period": ({"claim": {"angle_period": "1"}}, [[0, 1], [1, 0]], OSCILLATING),
    "another type": ({"generating_function": {"type": 1}}, [[0, 1], [1, 0]], OSCILLATING),
    "half the momentum": ({"definitions": {"N": "J + K"}}, [[0, 1], [1, 0]], [OSCILLATING[0],
        {**OSCILLATING[1], "value": "J + K"}]),
    "half the momentum, and said to be whole": ({"definitions": {"N": "J + K"}}, [[0, 1], [1, 0]], OSCILLATING),
    "another level": ({}, [[0, 1], [1, 0]], [OSCILLATING[0], {**OSCILLATING[1], "value": "2*J + 1001/1000*K"}]),
    "a level with r": ({}, [[0, 1], [1, 0]], [OSCILLATING[0], {**OSCILLATING[1], "value": "2*J + K + 0*r"}]),
    "another momentum": ({}, [[0, 1], [1, 0]], [{**OSCILLATING[0], "value": "2*K"}, OSCILLATING[1]]),
    "no value": ({}, [[0, 1], [1, 0]], [AROUND | {"action": "2*pi*L"}, OSCILLATING[1]]),
    "no sign of K": ({"symbols": {"K": "real"}}, [[0, 1], [1, 0]], OSCILLATING),
    "a condition on the angle": ({"domain": {"where": ["v > 0"]}}, [[0, 1], [1, 0]], OSCILLATING),
    "a condition on the old momentum": ({"domain": {"where": ["L > 0"]}}, [[0, 1], [1, 0]], OSCILLATING),
    "with old momenta": ({"definitions": {"N": "2*J + K + 0*L"}}, [[0, 1], [1, 0]], OSCILLATING),
    "an old momentum with a sign": ({"symbols": {"L": "positive"}}, [[0, 1], [1, 0]], OSCILLATING),
    "no energy for it": ({"domain": {"where": ["2*J + K < 0"]}}, [[0, 1], [1, 0]], OSCILLATING),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", GENERATED)
def test_other_generating_functions_are_not_shown(name: str) -> None:
    changes, turns, cycles = GENERATED[name]
    assert answer(other(ISOTROPIC, **changes), {"cycles": cycles, "turns": turns}) == "not shown"


WELL: Any = {"phase_space": {"q": ["x", "theta"], "p": ["p", "L"], "Q": ["u", "v"], "P": ["J", "K"]},
    "definitions": {"C": "(exp(x) + exp(-x))/2", "S": "(exp(x) - exp(-x))/2", "a": "K/4", "s": "a - J",
                    "y": "sqrt(a**2/C**2 - s**2)"},
    "domain": {"where": ["J < K/4", "K > 0"]},
    "hamiltonian": {"H": "p**2/2 - L**2/(8*(exp(x) + exp(-x))**2)"},
    "generating_function": {"type": 2, "F": "K*theta + a*atan2(a*S/C, y) - s*atan2(s*S, y*C)"},
    "claim": {"kind": "action_angle", "angle_period": "2*pi"}}  # fmt: skip


def well(action: str = "L/4 - sqrt(-2*level_1)", value: str = "K", H: str = WELL["hamiltonian"]["H"]) -> Any:
    """The cycles of a well −L²/32 cosh² x, whose action over 2π is |L|/4 − √(−2E)."""
    circle = {"coordinate": "theta", "action": "2*pi*L", "value": value}
    swing = {"coordinate": "x", "H": H, "level": "level_1", "action": f"2*pi*({action})", "value": "-(K/4 - J)**2/2"}
    return {"cycles": [circle, swing], "turns": [[0, 1], [1, 0]]}


@pytest.mark.slow
def test_a_well_by_its_generating_function_is_shown() -> None:
    assert answer(WELL, well()) == "shown"


@pytest.mark.parametrize(
    "torus",
    [
        well("sqrt(L)*sqrt(L)/4 - sqrt(-2*level_1)"),
        well("sqrt(L**2)/4 + 0*sqrt(L) - sqrt(-2*level_1)"),
        well("sqrt(L**2)/4 + 0*log(L) - sqrt(-2*level_1)"),
        well("sqrt(L**2)/4 + 0*asin(1 - L) - sqrt(-2*level_1)"),
        well("sqrt(L**2)/4 - sqrt(-2*level_1)", "sqrt(K)*sqrt(K)"),
        well("sqrt(L**2)/4 - sqrt(-2*level_1)", H=f"{WELL['hamiltonian']['H']} + 0*sqrt(L)"),
        pytest.param(well(), marks=pytest.mark.slow),
    ],
)
def test_a_torus_without_values_in_the_domain_shows_nothing(torus: Any) -> None:
    """Where K is below 0 J isn't the action over 2π: it differs by K/2, half of a turn of the other angle."""
    assert answer(other(WELL, domain={"where": ["J < K/4", "K + K**3 < 0"]}), torus) == "not shown"


ILL: Any = {
    "a period without values": {"claim": {"angle_period": "2*pi + 0*sqrt(-1 - e**2)"}},
    "a condition that compares nothing": {"domain": {"where": [*PLANE["domain"]["where"], "e"]}},
    "positive and negative": {"symbols": {"e": ["positive", "negative"]}},
}


@pytest.mark.parametrize("name", ILL)
def test_claims_without_a_meaning_are_not_shown(name: str) -> None:
    assert answer(other(**ILL[name])) == "not shown"


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("kepler-angles-plane", 0),
        pytest.param("kepler-angles-space", 0, marks=pytest.mark.slow),
        pytest.param("isochrone-angles", 3, marks=pytest.mark.slow),
    ],
)
def test_what_the_catalogue_proves_is_shown(name: str, number: int) -> None:
    """By the torus that the prover found."""
    (path,) = (path for path in files() if path.name == f"{name}.toml")
    tables = document.parse(path.read_text(encoding="utf-8"))
    claim = read_tables(tables).claims[number]
    data = certificate(claim, verify(claim), statement_tables(tables, number))
    assert data["verdict"] == "proved"
    assert alone_together.checked(data) == ("shown", "")
    data["known"]["torus"]["turns"][-1].reverse()
    assert alone_tori.checked(resealed(data))[0] == "not shown"
