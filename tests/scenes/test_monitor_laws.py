"""What monitors compute, held against formulas: their drifts, bounds and where loops are carried to."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from canon.scenes.monitors.conserved import SAFETY, breakers, drift_bound
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.loop import _error_slack
from canon.scenes.monitors.predicted import volume_exponent
from canon.scenes.problem import constrained_problem
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate

FALL = """
[system]
q_names = ["x", "y"]
p_names = ["px", "py"]
H = "(px**2 + py**2)/2 + x + y**2/2"
q = [0.0, 1.0]
p = [0.5, 2.0]
[run]
duration = 3.0
step = 0.25
integrator = "verlet"
samples = 7
monitor = ["energy"]
"""
THROWN = """
[[body]]
mass = 2.0
position = [0.0, 0.0]
velocity = [3.0, 4.0]
[[effect]]
kind = "uniform_gravity"
g = [3.0, 4.0]
[run]
duration = 2.0
samples = 5
monitor = ["momentum"]
"""


@pytest.fixture(scope="module")
def fall() -> Result:
    return simulate(read_scene_text(FALL))


def flow_of(result: Result, error: float | None = 1e-6) -> Flow:
    planned = result.planned
    return Flow(result.scene.model, result.problem.value, result.choice.method, planned.run, planned.good, error)


def test_a_drift_is_the_length_of_what_a_vector_changed_by() -> None:
    (momentum,) = simulate(read_scene_text(THROWN)).monitors
    assert momentum.expected == "broken by uniform_gravity"
    assert momentum.max_drift == pytest.approx(2 * 5 * 2, rel=1e-12)


def test_a_force_of_one_breaks_the_momentum(fall: Result) -> None:
    """{p_x, H} = −1: a number that needs no orbit to be looked at."""
    model = fall.scene.model
    px, py = model.p
    y = model.q[1]
    (effect,) = model.effects
    assert breakers((px,), model, fall.q, fall.p) == (effect,)
    assert breakers((-px,), model, fall.q, fall.p) == (effect,)
    assert breakers((py**2 + y**2,), model, fall.q, fall.p) == ()


def test_the_bound_of_a_drift_is_what_the_error_and_rounding_make_of_it(fall: Result) -> None:
    px, py = fall.scene.model.p
    largest = np.abs(fall.p).max()
    for error in (1e-6, 1e-3):
        flow = flow_of(fall, error)
        assert flow.steps == 12
        found = drift_bound((px,), flow, fall.times, fall.q, fall.p, fall.p.T[:1])
        rounding = np.abs(fall.p[:, 0]).max() * 1e-15 * np.sqrt(12)
        assert found == pytest.approx(SAFETY * (error * largest + rounding), rel=1e-12)
    plain = flow_of(fall, 0.0)
    found = drift_bound((py,), plain, fall.times, fall.q, fall.p, fall.p.T[1:])
    assert found == pytest.approx(SAFETY * np.abs(fall.p[:, 1]).max() * 1e-15 * np.sqrt(12), rel=1e-12, abs=0)
    assert drift_bound((px,), flow_of(fall, None), fall.times, fall.q, fall.p, fall.p.T) is None


def test_loops_are_carried_to_the_end_of_the_run(fall: Result) -> None:
    states = np.hstack([fall.q, fall.p])
    carried = flow_of(fall).neighbours.along(np.stack([states[0], states[0] + [1.0, 0.0, 0.0, 0.0]]), 2)[-1]
    assert np.allclose(carried[0], states[-1], rtol=0, atol=1e-13)
    assert np.allclose(carried[1], states[-1] + [1.0, 0.0, 0.0, 0.0], rtol=0, atol=1e-13)


def test_what_errors_make_of_a_loop_grows_with_it(fall: Result) -> None:
    """A loop's area has its size twice; steps that keep no area have the momenta's size in their errors, too."""
    angle = 2 * np.pi * np.arange(64) / 64
    loop = np.stack([np.cos(angle), 0 * angle, np.sin(angle), 0 * angle], axis=1)
    flow = flow_of(fall)
    one = _error_slack(flow, loop)
    # a circle: around it is 4 in each coordinate, and across it is 2
    assert one == pytest.approx(20 * 1e-6 * (4 * 2 + 4 * 2), rel=1e-2)
    assert _error_slack(flow, 3 * loop) == pytest.approx(9 * one, rel=1e-12)
    assert _error_slack(replace(flow, error=2e-6), loop) == pytest.approx(2 * one, rel=1e-12)
    traits = replace(flow.method.traits, symplectic=False)
    other = _error_slack(replace(flow, method=replace(flow.method, traits=traits)), loop)
    assert other == pytest.approx(20 * 1e-6 * (4 * 2 + 4 * 2 + 4 * 1), rel=1e-2)


def test_nothing_is_said_of_an_error_that_is_not_known(fall: Result) -> None:
    loop = np.eye(4)
    assert _error_slack(flow_of(fall, None), loop) == np.inf


HELD = """
[[body]]
mass = 2.0
charge = 1.0
position = [0.6, -0.8]
velocity = [0.0, 0.0]
{second}
[[effect]]
kind = "rod"
{ends}
[[effect]]
kind = "damping"
{damping}
{more}
[run]
duration = 1.0
"""
SECOND = "[[body]]\nmass = 1.0\nposition = [0.6, 0.2]\nvelocity = [0.0, 0.0]\n"
FIELD = '[[effect]]\nkind = "magnetic_field"\nB = 0.7\n'


def exponent(text: str, times: np.ndarray) -> tuple[float, float]:
    """∫ tr ∂F/∂p dt on the surface, for bodies that rest where they begin."""
    scene = read_scene_text(text)
    flow: Any = SimpleNamespace(model=scene.model, problem=constrained_problem(scene.model).value)
    places = np.broadcast_to(np.array(scene.q, dtype=float), (len(times), len(scene.q)))
    return volume_exponent(flow, times, places, 0 * places)


@pytest.mark.parametrize("more", ["", FIELD])
def test_one_rate_contracts_the_volume_of_what_is_free(more: str) -> None:
    """A rod from an anchor leaves one of two coordinates; a vector potential changes nothing of it."""
    times = np.linspace(1.0, 4.0, 5)
    held = HELD.format(second="", ends="length = 1.0", damping="rate = 0.1", more=more)
    assert exponent(held, times) == (pytest.approx(-2 * 0.1 * 1 * 3.0), 0.0)
    pair = HELD.format(second=SECOND, ends='bodies = ["body1", "body2"]\nlength = 1.0', damping="rate = 0.1", more="")
    assert exponent(pair, times) == (pytest.approx(-2 * 0.1 * 3 * 3.0), 0.0)


def test_a_matrix_contracts_the_volume_along_the_surface() -> None:
    """The body hangs at (0.6, −0.8) and can move along (0.8, 0.6): −α there, by its mass."""
    matrix = "matrix = [[0.3, 0.1], [0.1, 0.5]]"
    found, off = exponent(
        HELD.format(second="", ends="length = 1.0", damping=matrix, more=""), np.linspace(1.0, 4.0, 5)
    )
    assert found == pytest.approx(-3.0 * (0.3 * 0.64 + 2 * 0.1 * 0.48 + 0.5 * 0.36) / 2.0, rel=1e-12)
    assert off < 1e-12


def test_a_rod_breaks_the_momentum_and_not_the_energy() -> None:
    model = read_scene_text(HELD.format(second="", ends="length = 1.0", damping="rate = 0.1", more="")).model
    q, p = np.array([[0.6, -0.8], [0.8, 0.6]]), np.array([[0.4, 0.3], [-0.3, 0.4]])
    assert breakers((model.H,), model, q, p) == ("damping",)
    assert breakers((model.p[0],), model, q, p) == ("damping", "rod")
