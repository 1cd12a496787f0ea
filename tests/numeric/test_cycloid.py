"""The fastest descent."""

from math import inf, pi, sqrt

import pytest

from canon.errors import InputError
from canon.numeric.cycloid import fastest_descent


def test_the_exercise_from_one_above_to_two_aside():
    """theta = 3.50837 and r = 0.51720 (course, exercise 2.1)."""
    found = fastest_descent(2, 1, g=1)
    assert found.angle == pytest.approx(3.5083687720, rel=1e-9)
    assert found.radius == pytest.approx(0.5172001, rel=1e-6)
    assert found.place(1) == pytest.approx((2, 1), rel=1e-15)
    assert found.time < found.straight == pytest.approx(sqrt(10))


@pytest.mark.parametrize("ratio", [1e-12, 1e-4, 0.3, pi / 2, 1.6, 50, 1e4])
def test_the_end_point_is_met(ratio):
    found = fastest_descent(ratio, 1)
    assert 0 < found.angle < 2 * pi
    assert found.place(1) == pytest.approx((ratio, 1), rel=1e-12)
    assert found.time < found.straight or ratio < 1e-7  # there the two times agree to the last digit


def test_special_cases():
    assert fastest_descent(pi, 2).angle == pytest.approx(pi, rel=1e-15)  # to the lowest point
    level = fastest_descent(1, 0, g=1)
    assert level.angle == 2 * pi
    assert level.time == pytest.approx(sqrt(2 * pi), rel=1e-15)
    assert level.straight == inf
    steep = fastest_descent(1e-9, 1, g=1)
    assert steep.time == pytest.approx(sqrt(2), rel=1e-9)  # nearly a free fall


@pytest.mark.parametrize(("across", "down", "g"), [(0, 1, 1), (1, -1, 1), (1, 1, 0), (inf, 1, 1)])
def test_faults(across, down, g):
    with pytest.raises(InputError):
        fastest_descent(across, down, g)
