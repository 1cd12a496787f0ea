"""`canon cost`: tables, JSON, files and refusals."""

import csv
import json

import pytest

from canon.cli.main import main

CLAIMS = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[transformation]
Q = ["q + 2*p"]
P = ["p"]
[[claim]]
kind = "canonical"
title = "a shear"
"""


@pytest.fixture
def claims(tmp_path):
    path = tmp_path / "shear.toml"
    path.write_text(CLAIMS)
    return path


def test_claims_as_a_table_a_figure_and_rows(claims, tmp_path, capsys):
    figure, rows = tmp_path / "cost.svg", tmp_path / "cost.csv"
    assert main(["cost", "verify", str(claims), "--plot", str(figure), "--csv", str(rows)]) == 0
    printed = capsys.readouterr().out
    assert "a shear" in printed
    assert "proved" in printed
    assert figure.read_text().lstrip().startswith("<?xml")
    table = list(csv.DictReader(rows.read_text().splitlines()))
    assert table[-1]["method"] == "exact"
    assert table[-1]["error"] == "0.0"


def test_a_scene_as_json(capsys):
    command = ["cost", "simulate", "harmonic_oscillator", "--integrator", "verlet", "--cap", "0.01", "--json"]
    assert main(command) == 0
    (study,) = json.loads(capsys.readouterr().out)["studies"]
    assert study["kind"] == "simulate"
    assert study["methods"][0]["claimed_order"] == 2
    assert all(point["seconds"] > 0 for point in study["points"])


def test_the_cheapest_for_an_accuracy_is_named(capsys):
    assert main(["cost", "normal-form", "--order", "5", "--accuracy", "1e-3", "--within", "100"]) == 0
    printed = capsys.readouterr().out
    assert "for 1e-03: Lie series with" in printed
    assert "within 100 s: Lie series with 5 order" in printed


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["simulate", "no_such_system"], "no system"),
        (["simulate", "pendulum", "--integrator", "verlett"], "verlet"),
        (["verify", "nowhere.toml"], "nowhere.toml"),
        (["loop", "forced_oscillator.toml"], "forced_oscillator.toml"),
        (["normal-form", "kepler"], "origin"),
    ],
)
def test_bad_input_is_named_and_ends_with_3(arguments, said, capsys):
    assert main(["cost", *arguments]) == 3
    assert said in capsys.readouterr().err
