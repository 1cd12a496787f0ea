"""Orbits whose ends, or whose details, lie many decades from the unit of q; wells with a cusp."""

import math
from typing import Any

import pytest
from flint import arb
from mpmath import mp, mpf

from canon import InputError, motion
from canon.numeric.actions import course, inverse

FAR = ("1e110", "1e200", "1e300")


def agrees(found: Any, truth: Any) -> bool:
    return abs(mpf(found.value) - truth) <= found.bound


@pytest.mark.parametrize("energy", FAR)
def test_turning_points_far_out(energy: str) -> None:
    with mp.workdps(40):
        assert agrees(motion("p**2/2 + q**2/2").orbit(energy).action, 2 * mp.pi * mpf(energy))
        kinked = motion("p**2/2 + abs(q)").orbit("1e60")
        assert agrees(kinked.action, 8 * mp.sqrt(2) * mpf("1e60") ** mpf("1.5") / 3)
    with pytest.raises(InputError, match="too far out"):
        motion("p**2/2 + log(q) + 1/q", domain=(0, math.inf)).orbit("1e6")


@pytest.mark.parametrize("digits", [2, 6, 12, 18, 20, 24, 30, 40, 56, 60, 100, 300])
def test_nearly_parabolic_orbits(digits: int) -> None:
    """J = 2π(1/√(−2E) − L) of Kepler's radial motion: the core is 10^−digits of the orbit."""
    with mp.workdps(400):
        E = -(mpf(10) ** -digits)
        orbit = motion("p**2/2 + 1/(8*q**2) - 1/q", domain=(0, math.inf)).orbit(f"-1e-{digits}")
        assert agrees(orbit.action, 2 * mp.pi * (1 / mp.sqrt(-2 * E) - mpf(1) / 2))


@pytest.mark.parametrize("L", ["1/1000", "1e-6", "1e-9"])
def test_a_minimum_next_to_an_end(L: str) -> None:
    with mp.workdps(60):
        value = mpf(1) / 1000 if L == "1/1000" else mpf(L)
        found = motion("p**2/2 + L**2/(2*q**2) - 1/q", parameters={"L": L}, domain=(0, math.inf)).orbit("-1/2")
        assert agrees(found.action, 2 * mp.pi * (1 - value))
        pair = motion("p**2/2 + 4*((s/q)**12 - (s/q)**6)", parameters={"s": "3.4e-10"}, domain=(0, math.inf))
        assert abs(float(pair.nodes[1]) / (2 ** (1 / 6) * 3.4e-10) - 1) < 1e-12


@pytest.mark.parametrize("energy", [100, 10**4, 10**6])
@pytest.mark.parametrize(
    ("text", "bump"),
    [("exp(-q**2)", lambda x: mp.exp(-(x**2))), ("3/10*exp(-q**2)", lambda x: mpf(3) / 10 * mp.exp(-(x**2)))],
)
def test_a_hump_in_the_middle_of_a_wide_orbit(text: str, bump: Any, energy: int) -> None:
    with mp.workdps(30):
        end = mp.sqrt(2 * mpf(energy))  # the bump is below 1e-80 there
        cuts = [0, *(mp.asin(x / end) for x in (0.5, 1, 2, 3, 4, 6, 8, 12)), mp.pi / 2]

        def integrand(angle: Any) -> Any:
            x = end * mp.sin(angle)
            return mp.sqrt(abs(2 * (energy - x**2 / 2 - bump(x)))) * end * mp.cos(angle)

        found = motion(f"p**2/2 + q**2/2 + {text}").orbit(energy).action
        assert abs(found.value - 4 * mp.quad(integrand, cuts)) <= found.bound + 1e-20 * energy


@pytest.mark.parametrize(
    ("H", "inside", "outside"),
    [
        ("p**2/2 + abs(q)**(2/3)", 1, -1),
        ("p**2/2 + sqrt(abs(q - sqrt(2)))", 1, "-1/1000"),
        ("p**2/2 + abs(q)**(1/5) - 3", -2, "-3.1"),
    ],
)
def test_there_is_nothing_below_a_cusp(H: str, inside: Any, outside: Any) -> None:
    well = motion(H)
    assert well.orbit(inside).action.value > 0
    with pytest.raises(InputError, match="there is no motion"):
        well.orbit(outside)


@pytest.mark.parametrize("H", ["p**2/2 - 1/abs(q)", "p**2/2 + log(abs(q))"])
def test_a_pole_is_no_cusp(H: str) -> None:
    assert "from a singularity" in motion(H).ranges()
    assert motion(H).orbit(-1).action.value > 0


@pytest.mark.parametrize("action", [0, "1e-300", "1e-200", "1e-30"])
def test_the_energy_of_a_small_action(action: Any) -> None:
    """E = 1 − (1 − J/2π√2)² of Morse's well."""
    found = motion("p**2/2 + (1 - exp(-q))**2").energy(action)
    with mp.workdps(320):
        J = mpf(action)
        assert agrees(found, 1 - (1 - J / (2 * mp.pi * mp.sqrt(2))) ** 2)


@pytest.mark.parametrize("action", ["1e-200", "1e-150", "1e-90", "0.3"])
def test_no_energy_is_asked_for_once_its_action_is_met_to_its_last_bit(
    action: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Newton's method had gone on for 200 rounds about an action whose own bound is wider than what was asked for."""
    asked = []
    ends = course.end_place
    monkeypatch.setattr(course, "end_place", lambda *of: (asked.append(1), ends(*of))[1])
    motion("p**2/2 + (1 - exp(-q))**2").energy(action)
    assert 0 < len(asked) < 60


def test_a_place_is_as_sure_as_the_times_by_which_it_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    well = motion("p**2/2 + q**4")
    exact, times = well.point(1, 0.1), inverse.time_from_low
    monkeypatch.setattr(inverse, "time_from_low", lambda *of: times(*of) + arb(0, "1e-6"))
    q, p = well.point(1, 0.1)
    assert 1e-7 < q.bound < 1e-5
    assert abs(q.value - exact[0].value) <= q.bound
    assert abs(p.value - exact[1].value) <= p.bound


@pytest.mark.parametrize("action", [1e-10, 1e-3, 0.3, 2.0, 7.7, 8.88])
def test_the_bound_of_an_energy_holds(action: float) -> None:
    with mp.workdps(60):
        found = motion("p**2/2 + (1 - exp(-q))**2").energy(action)
        assert agrees(found, 1 - (1 - mpf(action) / (2 * mp.pi * mp.sqrt(2))) ** 2)
        found = motion("p**2/2 + 1/(8*q**2) - 1/q", domain=(0, math.inf)).energy(action)
        assert agrees(found, -1 / (2 * (mpf(action) / (2 * mp.pi) + mpf(1) / 2) ** 2))
