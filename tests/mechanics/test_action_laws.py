"""Laws that orbits and their actions obey: branches lie on the orbit, motions exist where turning points do, areas."""

from fractions import Fraction
from itertools import product
from typing import Any

import pytest
import sympy as sp

from canon.domain import Condition
from canon.mechanics.action_angle import ClosedAction, OneDegree, at_most, one_degree
from canon.mechanics.closed_actions import librations
from canon.mechanics.residues import by_residues
from canon.mechanics.separatrix_actions import SEPARATRIX
from canon.mechanics.standard_actions import pendulum_like, power_well, rotation
from canon.mechanics.substitutions import U
from tests.mechanics.areas import HALF, E, allowed, area, c, number, orbit, p, q, r, same


def test_both_branches_lie_on_the_orbit() -> None:
    a, m = sp.symbols("a m", positive=True)
    H = (p - a * q) ** 2 / (2 * m * (1 + q**2)) + m * q + q**4
    motion = one_degree(H, q, p, E)
    for sign in (1, -1):
        on_it = H.xreplace({p: motion.mean + sign * sp.sqrt(motion.square)}) - E
        assert sp.simplify(on_it) == 0


FAR = sp.sqrt(1 + r**2)


@pytest.mark.parametrize(
    ("square", "low", "high"),
    [
        ((3 - r) * (r - 1) * r**4, 1, 3),
        ((3 - r) * (r - 1) * (7 - r) ** 2 * (r + 1) ** 2, 1, 3),
        ((3 - r) * (r - 1) / r**2, 1, 3),
        ((3 - r) * (r - 1) / r**4, 1, 3),
        ((3 - r) * (r - 1) * (r + 2) ** 2 / r**6, 1, 3),
        ((3 - r) * (r - 1) / ((r + 1) ** 4 * (r + 2) ** 2), 1, 3),
        ((3 - r) * (r - 1) / (5 - r) ** 2, 1, 3),
        (3 * (3 - r) * (r - 1) * (r + 1) ** 4, 1, 3),
        (5 * (3 - r) * (r - 1) / ((2 * r + 3) ** 4 * (11 - 2 * r) ** 2), 1, 3),
        ((5 - sp.exp(r)) * (sp.exp(r) - 2), sp.log(2), sp.log(5)),
        ((HALF - sp.exp(-3 * r)) * (sp.exp(-3 * r) - sp.Rational(1, 5)), sp.log(2) / 3, sp.log(5) / 3),
        ((3 - FAR) * (FAR - sp.Rational(3, 2)) * r**2 / FAR**2, sp.sqrt(5) / 2, sp.sqrt(8)),
    ],
)
def test_residues_give_the_area(square: Any, low: Any, high: Any) -> None:
    """Moments up to the second, poles up to the third order, on either side of the range."""
    (x,) = square.free_symbols
    closed = next(by_residues(orbit(square, x, 0, sp.oo if square.has(sp.exp) else 5)))
    assert same(closed.value, area(square, x, low, high))
    at = {name: sp.Rational(5, 3) for name in (x, U)}
    for _, zero in closed.vanishes:
        assert abs(sp.N(zero.xreplace(at), 30)) < 1e-25
    assert abs(sp.N((closed.vanishes[0][1] + square / 1000).xreplace(at), 30)) > 1e-12


@pytest.mark.parametrize(
    "square",
    [
        (4 - r**2) / (3 + r**2) ** 2,
        7 * (4 - r**2) / (1 + 2 * r**2) ** 4,
        (4 - r**2) * (r**2 + 5) ** 2 / (3 + r**2) ** 2,
        (4 - r**2) / ((1 + r**2) ** 2 * (3 + r**2) ** 4),
        (4 - r**2) * (3 - r) ** 2 / (3 + r**2) ** 2,  # r/(3 + r²) is odd, and gives nothing
        (4 - r**2) / (-3 - r**2) ** 2,
    ],
)
def test_poles_off_the_line_come_in_pairs(square: Any) -> None:
    closed = next(by_residues(orbit(square, r, -3, 3)))
    assert same(closed.value, area(square, r, -2, 2))


def test_a_factor_that_is_negative_everywhere_turns_the_sign() -> None:
    k = sp.Symbol("k", negative=True)
    closed = next(by_residues(orbit((4 - r**2) / (k * r**2 - 1) ** 2, r, -3, 3)))
    value = {k: -sp.Rational(1, 3)}
    assert same(closed.value.xreplace(value), area(9 * (4 - r**2) / (3 + r**2) ** 2, r, -2, 2))


@pytest.mark.parametrize(
    "square", [(3 - r) * (r - 1) / (3 + r**2) ** 2, (4 - r**2) / (3 + r + r**2) ** 2, (4 - r**2) / (r**2 - 1) ** 2]
)
def test_poles_that_are_not_symmetric_or_lie_on_the_way_have_no_closed_form(square: Any) -> None:
    assert not list(by_residues(orbit(square, r, -5, 5)))


def test_a_motion_exists_where_both_turning_points_lie_in_the_range() -> None:
    """A circle of radius √E round c, between −1 and 3/2: `exists` is positive just where it fits in."""
    size, centre = sp.symbols("E c", real=True)
    low, high = sp.Integer(-1), sp.Rational(3, 2)
    closed = next(by_residues(orbit(size - (q - centre) ** 2, q, low, high)))
    for radius, place in product((Fraction(1, 3), 1, 2), (Fraction(k, 3) for k in range(-8, 12))):
        at = {size: sp.Rational(radius) ** 2, centre: sp.Rational(place)}
        fits = low < place - radius and place + radius < high
        if low in (place - radius,) or high in (place + radius,):
            continue
        assert all(e.xreplace(at) > 0 for e in closed.exists) == fits, (radius, place)
        passes = abs(min(max(place, low), high) - place) < radius  # p² > 0 somewhere in the range
        assert (passes and all(e.xreplace(at) > 0 for e in closed.through or ())) == fits, (radius, place)


RATE = sp.sqrt(2)
LESS = sp.Rational(1, 9)
WAVES: list[tuple[Any, Any, Any, Any, Any]] = [
    # p² in a wave s of this rate, its range, and where s is 1/9 (or −1/9) and 1/2
    (lambda s: (s - LESS) * (HALF - s) / (s * (1 - s)), sp.sin(RATE * q) ** 2, (0, sp.pi / 2), sp.asin(sp.sqrt(LESS)),
     sp.pi / 4),
    (lambda s: (s + LESS) * (HALF - s) / (1 - s**2), sp.sin(RATE * q), (-sp.pi / 2, sp.pi / 2), -sp.asin(LESS),
     sp.pi / 6),
    (lambda s: (s + LESS) * (HALF - s) / (1 - s**2), sp.cos(RATE * q), (0, sp.pi), sp.pi / 3, sp.acos(-LESS)),
]  # fmt: skip


@pytest.mark.parametrize(("square", "wave", "span", "left", "right"), WAVES)
def test_waves_of_any_rate_give_the_area(square: Any, wave: Any, span: Any, left: Any, right: Any) -> None:
    low, high = (end / RATE for end in span)
    closed = next(by_residues(orbit(square(wave), q, low, high)))
    assert same(closed.value, area(square(wave), q, left / RATE, right / RATE))


def exists(motion: OneDegree) -> bool:
    """Whether there is a closed form, and such a motion."""
    return any(all(e > 0 for e in closed.exists) for closed in by_residues(motion))


@pytest.mark.slow
def test_ranges_that_cut_the_orbit_have_no_action() -> None:
    """In √(1 + r²) beyond the range's end, and in waves before it or beyond it."""
    far = (3 - FAR) * (FAR - sp.Rational(3, 2)) * r**2 / FAR**2
    assert exists(orbit(far, r, 0, 3))
    assert not exists(orbit(far, r, 0, 2))
    assert not exists(orbit(far, r, sp.Rational(6, 5), 3))
    square, wave, *_ = WAVES[0]
    fifth = sp.asin(sp.sqrt(sp.Rational(1, 5))) / RATE
    whole = sp.pi / 2 / RATE
    assert exists(orbit(square(wave), q, 0, whole))
    assert not exists(orbit(square(wave), q, fifth, whole))
    assert not exists(orbit(square(wave), q, 0, whole / 2))
    for square, wave, (low, high), left, right in WAVES[1:]:
        inside = (left + right) / 2 / RATE
        assert not exists(orbit(square(wave), q, inside, high / RATE))
        assert not exists(orbit(square(wave), q, low / RATE, inside))


def test_a_pendulum_of_any_rate_at_its_separatrix() -> None:
    """8 √(2b)/κ, and half of it for a turn; near it the values on either side come close."""
    b, rate = sp.Rational(5, 2), 3
    motion = orbit(b + b * sp.cos(rate * q))
    (closed,) = pendulum_like(motion)
    wanted = area(b + b * sp.cos(rate * q), q, -sp.pi / rate, sp.pi / rate)
    assert same(closed.value, wanted)
    (turn,) = rotation(motion, None)
    assert same(2 * turn.value, wanted)
    assert all(e > 0 for e in (*closed.exists, *turn.exists))
    near = next(pendulum_like(orbit(b - sp.Rational(1, 10**9) + b * sp.cos(rate * q))))
    assert abs(number(near.value) - wanted) < 1e-6
    beyond = next(rotation(orbit(b + sp.Rational(1, 10**9) + b * sp.cos(rate * q)), None))
    assert abs(2 * number(beyond.value) - wanted) < 1e-6


@pytest.mark.parametrize(
    ("square", "well", "method"),
    [
        ((3 - q) * (q + 1), None, "residues"),
        (2 + sp.cos(3 * q) * 5, None, "complete elliptic"),
        (2 - sp.Abs(q), None, "beta function"),
        (3 + 2 * q**2 - q**4, sp.Integer(1), "even quartic"),
        ((q - 1) * (q - 2) * (q - 4), None, "elliptic integrals"),
        ((q - 2) ** 2 * (q + 1), None, SEPARATRIX),
    ],
)
def test_every_kind_of_libration_is_tried(square: Any, well: Any, method: str) -> None:
    assert method in next(librations(orbit(square), allowed, well)).method


def test_what_is_at_most_what() -> None:
    for low, high in ((-sp.oo, 3), (3, sp.oo), (-sp.oo, sp.oo), (3, 3), (3, sp.pi), (0, c), (-c, 0), (c, c + 1)):
        assert at_most(sp.sympify(low), sp.sympify(high))
    for low, high in ((sp.oo, 3), (3, -sp.oo), (sp.pi, 3), (c, 0), (q, q**2), (sp.oo, -sp.oo)):
        assert not at_most(sp.sympify(low), sp.sympify(high))


def test_the_range_of_a_pendulum_holds_its_well() -> None:
    """One period of the angle from barrier to barrier, and not from well to well, nor where the sign isn't known."""
    b = sp.Symbol("b", real=True)

    def found(strength: Any, low: Any, high: Any) -> list[ClosedAction]:
        return list(pendulum_like(orbit(E + strength * sp.cos(q), q, low, high)))

    assert found(c, -sp.pi, sp.pi)
    assert found(-c, 0, 2 * sp.pi)
    assert not found(c, 0, 2 * sp.pi)
    assert not found(-c, -sp.pi, sp.pi)
    assert not found(b, -sp.pi, sp.pi)
    assert not found(c, -sp.pi / 2, sp.pi / 2)


def test_a_power_passes_the_kink_of_its_absolute_value() -> None:
    (closed,) = power_well(orbit(E - c * sp.Abs(q)))
    assert closed.passes_zero


def test_linear_conditions_bound_the_range() -> None:
    conditions = [Condition("positive", (e,)) for e in (2 * q + c, 3 - q)]
    motion = one_degree(p**2 + q**2, q, p, E, conditions)
    assert (motion.low, motion.high) == (-c / 2, 3)
