"""Elliptic actions: even quartics give the area, periods are the integrals, and so is Legendre's form."""

from typing import Any

import mpmath
import pytest
import sympy as sp

from canon.mechanics.elliptic_actions import elliptic
from canon.mechanics.legendre import S, decomposed
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.substitutions import integrands
from tests.mechanics.areas import CUBIC, HALF, QUARTIC, M, area, number, orbit, q, r, same, sure

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
