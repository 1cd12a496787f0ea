"""Actions, periods and angles of one degree of freedom against closed forms of 50 digits, and what is refused.

Ledger: sec-14.5-a (J = ∮ p dq, ν = dE/dJ), sec-14.5-c (ν T = 1; the separatrix), sec-14.5-d, sec-14.5-f.
"""

import math
from typing import Any

import mpmath as mp
import pytest

from canon.errors import InputError
from canon.numeric.actions.bounded import Bounded
from canon.numeric.actions.motion import Motion, motion

INF = math.inf


def test_a_period_that_is_none() -> None:
    """J of a rotation over a length of 1 was 2.38 ± 3e-18."""
    for H, period in (
        ("p**2/2 - cos(q)", 1),
        ("p**2/2 - cos(q)", "pi"),
        ("p**2*(2 + sin(q))", "pi"),
        ("p**2 + q**2", 1),
    ):
        with pytest.raises(InputError, match=r"period: H = .* doesn't repeat itself after"):
            motion(H, period=period)
    for H, period in (
        ("p**2/2 - cos(q)", 2 * math.pi),
        ("p**2/2 - cos(q)", "4*pi"),
        ("p**2/2 - exp(cos(2*q))", "pi"),
        ("p**2*(2 + sin(q)**2)", "pi"),
        ("p**2 + 3", 1),
        ("p**2/2 + tan(q)**2", "pi"),
    ):
        motion(H, period=period)


@pytest.mark.parametrize(
    ("H", "E"),
    [
        ("p**4 - p**2 + q**2", 1.0),  # J was 4.79 within 1e-16, between ±1 in place of ±1.118
        ("p**4 - p**2 + q**2", -0.1),  # there was no motion
        ("q**2/2 - cos(p)", 0.9),  # beyond the next maximum
        ("q**2 - p**4", 0.5),
        ("q**2 - sqrt(1 + p**2)", 0.5),
        ("q**2/2 + p**4 - p**3*9/4 + p**2*5/4", 0.2),  # least at 0, and again near 1.18
    ],
)
def test_more_than_one_momentum_at_which_H_is_least(H: str, E: float) -> None:
    with pytest.raises(InputError, match=r"H: H = .* isn't least at one momentum|is greatest, not least|one momentum"):
        motion(H).orbit(E)


def test_one_minimum_in_p_serves_below_the_next_maximum() -> None:
    """q²/2 − cos p is the pendulum with q and p exchanged."""
    with mp.workdps(60):
        exact = pendulum_reference(mp.mpf("0.75"))
    found = motion("q**2/2 - cos(p)").orbit(-0.5)
    assert holds(found.action, exact[0])
    assert holds(found.period, exact[1])


def holds(number: Bounded | None, exact: Any, ulps: float = 1.0) -> bool:
    """The bound holds, and it is no larger than so many units in the last place."""
    assert number is not None
    with mp.workdps(60):
        return abs(mp.mpf(number.value) - exact) <= number.bound <= ulps * math.ulp(number.value)


def pendulum_reference(m1: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
    """(J, T) of p²/2 − cos q at E = 1 − 2 m1, m = 1 − m1: J = 16 (E(m) − m1 K(m)), T = 4 K(m); rotations for m1 < 0.

    Lawden (1989), Elliptic Functions and Applications, 5.1.
    """
    m = 1 - m1
    if m1 > 0:
        return 16 * (mp.ellipe(m) - m1 * mp.ellipk(m)), 4 * mp.ellipk(m)
    return 8 * mp.sqrt(m) * mp.ellipe(1 / m), 2 * mp.ellipk(1 / m) / mp.sqrt(m)


with mp.workdps(60):
    third = mp.mpf(1) / 3
    CASES = {
        "oscillator": ("p**2/2 + q**2/2", {}, 2, 4 * mp.pi, 2 * mp.pi),
        "quartic": (
            "p**2/2 + q**4", {}, 1, mp.sqrt(2) * mp.beta(mp.mpf(1) / 4, mp.mpf(3) / 2),
            mp.beta(mp.mpf(1) / 4, mp.mpf(1) / 2) / mp.sqrt(2),
        ),
        "a kink": ("p**2/2 + abs(q)", {}, 1, 8 * mp.sqrt(2) / 3, 4 * mp.sqrt(2)),
        "Morse": (
            "p**2/2 + (1 - exp(-q))**2", {}, "1/2", 2 * mp.pi * mp.sqrt(2) * (1 - mp.sqrt(0.5)), 2 * mp.pi,
        ),
        "Poeschl-Teller": (
            "p**2/2 - 1/cosh(q)**2", {}, "-1/4", 2 * mp.pi * (mp.sqrt(2) - mp.sqrt(0.5)), mp.pi * 2 * mp.sqrt(2),
        ),
        "Kepler, radial": (
            "p**2/2 - 1/q + 1/(2*q**2)", {"domain": (0, INF)}, "-1/3", 2 * mp.pi * (mp.sqrt(1.5) - 1),
            2 * mp.pi * mp.mpf(1.5) ** 1.5,
        ),
        "a box with a slope": (
            "p**2/2 + q/10", {"domain": (0, 1), "walls": True}, 1,
            2 * mp.sqrt(2) * 20 * third * (1 - mp.mpf("0.9") ** 1.5),
            2 * mp.sqrt(2) * 10 * (1 - mp.sqrt(mp.mpf("0.9"))),
        ),
        "a bead with inertia": ("p**2/(2*(1 + q**2)) + q**2/2", {}, "1/2", None, None),
        "pendulum, libration": ("p**2/2 - cos(q)", {}, "1/2", *pendulum_reference(mp.mpf("0.25"))),
        "pendulum, rotation": ("p**2/2 - cos(q)", {}, 3, *pendulum_reference(mp.mpf(-1))),
    }  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_closed_forms(name: str) -> None:
    H, where, energy, action, period = CASES[name]
    orbit = motion(H, **where).orbit(energy)
    if action is None:  # the area within x²(1 + x²) = y²: by 50 digits of quadrature
        with mp.workdps(50):
            action = 4 * mp.quad(lambda x: mp.sqrt((1 + x * x) * (1 - x * x)), [0, 1])
            period = 4 * mp.quad(lambda x: mp.sqrt((1 + x * x) / (1 - x * x)), [0, 0.5, 1])
    assert holds(orbit.action, action)
    assert holds(orbit.period, period)
    assert holds(orbit.frequency, 1 / period)


def test_the_rule_is_chosen_by_the_ends() -> None:
    assert [motion("p**2/2 - cos(q)").orbit(E).rule for E in (0, 3)] == ["arithmetic-geometric mean"] * 2
    assert motion("p**2/2 - sin(3*q + 1) + 2*cos(3*q)").orbit(0, well=2).rule == "arithmetic-geometric mean"
    other = motion("p**2/2 - cos(q) - cos(2*q)/8")
    assert other.orbit(0).rule == "Gauss-Chebyshev"
    assert other.orbit(0).nodes < 100
    assert other.orbit(3).rule == "periodic trapezoid"
    assert other.orbit(below_separatrix="1e-5").rule == "tanh-sinh"
    assert motion("p**2/2 + abs(q)").orbit(1).rule == "tanh-sinh"


@pytest.fixture(scope="module")
def pendulum() -> Motion:
    return motion("p**2/2 - cos(q)")


@pytest.mark.parametrize("distance", ["1e-1", "1e-12", "1e-40"])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("H", ["p**2/2 - cos(q)", "p**2/2 + 2*sin(q/2)**2 - 1"])
def test_near_the_separatrix(H: str, distance: str, side: int) -> None:
    """By Gauss's mean, and by the quadrature of a potential that is not seen to be a pendulum's."""
    pendulum = motion(H, period="2*pi")
    orbit = pendulum.orbit(below_separatrix=distance) if side > 0 else pendulum.orbit(above_separatrix=distance)
    with mp.workdps(120):
        action, period = pendulum_reference(side * mp.mpf(distance) / 2)
    assert holds(orbit.action, action)
    assert holds(orbit.period, period)


def test_a_small_distance_from_the_minimum(pendulum: Motion) -> None:
    orbit = pendulum.orbit(above_minimum="1e-100")
    with mp.workdps(250):
        action, period = pendulum_reference(1 - mp.mpf("1e-100") / 2)
    assert holds(orbit.action, action)
    assert holds(orbit.period, period)


def test_the_separatrix_has_an_action_and_no_period(pendulum: Motion) -> None:
    orbit = pendulum.orbit(1)
    assert orbit.action.value == 16.0
    assert orbit.period is None
    assert orbit.frequency is None
    assert "half" in orbit.note
    assert abs(pendulum.orbit(above_separatrix="1e-40").action.value - 8.0) < 1e-14
    with pytest.raises(InputError, match=r"exactly that of the separatrix.*from -1 to 1; rotations above 1"):
        pendulum.at("pi", 0)


def test_two_wells() -> None:
    double = motion("p**2/2 + q**4/4 - q**2/2")
    left, right = double.orbits("-1/10")
    assert left.action == right.action
    assert left.ends[0].value == -right.ends[1].value
    assert double.orbit("-1/10", well=-0.9) == left
    # over the barrier the two wells are one; on it, each is half of what is next to it
    assert double.orbit(0, well=1).action.value == pytest.approx(4 / 3, rel=1e-15)
    assert double.orbit("1e-30").action.value == pytest.approx(8 / 3, rel=1e-14)
    with pytest.raises(InputError, match="2 wells have orbits at E = -1/10: choose one with well = -1, 1"):
        double.orbit("-1/10")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("H", "q", "p"),
    [
        ("p**2/2 + q**2/2", 0.6, 0.8),
        ("p**2/2 - cos(q)", 1.0, -0.5),
        ("p**2/2 - cos(q)", 1.0, 2.5),
        ("sqrt(1 + p**2) + q**2/2", 0.3, 0.5),
        ("(p - q**2)**2/2 + q**2/2", 0.3, 0.5),
        ("(p - q)**2/2 + (p - q)**4 + q**2/2", 0.3, 0.1),
    ],
)
def test_there_and_back(H: str, q: float, p: float) -> None:
    moved = motion(H)
    orbit = moved.at(q, p)
    assert orbit.angle is not None
    back = moved.point(orbit.action.value, orbit.angle.value, branch=orbit.kind)
    assert back[0].value == pytest.approx(q, abs=4e-15)
    assert back[1].value == pytest.approx(p, abs=4e-15)
    assert moved.energy(orbit.action.value, branch=orbit.kind).value == pytest.approx(orbit.energy.value, rel=1e-15)


def test_angles(pendulum: Motion) -> None:
    """w = F(φ | m)/4K + 1/4 with sin(q/2) = √m sin φ, at E = 0; the oscillator's is that of a circle."""
    orbit = pendulum.at("1/2", "0.1")
    with mp.workdps(50):
        E = mp.mpf("0.1") ** 2 / 2 - mp.cos(mp.mpf("0.5"))
        m = (1 + E) / 2
        phi = mp.asin(mp.sin(mp.mpf("0.25")) / mp.sqrt(m))
        assert holds(orbit.angle, mp.mpf(1) / 4 + mp.ellipf(phi, m) / (4 * mp.ellipk(m)))
        circle = motion("p**2/2 + q**2/2").at("-3/10", "-2/5").angle
        assert holds(circle, mp.mpf(3) / 4 + mp.atan(mp.mpf(3) / 4) / (2 * mp.pi))
    # a rotation the other way runs the other way, from the other end
    there, back = (pendulum.at(1, p).angle for p in (2.5, -2.5))
    assert there is not None
    assert back is not None
    assert there.value + back.value == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("H", "where", "orbit", "message"),
    [
        ("p**2/2 - cos(q)", {}, {"energy": -2}, "there is no motion at E = -2; the energies are: librations about q"),
        ("p**2/2 - cos(q)", {}, {"energy": -1}, "nothing moves: J = 0, and there is no angle, at the minimum"),
        ("p**2/2 - cos(q)", {}, {"energy": 0, "branch": "rotation"}, "no rotation at E = 0.*rotations above 1"),
        ("p**2/2 - cos(q)", {}, {"energy": 2, "branch": "libration"}, "no libration at E = 2.*from -1 to 1"),
        ("p**2/2 - cos(q)", {}, {}, "one of energy, above_minimum, above_separatrix or below_separatrix"),
        ("p**2/2 - cos(q)", {}, {"above_minimum": -1}, "is 0 or more, unlike -1; the energies are: librations"),
        ("p**2/2 - cos(q)", {}, {"energy": "1/0"}, "undefined|divi"),
        ("p**2/2 - 1/q + 1/q**2", {"domain": (0, INF)}, {"energy": 1}, r"is not bounded.*from -0.25 to 0"),
        ("p**2/2 + q**3/3 - q", {}, {"energy": 1}, "is not bounded: the energies are: librations about q = 1"),
        ("p**2/2 - q", {}, {"energy": 1}, "the potential has no minimum, so that nothing is bound at any energy"),
        ("p**2/2 + q**2", {}, {"below_separatrix": 1}, "no separatrix; the energies are: librations about q = 0"),
    ],
)  # fmt: skip
def test_what_is_refused(H: str, where: dict[str, Any], orbit: dict[str, Any], message: str) -> None:
    moved = motion(H, **where)
    with pytest.raises(InputError, match=message):
        moved.orbit(**orbit)


@pytest.mark.parametrize(
    ("H", "message"),
    [
        ("p*q", "linear in p"),
        ("q**2", "does not depend on p"),
        ("-p**2/2 + q**2", "the kinetic energy in .* is negative"),
        ("p**2/2 + k*q**2", "unknown name 'k'"),
        ("p**2/2 + 1/q + q**2/2", r"jumps from one infinity to the other near q = 0: .*domain = \(0, inf\)"),
        ("p**3 + p**4 + p**2*q + q**2", "neither quadratic nor even in p"),
    ],
)
def test_hamiltonians_that_are_none(H: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        motion(H)


def test_over_a_barrier_the_wells_are_one() -> None:
    double = motion("p**2/2 + q**4/4 - q**2/2")
    over = double.at(1.5, 0.5)
    assert over.angle is not None
    q, p = double.point(over.action.value, over.angle.value, well=1)
    assert (q.value, p.value) == pytest.approx((1.5, 0.5), abs=4e-15)
    with pytest.raises(InputError, match=r"below 1\.333333333 or, over the barrier, above 2\.666666667, unlike 2"):
        double.point(2, 0.1, well=1)
    # two barriers of one height in a period: a rotation passes both
    two = motion("p**2/2 - cos(2*q) + cos(q)/10")
    turning = two.at(0.3, 2.5)
    assert turning.angle is not None
    q, p = two.point(turning.action.value, turning.angle.value, branch="rotation")
    assert (q.value, p.value) == pytest.approx((0.3, 2.5), abs=4e-15)
    with pytest.raises(InputError, match=r"rotations have actions above 8\.00250013, unlike 3"):
        two.point(3, 0.2, branch="rotation")
    with pytest.raises(InputError, match=r"have actions below 7\.688340865, unlike 12: choose another branch"):
        two.point(12, 0.2, well=0)


def test_actions_beyond_the_branch(pendulum: Motion) -> None:
    with pytest.raises(InputError, match="librations about q = 0 have actions below 16"):
        pendulum.point(17, 0.1)
    with pytest.raises(InputError, match="rotations have actions above 8"):
        pendulum.point(7, 0.1, branch="rotation")


@pytest.mark.slow
def test_the_largest_action_of_a_well_that_can_be_left() -> None:
    """Morse's well: J < 2π√2 below the energy of escape."""
    morse = motion("p**2/2 + (1 - exp(-q))**2")
    with mp.workdps(40):
        exact = 1 - (1 - mp.mpf("8.8") / (2 * mp.pi * mp.sqrt(2))) ** 2
    assert holds(morse.energy("8.8"), exact, 2.0)
    with pytest.raises(InputError, match=r"no libration has the action 9: they end at 8\.8857"):
        morse.energy(9)


@pytest.mark.parametrize("time", [0.2, 0.7, 2.0, 3.0])
def test_the_angle_of_a_cyclic_coordinate_grows_evenly(time: float) -> None:
    """x = 2 cos t, y = sin t: in polar coordinates w_θ = t/2π, although θ itself hurries and lingers. sec-14.5-b."""
    x, y, v, w = 2 * math.cos(time), math.sin(time), -2 * math.sin(time), math.cos(time)
    r = math.hypot(x, y)
    radial = motion("p**2/2 + L**2/(2*q**2) + q**2/2", domain=(0, INF), parameters={"L": 2})
    frequency, angle = radial.drift(r, (x * v + y * w) / r, 2 / radial.profile.q**2, math.atan2(y, x))
    assert frequency.value == pytest.approx(1 / (2 * math.pi), rel=1e-14)
    assert (angle.value - time / (2 * math.pi) + 0.5) % 1 == pytest.approx(0.5, abs=1e-14)


def test_a_well_isnt_named_by_the_top_of_its_barrier():
    double = motion("p**2/2 + (q**2 - 1)**2")
    with pytest.raises(InputError, match=r"on the barrier between two wells.* q = -1, 1 inside"):
        double.orbit("1/2", well=0)
    assert double.orbit("1/2", well="1/100").ends[0].value > 0


@pytest.mark.parametrize(
    ("H", "turns"),
    [
        ("p**2/2 - cos(q)", 1),
        ("p**2/2 + sin(q)**2", 2),
        ("p**2/2 + tan(q)**2", 2),
        ("p**2/2 - cos(q) + sin(q)**2", 1),
        ("p**2/2 + sin(q)**2*cos(q)**2", 4),
        ("p**2/2 + cos(q)**3 - 3*cos(q)/4", 3),  # cos 3q / 4
        ("p**2/(2*(1 + sin(q)**2)) - cos(2*q)", 2),
        ("p**2/2 + sqrt(1 + sin(q)**2)", 2),
    ],
)
def test_the_least_period(H: str, turns: int) -> None:
    found = motion(H).domain.period
    assert found is not None
    assert float(found()) * turns == pytest.approx(2 * math.pi, rel=1e-15)


@pytest.mark.slow
def test_a_level_turning_point_has_an_action_and_no_period() -> None:
    """V has a triple zero at q = 1: the integral of √(2 (1 − q)³ (q + 2)) from −2 to 1 is elementary."""
    orbit = motion("p**2/2 + (q - 1)**3*(q + 2)").orbit(energy=0)
    # 2√2 (1 − q)^(3/2) (q + 2)^(1/2): 2√2 · 3³ · B(5/2, 3/2)
    exact = 2 * math.sqrt(2) * 27 * math.gamma(2.5) * math.gamma(1.5) / math.gamma(4)
    assert orbit.action.value == pytest.approx(exact, rel=1e-15)
    assert orbit.period is None
    assert "V is level at the turning point q = 1" in orbit.note
