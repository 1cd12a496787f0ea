"""Every effect alone against Newton's equations, written down here as forces and solved by another library."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from canon.errors import InputError
from canon.scenes.effects import EFFECTS
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.states import named_states

Array = Any
Force = Callable[[Array, Array, float], Array]
M, Q = 2.0, -1.5
X0, V0 = np.array([1.0, 0.2, -0.3]), np.array([0.1, 0.9, 0.2])
BODY = 'name = "a"\nmass = 2.0\ncharge = -1.5\nposition = [1.0, 0.2, -0.3]\nvelocity = [0.1, 0.9, 0.2]\n'
RUN = "[run]\nduration = 4.0\naccuracy = 1e-10\nsamples = 5\n"


def one(effect: str, more: str = "") -> str:
    return f"{more}\n[[body]]\n{BODY}\n[[effect]]\n{effect}\n{RUN}"


def by_newton(force: Force, x: Array = X0, v: Array = V0, masses: Any = M) -> Array:
    """x (samples, n) of m ẍ = F(x, ẋ, t)."""
    n = len(x)
    found = solve_ivp(
        lambda t, z: np.concatenate([z[n:], force(z[:n], z[n:], t) / masses]),
        (0.0, 4.0), np.concatenate([x, v]), "DOP853", np.linspace(0, 4, 5), rtol=1e-12, atol=1e-13,
    )  # fmt: skip
    return found.y[:n].T


def r(x: Array) -> float:
    return float(np.sqrt(x @ x))


C = np.array([0.5, 0.1, 2.0])
B = np.array([0.3, -0.2, 1.0])
OMEGA = np.array([0.1, 0.2, 0.5])
ALPHA = np.array([[0.3, 0.1, 0.0], [0.1, 0.2, 0.05], [0.0, 0.05, 0.4]])
SINGLE: dict[str, tuple[str, Force]] = {
    "uniform_gravity": ('kind = "uniform_gravity"\ng = 1.5', lambda x, v, t: np.array([0, 0, -M * 1.5])),
    "uniform_gravity vector": (
        'kind = "uniform_gravity"\ng = [0.1, 0.2, 1.5]',
        lambda x, v, t: M * np.array([0.1, 0.2, 1.5]),
    ),
    "inverse_distance": (
        'kind = "inverse_distance"\na = 1.7\ncentre = [0.5, 0.1, 2.0]',
        lambda x, v, t: -1.7 * (x - C) / r(x - C) ** 3,
    ),
    "inverse_square": ('kind = "inverse_square"\nc = 0.4', lambda x, v, t: 2 * 0.4 * x / r(x) ** 4),
    "power_law even": ('kind = "power_law"\na = 0.5\nn = 4', lambda x, v, t: -0.5 * 4 * r(x) ** 2 * x),
    "power_law odd": ('kind = "power_law"\na = 0.5\nn = 3', lambda x, v, t: -0.5 * 3 * r(x) * x),
    "potential": (
        'kind = "potential"\nV = "x**2*y + cos(t)*z"',
        lambda x, v, t: -np.array([2 * x[0] * x[1], x[0] ** 2, np.cos(t)]),
    ),
    "spring": ('kind = "spring"\nk = 3.0', lambda x, v, t: -3 * x),
    "spring with a length": (
        'kind = "spring"\nk = 3.0\nlength = 0.7\nanchor = [0.5, 0.1, 2.0]\nanchor_velocity = [0.1, 0.0, -0.2]',
        lambda x, v, t: -3 * (d := x - C - np.array([0.1, 0, -0.2]) * t) * (1 - 0.7 / r(d)),
    ),
    "damping": ('kind = "damping"\nrate = 0.2', lambda x, v, t: -2 * M * 0.2 * v),
    "damping matrix": (
        'kind = "damping"\nmatrix = [[0.3, 0.1, 0.0], [0.1, 0.2, 0.05], [0.0, 0.05, 0.4]]',
        lambda x, v, t: -ALPHA @ v,
    ),
    "driving": ('kind = "driving"\nforce = ["cos(2*t)", 0, "t"]', lambda x, v, t: np.array([np.cos(2 * t), 0, t])),
    "electric_field": ('kind = "electric_field"\nE = [0.1, 0.2, -0.4]', lambda x, v, t: Q * np.array([0.1, 0.2, -0.4])),
    "electric_field varying": (
        'kind = "electric_field"\nE = ["2*x*y", "x**2", "sin(t)"]',
        lambda x, v, t: Q * np.array([2 * x[0] * x[1], x[0] ** 2, np.sin(t)]),
    ),
    "electric_field potential": (
        'kind = "electric_field"\npotential = "x*z"',
        lambda x, v, t: -Q * np.array([x[2], 0, x[0]]),
    ),
    "magnetic_field": ('kind = "magnetic_field"\nB = [0.3, -0.2, 1.0]', lambda x, v, t: Q * np.cross(v, B)),
    "magnetic_field varying": (
        'kind = "magnetic_field"\nB = ["x*y", "1 - y**2/2", "1"]',
        lambda x, v, t: Q * np.cross(v, [x[0] * x[1], 1 - x[1] ** 2 / 2, 1.0]),
    ),
    "magnetic_field by A": (
        'kind = "magnetic_field"\nvector_potential = ["0", "x*(1 + t)", "0"]',
        lambda x, v, t: Q * (np.cross(v, [0, 0, 1 + t]) - np.array([0, x[0], 0])),
    ),
    "rotating_frame": (
        'kind = "rotating_frame"\nOmega = [0.1, 0.2, 0.5]',
        lambda x, v, t: -M * (2 * np.cross(OMEGA, v) + np.cross(OMEGA, np.cross(OMEGA, x))),
    ),
    "accelerated_frame": (
        'kind = "accelerated_frame"\ndisplacement = ["t**3/6", 0, "cos(t)"]',
        lambda x, v, t: -M * np.array([t, 0, -np.cos(t)]),
    ),
}


def motion(text: str) -> tuple[Result, Array]:
    result = simulate(read_scene_text(text))
    return result, np.hstack([*named_states(result)["position"].values()])


@pytest.mark.parametrize("name", SINGLE)
def test_one_effect_moves_as_newton_says(name: str) -> None:
    effect, force = SINGLE[name]
    result, x = motion(one(effect))
    assert result.ok, result.messages
    assert np.allclose(x, by_newton(force), rtol=0, atol=5e-9)
    velocity = named_states(result)["velocity"]["a"]
    assert np.allclose(velocity[0], V0, atol=1e-14)


def test_effects_add_up() -> None:
    """A charge in crossed fields, in a rotating frame with friction, which acts on the velocity in that frame.

    −Ω·M with the canonical M: the field also acts on the velocity Ω × x, as a potential −q A·(Ω × x).
    """
    effect = """kind = "magnetic_field"
B = 0.7
[[effect]]
kind = "rotating_frame"
Omega = [0.1, 0.2, 0.5]
[[effect]]
kind = "damping"
rate = 0.1
[[effect]]
kind = "electric_field"
E = [0.3, 0.0, 0.0]"""
    result, x = motion(one(effect))
    field = np.array([0, 0, 0.7])

    def force(x: Array, v: Array, t: float) -> Array:
        motional = (field @ OMEGA) * x - field * (OMEGA @ x) / 2 - OMEGA * (field @ x) / 2
        inertial = -M * (2 * np.cross(OMEGA, v) + np.cross(OMEGA, np.cross(OMEGA, x)))
        return Q * (np.cross(v, field) + motional + np.array([0.3, 0, 0])) - 2 * M * 0.1 * v + inertial

    assert result.ok
    assert np.allclose(x, by_newton(force), rtol=0, atol=5e-9)


PAIR = """
[[body]]
name = "a"
mass = 1.0
position = [1.0, 0.0]
velocity = [0.0, 0.4]
[[body]]
name = "b"
mass = 3.0
position = [-0.5, 0.2]
velocity = [0.1, -0.2]
"""
PAIRS: dict[str, tuple[str, Callable[[Array], Array]]] = {
    "mutual_gravity": ('kind = "mutual_gravity"\nG = 0.9', lambda d: -0.9 * 3 * d / r(d) ** 3),
    "softened": ('kind = "mutual_gravity"\nsoftening = 0.5', lambda d: -3 * d / (d @ d + 0.25) ** 1.5),
    "coupling_spring": (
        'kind = "coupling_spring"\nk = 2.0\nbodies = ["a", "b"]\nlength = 0.3',
        lambda d: -2 * d * (1 - 0.3 / r(d)),
    ),
    "pair": ('kind = "potential"\npair = "r**2 + 1/r"', lambda d: -(2 - 1 / r(d) ** 3) * d),
}


@pytest.mark.parametrize("name", PAIRS)
def test_pairs_attract_each_other(name: str) -> None:
    effect, on_first = PAIRS[name]
    result, x = motion(f"{PAIR}[[effect]]\n{effect}\n{RUN}monitor = ['momentum', 'angular_momentum', 'energy']\n")
    start = np.array([1.0, 0, -0.5, 0.2]), np.array([0, 0.4, 0.1, -0.2])

    def force(x: Array, v: Array, t: float) -> Array:
        F = on_first(x[:2] - x[2:])
        return np.concatenate([F, -F])

    assert np.allclose(x, by_newton(force, *start, np.array([1, 1, 3, 3])), rtol=0, atol=5e-9)
    assert result.ok
    assert {reading.expected for reading in result.monitors} == {"conserved"}


def test_a_relativistic_charge_turns_slower() -> None:
    """In a field B along z the frequency is qB/γm; on a line a constant force makes hyperbolic motion."""
    text = one('kind = "magnetic_field"\nB = 1.0', 'dynamics = "relativistic"\nconstants = {c = 2.0}')
    result, _ = motion(text)
    v = named_states(result)["velocity"]["a"]
    omega = -Q * np.sqrt(1 - V0 @ V0 / 4) / M
    turned = V0[0] * np.cos(omega * result.times) - V0[1] * np.sin(omega * result.times)
    assert result.ok
    assert np.allclose(v[:, 0], turned, atol=1e-9)
    line = '[constants]\nc = 3.0\n[[body]]\nmass = 2\nposition=[0]\n[[effect]]\nkind="driving"\nforce=5\n'
    result, x = motion('dynamics = "relativistic"\n' + line + RUN)
    a, t = 5 / 2, result.times
    assert np.allclose(x[:, 0], 9 / a * (np.sqrt(1 + (a * t / 3) ** 2) - 1), atol=1e-8)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (one('kind = "sprng"\nk = 1'), "unknown effect 'sprng': did you mean 'spring'?"),
        (one('kind = "spring"\nK = 1'), "unknown key 'K': did you mean 'k'?"),
        (one('kind = "spring"'), "the key 'k' is missing"),
        (one('kind = "spring"\nk = "x +"'), "effect 1, spring, key 'k'"),
        (one('kind = "spring"\nk = 1\nbodies = ["b"]'), "there is no body 'b'"),
        (one('kind = "spring"\nk = 1\nanchor = [1, 2]'), "2 components where the bodies have 3"),
        (one('kind = "damping"'), "one of 'rate' or 'matrix' is expected"),
        (one('kind = "damping"\nmatrix = [[1,2,0],[0,1,0],[0,0,1]]'), "is symmetric"),
        (one('kind = "mutual_gravity"'), "two bodies or more"),
        (one('kind = "electric_field"\nE = 1').replace("charge = -1.5\n", ""), "the body 'a' has no charge"),
        (one('kind = "magnetic_field"\nB = ["x", 0, 0]'), "no magnetic field has a divergence"),
        (one('kind = "magnetic_field"\nB = "cos(t)"'), "B is constant in time"),
        (one('kind = "electric_field"\nE = ["y", 0, 0]'), "this field has a curl"),
        (one('kind = "driving"\nforce = "x"'), "unknown name 'x'"),
        (one("", 'dynamics = "relativistic"\nconstants = {c = 0.5}').replace("[[effect]]", ""), "speed of light"),
        (one("kind = 3"), "a string is expected"),
        (one("k = 3"), "the key 'kind' is missing"),
        (f"{PAIR}[[effect]]\nkind='rotating_frame'\nOmega=[0,1]\n{RUN}", "in a plane this is a number"),
        (PAIR.replace('"b"', '"a"') + RUN, "there are two bodies 'a'"),
        (PAIR.replace("[-0.5, 0.2]", "[-0.5]").replace("[0.1, -0.2]", "[0]") + RUN, "the first body has 2"),
        (PAIR.replace("mass = 3.0", "mass = -3.0") + RUN, "a number above 0"),
    ],
)
def test_bad_input_is_told_from_good(text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert says in str(caught.value)


ELSEWHERE = (
    "mutual_gravity", "coupling_spring", "rod", "string", "surface", "skate", "torque", "gravity_torque",
    "refractive_index", "scatterer",
)  # fmt: skip
"""The tests of these are in this file, or one of their own."""


def test_every_effect_has_a_test() -> None:
    assert {name.split()[0] for name in SINGLE} | {*ELSEWHERE} == {*EFFECTS}
