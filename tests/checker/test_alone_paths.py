"""Second variations in one small file: what is shown, near misses, and claims that no file could state."""

from typing import Any

import pytest

from canon.checker import alone_paths, alone_together
from tests.checker.certified import certified, resealed

NAMES = {"m": "positive", "w": "positive", "T": "positive", "k": "real", "V": "function", "N": ["function", "positive"]}
SPACE: Any = {"phase_space": {"q": ["x"], "p": ["p"]}, "symbols": NAMES}
WAVE = {"L": "m*v**2/2 - m*w**2*x**2/2", "path": "k*sin(w*t)", "from": "0"}
FREE = {"L": "m*v**2/2", "path": "k*t", "from": "0", "to": "T"}
SHORT, LONG = {"to": "3*pi/(4*w)"}, {"to": "3*pi/w"}
PLANE: Any = {"phase_space": {"q": ["x", "y"], "p": ["px", "py"]}, "symbols": NAMES}
CHARGE = {"L": "m*(u**2 + v**2)/2 + m*w*(x*v - y*u)/2", "path": ["k*sin(w*t)", "k*cos(w*t)"], "from": "0"}
TURNS = [["sin(w*t)", "cos(w*t) - 1"], ["1 - cos(w*t)", "sin(w*t)"]]


def answer(keys: Any, file: Any = SPACE, **sections: Any) -> str:
    """The answer about a path of x, or of x and y, whose velocities are v, or u and v."""
    n = len(file["phase_space"]["q"])
    claim = {"kind": "stationary", "velocities": ["u", "v"][2 - n :], **keys}
    data = {"certificate": 1, "tables": {**file, "claim": claim, **sections}, "verdict": "proved", "witness": None}
    return alone_paths.checked(resealed({**data, "cases": [{}]}))[0]


@pytest.mark.parametrize("keys", [
    FREE, {**FREE, "extremum": "minimum"}, {**FREE, "L": "-v**2", "extremum": "maximum"},
    {**FREE, "L": "m*v**2/2 + x*v + k*t"}, {**FREE, "L": "m*v**2/2 + x*v", "extremum": "minimum"},
    {**FREE, "L": "exp(k*t)*v**2 + V(t)", "path": "T", "extremum": "minimum"},
    {**FREE, "L": "N(t)*sqrt(1 + v**2)", "path": "k", "extremum": "minimum"},
    {**FREE, "L": "(v**2 + x**2)/2", "path": "k*sinh(t)", "extremum": "minimum"},
    {**FREE, "extremum": "minimum", "field": "t"}, {**FREE, "extremum": "minimum", "field": "T - t"},
    {**WAVE, **SHORT}, {**WAVE, **LONG}, {**WAVE, **SHORT, "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, **SHORT, "extremum": "minimum", "field": "cos(w*t - 3*pi/8)"},
    {**WAVE, "to": "pi/w", "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, "from": "-pi/w", "to": "0", "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t - pi/2)", "conjugate": ["pi/(2*w)", "3*pi/(2*w)"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "cos(w*t)", "conjugate": ["pi/(2*w)", "5*pi/(2*w)"]},
])  # fmt: skip
def test_a_path_is_shown(keys: Any) -> None:
    assert answer(keys) == "shown"


@pytest.mark.parametrize("keys", [
    {**FREE, "path": "k*t**2"}, {**WAVE, **SHORT, "path": "k*sin(2*w*t)"}, {**FREE, "L": "m*v**2/2 - m*x"},
    {**FREE, "extremum": "maximum"}, {**FREE, "extremum": "neither"}, {**FREE, "L": "k*v**2", "extremum": "minimum"},
    {**FREE, "L": "v**3", "extremum": "minimum"}, {**FREE, "L": "v", "extremum": "minimum"},
    {**FREE, "L": "m*v**2/2 - x**2/2", "path": "0", "extremum": "minimum"},
    {**FREE, "L": "m*v**2/2 + k*x**2/2", "path": "0", "extremum": "minimum"},
    {**FREE, "L": "V(t)*sqrt(1 + v**2)", "path": "k", "extremum": "minimum"},
    {**FREE, "L": "(v**2 + V(t)*x**2)/2", "path": "0", "extremum": "minimum"},
    {**WAVE, **SHORT, "extremum": "minimum"}, {**WAVE, **LONG, "extremum": "minimum"},
    {**WAVE, "to": "1001*pi/(1000*w)", "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, **LONG, "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, **LONG, "extremum": "minimum", "field": "2 + sin(w*t)"},
    {**WAVE, **SHORT, "extremum": "minimum", "field": "cos(w*t)"},
    {**WAVE, **SHORT, "extremum": "minimum", "field": "1"}, {**WAVE, **SHORT, "extremum": "minimum", "field": "0"},
    {**WAVE, **SHORT, "extremum": "minimum", "field": "exp(w*t)"},
    {**WAVE, "to": "T", "extremum": "minimum", "field": "sin(w*t)"},
    {**WAVE, "from": "-pi/w", "to": "pi/w", "extremum": "minimum", "field": "sin(w*t)"},
    {**FREE, "extremum": "minimum", "field": "t - T/2"}, {**FREE, "extremum": "minimum", "field": "k*t + 1"},
    {**WAVE, **LONG, "extremum": "neither", "field": "0*t", "conjugate": ["pi/(2*w)", "3*pi/(2*w)"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "k*cos(w*t)", "conjugate": ["pi/(2*w)", "3*pi/(2*w)"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["pi/w", "3*pi/w"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["0", "pi/w"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["pi/w", "pi/w"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["2*pi/w", "pi/w"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["pi/w", "3*pi/(2*w)"]},
    {**WAVE, **SHORT, "extremum": "neither", "field": "sin(w*t)", "conjugate": ["pi/w", "2*pi/w"]},
    {**WAVE, **LONG, "extremum": "neither", "field": "sin(2*w*t)", "conjugate": ["pi/w", "2*pi/w"]},
])  # fmt: skip
def test_what_is_false_isnt_shown(keys: Any) -> None:
    assert answer(keys) == "not shown"


@pytest.mark.parametrize("keys", [
    {**FREE, "to": "-T"}, {**FREE, "to": "k"}, {**FREE, "from": "T"}, {**FREE, "to": "infinity"}, {**FREE, "to": "t"},
    {**FREE, "path": "1/(t - T/2)", "L": "v"}, {**FREE, "path": "abs(t - T/2)", "L": "0*v"}, {**FREE, "path": "x"},
    {**FREE, "path": "k*t + 0*log(t - T/2)"}, {**FREE, "L": "m*v**2/2 + 0*sqrt(x - 1)"}, {**FREE, "path": "v*t"},
    {**FREE, "L": "m*v**2/2 + 0*V(x)/x"}, {**FREE, "L": "m*v**2/2 + 0*log(v)"}, {**FREE, "L": "p**2"},
    {**FREE, "domain": {"where": ["x > 0"]}}, {**FREE, "domain": {"where": ["t < T/2"]}},
    {**FREE, "symbols": {**NAMES, "x": "positive"}}, {**FREE, "symbols": {**NAMES, "v": "positive"}},
    {**FREE, "symbols": {**NAMES, "t": "negative"}}, {**FREE, "hamiltonian": {"H": "log(x - 1) + p"}},
    {**FREE, "definitions": {"a": "log(t - T/2)"}, "L": "m*v**2/2 + 0*a"}, {**FREE, "field": "t"},
    {**FREE, "definitions": {"a": "sqrt(x)"}, "domain": {"where": ["a > 1"]}},
    {**FREE, "extremum": "saddle"}, {**FREE, "extremum": "minimum", "conjugate": ["0", "T"]},
    {**FREE, "transformation": {"Q": ["x"], "P": ["p"]}}, {**FREE, "velocities": ["x"]}, {**FREE, "path": ["0", "0"]},
    {**FREE, "velocities": ["p"]}, {**FREE, "path": {"x": "t"}}, {**FREE, "extremum": "minimum", "field": ["t"]},
    {**FREE, "L": "D(V(t/(t - T/2)), v) + v**2"}, {**FREE, "order": 2}, {**FREE, "to": "T", "from": "T*k**2"},
])  # fmt: skip
def test_what_no_file_could_state_isnt_shown(keys: Any) -> None:
    sections = {key: keys[key] for key in keys if key in ("symbols", "hamiltonian", "domain", "definitions")}
    sections |= {"transformation": keys["transformation"]} if "transformation" in keys else {}
    assert answer({key: x for key, x in keys.items() if key not in sections}, **sections) == "not shown"


def test_several_coordinates() -> None:
    close = {"to": "7*pi/(4*w)", "extremum": "minimum", "field": TURNS}
    assert answer({**CHARGE, **close}, PLANE) == "shown"
    assert answer({**CHARGE, **close, "to": "2*pi/w"}, PLANE) == "shown"
    assert answer({**CHARGE, **close, "to": "9*pi/(4*w)"}, PLANE) == "not shown"
    assert answer({**CHARGE, **close, "field": TURNS[:1]}, PLANE) == "not shown"
    assert answer({**CHARGE, **close, "field": [TURNS[0], TURNS[0]]}, PLANE) == "not shown"
    assert answer({**CHARGE, **close, "field": [["1", "0"], ["0", "1"]]}, PLANE) == "not shown"  # they aren't conjoined
    assert answer({**CHARGE, **close, "field": [["1"], ["0"]]}, PLANE) == "not shown"
    assert answer({**CHARGE, "to": "T", "extremum": "minimum"}, PLANE) == "not shown"  # R isn't symmetric


def test_several_coordinates_without_a_field() -> None:
    free = {"path": ["0", "k*t"], "from": "0", "to": "T", "extremum": "minimum"}
    assert answer({**free, "L": "(u**2 + v**2)/2 + x*v + y*u"}, PLANE) == "shown"
    assert answer({**free, "L": "(u**2 + v**2)/2 + u*v"}, PLANE) == "not shown"
    assert answer({**free, "L": "(u**2 - v**2)/2"}, PLANE) == "not shown"
    assert answer({**free, "L": "(u**2 + v**2)/2 + x**2"}, PLANE) == "shown"
    assert answer({**free, "L": "(u**2 + v**2)/2 - x**2"}, PLANE) == "not shown"
    assert answer({**free, "L": "(u**2 + v**2)/2 + 2*x*(y - k*t) + x**2/2 + (y - k*t)**2/2"}, PLANE) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    file = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\nT = "positive"\nk = "real"\n'
    keys = 'L = "v**2/2"\nvelocities = ["v"]\npath = ["k*t"]\nfrom = "0"\nto = "T"\nextremum = "minimum"'
    data = certified(file, f'kind = "stationary"\n{keys}')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["extremum"] = "maximum"
    assert alone_together.checked(resealed(data))[0] == "not shown"
