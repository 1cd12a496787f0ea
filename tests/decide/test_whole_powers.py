"""Whole powers of balls, about 0 too."""

import pytest
from flint import acb, arb

from canon.decide.enclosure import whole_power


@pytest.mark.parametrize("ball", [arb(0, 0.5), arb(0.25, 0.5), arb(3, 0.5), arb(-3, 0.5), arb(0), acb(0, arb(0, 0.5))])
@pytest.mark.parametrize("exponent", [1, 2, 3, 7])
def test_the_power_of_a_ball_holds_the_powers_of_its_points(ball, exponent):
    value = whole_power(ball, exponent)
    assert value.is_finite()
    middle = ball.mid()
    assert (value - middle**exponent if middle != 0 else value).contains(0)
    assert abs(value).abs_upper() <= (abs(ball).abs_upper() + arb(1e-9)) ** exponent * 3
