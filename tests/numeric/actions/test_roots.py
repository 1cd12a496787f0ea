"""Zeros between two places, and how much is asked for them."""

import flint
import pytest
import sympy as sp
from flint import arb

from canon.numeric.actions import landscape
from canon.numeric.actions.balls import precision
from canon.numeric.actions.motion import motion
from canon.numeric.actions.roots import zero_between


@pytest.mark.parametrize(
    ("function", "slope", "zero", "most"),
    [
        (lambda x: x.sin(), lambda x: x.cos(), arb.pi, 40),
        (lambda x: x * x - 10, lambda x: 2 * x, lambda: arb(10).sqrt(), 40),
        (lambda x: (x - 3) ** 3, lambda x: 3 * (x - 3) ** 2, lambda: arb(3), 1000),  # by halving
        (lambda x: (x - 3).exp() - (3 - x).exp() * 2, lambda x: (x - 3).exp() + (3 - x).exp() * 2,
         lambda: 3 + arb(2).log() / 2, 40),
    ],
)  # fmt: skip
def test_newton_ends_where_it_has_arrived(function, slope, zero, most):
    """Though it comes from one side, so that the other end of the bracket stays where it was."""
    asked = []

    def counted(x):
        asked.append(x)
        return function(x)

    with precision(128):
        found = zero_between(counted, slope, arb(2), arb(4))
        assert found.overlaps(zero())
        assert found.rad() < 1e-30
        assert len(asked) < most
        assert flint.ctx.prec == 128


def test_of_thousands_of_wells_those_far_off_are_told_by_their_height():
    """V = (q²/2 − 1)(2 + cos q) has critical points in each stretch that is looked at: few need a place."""
    q, p = sp.symbols("q p", real=True)
    orbits = motion((p**2 / 2 + q**2 / 2 - 1) * (2 + sp.cos(q)), q, p)
    assert len(orbits.nodes) > 1000
    landscape._place.cache_clear()
    ((low, high),) = orbits.librations(0)
    assert abs(low + 2**0.5) < 1e-15
    assert abs(high - 2**0.5) < 1e-15
    assert landscape._place.cache_info().misses < 200
