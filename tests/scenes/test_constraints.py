"""Rods and surfaces: pendulums of Cartesian bodies, against the same in angles, and against Newton."""

import numpy as np
import pytest

from canon.errors import InputError
from canon.scenes.examples import scene_text
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.systems import load_system

PENDULUM = """
[[body]]
name = "bob"
mass = 2.0
position = [1.2, -1.6]
velocity = [0.4, 0.3]
[[effect]]
kind = "uniform_gravity"
g = 9.81
[[effect]]
kind = "{kind}"
{more}
[run]
duration = 5.0
accuracy = 1e-9
samples = 11
monitor = ["energy", "angular_momentum", "constraint", "reversibility"]
"""
ROD = PENDULUM.format(kind="rod", more="length = 2.0")
LOGARITHM = PENDULUM.format(kind="surface", more='equation = "log(y)"')


@pytest.mark.slow
@pytest.mark.parametrize("text", [ROD, PENDULUM.format(kind="surface", more='equation = "x**2 + y**2 - 4"')])
def test_a_rod_is_a_pendulum(text: str) -> None:
    result = simulate(read_scene_text(text))
    assert result.ok, result.messages
    angle = scene_text(load_system("pendulum")).replace("R = 1.0", "R = 2.0").replace("m = 1.0", "m = 2.0")
    angle = angle.replace("[3.1]", '["atan2(1.2, 1.6)"]').replace("p = [0]", "p = [2.0]").replace("20.0", "5.0")
    one = simulate(read_scene_text(angle.replace("accuracy", "samples = 11\naccuracy")))
    assert np.allclose(result.q[:, 0], 2 * np.sin(one.q[:, 0]), atol=2e-8)
    assert np.allclose(result.q[:, 1], -2 * np.cos(one.q[:, 0]), atol=2e-8)
    found = {reading.name: reading for reading in result.monitors}
    assert found["energy"].expected == "conserved"
    assert found["angular_momentum"].expected == "broken by uniform_gravity"
    assert found["constraint"].max_drift < 1e-13


def test_a_dumbbell_falls_and_turns() -> None:
    """A rod between two bodies breaks neither momentum nor angular momentum; without effects its centre is uniform."""
    text = """
[[body]]
mass = 1.0
position = [0, 0, 0]
velocity = [0, 1, 0]
[[body]]
mass = 3.0
position = [2, 0, 0]
velocity = [0, 0, 1]
[[effect]]
kind = "rod"
length = 2
[run]
duration = 4.0
samples = 5
monitor = ["energy", "momentum", "angular_momentum"]
"""
    result = simulate(read_scene_text(text))
    assert result.ok, result.messages
    assert {reading.expected for reading in result.monitors} == {"conserved"}
    centre = (result.q[:, :3] + 3 * result.q[:, 3:]) / 4
    expected = np.array([1.5, 0, 0]) + result.times[:, None] * np.array([0, 0.25, 0.75])
    assert np.allclose(centre, expected, atol=1e-8)


def test_a_moving_surface_does_work() -> None:
    """A bead on a line through the origin that turns with Ω: r̈ = Ω² r, so r = cosh Ωt."""
    text = """
[[body]]
mass = 1.0
position = [1, 0]
velocity = [0, 2]
[[effect]]
kind = "surface"
equation = "y*cos(2*t) - x*sin(2*t)"
[run]
duration = 1.5
samples = 4
monitor = ["energy"]
"""
    result = simulate(read_scene_text(text))
    assert result.ok, result.messages
    assert np.allclose(np.hypot(*result.q.T), np.cosh(2 * result.times), rtol=1e-8)
    assert result.monitors[0].expected == "broken by surface"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (ROD.replace("length = 2.0", "length = 2.1"), "the initial state is not on its constraints"),
        (ROD.replace("[0.4, 0.3]", "[0.4, 0.4]"), "the velocity leaves constraint 1"),
        (ROD.replace("length = 2.0", "length = -2.0"), "the length of a rod"),
        (ROD.replace("accuracy = 1e-9", "step = 1e-300"), "at most 2e+09"),
        (LOGARITHM, "constraint 1, or how it changes, is not finite there"),
        (
            "dynamics = 'relativistic'\nconstants = {c = 30}\n" + ROD + "[[effect]]\nkind = 'damping'\nrate = 1\n",
            "together with a constraint is not available in relativistic dynamics",
        ),
        (ROD + "[[body]]\nmass=1\nposition=[5,5]\n[[body]]\nmass=1\nposition=[6,5]\n", "a rod joins two bodies"),
    ],
)
def test_bad_input_is_told_from_good(text: str, says: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is made that computes, which takes seconds to load and to compile."""
    monkeypatch.delattr("canon.scenes.simulate.problem_of")
    with pytest.raises(InputError) as caught:
        simulate(read_scene_text(text))
    assert says in str(caught.value)


def test_many_bodies_are_split_as_they_are_written() -> None:
    bodies = "".join(f"[[body]]\nmass = {k + 1}\nposition = [{k}, {k % 3}, 0]\n" for k in range(5))
    text = bodies + '[[effect]]\nkind = "uniform_gravity"\ng = 2\n[[effect]]\nkind = "damping"\nrate = 0.1\n'
    result = simulate(read_scene_text(text + "[run]\nduration = 1.0\nsamples = 3\n"))
    assert result.ok
    assert result.problem.kind == "T(p) + V(q), and damping"
    fallen = -2 * (result.times / 0.2 - (1 - np.exp(-0.2 * result.times)) / 0.04)
    assert np.allclose(result.q[:, 2::3], fallen[:, None], atol=1e-9)
