"""Laws that orbits and their actions obey: branches lie on the orbit, motions exist where turning points do, areas."""

from fractions import Fraction
from itertools import product
from typing import Any

import mpmath
import pytest
import sympy as sp

from canon.domain import Condition
from canon.mechanics.action_angle import ClosedAction, NotQuadratic, OneDegree, at_most, one_degree
from canon.mechanics.closed_actions import librations
from canon.mechanics.elliptic_actions import elliptic
from canon.mechanics.legendre import S, decomposed
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.residues import by_residues
from canon.mechanics.separatrix_actions import SEPARATRIX, separatrix
from canon.mechanics.solved_momentum import solved_momentum
from canon.mechanics.standard_actions import pendulum_like, power_well, rotation
from canon.mechanics.substitutions import U, integrands

q, p, E = sp.symbols("q p E", real=True)
r = sp.Symbol("r", positive=True)
c = sp.Symbol("c", positive=True)
HALF = sp.Rational(1, 2)
M = sp.Rational(2, 7)


def orbit(square: Any, x: sp.Symbol = q, low: Any = -sp.oo, high: Any = sp.oo) -> OneDegree:
    return OneDegree(x, sp.sympify(square), sp.S.Zero, HALF, sp.sympify(low), sp.sympify(high))


def sure(expression: Any) -> bool:
    return bool(sp.sympify(expression).is_number and expression > 0)


def area(square: Any, x: sp.Symbol, low: Any, high: Any) -> Any:
    """2 ∫ √square dx between turning points."""
    root = sp.lambdify(x, square, "mpmath")
    with mpmath.workdps(25):
        middle, half = (mpmath.mpf(sp.N(s, 30)) / 2 for s in (sp.sympify(high) + low, sp.sympify(high) - low))
        f = lambda t: mpmath.sqrt(abs(root(middle + half * mpmath.sin(t)))) * half * mpmath.cos(t)  # noqa: E731
        return 2 * mpmath.quad(f, [-mpmath.pi / 2, 0, mpmath.pi / 2])


FUNCTIONS = {"EllipticPi": mpmath.ellippi, "elliptic_k": mpmath.ellipk, "elliptic_e": mpmath.ellipe}


def number(closed: Any) -> Any:
    with mpmath.workdps(25):
        return sp.lambdify((), closed, [FUNCTIONS, "mpmath"])()


def same(closed: Any, value: Any) -> bool:
    return abs(number(closed) - value) < 1e-15 * abs(value)


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


WELLS: list[tuple[Any, Any, Any, Any, Any]] = [
    (3 + 2 * q**2 - q**4, -sp.oo, sp.oo, -sp.sqrt(3), sp.sqrt(3)),
    (3 - 2 * q**2 - 5 * q**4, -sp.oo, sp.oo, -sp.sqrt(sp.Rational(3, 5)), sp.sqrt(sp.Rational(3, 5))),
    (5 * r**2 - 4 - r**4, 0, sp.oo, 1, 2),
    (7 * r**2 - 3 * r**4, 0, sp.oo, 0, sp.sqrt(sp.Rational(7, 3))),
    (4 - 5 * q**2 + q**4, -sp.oo, sp.oo, -1, 1),
    (2 - 8 * q**2 + 8 * q**4, -sp.oo, sp.oo, -sp.sqrt(HALF), sp.sqrt(HALF)),
]


@pytest.mark.parametrize(("square", "low", "high", "left", "right"), WELLS)
def test_even_quartics_give_the_area(square: Any, low: Any, high: Any, left: Any, right: Any) -> None:
    """One well, two of which the right one is asked for, a well between hills, and both separatrices."""
    (x,) = square.free_symbols
    closed = next(quartic_wells(orbit(square, x, low, high)))
    assert same(closed.value, area(square, x, left, right))
    assert all(e > 0 for e in closed.exists)


def test_an_even_quartic_beside_a_barrier_is_taken_on_one_side_of_it() -> None:
    square = 5 * q**2 - 4 - q**4
    assert not list(quartic_wells(orbit(square)))  # two wells, and none is named
    closed = next(quartic_wells(orbit(square), sure, sp.Rational(3, 2)))
    assert same(closed.value, area(square, q, 1, 2))


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


CUBIC, QUARTIC = (q - 1) * (q - 2) * (q - 4), (q - 1) * (q - 2) * (q - 4) * (q - 7)
PERIODS: list[tuple[Any, Any, Any, Any]] = [
    (sp.Integer(2), CUBIC, 1, 2),
    (sp.Integer(2), QUARTIC, 2, 4),
    (2 / (q + 3), QUARTIC, 2, 4),
    (2 * (q + 3), -CUBIC, 2, 4),
]


@pytest.mark.parametrize(("rate", "square", "low", "high"), PERIODS)
def test_elliptic_periods_are_the_integrals(rate: Any, square: Any, low: Any, high: Any) -> None:
    """The period is ∂J/∂E = ∫ rate/√square dq."""
    motion = orbit(square)
    closed = next(elliptic(motion, integrands(motion), sure, None, rate))
    rest = sp.cancel(square / ((q - low) * (high - q)))
    slow = sp.lambdify(q, rate / sp.sqrt(rest), "mpmath")  # with q = middle + half sin t the ends are regular
    with mpmath.workdps(25):
        middle, half = mpmath.mpf(low + high) / 2, mpmath.mpf(high - low) / 2
        value = mpmath.quad(lambda t: slow(middle + half * mpmath.sin(t)), [-mpmath.pi / 2, 0, mpmath.pi / 2])
    assert abs(number(closed.period) - value) < 1e-12 * value
    for _, zero in closed.vanishes:
        assert abs(sp.N(zero.xreplace(dict.fromkeys(zero.free_symbols, sp.Rational(3, 11))), 30)) < 1e-20


def test_elliptic_roots_count_by_their_order_beside_a_well() -> None:
    """Of two allowed intervals the one that holds the point, from either side."""
    square = -(q - 1) * (q - 2) * (q - 4) * (q - 7)
    motion = orbit(square)
    for well, low, high in ((sp.Rational(3, 2), 1, 2), (sp.Integer(5), 4, 7)):
        closed = next(elliptic(motion, integrands(motion), sure, well))
        assert same(closed.value, area(square, q, low, high))
    assert not list(elliptic(motion, integrands(motion), sure, sp.Integer(3)))


def test_linear_conditions_bound_the_range() -> None:
    conditions = [Condition("positive", (e,)) for e in (2 * q + c, 3 - q)]
    motion = one_degree(p**2 + q**2, q, p, E, conditions)
    assert (motion.low, motion.high) == (-c / 2, 3)


def by_sine(R: Any, m: Any) -> Any:
    """∫ R/√(s(1 − s)(1 − ms)) ds from 0 to 1, by s = sin²φ."""
    f = sp.lambdify(S, R / sp.sqrt(1 - m * S), "mpmath")
    with mpmath.workdps(25):
        return mpmath.quad(lambda t: 2 * f(mpmath.sin(t) ** 2), [0, mpmath.pi / 4, mpmath.pi / 2])


@pytest.mark.parametrize(
    ("constant", "shape"),
    [
        (1, {S: 1}),
        (3, {S: 4, 1 - S: 1}),
        (2, {1 + S / 3: -1, S: 2}),
        (2, {1 + S / 3: -2}),
        (1, {1 + S / 3: -4, S: 1, 1 - S: 1}),
        (1, {1 - M * S: -1}),
        (1, {1 - M * S: -3, 1 - S: 2}),
        (1, {1 - M * S: -1, 1 + 2 * S: -2, 1 - S / 5: -1, S: 5}),
    ],
)
def test_legendres_form_is_the_integral(constant: Any, shape: dict[Any, int]) -> None:
    """Powers and poles of every order, at 1/m too; what is to vanish does at a point, and not for 1001/1000 of R."""
    found = decomposed({sp.Integer(constant): 1} | shape, M)
    assert found is not None
    parts, rest = found
    R = constant * sp.Mul(*(f**e for f, e in shape.items()))
    assert same(sum(f * e for f, e in parts.items()), by_sine(R, M))
    at = {S: sp.Rational(3, 11)}
    assert sp.sympify(rest).xreplace(at) == 0
    assert (rest + R / 1000).xreplace(at) != 0


@pytest.mark.parametrize("shape", [{1 + S**2: -1}, {S**2 + S + 1: -1, S: 1}, {(1 + S**2) * (1 + S): -1}])
def test_poles_that_are_not_real_have_no_legendre_form(shape: dict[Any, int]) -> None:
    assert decomposed(shape, M) is None


LOOPS: list[tuple[Any, Any, Any, Any, Any, Any]] = [
    # p², the range, a point inside, the ends of the loop
    ((q - 2) ** 2 * (q + 1), -sp.oo, sp.oo, None, -1, 2),
    ((q + 2) ** 2 * (1 - q), -sp.oo, sp.oo, None, -2, 1),
    (3 * (q - 1) ** 2 * (q + 1) * (q + 4), -sp.oo, sp.oo, None, -1, 1),
    ((q - 1) ** 2 * (q - 3) * (q - 4), -sp.oo, sp.oo, None, 1, 3),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 2, 1, 4),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, -1, -2, 1),
    ((q - 1) ** 2 * (4 - q) * (q + 2), 1, sp.oo, None, 1, 4),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -3, 1, None, -2, 1),
    ((q - 2) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 3, 2, 4),
    (3 * (q - 2) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 0, -2, 2),
    ((q - 1) ** 4 * (4 - q) * (q + 2), 1, sp.oo, None, 1, 4),
    ((q - 1) ** 6 * (4 - q), -sp.oo, sp.oo, None, 1, 4),
]


@pytest.mark.parametrize(("square", "low", "high", "well", "left", "right"), LOOPS)
def test_loops_at_a_double_root_give_the_area(
    square: Any, low: Any, high: Any, well: Any, left: Any, right: Any
) -> None:
    motion = orbit(square, q, low, high)
    closed = next(separatrix(motion, integrands(motion), allowed, None if well is None else sp.Integer(well)))
    assert all(sure(need) for need in closed.needs)
    with mpmath.workdps(25):
        root = sp.lambdify(q, square, "mpmath")
        half = mpmath.mpf(right - left) / 2
        f = lambda x: 2 * mpmath.sqrt(abs(root(left + x)))  # noqa: E731
        value = mpmath.quad(f, [0, half, 2 * half])
        assert abs(mpmath.mpf(sp.N(closed.value, 25)) - value) < 1e-9 * value
    for _, zero in closed.vanishes:
        assert sp.expand(zero) == 0


def allowed(expression: Any) -> bool:
    """Whether it is positive for every positive value of names in it that are small."""
    value = sp.sympify(expression)
    return bool(value.xreplace(dict.fromkeys(value.free_symbols, sp.Rational(1, 10**6))) > 0)


@pytest.mark.parametrize(
    ("square", "low", "high", "well"),
    [
        ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, None),  # two loops
        ((q - 1) ** 2 * (4 - q) * (q + 2), -3, 5, None),
        ((q - 1) ** 2 * (4 - q) * (q + 2), 1, 3, None),  # the range cuts it
        ((q - 1) ** 2 * (4 - q) * (q + 2), -1, 1, None),
        ((q - 2) ** 2 * (q + 1), 0, sp.oo, None),
        ((q - 2) ** 2 * (q + 1), -sp.oo, sp.oo, 3),  # a point outside of the loop
        ((q - 1) ** 2 * (q**2 + 1), -sp.oo, sp.oo, None),  # no other root
        ((q - 1) ** 2 * (q - 4) * (q + 2), -sp.oo, sp.oo, None),  # the double root lies in a hill
        ((q - 1) ** 2 * (q - 2) ** 2 * (4 - q), -sp.oo, sp.oo, None),  # two double roots
    ],
)
def test_loops_that_are_none(square: Any, low: Any, high: Any, well: Any) -> None:
    motion = orbit(square, q, low, high)
    assert not list(separatrix(motion, integrands(motion), allowed, None if well is None else sp.Integer(well)))


def test_no_loop_where_the_point_lies_beyond_the_other_root() -> None:
    """Right of 4, and of 1, where p² = (q − 1)²(q − 3)(q − 4) is positive, its loop is not."""
    motion = orbit((q - 1) ** 2 * (q - 3) * (q - 4))
    assert not list(separatrix(motion, integrands(motion), allowed, sp.Integer(5)))
    assert not list(separatrix(motion, integrands(motion), allowed, sp.Integer(0)))


@pytest.mark.parametrize(
    "H",
    [
        sp.sqrt(p**2 + c**2) + q**2,
        sp.cosh(p) - sp.cos(q),
        sp.exp(p**2 / 2) / 3 + q**4,
        p**4 / 4 + c * p**2 + q**2,
        2 * p**4 + q**2,
        (c * p**2 + 2 * p**2) / 3 + q,
        c * (p**2 + 1) ** sp.Rational(3, 2) + q**2,
        3 * sp.cosh(sp.sqrt(2) * p) * c + q**2,
        sp.sqrt(1 + sp.exp(p**2)) + sp.Abs(q),
    ],
)
def test_a_solved_momentum_lies_on_the_orbit(H: Any) -> None:
    """H(q, √(p²)) = E, where the guards are positive; the level stands for the energy."""
    found = solved_momentum(H, q, p, E)
    at = {q: sp.Rational(1, 3), c: sp.Rational(1, 2), E: 5}
    assert all(guard.xreplace(at) > 0 for guard in found.guards)
    square = found.motion.square.xreplace(at)
    assert square > 0
    assert abs(sp.N(H.xreplace(at).xreplace({p: sp.sqrt(square)}) - 5, 20)) < 1e-15
    assert found.of_level.xreplace({found.level: E}) == found.motion.square
    assert found.motion.mean == 0


def test_a_guard_that_fails_says_that_there_is_no_motion() -> None:
    """√(p² + 1) = E has none for E < 0, cosh p = E none for E < 1, exp(p²) = E none for E ≤ 0."""
    for H, energy in ((sp.sqrt(p**2 + 1), -2), (sp.cosh(p), HALF), (sp.exp(p**2), -1)):
        found = solved_momentum(H + 0 * q, q, p, sp.sympify(energy))
        assert any(guard <= 0 for guard in found.guards)


@pytest.mark.parametrize(
    "H", [p**3 + q, p**4 - p**2 + q**2, p**4 + p**2 * q, p**6 + p**2, p**6 + p**4 + p**2, sp.cos(p), -(p**4), c - p]
)
def test_momenta_that_are_not_solved_for(H: Any) -> None:
    """Odd in p, several branches, or none that is known to be one."""
    with pytest.raises(NotQuadratic):
        solved_momentum(H, q, p, E)


def test_the_range_of_a_solved_momentum() -> None:
    found = solved_momentum(sp.cosh(p) + q, q, p, E, [Condition("positive", (q - 1,))])
    assert (found.motion.low, found.motion.high) == (1, sp.oo)
