"""Lie series and brackets in numbers: closed flows, radii of convergence, sums that cancel."""

import math

import mpmath as mp
import pytest
import sympy as sp

from canon import InputError
from canon.ball_precision import precision
from canon.mechanics.poisson import bracket_in
from canon.numeric.lie_sum import lie_sum, nested_bracket
from canon.numeric.values import value_at

q, p = sp.symbols("q p", real=True)
MOEBIUS = q**2 * p
PENDULUM = p**2 / 2 - sp.cos(q)


@pytest.mark.parametrize("s", [0.25, 0.9, 0.99, -0.99, -5.0])
def test_a_series_at_and_beyond_its_radius(s: float) -> None:
    """The flow of q²p takes q into q/(1 − sq)."""
    found = lie_sum(q, MOEBIUS, (q,), (p,), {q: 0.5, p: 0.3}, s)
    with mp.workdps(30):
        assert abs(found.value.value - mp.mpf(0.5) / (1 - mp.mpf(s) / 2)) <= found.value.bound
    assert found.value.bound < 4e-16 * abs(found.value.value)
    assert found.radius == pytest.approx(2, rel=1e-6)
    assert found.within(s) is (abs(s) < 2)
    assert "the series converges for |s| below about 2" in str(found)


def test_a_flow_that_ends_says_so() -> None:
    found = lie_sum(q, MOEBIUS, (q,), (p,), {q: 1.0, p: 0.3}, 1.5)
    assert math.isnan(found.value.value)
    assert found.value.bound == math.inf


def test_the_nearest_singularity_is_the_radius() -> None:
    """cn² has its poles at iK': for the pendulum from the bottom the radius is K(1 − k²), k = p/2."""
    found = lie_sum(q, PENDULUM, (q,), (p,), {q: 0.0, p: 1.0}, 0.1)
    assert found.radius == pytest.approx(float(mp.ellipk(0.75)), rel=0.05)


@pytest.mark.parametrize("order", [0, 1, 5])
def test_nested_brackets_are_those_that_sympy_multiplies_out(order: int) -> None:
    f, point = q * sp.exp(p), {q: 0.7, p: 0.3}
    found = nested_bracket(f, PENDULUM, (q,), (p,), point, order)
    for _ in range(order):
        f = bracket_in(f, PENDULUM, (q,), (p,))
    exact = sp.Float(f.subs({q: sp.Rational(0.7), p: sp.Rational(0.3)}).evalf(40), 40)
    assert abs(sp.Rational(found.value) - sp.Rational(exact)) <= found.bound
    assert found.bound < 1e-14


def test_a_series_that_ends() -> None:
    found = lie_sum(q, p**2 / 2, (q,), (p,), {q: 1.0, p: 0.5}, 1e6)
    assert found.value.value == 500001.0
    assert found.radius == math.inf
    assert found.pieces == 1


def test_values_in_as_many_bits_as_cancel() -> None:
    delta = sp.Symbol("delta")
    assert value_at((1 + delta) ** 2 - 1 - 2 * delta, {delta: 1e-100}).value == pytest.approx(1e-200, rel=1e-15)
    assert value_at(sp.exp(900 * q) * sp.exp(-900 * q + p), {q: 1.0, p: 0.0}).value == 1.0
    close = value_at(sp.sin(q) - q, {q: 1e-20})
    assert close.value == pytest.approx(-1e-60 / 6, rel=1e-15)


def test_what_is_refused() -> None:
    with pytest.raises(InputError, match="no value is given for p"):
        value_at(q * p, {q: 1.0})
    with pytest.raises(InputError, match="no finite value"):
        value_at(1 / q, {q: 0.0})
    with pytest.raises(InputError, match="has no value at this point"):
        lie_sum(sp.log(q), MOEBIUS, (q,), (p,), {q: -1.0, p: 1.0}, 0.1)


def test_a_sum_and_its_bound_do_not_depend_on_the_precision_of_others() -> None:
    alone = lie_sum(q, q**2 * p, (q,), (p,), {q: 1.0, p: 0.5}, 0.99)
    for bits in (20, 400):
        with precision(bits):
            assert lie_sum(q, q**2 * p, (q,), (p,), {q: 1.0, p: 0.5}, 0.99) == alone
