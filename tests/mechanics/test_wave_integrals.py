"""Antiderivatives of rational functions of one wave: their derivative, and that they have no jumps."""

import pytest
import sympy as sp

from canon.mechanics.wave_integrals import wave_integrals

x, e = sp.Symbol("x", real=True), sp.Symbol("e", real=True)


@pytest.mark.parametrize(
    "f",
    [
        1 / (1 + e * sp.cos(x)),
        1 / (1 + e * sp.cos(x)) ** 3,
        1 / (-2 - e * sp.cos(x)),
        sp.cos(x) ** 2 / (3 + e * sp.cos(x)) ** 2,
        sp.sin(x) ** 2 / (1 - e * sp.cos(x)) ** 2,
        1 / (2 + sp.sin(3 * x + 1)),
        1 / (4 * sp.cos(x) ** 2 + e**2 * sp.sin(x) ** 2),
    ],
)
def test_the_derivative_and_no_jump_at_pi(f):
    found = list(wave_integrals(f, x))
    assert found
    for F in found:
        numbers = {e: sp.Rational(3, 7)}
        slope = sp.lambdify(x, (sp.diff(F, x) - f).subs(numbers), "math")
        assert max(abs(slope(0.37 * k - 5.1)) for k in range(28)) < 1e-12
        value = sp.lambdify(x, F.subs(numbers), "math")
        assert max(abs(value(0.01 * k + 0.01) - value(0.01 * k)) for k in range(700)) < 0.2


def test_none_of_what_is_no_such_function():
    for f in (sp.cos(x) * x, 1 / (1 + sp.cos(x) + sp.sin(x)), sp.cos(x) / (1 + sp.cos(2 * x)), sp.exp(sp.cos(x))):
        assert not list(wave_integrals(f, x))
