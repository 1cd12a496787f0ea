"""Noether's charges that are found from a scene: those of the Galilei group that its effects leave, and no other."""

from typing import Any

import numpy as np
import pytest

from canon.errors import InputError
from canon.scenes.monitors.charges import charges
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate

BODIES = """
[[body]]
name = "a"
mass = 1.0
charge = 1.0
position = [1.0, 0.2, 0.1]
velocity = [0.1, 0.7, 0.2]
[[body]]
name = "b"
mass = 2.0
charge = -3.0
position = [-1.0, 0.3, 0.0]
velocity = [0.2, -0.5, 0.1]
"""
TOP = "[[rigid_body]]\nmoments = {}\neuler = [0.1, 0.7, 0.3]\nangular_velocity = [0.3, 0.2, 8.0]\n"
RUN = "[run]\nduration = 1.0\nsamples = 5\n"


def effect(kind: str, *lines: str) -> str:
    return f'[[effect]]\nkind = "{kind}"\n' + "".join(f"{line}\n" for line in lines)


def texts(text: str) -> list[str]:
    """The charges at states that are on no orbit: no run is needed to find them."""
    scene = read_scene_text(text + RUN)
    random = np.random.default_rng(1)
    q, p = (np.array(x) + 0.1 * random.standard_normal((9, len(x))) for x in (scene.q, scene.p))
    return [charge.text for charge in charges(scene.model, q, p, np.linspace(0, 1, 9))]


M, P = ["M_x", "M_y", "M_z"], ["P_x", "P_y", "P_z"]
BOOSTS = ["t P_x - sum(m x)", "t P_y - sum(m y)", "t P_z - sum(m z)"]
GRAVITY, UNIFORM = effect("mutual_gravity"), effect("uniform_gravity", "g = 9.81")


@pytest.mark.parametrize(
    ("effects", "expected"),
    [
        ("", ["H", *M, *P, *BOOSTS]),
        (GRAVITY, ["H", *M, *P, *BOOSTS]),
        # free fall is a symmetry, too: Σ p_z + M g t, and the boost that falls
        (GRAVITY + UNIFORM, ["H", "M_z", "P_x", "P_y", "P_z + 29.43 t", *BOOSTS[:2], f"{BOOSTS[2]} + 14.715 t^2"]),
        # the translations across a magnetic field, of which no other combination is kept
        (effect("magnetic_field", "B = 2.0"), ["H", "M_z", "P_x - sum(e y)", "P_y + sum(e x)", "P_z", BOOSTS[2]]),
        (effect("inverse_distance", "a = 1.0"), ["H", *M]),
        (GRAVITY + effect("rotating_frame", "Omega = 0.3"), ["H", "M_z", "P_z", BOOSTS[2]]),
        (effect("driving", 'force = ["cos(t)", 0, 0]') + GRAVITY, ["M_x", "P_y", "P_z", *BOOSTS[1:]]),
        (effect("damping", "rate = 0.1"), [f"P_{x} + 0.2 sum(m {x})" for x in "xyz"]),
        (effect("rod", "length = 2.0", 'bodies = ["a", "b"]'), ["H", *M, *P, *BOOSTS]),
        (effect("rod", "length = 1.0", 'bodies = ["a"]') + UNIFORM, ["H", "M_z"]),
        (effect("surface", 'equation = "z - sin(t)"', 'bodies = ["a"]'), ["M_z", *P[:2], *BOOSTS[:2]]),
        (effect("potential", 'V = "x**4 + y**4 + z**4 + x*y + z"'), ["H"]),
        # one part in a thousand more along one axis
        (effect("potential", 'V = "x**2 + 1.001*y**2 + z**2"'), ["H", "M_y"]),
    ],
)
def test_charges_of_bodies(effects: str, expected: list[str]) -> None:
    # a rod's own place is no part of what is asked here
    assert texts(BODIES.replace("[1.0, 0.2, 0.1]", "[1.0, 0.0, 0.0]") + effects) == expected


def test_charges_of_tops_and_systems() -> None:
    weight = effect("gravity_torque", "m = 2.0", "g = 9.81", "l = 0.3")
    assert texts(TOP.format([1.0, 1.0, 0.5]) + weight) == ["H", "M_z", "M_3"]
    assert texts(TOP.format([1.0, 1.1, 0.5])) == ["H", *M]
    # beside bodies that fall each keeps its own
    both = texts(BODIES + UNIFORM + 'bodies = ["a"]\n' + TOP.format([1.0, 1.1, 0.5]).replace("8.0", "0"))
    assert both[-4:] == [f"{name} of the rigid bodies" for name in ("H", *M)]
    assert both[0] == "H of the bodies"
    system = '[system]\nq_names = ["r", "a"]\np_names = ["pr", "L"]\nH = "(pr**2 + L**2/r**2)/2 - 1/r"\n'
    assert texts(system + "q = [1.0, 0.3]\np = [0.1, 0.9]\n") == ["H", "L"]
    free: Any = '[system]\nq_names = ["x"]\np_names = ["p"]\nH = "p**2/2 - 3*x"\nq = [1.0]\np = [0.3]\n'
    assert texts(free) == ["H", "p - 3 t", "t p - x - 1.5 t^2"]


def test_the_monitor() -> None:
    found = simulate(read_scene_text(BODIES + RUN + 'monitor = ["charges"]\n'))
    (reading,) = found.monitors
    assert found.ok
    assert len(reading.initial) == len(reading.extra["charges"]) == len(reading.extra["drifts"])
    assert reading.extra["symmetries"][0] == "time"
    assert reading.max_drift <= reading.bound < 1e-6
    with pytest.raises(InputError, match="a body on a skate has none"):
        read_scene_text(
            "[[body]]\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n"
            + effect("skate", 'body = "body1"')
            + RUN
            + 'monitor = ["charges"]\n'
        )
