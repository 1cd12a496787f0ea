"""`canon actions` from the command line: what it prints and draws, and what it refuses."""

import json
import math
import time
from pathlib import Path

import pytest

from canon.cli import actions
from canon.cli.main import main

WELL = """
[phase_space]
q = ["x"]
p = ["p"]
[symbols]
k = "positive"
[hamiltonian]
H = "p**2/2 + k*x**2/2"
[[claim]]
kind = "bracket"
f = "x"
g = "p"
equals = "1"
"""
PLANET = """
title = "A planet"
[[body]]
name = "planet"
mass = 2.0
position = [3.0, 0.0, 0.0]
velocity = [0.0, 0.25, 0.25]
[[effect]]
kind = "inverse_distance"
a = 2.0
[run]
duration = 1.0
"""


@pytest.fixture
def well(tmp_path: Path) -> str:
    path = tmp_path / "well.toml"
    path.write_text(WELL)
    return str(path)


def test_the_record(capsys: pytest.CaptureFixture[str]) -> None:
    """sec-14.5-d: J = 2πE/ω, ν = ω/2π."""
    assert main(["actions", "harmonic_oscillator", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["format"] == 1
    (degree,) = record["degrees"]
    assert degree["kind"] == "libration"
    assert degree["action"]["value"] == math.pi
    assert degree["action"]["bound"] < 5e-16
    assert degree["frequency"]["value"] == 1 / (2 * math.pi)
    assert degree["angle"]["value"] == 0.5
    assert [end["value"] for end in degree["ends"]] == [-1.0, 1.0]


def test_kepler_is_degenerate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """sec-14.5-f: J_r = 2π(a√(m/−2E) − M), H = −2π²ma²/(J_r + 2πM)², all frequencies equal; in a tilted plane."""
    path = tmp_path / "planet.toml"
    path.write_text(PLANET)
    assert main(["actions", str(path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    m = a = 2.0
    E = record["energy"]["value"]
    assert pytest.approx(-2 / 3 + 0.125, rel=1e-15) == E
    M, along = 6 * math.hypot(0.25, 0.25), 1.5
    actions = {degree["name"]: degree["action"]["value"] for degree in record["degrees"]}
    assert actions["r"] == pytest.approx(2 * math.pi * (a * math.sqrt(m / (-2 * E)) - M), rel=1e-14)
    assert actions["theta"] == pytest.approx(2 * math.pi * (M - along), rel=1e-15)
    assert actions["phi"] == pytest.approx(2 * math.pi * along, rel=1e-15)
    total = sum(actions.values())
    assert pytest.approx(-2 * math.pi**2 * m * a**2 / total**2, rel=1e-15) == E
    for degree in record["degrees"]:
        assert degree["frequency"]["value"] == pytest.approx(4 * math.pi**2 * m * a**2 / total**3, rel=1e-14)


def test_a_named_orbit_and_its_figure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    figure = tmp_path / "portrait.svg"
    assert (
        main(["actions", "pendulum", "--above-separatrix", "1e-3", "--branch", "rotation", "--plot", str(figure)]) == 0
    )
    out = capsys.readouterr().out
    assert "theta: rotation from -3.141592654 to 3.141592654" in out
    assert "rule         arithmetic-geometric mean, " in out
    assert figure.read_text().startswith("<?xml")


def test_a_claim_file(well: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["actions", well, "--parameter", "k=4", "--q", "1/2", "--p", "0"]) == 0
    assert f"action       {math.pi / 2!r}" in capsys.readouterr().out
    assert main(["actions", well, "--parameter", "k=4", "--energy", "2", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["degrees"][0]["action"]["value"] == 2 * math.pi


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["WELL", "--energy", "1"], "no value is given for k: give one, as --parameter k=1"),
        (["WELL", "--parameter", "j=1"], "H has no parameter 'j'"),
        (["WELL", "--parameter", "k"], "sets nothing"),
        (["WELL", "--parameter", "k=1"], "--q and --p; the energies are: librations about x = 0 from 0 up"),
        (["WELL", "--parameter", "k=1", "--energy", "-1"], "there is no motion at E = -1; the energies are"),
        (["pendulum", "--well", "0"], "goes with --energy"),
        (["pendulum", "--parameter", "g=1"], "a scene has its initial state and its parameters itself"),
        (["three_body"], "H does not separate in x1, y1, x2, y2, x3, y3"),
        (["damped_oscillator"], "H depends on the time"),
        (["uniform_gravity"], "no minimum, so that nothing is bound"),
        (["coulomb_scattering"], "is not bounded"),
        (["asymmetric_top"], "the state of rigid bodies and of skates is not (q, p)"),
        (["skate_on_an_incline"], "the state of rigid bodies and of skates is not (q, p)"),
        (["pendulumm"], "did you mean 'pendulum'"),
        (["pendulum", "--plot", "/nowhere/at/all.png"], "there is no folder"),
        (["kepler", "--energy", "-1"], "with one degree of freedom, not with 3"),
    ],
)
def test_what_is_refused(well: str, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["actions", *(well if word == "WELL" else word for word in arguments)]) == 3
    assert message in capsys.readouterr().err
    assert main(["actions", *(well if word == "WELL" else word for word in arguments), "--json"]) == 3
    assert message in json.loads(capsys.readouterr().out)["errors"][0]["message"]


def test_a_claim_file_with_cyclic_coordinates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The radial action of Kepler's problem, sec-14.5-f: J = 2π(a √(m/−2E) − M)."""
    path = tmp_path / "radial.toml"
    text = WELL.replace('["x"]', '["r", "phi"]', 1).replace('["p"]', '["p", "M"]', 1).replace('f = "x"', 'f = "r"')
    H, known = 'H = "p**2/2 + M**2/(2*r**2) - k/r"', 'k = "positive"\nr = "positive"'
    path.write_text(text.replace('H = "p**2/2 + k*x**2/2"', H).replace('k = "positive"', known))
    options = ["actions", str(path), "--energy", "-1/2", "--parameter", "k=1", "--json"]
    assert main([*options, "--parameter", "M=1/2"]) == 0
    (degree,) = json.loads(capsys.readouterr().out)["degrees"]
    assert degree["action"]["value"] == pytest.approx(math.pi, rel=1e-15)
    assert main(options) == 3
    assert "no value is given for M" in json.loads(capsys.readouterr().out)["errors"][0]["message"]
    path.write_text(path.read_text().replace("- k/r", "- k/r + phi"))
    assert main([*options, "--parameter", "M=1/2"]) == 3
    assert "r, phi occur in H" in json.loads(capsys.readouterr().out)["errors"][0]["message"]


def test_what_takes_longer_than_its_budget_is_given_up(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nested = "sin(q)"
    for _ in range(5):
        nested = f"sin(q*{nested})"
    file = tmp_path / "long.toml"
    file.write_text(
        WELL.replace("x", "q").replace("k*q**2/2", f"k*{nested}*exp(sin(40*q**3)) + q**4"), encoding="utf-8"
    )
    asked = ["actions", str(file), "--parameter", "k=1", "--energy", "3", "--budget", "0.5"]
    start = time.monotonic()
    assert main(asked) == 2
    assert time.monotonic() - start < 15
    assert "nothing is known after 0.5 s" in capsys.readouterr().err
    assert main([*asked, "--json"]) == 2
    (error,) = json.loads(capsys.readouterr().out)["errors"]
    assert error["file"] == str(file)
    assert "--budget" in error["message"]


def test_a_figure_that_takes_too_long_takes_no_number_along(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(actions, "_draw", lambda found, path: time.sleep(4))
    assert main(["actions", "pendulum", "--budget", "3", "--plot", str(tmp_path / "pendulum.png")]) == 74
    out, err = capsys.readouterr()
    assert "frequency" in out
    assert "was not drawn within the 3 s" in err
    assert not list(tmp_path.iterdir())
