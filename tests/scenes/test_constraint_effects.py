"""Constraints with friction, magnetic fields, frames and relativity; the form that a flow keeps on a surface."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from canon.scenes.examples import scene_text
from canon.scenes.monitors import Reading
from canon.scenes.monitors.predicted import conformal_rate, volume_exponent
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.systems import load_system

BOB = """
[[body]]
name = "bob"
mass = 2.0
charge = 1.5
position = [1.2, -1.6]
velocity = [0.4, 0.3]
[[effect]]
kind = "uniform_gravity"
g = 9.81
[[effect]]
kind = "rod"
length = 2.0
[run]
duration = 2.0
samples = 21
"""
FIELD = '[[effect]]\nkind = "magnetic_field"\nB = 3.0\n'
DAMPING = '[[effect]]\nkind = "damping"\nrate = 0.1\n'
FLOW = ("energy", "symplecticity", "volume", "cartan")


def run(text: str, *monitors: str) -> tuple[Result, dict[str, Reading]]:
    scene = read_scene_text(text)
    result = simulate(replace(scene, settings=replace(scene.settings, monitors=monitors)))
    assert result.ok, result.messages
    return result, {reading.name: reading for reading in result.monitors}


def system(name: str, parameters: str, q: str, p: str) -> str:
    text = scene_text(load_system(name))
    lines = f"parameters = {{ {parameters} }}\nq = [{q}]\np = [{p}]\n[run]\nduration = 2.0\nsamples = 21\n"
    return text[: text.index("parameters")] + lines


@pytest.mark.slow
def test_a_magnetic_field_across_the_plane_pulls_along_the_rod_alone() -> None:
    """The pendulum moves as without it; its momentum is another, and the form on the surface is kept to rounding."""
    result, found = run(BOB + FIELD, *FLOW)
    angle = simulate(read_scene_text(system("pendulum", "m = 2.0, g = 9.81, R = 2.0", '"atan2(1.2, 1.6)"', "2.0")))
    assert np.allclose(result.q[:, 0], 2 * np.sin(angle.q[:, 0]), atol=2e-8)
    assert {reading.expected for reading in found.values()} == {"conserved"}
    assert found["symplecticity"].max_drift < 1e-12
    assert found["cartan"].max_drift < 1e-12
    assert abs(found["cartan"].initial) > 1e-4


@pytest.mark.slow
def test_friction_contracts_the_form_as_predicted() -> None:
    result, found = run(BOB + DAMPING, "symplecticity", "volume", "loop", "energy")
    text = system("pendulum", "m = 2.0, g = 9.81, R = 2.0", '"atan2(1.2, 1.6)"', "2.0") + DAMPING
    assert np.allclose(result.q[:, 0], 2 * np.sin(simulate(read_scene_text(text)).q[:, 0]), atol=2e-8)
    factor = np.exp(-0.4)
    assert found["volume"].final == pytest.approx(factor - 1, abs=1e-12)
    assert found["symplecticity"].max_drift < 1e-12
    assert found["loop"].final / found["loop"].initial == pytest.approx(factor, abs=1e-9)
    assert {reading.expected for reading in found.values()} == {"broken by damping"}


def test_friction_that_differs_from_place_to_place() -> None:
    """With Rayleigh's matrix diag(α, 0) on a circle the volume goes as exp −∫ (α/m) cos²θ dt."""
    matrix = '[[effect]]\nkind = "damping"\nmatrix = [[0.8, 0], [0, 0]]\n'
    result, found = run(BOB.replace("samples = 21", "samples = 401") + matrix, "volume", "constraint")
    along = (result.q[:, 1] / 2) ** 2
    exponent = -0.4 * ((along[1:] + along[:-1]) / 2 * np.diff(result.times)).sum()
    assert found["volume"].final == pytest.approx(np.expm1(exponent), abs=1e-5)
    assert found["volume"].max_drift < 1e-7
    assert found["constraint"].max_drift < 1e-13


def test_the_bead_on_a_rotating_hoop() -> None:
    """S09: a circle in a plane of the rotating frame."""
    text = """
[[body]]
mass = 1.0
position = [0.6, 0, -0.8]
[[effect]]
kind = "uniform_gravity"
g = 9.81
[[effect]]
kind = "rod"
length = 1.0
[[effect]]
kind = "surface"
equation = "y"
[[effect]]
kind = "rotating_frame"
Omega = 4.0
[run]
duration = 2.0
samples = 21
"""
    result, found = run(text, "energy", "constraint")
    hoop = simulate(
        read_scene_text(system("rotating_hoop", "m = 1.0, g = 9.81, R = 1.0, Omega = 4.0", '"atan2(0.6, 0.8)"', "0"))
    )
    assert np.allclose(result.q[:, 0], np.sin(hoop.q[:, 0]), atol=1e-8)
    assert found["energy"].expected == "conserved"


@pytest.mark.slow
def test_a_relativistic_charge_on_a_circle() -> None:
    """No force along the circle: v is constant, whatever the field across; p is γ m v + q A."""
    text = """
dynamics = "relativistic"
constants = { c = 2.0 }
[[body]]
mass = 1.0
charge = 1.0
position = [1.0, 0]
velocity = [0, 1.5]
[[effect]]
kind = "rod"
length = 1.0
[run]
duration = 3.0
samples = 31
"""
    result, found = run(text + FIELD, "symplecticity")
    assert np.allclose(result.q[:, 0], np.cos(1.5 * result.times), atol=1e-8)
    gamma = 1 / np.sqrt(1 - (1.5 / 2) ** 2)
    momentum = result.q[:, 0] * result.p[:, 1] - result.q[:, 1] * result.p[:, 0]
    assert np.allclose(momentum, 1.5 * gamma + 3.0 / 2, atol=1e-9)
    assert found["symplecticity"].max_drift < 1e-12


@pytest.mark.slow
def test_friction_on_a_line_that_turns() -> None:
    """r̈ = Ω²r − 2λṙ: the friction along the line; that across it is the line's business."""
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
samples = 7
"""
    result, found = run(text + DAMPING.replace("0.1", "0.5"), "volume", "loop")
    root = np.sqrt(4.25)
    up, down = -0.5 + root, -0.5 - root
    exact = (-down * np.exp(up * result.times) + up * np.exp(down * result.times)) / (up - down)
    assert np.allclose(np.hypot(*result.q.T), exact, rtol=1e-8)
    assert found["volume"].final == pytest.approx(np.exp(-1.5) - 1, abs=1e-10)
    assert found["loop"].final / found["loop"].initial == pytest.approx(np.exp(-1.5), abs=1e-8)


DRAGGED = """
[[body]]
mass = 1.0
charge = 1.0
position = [0.6, 0.0, -0.8]
velocity = [0.0, 0.7, 0.0]

[[effect]]
kind = "rod"
length = 1.0

[[effect]]
kind = "magnetic_field"
B = 0.5

[[effect]]
kind = "damping"
rate = 0.05
"""


def test_friction_on_a_sphere_in_a_magnetic_field_contracts_phase_volume() -> None:
    """det M = exp(−2 λ t · 2), of the two degrees of freedom that a sphere leaves: B is of no importance to it."""
    model = read_scene_text(DRAGGED + "[run]\nduration = 5.0\n").model
    flow: Any = SimpleNamespace(model=model)
    exponent, off = volume_exponent(flow, np.linspace(0, 5, 3), np.zeros((3, 3)), np.zeros((3, 3)))
    assert exponent == pytest.approx(-2 * 0.05 * 5 * 2)
    assert off == 0
    assert conformal_rate(model) is None, "a loop's integral of the canonical momenta decays otherwise"


@pytest.mark.slow
def test_and_its_volume_is_found_so() -> None:
    run = '[run]\nduration = 1.0\naccuracy = 1e-5\nsamples = 5\nmonitor = ["volume"]\n'
    result = simulate(read_scene_text(DRAGGED + run))
    assert result.ok, result.messages
    assert 1 + float(result.monitors[0].final) == pytest.approx(np.exp(-0.2), rel=1e-9)


ON_A_TABLE = """
[[body]]
mass = 2.0
position = [0.0, 0.0, 0.0]
velocity = [1.0, 0.5, 0.0]

[[effect]]
kind = "surface"
equation = "z"

[run]
duration = 2.0
step = 0.25
samples = 5
monitor = []
integrator = "rattle"
"""


def test_on_a_table_forces_act_when_they_are_given_and_friction_as_long_as_a_step() -> None:
    """ṗ = t gives t²/2, and −2λp the factor exp(−2λt), both without any error of the method."""
    driven = simulate(read_scene_text(ON_A_TABLE + '[[effect]]\nkind = "driving"\nforce = ["t", "0", "0"]\n'))
    assert np.allclose(driven.p[:, 0], 2 + driven.times**2 / 2, rtol=1e-13)
    slowed = simulate(read_scene_text(ON_A_TABLE + '[[effect]]\nkind = "damping"\nrate = 0.3\n'))
    assert np.allclose(slowed.p[:, 1], np.exp(-0.6 * slowed.times), rtol=1e-13)
