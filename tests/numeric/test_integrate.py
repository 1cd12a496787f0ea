"""The engine: samples, times, resuming bit for bit, what ends a run, and the minimal program."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError
from canon.numeric.integrate import advance, flow_map, integrate, pieces, start
from canon.numeric.integrators import ExactPart, Field, Splitting, separable
from canon.numeric.integrators.catalogue import METHODS
from canon.numeric.integrators.yoshida import VERLET, YOSHIDA_4, YOSHIDA_6
from canon.numeric.precision import double

PENDULUM = separable(lambda p: p, lambda q: -jnp.sin(q))
STATE = (np.array([1.0]), np.array([0.3]))


def energy(states: tuple[np.ndarray, ...]) -> np.ndarray:
    return states[1] ** 2 / 2 - np.cos(states[0])


def test_samples_are_equidistant_and_steps_are_rounded_up() -> None:
    run = integrate(PENDULUM, YOSHIDA_4, STATE, duration=7.0, steps=10, samples=5)
    assert run.steps == 12
    assert run.step == 7 / 12
    assert np.array_equal(run.times, [0.0, 1.75, 3.5, 5.25, 7.0])
    assert run.states[0].shape == (5, 1)
    assert run.completed == 5
    assert np.array_equal(run.states[0][0], STATE[0])
    half = integrate(PENDULUM, YOSHIDA_4, STATE, duration=3.5, steps=6)
    assert np.allclose(half.state[0], run.states[0][2], rtol=1e-14)


def test_resumed_runs_have_every_bit() -> None:
    keywords = {"duration": 500.0, "steps": 210_000, "samples": 3, "compensated": True}
    whole = integrate(PENDULUM, VERLET, STATE, **keywords)
    run = start(PENDULUM, VERLET, STATE, **keywords)
    seen = [run := piece for piece in pieces(PENDULUM, VERLET, run)]
    assert len(seen) == whole.chunks == 4
    assert [piece.completed for piece in seen] == [1, 2, 2, 3]
    for a, b in zip(jax.tree.leaves(run.stored), jax.tree.leaves(whole.stored), strict=True):
        assert np.array_equal(np.asarray(a), np.asarray(b))
    assert advance(PENDULUM, VERLET, run).done == run.done


def test_compensation_keeps_the_energy_over_long_runs() -> None:
    keywords = {"duration": 3000.0, "steps": 300_000}
    initial = energy(STATE)
    plain = abs(energy(integrate(PENDULUM, YOSHIDA_6, STATE, compensated=False, **keywords).state) - initial)
    kept = abs(energy(integrate(PENDULUM, YOSHIDA_6, STATE, compensated=True, **keywords).state) - initial)
    assert kept < 2e-15
    assert plain > 4 * kept


def test_many_orbits_at_once_are_the_single_ones() -> None:
    q, p = np.linspace(0.1, 2, 5), np.linspace(0, 0.4, 5)
    run = integrate(PENDULUM, YOSHIDA_6, (q[None], p[None]), duration=3.0, steps=30, batched=True)
    one = integrate(PENDULUM, YOSHIDA_6, (q[3:4], p[3:4]), duration=3.0, steps=30)
    assert np.allclose(run.state[0][0, 3], one.state[0][0], rtol=1e-14)


def test_a_run_ends_at_its_last_good_state() -> None:
    blow_up = separable(lambda p: p, lambda q: q**3)
    run = integrate(blow_up, VERLET, (np.array([3.0]), np.array([9.0])), duration=10.0, steps=2000, samples=101)
    assert run.ended
    assert 1 < run.completed < 20
    assert np.isfinite(run.states[0]).all()
    both = (np.array([[3.0, 0.0]]), np.array([[9.0, 0.0]]))
    run = integrate(blow_up, VERLET, both, duration=10.0, steps=2000, samples=101, batched=True)
    assert run.completed == 101
    assert np.isfinite(run.states[0][:, 0, 1]).any()
    assert not np.isfinite(run.state[0][0, 0])


def test_time_dependence_keeps_the_order_and_costs_nothing_when_absent() -> None:
    """q̈ = cos 2t from rest is −cos(2t)/4 + 1/4."""
    driven = separable(lambda p: p, lambda q, t: jnp.cos(2 * t) + 0 * q, time_dependent=True)
    state = (np.array([0.0]), np.array([0.0]))
    errors = [
        abs(integrate(driven, YOSHIDA_4, state, duration=3.0, steps=n, t0=0.5).state[0][0] - exact)
        for n in (40, 80)
        for exact in [-np.cos(7.0) / 4 + np.cos(1.0) / 4 - 3 * np.sin(1.0) / 2]
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.2)
    with double():
        step = str(jax.make_jaxpr(flow_map(PENDULUM, YOSHIDA_4, steps=1, h=0.1))(STATE))
        timed = str(jax.make_jaxpr(flow_map(driven, YOSHIDA_4, steps=1, h=0.1))(STATE))
    assert step.count(" sin ") == 1
    assert "cos" not in step
    assert timed.count(" mul ") > step.count(" mul ")


def test_more_than_two_parts_and_exact_parts() -> None:
    """A pendulum with its gravity cut in two, one of them with a rotation as an exact part: the order stays."""

    def rotate(state: tuple, angle: tuple, t: float) -> tuple:
        (q, p), (c, s) = state, angle
        return c * q + s * p, c * p - s * q

    oscillator = ExactPart(rotate, lambda h: (jnp.cos(h), jnp.sin(h)))
    kicks = separable(lambda p: 0.3 * p, lambda q: -jnp.sin(q))
    problem = Splitting((*kicks.parts, oscillator))
    ends = [integrate(problem, YOSHIDA_4, STATE, duration=2.0, steps=n).state[0] for n in (20, 40, 1280)]
    assert np.log2(abs(ends[0] - ends[2]) / abs(ends[1] - ends[2])) == pytest.approx(4, abs=0.3)


def test_what_cannot_be_run_is_an_input_error() -> None:
    with pytest.raises(InputError, match="split into solvable parts"):
        integrate(Field(lambda state, t: state), VERLET, STATE, duration=1.0, steps=1)
    with pytest.raises(InputError, match="samples: a whole number is needed, at least 2"):
        integrate(PENDULUM, VERLET, STATE, duration=1.0, steps=1, samples=1)


def test_the_energy_walks_and_does_not_drift_where_products_round_with_a_bias():
    """Steps of 1/20: what rounding takes from h·p has a mean that isn't 0, 3e-14 of the energy in a million steps."""
    angles = np.linspace(0.1, 6.2, 64)
    start = (np.cos(angles), np.sin(angles))
    oscillators = separable(lambda p: p, lambda q: -q)
    run = integrate(oscillators, VERLET, start, duration=0.05 * 1e6, steps=1_000_000, compensated=True)
    q, p = (np.longdouble(np.asarray(slot)) for slot in run.states)
    energy = q * q + (1 - np.longdouble(run.step) ** 2 / 4) * p * p
    drift = np.asarray((energy[-1] - energy[0]) / energy[0], dtype=float)
    assert abs(drift.mean()) < 3e-15
    assert np.sqrt(np.mean(drift**2)) < 8e-15


@pytest.mark.parametrize("name", ["verlet", "nystrom6", "gauss6"])
def test_every_step_is_made_at_its_own_time(name: str) -> None:
    """ṗ = t from t0, in several chunks and samples: p gains (t² − t0²)/2, without any error of the method."""
    method = next(each for each in METHODS if each.name == name)
    pushed = separable(lambda p: p, lambda q, t: t + 0 * q, time_dependent=True)
    run = integrate(pushed, method, (np.zeros(1), np.ones(1)), duration=3.0, steps=12, samples=4, t0=1.5)
    p = run.states[1][:, 0]
    assert np.allclose(p, 1 + (run.times**2 - 1.5**2) / 2, rtol=1e-14)
    if name == "gauss6":
        cubic = separable(lambda p: p, lambda q, t: t**3 + 0 * q, time_dependent=True)
        end = integrate(cubic, method, (np.zeros(1), np.ones(1)), duration=3.0, steps=3, t0=1.5).state
        assert end[1][0] == pytest.approx(1 + (4.5**4 - 1.5**4) / 4, rel=1e-14)
