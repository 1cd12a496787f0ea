"""Poincaré's absolute invariants of every order along a scene's flow: kept, and broken by as much as theory says."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.pfaffians import powers
from canon.scenes.absolute_invariants import absolute_invariants, run_map
from canon.scenes.monitors.tangent import order_drifts
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from tests.short_scenes import HENON

CHAOS = f"""{HENON}duration = 20.0
samples = 11
monitor = ["symplecticity"]
"""
SPRINGS = """
[system]
q_names = ["x", "y"]
p_names = ["px", "py"]
H = "(px**2 + py**2)/2 + 5*x**2/4 + 5*y**2/4 + 3*x*y/2"
q = [1.0, 0.5]
p = [0.5, 0.2]
[run]
duration = 5.0
step = 0.25
integrator = "rk4"
samples = 3
monitor = ["symplecticity", "volume"]
"""
FREE = """
[[body]]
mass = 1.0
position = [1.0, 0.3, 0.2]
velocity = [0.5, 1.0, 0.7]
[[effect]]
kind = "damping"
{damping}
[run]
duration = 2.0
samples = 11
monitor = ["symplecticity", "volume"]
"""


def run_of(text: str) -> Result:
    return simulate(read_scene_text(text))


def drifts(result: Result) -> list[float]:
    return [each["max_drift"] for each in result.monitors[0].extra["orders"]]


@pytest.fixture(scope="module")
def henon() -> Result:
    return run_of(CHAOS)


def test_a_hamiltonian_flow_keeps_every_order(henon: Result) -> None:
    orders = henon.monitors[0].extra["orders"]
    assert [each["order"] for each in orders] == [1, 2]
    assert orders[0]["max_drift"] == henon.monitors[0].max_drift
    assert all(each["max_drift"] <= each["bound"] < 1e-10 for each in orders)
    for found, size in zip(absolute_invariants(henon), (1e-6, 1e-11), strict=True):
        assert found.preserved, str(found)
        assert abs(found.before) > size > 1e6 * found.bound


def test_the_map_is_the_run(henon: Result) -> None:
    states = np.hstack([henon.q, henon.p])
    after = run_map(henon)
    assert np.allclose(after(states[0]), states[-1], rtol=0, atol=1e-13)
    many = after(np.vstack([states[:1]] * 300))  # more than one block
    assert many.shape == (300, 4)
    assert np.allclose(many, states[-1], rtol=0, atol=1e-13)


def test_what_runge_kutta_makes_of_each_order() -> None:
    """A step of length h multiplies the areas of an oscillator's plane by 1 − (hω)⁶/72 + (hω)⁸/576; here ω is 1 and 2,
    in planes turned by 45°. Hairer, Lubich and Wanner (2006), VI.1.
    """
    result = run_of(SPRINGS)
    slow, fast = ((1 - x**6 / 72 + x**8 / 576) ** 20 for x in (0.25, 0.5))
    # M J Mᵀ has (slow + fast)/2 in both planes, and (slow − fast)/2 between them
    assert drifts(result) == pytest.approx([1 - (slow + fast) / 2, 1 - slow * fast], rel=1e-8)

    def turned(u: np.ndarray) -> np.ndarray:
        x, p = (np.multiply.outer(c - 0.5, [1.0, -1.0]) / np.sqrt(2) for c in u.T)
        return np.hstack([x, p])

    (area,) = absolute_invariants(result, surface=turned, periodic=(False, False))
    assert area.preserved is False
    assert area.after / area.before == pytest.approx(slow, rel=1e-10)
    _, volume = absolute_invariants(result)
    assert volume.preserved is False
    assert volume.after / volume.before == pytest.approx(slow * fast, rel=1e-9)


def test_orders_that_volume_does_not_see() -> None:
    """Friction along x, and as much of the other sign along y: phase volume is kept, no other order is."""
    result = run_of(FREE.format(damping="matrix = [[0.3, 0.0, 0.0], [0.0, -0.3, 0.0], [0.0, 0.0, 0.0]]"))
    one, more = 1 - np.exp(-0.6), np.exp(0.6) - 1
    assert drifts(result) == pytest.approx([more, more, 0.0], abs=1e-11)
    assert more > one
    assert all(each["bound"] is None for each in result.monitors[0].extra["orders"])
    assert abs(result.monitors[1].final) < 1e-11
    with pytest.raises(InputError, match="several rates"):
        absolute_invariants(result)


def test_one_rate_contracts_order_k_by_its_kth_power() -> None:
    result = run_of(FREE.format(damping="rate = 0.1"))
    assert all(each["max_drift"] <= each["bound"] < 1e-10 for each in result.monitors[0].extra["orders"])
    for order, found in enumerate(absolute_invariants(result, [1, 2, 3]), 1):
        assert found.preserved, str(found)
        assert found.after / found.before == pytest.approx(np.exp(-2 * 0.1 * 2 * order), rel=1e-7)
        assert found.bound < 1e-6 * abs(found.before)


def test_surfaces_that_are_stretched_too_far_are_said_to_be() -> None:
    result = run_of(CHAOS.replace("20.0", "150.0").replace('"symplecticity"', "").replace("[0.5, 0.0]", "[0.55, 0.1]"))
    (found,) = absolute_invariants(result, [1], most_points=256)
    assert found.preserved is None
    assert "not resolved" in str(found)


def test_powers_are_pfaffians() -> None:
    random = np.random.default_rng(3)
    A = random.standard_normal((6, 6))
    A -= A.T
    found = powers(A)
    for order, (values, bounds) in enumerate(found, 1):
        for S, value, bound in zip(combinations(range(6), 2 * order), values, bounds, strict=True):
            assert value**2 == pytest.approx(np.linalg.det(A[np.ix_(S, S)]), rel=1e-10)
            assert 0 <= bound < 1e-12
    (pf,) = found[1][0][:1]
    assert pf == pytest.approx(A[0, 1] * A[2, 3] - A[0, 2] * A[1, 3] + A[0, 3] * A[1, 2])


def test_odd_and_large_matrices_have_no_orders() -> None:
    assert order_drifts(np.zeros((3, 3)), np.zeros((3, 3)), 0.0) == {}
    assert order_drifts(np.zeros((10, 10)), np.zeros((10, 10)), 0.0) == {}
    (one,) = order_drifts(np.array([[0.0, 3.0], [-3.0, 0.0]]), np.array([[0.0, 1.0], [-1.0, 0.0]]), 0.5)["orders"]
    assert one == {"order": 1, "max_drift": 2.0, "bound": pytest.approx(0.5, rel=1e-12)}


def test_what_has_no_surfaces_is_said(henon: Result) -> None:
    with pytest.raises(InputError, match="1 to 2"):
        absolute_invariants(henon, [3])
    with pytest.raises(InputError, match="directions"):
        absolute_invariants(henon, surface=lambda u: u, periodic=(True,))
    held = replace(henon.scene.model, constraints=(("rod", henon.scene.model.H),))
    with pytest.raises(InputError, match="without constraints"):
        run_map(replace(henon, scene=replace(henon.scene, model=held)))
