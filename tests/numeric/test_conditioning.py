"""What docstrings state of conditioning, where it is a number: measured by moving what goes in."""

import jax
import mpmath as mp
import numpy as np
import pytest

from canon.numeric.exact import carlson
from canon.numeric.groups import se3
from canon.numeric.precision import double

STEP = 1e-6
POINTS = [(0.3, 1.0, 2.0, 0.7), (1e-8, 1.0, 1e6, 0.7), (1.0, 1.0, 1.0 + 1e-3, 0.7)]


def total(function, arguments) -> np.ndarray:
    """Σ |∂ ln f/∂ ln x| by central differences, at all points at once."""
    found = 0.0
    for k, x in enumerate(arguments):
        up, down = ([*arguments[:k], x * factor, *arguments[k + 1 :]] for factor in (1 + STEP, 1 - STEP))
        found = found + np.abs(np.log(function(*up)) - np.log(function(*down))) / (2 * STEP)
    return found


def test_carlsons_integrals_do_not_amplify():
    x, y, z, p = np.array(POINTS).T
    with double():
        r_f, r_j = jax.jit(carlson.carlson_rf), jax.jit(carlson.carlson_rj)
        assert total(r_f, (x, y, z)) == pytest.approx(1 / 2, abs=1e-6)
        assert total(r_j, (x, y, z, p)) == pytest.approx(3 / 2, abs=1e-6)
        assert np.asarray(r_f(x, y, z)) == pytest.approx([float(mp.elliprf(*at[:3])) for at in POINTS], rel=1e-14)


@pytest.mark.parametrize("angle", [1e-9, 1.0, 3.0, np.pi])
def test_translations_of_twists_have_the_condition_that_is_stated(angle):
    with double():
        omega = angle * np.array([2.0, 3.0, 6.0]) / 7
        matrix = np.stack([np.asarray(se3.exp(omega, v)[1]) for v in np.eye(3)], axis=1)
    assert np.linalg.cond(matrix) == pytest.approx((angle / 2) / np.sin(angle / 2), rel=1e-12)
    assert np.linalg.cond(matrix) <= np.pi / 2 + 1e-12
