"""Enclosures of actions and periods against values known otherwise."""

from fractions import Fraction

import pytest
import sympy as sp
from flint import arb

from canon.budget import Budget
from canon.decide.enclosure import precision
from canon.decide.libration import BITS, Integrand, libration, stays
from canon.decide.orbit_mean import _with_momentum
from canon.decide.orbit_quadrature import action, backward_too, period, turn
from canon.decide.tape import Tape

Q, E = sp.symbols("q E", real=True)


def _integrand(square, energy, mean=sp.S.Zero, low=None, high=None):
    tape = Tape()
    nodes = tape.symbol(Q), tape.load(square), tape.load(mean)
    return Integrand(tape, *nodes, {tape.symbol(E): Fraction(energy)}, low, high)


@pytest.mark.parametrize(
    ("square", "energy", "inside", "J", "T"),
    [
        (2 * E - Q**2, 1, 0, "2*pi", "2*pi"),
        (2 * E - Q**2 - Q**4, 1, 0, None, None),
        (2 * (E + sp.cos(Q)), Fraction(1, 2), 0, "16*(elliptic_e(3/4) - elliptic_k(3/4)/4)", "4*elliptic_k(3/4)"),
        (2 * (E + sp.cos(Q)), Fraction(999, 1000), 0, "16*(elliptic_e(m) - elliptic_k(m)/2000)", None),
        (2 * E + 2 / Q - 1 / (4 * Q**2), Fraction(-1, 2), 1, "pi", "2*pi"),
    ],
)
def test_librations(square, energy, inside, J, T):
    integrand = _integrand(square, energy, low=Fraction(0) if square.has(1 / Q) else None)
    orbit = libration(integrand, Fraction(inside), Budget(10))
    assert orbit is not None
    exact = {"m": sp.Rational(1999, 2000), "elliptic_e": sp.elliptic_e, "elliptic_k": sp.elliptic_k}
    for found, text in ((action(integrand, orbit), J), (period(integrand, orbit, integrand.tape.symbol(E)), T)):
        if text is not None:
            value = sp.sympify(text, locals=exact).evalf(40)
            with precision(BITS):
                assert found.contains(arb(str(value)))
            assert float(found.rad()) < 1e-12 * abs(float(found.mid()))


def test_an_orbit_that_skips_a_narrow_barrier_is_not_one():
    barrier = 2 * E - Q**2 / 100 - sp.exp(-10000 * (Q - 3) ** 2)
    orbit = libration(_integrand(barrier, Fraction(1, 4)), Fraction(0), Budget(10))
    assert orbit is not None
    assert orbit.right < 3 < orbit.outer[1] + Fraction(1, 50)


def test_no_libration():
    assert libration(_integrand(2 * E + Q**2, 1), Fraction(0), Budget(10)) is None  # unbounded
    assert libration(_integrand(2 * E - Q**2, 1), Fraction(3), Budget(10)) is None  # outside
    assert libration(_integrand(2 * E - Q**2, 1, high=Fraction(1)), Fraction(0), Budget(10)) is None  # leaves the range


def test_rotations_and_conditions_along_an_orbit():
    integrand = _integrand(2 * (E + sp.cos(Q)), 2, mean=sp.S.One)
    whole = (Fraction(6), arb(0))
    turned = turn(integrand, Fraction(0), whole, Budget(10), None)
    with precision(BITS):
        assert abs(turned - arb("17.664930786486875")) < 1e-14
        rest = arb(2) ** -20
        almost = turn(integrand, Fraction(0), (6 - Fraction(1, 2**20), rest), Budget(10), None)
        assert almost.contains(turned)
        assert almost.rad() < 1e-11
    assert turn(_integrand(2 * (E + sp.cos(Q)), Fraction(1, 2)), Fraction(0), whole, Budget(10), None) is None
    assert not backward_too(integrand, Fraction(0), Fraction(6), Budget(10))
    fast = _integrand(2 * (E + sp.cos(Q)), 2, mean=sp.Integer(3))
    assert backward_too(fast, Fraction(0), Fraction(6), Budget(10))
    oscillator = _integrand(2 * E - Q**2, 1)
    orbit = libration(oscillator, Fraction(0), Budget(10))
    assert orbit is not None
    for least, expected in ((-1.5, True), (-1.4, False)):
        found = stays(oscillator, orbit.left, orbit.right, Budget(10), lambda q, p, least=least: p > least)
        assert found is expected


def test_the_time_of_a_rotation_is_the_derivative_of_its_action():
    """By the energy, on which the mean of the momentum's branches may depend too."""
    step = Fraction(1, 2**40)
    whole = (Fraction(6), arb(0))
    square, mean = 2 * (E + sp.cos(Q)), E / 3 + E**2 * sp.sin(Q) ** 2
    below, above = (turn(_integrand(square, 2 + k * step, mean), Fraction(0), whole, Budget(10), None) for k in (-1, 1))
    integrand = _integrand(square, 2, mean)
    time = turn(integrand, Fraction(0), whole, Budget(10), integrand.tape.symbol(E))
    with precision(BITS):
        assert abs((above - below) / (2 * arb(2) ** -40) - time) < 1e-9


def test_a_function_over_an_edge_has_all_its_values_there():
    integrand = _integrand(2 * E - Q**2, 1)
    momentum = integrand.tape.symbol(sp.Symbol("p", real=True))
    with precision(BITS):
        for near, far in ((-1, Fraction(6, 5)), (1, Fraction(7, 5))):
            place = _with_momentum(integrand, integrand.coordinate, momentum, Fraction(near), Fraction(far))
            assert place.contains(near)
            assert place.contains(arb(Fraction(far).numerator) / Fraction(far).denominator - arb(2) ** -60)
            both = _with_momentum(integrand, momentum, momentum, Fraction(near), Fraction(far))
            assert both.contains(1)
            assert both.contains(-1)
