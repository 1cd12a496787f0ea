"""What double precision can hold of a run: the growth of one rounding, on motions whose growth is known."""

import numpy as np
import pytest

from canon.cli.main import main
from canon.numeric.attainable import MOVED, attainable
from canon.numeric.integrators.catalogue import method
from canon.numeric.precision import UNIT
from canon.numeric.step_search import Task
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text

SCENE = """
[system]
q_names = ["q"]
p_names = ["p"]
H = "{H}"
q = [{q}]
p = [0.0]
[run]
duration = {duration}
samples = 3
"""


def task(H: str, q: float, duration: float) -> Task:
    scene = read_scene_text(SCENE.format(H=H, q=q, duration=duration))
    value = problem_of(scene.model, exact=False).value
    return Task(value, method("nystrom6a"), (np.array(scene.q), np.array(scene.p)), duration, 3, 0.0)


def test_an_oscillator_keeps_what_it_was_given():
    assert UNIT <= attainable(task("p**2/2 + q**2/2", 1.0, 20.0)) < 3 * UNIT


@pytest.mark.parametrize("duration", [5.0, 10.0])
def test_an_unstable_point_multiplies_it_as_theory_says(duration):
    # q̈ = sin q at 0: neighbours part as cosh t
    found = attainable(task("p**2/2 + cos(q)", 1e-12, duration))
    # the orbit that was moved ends at 1e-12·(1 + MOVED) cosh t, beside 1e-12 cosh t: relative to the end, MOVED
    assert found == pytest.approx(UNIT, rel=0.5)
    assert MOVED < 1e-6


def test_a_swing_past_the_top_loses_digits_with_every_period():
    short, long = (attainable(task("p**2/2 - cos(q)", 3.14, duration)) for duration in (6.0, 60.0))
    assert 100 * UNIT < 2 * short < long


def test_it_is_said_before_the_run(tmp_path, capsys):
    path = tmp_path / "swing.toml"
    path.write_text(SCENE.format(H="p**2/2 - cos(q) + p**4/100", q=3.14, duration=20.0))
    assert main(["simulate", str(path), "--accuracy", "1e-15"]) == 1
    said = capsys.readouterr()
    assert "cannot be reached: in double precision" in said.err
    assert "was not reached" in said.out
    assert "ask for" in said.out
