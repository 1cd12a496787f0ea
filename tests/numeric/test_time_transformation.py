"""Transformations of time: close approaches at the price of distant ones, times that are met, and what is refused."""

import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon.errors import InputError
from canon.numeric.integrators.blanes_moan import BLANES_MOAN_4
from canon.numeric.integrators.catalogue import METHODS, method
from canon.numeric.integrators.compositions import SOFRONIOU_SPALETTA_10
from canon.numeric.integrators.gauss import GAUSS_6
from canon.numeric.integrators.problem import ExactPart
from canon.numeric.integrators.time_transformation import sundman, sundman_state, weighted, weighted_state
from canon.numeric.precision import double
from canon.numeric.regularise import regularise
from canon.numeric.transformed import integrate_transformed

x, y, px, py, a = sp.symbols("x y p_x p_y a", positive=True)
KEPLER = regularise((px**2 + py**2) / 2, -a / sp.sqrt(x**2 + y**2), (x, y), (px, py), {a: 1.0})
TURN = 2 * np.pi


def ellipse(e: float) -> tuple[np.ndarray, np.ndarray]:
    return np.array([1 - e, 0.0]), np.array([0.0, ((1 + e) / (1 - e)) ** 0.5])


@pytest.mark.parametrize("e", [0.0, 0.6, 0.99])
def test_kepler_orbits_are_exact_but_for_time(e: float) -> None:
    q, p = ellipse(e)
    times = [0.0, 0.3, 1.0, 1.7 * TURN, 100 * TURN]
    run = integrate_transformed(KEPLER.problem, SOFRONIOU_SPALETTA_10, KEPLER.state(q, p), times, step=TURN / 12)
    assert run.completed == len(times)
    assert np.abs(run.states[2] - times).max() < 1e-12
    r = np.hypot(*run.states[0].T)
    ellipses = np.abs(run.states[0][:, 0] * e + r - (1 - e * e))
    assert ellipses.max() < 1e-12
    assert np.abs(run.states[0][-1] - q).max() < 1e-7
    assert run.steps == pytest.approx(1200, abs=3)


def test_its_order_in_time() -> None:
    q, p = ellipse(0.8)
    error = []
    for steps in (40, 80):
        run = integrate_transformed(KEPLER.problem, BLANES_MOAN_4, KEPLER.state(q, p), [0.0, TURN], step=TURN / steps)
        error.append(np.abs(run.states[0][-1] - q).max())
    assert np.log2(error[0] / error[1]) == pytest.approx(4, abs=0.5)


@pytest.mark.slow
def test_weighted_and_sundman_steps() -> None:
    q, p = ellipse(0.9)

    def force(z: jnp.ndarray) -> jnp.ndarray:
        return -z / jnp.sum(z**2, axis=0) ** 1.5

    def weight(z: jnp.ndarray) -> jnp.ndarray:
        return 1 / jnp.sqrt(jnp.sum(z**2, axis=0))

    problem = weighted(lambda v: v, force, weight)
    few, many = (
        np.abs(
            integrate_transformed(
                problem, BLANES_MOAN_4, weighted_state(q, p, 0.0, weight), [0.0, TURN], step=TURN / n
            ).states[0][-1]
            - q
        ).max()
        for n in (100, 200)
    )
    assert np.log2(few / many) == pytest.approx(4, abs=0.5)

    def energy(z: jnp.ndarray, v: jnp.ndarray) -> jnp.ndarray:
        return jnp.sum(v**2, axis=0) / 2 - weight(z)

    slow = sundman(energy, lambda z, v: 1 / weight(z))
    run = integrate_transformed(slow, GAUSS_6, sundman_state(q, p, 0.0, energy), [0.0, TURN], step=TURN / 60)
    assert np.abs(run.states[0][-1] - q).max() < 1e-5
    assert 55 < run.steps < 65


def test_what_is_refused() -> None:
    q, p = ellipse(0.1)
    with pytest.raises(InputError, match="increase"):
        integrate_transformed(KEPLER.problem, BLANES_MOAN_4, KEPLER.state(q, p), [0.0, 0.0], step=0.1)
    with pytest.raises(InputError, match="positive"):
        integrate_transformed(KEPLER.problem, BLANES_MOAN_4, KEPLER.state(q, p), [0.0, 1.0], step=-0.1)
    with pytest.raises(InputError, match="V < 0"):
        regularise(px**2 / 2, 1 / x, (x,), (px,)).state([1.0], [0.0])
    with pytest.raises(InputError, match="T\\(p\\) \\+ V\\(q\\)"):
        regularise(px**2 * x, -1 / x, (x,), (px,))
    short = integrate_transformed(
        KEPLER.problem, BLANES_MOAN_4, KEPLER.state(q, p), [0.0, 1e3], step=0.1, most_steps=10
    )
    assert short.completed == 1


def test_the_catalogue() -> None:
    names = [each.name for each in METHODS]
    assert len({*names}) == len(names) > 35
    assert method("rattle_6").traits.order == 6
    assert all(each.source for each in METHODS)
    with pytest.raises(InputError, match="yoshida6"):
        method("yoshida7")


def test_a_weighted_kick_is_undone_by_one_back() -> None:
    """w changes by the mean of the velocities before and after, without which the leapfrog were not symmetric."""
    kick = weighted(lambda p: p, lambda q: -q, lambda q: 1 + jnp.sum(q * q)).parts[1]
    assert isinstance(kick, ExactPart)
    state = (np.array([0.3, -0.7]), np.array([0.9, 0.4]), np.array(0.2), np.array(1.5))
    with double():
        after = kick.flow(state, 0.4, None)
        back = kick.flow(after, -0.4, None)
    assert abs(float(after[3]) - 1.5) > 0.01
    assert all(np.allclose(x, y, rtol=1e-14) for x, y in zip(back, state, strict=True))
