"""Skates: the ledger's skate on an incline in closed form, and what a non-holonomic constraint keeps and breaks."""

from dataclasses import replace

import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.integrators.yoshida import VERLET
from canon.numeric.operations import operations_per_step
from canon.scenes.examples import scene_text
from canon.scenes.monitors import Reading
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.states import named_states, own_states
from canon.scenes.systems import load_system

SKATER = """
[[body]]
name = "skater"
mass = 2.0
position = [1.0, 0.5]
velocity = [0.6, 0.8]
[run]
duration = 5.0
samples = 11
"""
SKATE = '[[effect]]\nkind = "skate"\nturning = 0.7\n'
PULL = '[[effect]]\nkind = "spring"\nk = 1.5\n'


def run(text: str, *monitors: str) -> tuple[Result, dict[str, Reading]]:
    scene = read_scene_text(text)
    result = simulate(replace(scene, settings=replace(scene.settings, monitors=monitors)))
    assert result.ok, result.messages
    return result, {reading.name: reading for reading in result.monitors}


def test_the_skate_on_an_incline() -> None:
    """S33, by d'Alembert: v = (g/ω) sin ωt and no net descent; at g = ω = 1 and t = 6 it is at (0.039, 3.134)."""
    g, w = 1.3, 0.8
    text = scene_text(load_system("skate_on_an_incline")).replace(", g = 1.0", f", g = {g}")
    result, found = run(text.replace("turning = 1.0", f"turning = {w}"), "energy", "volume", "momentum")
    t, states = result.times, own_states(result)
    assert np.allclose(states["speed"], g / w * np.sin(w * t), atol=1e-9)
    assert np.allclose(states["heading"], w * t, atol=1e-12)
    assert np.allclose(states["position"][:, 0], g / (2 * w * w) * np.sin(w * t) ** 2, atol=1e-8)
    assert np.allclose(states["position"][:, 1], g / (2 * w * w) * (w * t - np.sin(2 * w * t) / 2), atol=1e-8)
    assert found["energy"].expected == found["volume"].expected == "conserved"
    assert "skate" in found["momentum"].expected
    assert 0.5 * np.sin(6) ** 2 == pytest.approx(0.039, abs=5e-4)


def test_a_free_skate_runs_in_a_circle() -> None:
    result, found = run(SKATER + SKATE, "energy", "momentum", "symplecticity")
    assert result.problem.exact
    states = named_states(result)
    heading = np.arctan2(0.8, 0.6) + 0.7 * result.times
    assert np.allclose(states["heading"]["skater"], heading, atol=1e-13)
    assert np.allclose(states["velocity"]["skater"], np.column_stack([np.cos(heading), np.sin(heading)]), atol=1e-12)
    centre = np.array([1.0, 0.5]) + np.array([-0.8, 0.6]) / 0.7
    radius = np.linalg.norm(states["position"]["skater"] - centre, axis=1)
    assert np.allclose(radius, 1 / 0.7, atol=1e-13)
    assert found["energy"].expected == "conserved"
    assert found["momentum"].expected == found["symplecticity"].expected == "broken by skate"
    assert found["symplecticity"].final > 0.1


def test_friction_and_another_body() -> None:
    """Without forces the speed falls as exp(−2λt); the other body, without a skate, goes straight on."""
    other = "[[body]]\nmass = 1.0\nposition = [0, 0]\nvelocity = [0.3, 0]\n"
    text = other + SKATER + SKATE + 'body = "skater"\n'
    result, found = run(text + '[[effect]]\nkind = "damping"\nrate = 0.1\nbodies = ["skater"]\n', "volume")
    fallen = np.exp(-0.2 * result.times)
    velocity = named_states(result)["velocity"]
    assert np.allclose(np.hypot(*velocity["skater"].T), fallen, atol=1e-9)
    assert np.allclose(velocity["body1"], [0.3, 0], atol=1e-14)
    assert found["volume"].extra["predicted"] == pytest.approx(np.exp(-1) - 1, abs=1e-12)


def test_only_what_is_called_for() -> None:
    def operations(effects: str) -> int:
        scene = read_scene_text(SKATER + effects)
        return operations_per_step(problem_of(scene.model).value, VERLET, (np.array(scene.q), np.array(scene.p)))

    free, pulled, skating = operations(""), operations(PULL), operations(SKATE)
    assert free < pulled < operations(SKATE + PULL)
    assert free < skating < operations(SKATE + PULL) <= skating + pulled + 20
    assert len(read_scene_text(SKATER).q) == 2
    scene = read_scene_text(SKATER + SKATE)
    assert (len(scene.q), len(scene.p)) == (3, 2)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (SKATER + SKATE + "heading = 0.1\n", "its skate does not move sideways"),
        (SKATER + SKATE + 'body = "sk8er"\n', "there is no body 'sk8er': the bodies are skater"),
        (SKATER + SKATE + "moment = 0\n", "a moment of inertia is above 0"),
        (SKATER.replace("0.5]", "0.5, 0]").replace("0.8]", "0.8, 0]") + SKATE, "a skate runs in a plane"),
        (SKATER + SKATE + '[[effect]]\nkind = "rod"\nlength = 1\n', "together with a skate is not available"),
        ('dynamics = "relativistic"\n' + SKATER + SKATE, "no relativistic dynamics"),
        (scene_text(load_system("skate_on_an_incline")).replace("speed = 0", "q = 0"), "unknown key 'q'"),
    ],
)
def test_bad_input_is_told_from_good(text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert says in str(caught.value)
