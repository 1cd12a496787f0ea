"""Picard's iteration."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.picard import picard

t, x, y, k, a = sp.symbols("t x y k a", real=True)
Q = sp.Rational


def test_the_riccati_equation():
    """x' = x² + t²: t³/3, + t⁷/63, + 2 t¹¹/2079 + t¹⁵/59535 (course, 13.5)."""
    steps = picard(x**2 + t**2, x, t, 0, 3)
    assert steps[1] == (t**3 / 3,)
    assert steps[2] == (t**3 / 3 + t**7 / 63,)
    assert steps[3] == (t**3 / 3 + t**7 / 63 + Q(2, 2079) * t**11 + t**15 / 59535,)


def test_partial_sums_of_the_exponential_from_another_time():
    (last,) = picard(k * x, x, t, a, 4, start=1)[-1]
    assert sp.expand(last - a * sum((k * (t - 1)) ** n / sp.factorial(n) for n in range(5))) == 0


def test_the_oscillator():
    steps = picard([y, -x], [x, y], t, [1, 0], 5)
    assert steps[-1] == (1 - t**2 / 2 + t**4 / 24, -t + t**3 / 6 - t**5 / 120)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: picard(sp.exp(x), x, t, 0, 1), "no polynomial"),
        (lambda: picard([x, y], [x], t, [0], 1), "2 rates"),
        (lambda: picard(x, x, t, t, 1), "initial"),
        (lambda: picard(x, x, t, 0, -1), "steps: a whole number is needed, at least 0"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
