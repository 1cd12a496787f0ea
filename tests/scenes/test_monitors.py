"""Monitors: what theory conserves is conserved, what friction does is as predicted, what is wrong raises an alarm."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from canon.numeric.integrators.problem import Shear, Splitting
from canon.numeric.integrators.yoshida import YOSHIDA_6
from canon.report.scene_record import scene_record
from canon.report.scene_text import run_lines
from canon.scenes.examples import scene_text
from canon.scenes.monitors import Reading, read_monitors
from canon.scenes.monitors.flow import Flow
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.systems import load_system
from tests.short_scenes import HENON

ALL = ("energy", "symplecticity", "volume", "loop", "cartan", "reversibility")
HENON_HEILES = f"""{HENON}duration = 30.0
samples = 41
"""


def readings(text: str, monitors: tuple[str, ...] = ALL, **settings: Any) -> tuple[Result, dict[str, Reading]]:
    scene = read_scene_text(text)
    result = simulate(replace(scene, settings=replace(scene.settings, monitors=monitors, **settings)))
    return result, {reading.name: reading for reading in result.monitors}


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [None, "gauss6"])
def test_a_hamiltonian_flow_keeps_its_invariants(integrator: str | None) -> None:
    result, found = readings(HENON_HEILES, integrator=integrator)
    assert result.ok, result.messages
    assert {reading.expected for reading in found.values()} == {"conserved"}
    assert found["symplecticity"].max_drift < 1e-11
    assert abs(found["loop"].initial) > 1e-6
    assert found["loop"].max_drift < 1e-14
    assert found["cartan"].max_drift < 1e-13
    assert all(reading.bound is not None for reading in found.values())


@pytest.mark.slow
def test_a_coarse_symplectic_step_keeps_them_and_runge_kutta_does_not() -> None:
    _, verlet = readings(HENON_HEILES, ("symplecticity", "loop"), accuracy=None, step=0.1, integrator="verlet")
    _, rk4 = readings(HENON_HEILES, ("symplecticity", "loop"), accuracy=None, step=0.1, integrator="rk4")
    assert verlet["symplecticity"].max_drift < 1e-11 < 1e-8 < rk4["symplecticity"].max_drift
    assert verlet["loop"].max_drift < 1e-14 < 1e-10 < rk4["loop"].max_drift
    assert not rk4["symplecticity"].alarm
    assert "rk4 is not symplectic" in rk4["symplecticity"].extra["note"]


def test_areas_that_a_method_loses_are_an_alarm_whatever_its_error() -> None:
    """An oscillator, whose step of Runge–Kutta's method multiplies areas by 1 − h⁶/72 + h⁸/576. Hairer, Lubich and
    Wanner (2006), VI.1.
    """
    text = """
[system]
q_names = ["x"]
p_names = ["p"]
H = "(p**2 + x**2)/2"
q = [1.0]
p = [0.0]
[run]
duration = 10.0
step = 0.5
integrator = "rk4"
samples = 2
monitor = ["symplecticity", "volume", "loop"]
"""
    coarse = simulate(read_scene_text(text))
    lost = 1 - (1 - 0.5**6 / 72 + 0.5**8 / 576) ** 20
    symplecticity, volume, loop = coarse.monitors
    assert symplecticity.max_drift == pytest.approx(lost, rel=1e-9)
    assert (volume.final, 1 - loop.final / loop.initial) == pytest.approx((-lost, lost), rel=1e-9)
    assert all("rk4 are too long, and not symplectic" in reading.alarm for reading in coarse.monitors)
    assert not coarse.ok
    assert "alarm" in scene_record(coarse)["monitors"]["volume"]
    assert run_lines(coarse)[-1].startswith("  ! loop")


def damped(rate: float, duration: float = 5.0) -> str:
    text = scene_text(load_system("isotropic_oscillator")).replace("duration = 20.0", f"duration = {duration}")
    return text + f'[[effect]]\nkind = "potential"\nV = "x**2*y/5"\n[[effect]]\nkind = "damping"\nrate = {rate}\n'


@pytest.mark.slow
def test_damping_contracts_as_predicted() -> None:
    result, found = readings(damped(0.1))
    assert result.ok, result.messages
    assert {found[name].expected for name in ALL[:-1]} == {"broken by damping"}
    factor = np.exp(-2 * 0.1 * 5)
    assert np.isclose(found["volume"].final, factor**2 - 1, atol=1e-12)
    assert np.isclose(found["volume"].extra["predicted"], factor**2 - 1, atol=1e-14)
    assert np.isclose(found["loop"].final / found["loop"].initial, factor, atol=1e-9)
    assert np.isclose(found["symplecticity"].final, 1 - factor, atol=1e-12)
    for name in ("volume", "loop", "symplecticity"):
        assert found[name].max_drift <= found[name].bound < 1e-8


@pytest.mark.slow
def test_rayleighs_matrix_contracts_volume_by_its_trace() -> None:
    text = """
[[body]]
mass = 2.0
position = [1.0, 0.0]
velocity = [0.0, 1.0]
[[effect]]
kind = "damping"
matrix = [[0.3, 0.1], [0.1, 0.2]]
[[effect]]
kind = "spring"
k = 1.0
[run]
duration = 4.0
"""
    result, found = readings(text, ("volume", "loop"))
    assert result.ok, result.messages
    assert np.isclose(found["volume"].final, np.exp(-0.5 * 4 / 2) - 1, atol=1e-12)
    assert "predicted" not in found["loop"].extra
    first, last = found["loop"].initial, found["loop"].final
    assert abs(last - first) <= found["loop"].max_drift < abs(first)


@pytest.mark.slow
def test_relativistic_friction_contracts_volume_along_the_orbit() -> None:
    text = """
dynamics = "relativistic"
[[body]]
mass = 1.0
position = [0.0]
momentum = [2.0]
[[effect]]
kind = "damping"
rate = 0.2
[run]
duration = 3.0
samples = 401
"""
    result, found = readings(text, ("volume",))
    assert result.ok, result.messages
    assert found["volume"].extra["predicted"] < -0.05
    assert found["volume"].max_drift < 1e-6


@pytest.mark.slow
def test_a_flow_that_is_not_hamiltonian_raises_the_alarm() -> None:
    """The same model, but its steps get a force that is in no Hamiltonian: every monitor sees it."""
    result, _ = readings(HENON_HEILES, ())

    def wrong(state: Any, t: Any) -> tuple[Any]:
        x, y = state[0]
        return ((-x - 2 * x * y + 1e-5 * y, -y - x**2 + y**2),)

    import jax.numpy as jnp

    kick = Shear((1,), lambda state, t: (jnp.stack(wrong(state, t)[0]),), "V")
    drift = Shear((0,), lambda state, t: (state[1],), "T")
    problem = Splitting((drift, kick), None, True)
    from canon.numeric.integrate import integrate

    start = (np.array(result.scene.q), np.array(result.scene.p))
    run = integrate(problem, YOSHIDA_6, start, duration=30.0, steps=1200, samples=41)
    flow = Flow(result.scene.model, problem, YOSHIDA_6, run, run.completed, 1e-12)
    q, p = (np.asarray(slot) for slot in run.states)
    found = {reading.name: reading for reading in read_monitors(ALL, flow, run.times, q, p)}
    assert all(found[name].alarm for name in ("energy", "symplecticity", "loop", "cartan"))
    assert not found["volume"].alarm
    assert not found["reversibility"].alarm


def test_effects_are_named_that_break_a_monitor() -> None:
    text = """
[[body]]
mass = 1.0
position = [0.5, 0.0]
velocity = [0.0, 1.3]
[[effect]]
kind = "inverse_distance"
a = 1.0
[[effect]]
kind = "inverse_square"
c = 0.01
[[effect]]
kind = "driving"
force = ["cos(t)/10", 0]
[run]
duration = 2.0
"""
    result, found = readings(text, ("energy", "momentum", "angular_momentum", "lrl"))
    assert result.ok, result.messages
    assert found["energy"].expected == "broken by driving"
    assert found["momentum"].expected == "broken by inverse_distance, inverse_square, driving"
    assert found["angular_momentum"].expected == "broken by driving"
    assert found["lrl"].expected == "broken by inverse_square, driving"


@pytest.mark.slow
def test_a_loop_that_is_torn_is_said_to_be() -> None:
    """A hyperbolic motion stretches any loop by e^30."""
    text = HENON_HEILES.replace("(x**2 + y**2)/2 + x**2*y - y**3/3", "(x**2 + y**2)/2*(-1) + x**4").replace(
        "0.5, 0.0", "0.1, 0.0"
    )
    _, found = readings(text.replace("30.0", "60.0"), ("loop",), accuracy=None, step=0.05)
    loop = found["loop"]
    assert loop.final is None
    assert "no longer resolve" in loop.extra["note"]
    assert 5 < loop.extra["resolved_until"] < 40
    assert loop.max_drift <= loop.bound < abs(loop.initial)


def test_a_run_of_whose_error_nothing_is_known_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of the budget is to be left for the monitors: there is no second run to compare the first one with."""
    monkeypatch.setattr("canon.scenes.simulate.price", lambda *_: lambda seconds: 1e6)
    scene = read_scene_text(scene_text(load_system("harmonic_oscillator")))
    found = simulate(replace(scene, settings=replace(scene.settings, accuracy=None, budget=20.0, monitors=())))
    assert len(found.planned.trials) == 1
    assert found.planned.error is None
    assert not found.ok
    assert found.messages == ("the budget left time for a single run: nothing is known of its error",)


@pytest.mark.slow
def test_friction_in_every_step_is_rounded_alike() -> None:
    """The factors' roundings add up over the steps: that is no alarm."""
    text = """
[[body]]
mass = 1.0
charge = 1.0
position = [1.0, 0.0]
velocity = [0.0, 0.5]
[[effect]]
kind = "magnetic_field"
B = 1.0
[[effect]]
kind = "damping"
rate = 0.1
[run]
duration = 5.0
monitor = ["volume"]
"""
    result = simulate(read_scene_text(text))
    assert result.ok, result.messages
    (volume,) = result.monitors
    assert volume.bound is not None
    assert volume.bound < 1e-10
    assert volume.final == pytest.approx(np.exp(-2 * 2 * 0.1 * 5) - 1, rel=1e-10)


CHAOS = """
[system]
q_names = ["x", "y"]
p_names = ["px", "py"]
H = "(px**2 + py**2)/2 + (x**2 + y**2)/2 + x**2*y - y**3/3"
"""


def test_a_bound_that_would_pass_anything_is_none() -> None:
    """In chaotic motion the estimated error makes no ✓ of a loop: splittings keep it without, and others say so."""
    started = "q = [0.0, -0.1]\np = [0.57, 0.05]\n"
    chaotic = CHAOS + started + '[run]\nduration = 30.0\nstep = 0.15\nsamples = 11\nmonitor = ["loop", "cartan"]\n'
    loop, cartan = simulate(read_scene_text(chaotic)).monitors
    for reading in (loop, cartan):
        assert not reading.alarm
        assert reading.bound is None or reading.bound < abs(reading.initial)
    assert loop.bound is not None
    assert loop.max_drift < 1e-6 * abs(loop.initial)


@pytest.mark.slow
def test_what_is_beyond_double_precision_costs_its_own_reading_alone() -> None:
    """Of a body at 1e308 the tangent map isn't finite, nor is the bound of the Lenz vector's drift: no alarm."""
    text = """
[[body]]
mass = 1
position = [1e308, 0]
velocity = [0, 1]
[[effect]]
kind = "inverse_distance"
a = 1
[run]
duration = 1
step = 0.1
samples = 3
"""
    result, found = readings(text, ("energy", "lrl", "symplecticity", "volume"), accuracy=None)
    assert not any(reading.alarm for reading in found.values())
    assert (found["energy"].max_drift, found["lrl"].bound) == (0, None)
    for name in ("symplecticity", "volume"):
        assert (found[name].expected, found[name].bound) == ("unknown", None)
        assert "beyond double precision" in found[name].extra["note"]
    assert scene_record(result)["monitors"]["volume"]["expected"] == "unknown"
