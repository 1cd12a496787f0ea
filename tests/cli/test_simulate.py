"""`canon simulate` from the command line: what it prints and writes, and its exit status."""

import json
from pathlib import Path

import numpy as np
import pytest

from canon.cli.main import main

PENDULUM = """
title = "A pendulum"
[system]
q_names = ["theta"]
p_names = ["L"]
H = "L**2/2 - cos(theta)"
q = [1.0]
p = [0.0]
[run]
duration = 5
samples = 21
accuracy = 1e-8
monitor = ["energy"]
"""


@pytest.fixture
def pendulum(tmp_path: Path) -> str:
    path = tmp_path / "pendulum.toml"
    path.write_text(PENDULUM)
    return str(path)


def test_the_record(pendulum: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", pendulum, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["format"] == 1
    assert record["title"] == "A pendulum"
    assert record["effects"] == {"active": []}
    assert record["integrator"]["symplectic"] is True
    assert record["monitors"]["energy"]["expected"] == "conserved"
    assert abs(record["monitors"]["energy"]["initial"] + np.cos(1.0)) < 1e-15
    assert record["monitors"]["energy"]["max_drift"] < 1e-7
    assert record["error_estimate"] <= 1e-8
    assert len(record["times"]) == len(record["q"]) == len(record["p"]) == 21
    assert record["times"][-1] == 5
    assert record["operations"]["per_step"] > 0


def test_words_files_and_explanation(pendulum: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    states, figure = tmp_path / "states.npz", tmp_path / "orbit.svg"
    assert main(["simulate", pendulum, "--explain", "--out", str(states), "--plot", str(figure)]) == 0
    out = capsys.readouterr().out
    assert "Splitting: a pendulum, in closed form" in out
    assert "✓ energy  conserved" in out
    assert figure.read_text().startswith("<?xml")
    with np.load(states) as stored:
        assert stored["q"].shape == (21, 1)
        assert stored["times"][-1] == 5
    assert [path.name for path in tmp_path.iterdir() if "part" in path.name] == []


def test_an_accuracy_that_is_out_of_reach_is_said(pendulum: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", pendulum, "--accuracy", "1e-15", "--integrator", "yoshida6"]) == 1
    assert "the accuracy 1.0e-15 was not reached" in capsys.readouterr().out


def test_bad_input_has_status_3(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", str(tmp_path / "absent.toml")]) == 3
    assert "there is no such file" in capsys.readouterr().err
    bad = tmp_path / "bad.toml"
    bad.write_text(PENDULUM.replace("title", "titel"))
    assert main(["simulate", str(bad), "--json"]) == 3
    record = json.loads(capsys.readouterr().out)
    assert record["errors"][0]["message"].startswith("unknown key 'titel': did you mean 'title'?")
    with pytest.raises(SystemExit) as caught:
        main(["simulate", str(bad), "--plot", "orbit.gif"])
    assert caught.value.code == 3


@pytest.mark.slow
def test_scenes_prints_what_simulate_runs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes"]) == 0
    listed = capsys.readouterr().out
    assert "kepler" in listed
    assert "mutual_gravity" in listed
    assert main(["scenes", "kepler"]) == 0
    (tmp_path / "kepler.toml").write_text(capsys.readouterr().out)
    assert main(["simulate", str(tmp_path / "kepler.toml")]) == 0
    by_file = capsys.readouterr().out
    assert "✓ lrl" in by_file
    assert main(["simulate", "kepler"]) == 0
    assert main(["scenes", "damping"]) == 0
    assert "no: it is a force" in capsys.readouterr().out
    assert main(["scenes", "dampng"]) == 3
    assert "did you mean 'damping'?" in capsys.readouterr().err
