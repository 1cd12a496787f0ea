"""Deflection by quadrature against closed forms, forward and backward; cross-sections; what is not scattered."""

from math import pi, sqrt

import numpy as np
import pytest

from canon.numeric.deflection import cross_section, deflection, rutherford, rutherford_cross_section


def coulomb(k: float):
    return (lambda r: k / r), (lambda r: -k / r**2)


@pytest.mark.parametrize(("k", "b"), [(1.0, 1e-7), *((k, b) for k in (1.0, -1.0) for b in (0.1, 1.0, 1e3, 1e8))])
def test_coulomb_keeps_its_digits_forward_and_backward(k: float, b: float) -> None:
    """Ledger sec-9.3.1-a, exercise-9.5: cot(χ/2) = 2Eb/k."""
    E = 0.7
    exact, found = rutherford(k, E, b), deflection(*coulomb(k), E, b, 20 * max(b, 1.0))
    assert found is not None
    assert found.angle == pytest.approx(exact.angle, rel=3e-15)
    assert found.backward == pytest.approx(exact.backward, rel=1e-14 if k > 0 else 1e-13)
    assert found.nearest == pytest.approx(exact.nearest, rel=1e-15)
    sigma = cross_section(lambda each: deflection(*coulomb(k), E, each, 20 * max(b, 1.0)), b, found.nearest)
    assert sigma == pytest.approx(rutherford_cross_section(k, E, b), rel=1e-9)


def test_rutherford_has_the_digits_of_the_limits() -> None:
    """Ledger E34, sec-9.3.1-b: (k/4E)²/sin⁴(χ/2), without a π; χ ≈ k/(Eb) far out, π − χ ≈ 4Eb/k close in."""
    k, E = 1.3, 0.4
    assert rutherford(k, E, 1e8).angle == pytest.approx(k / (E * 1e8), rel=1e-15)
    assert rutherford(k, E, 1e-9).backward == pytest.approx(4 * E * 1e-9 / k, rel=1e-15)
    for b in (0.3, 2.0):
        found = rutherford(k, E, b)
        assert rutherford_cross_section(k, E, b) == pytest.approx((k / 4 / E) ** 2 / np.sin(found.angle / 2) ** 4)
        assert found.angle + found.backward == pytest.approx(pi, rel=1e-15)


@pytest.mark.parametrize(("c", "b"), [(0.5, 1e-3), (0.5, 1.0), (0.5, 1e5), (-0.3, 0.8), (-0.3, 10.0)])
def test_inverse_squares(c: float, b: float) -> None:
    """V = c/r²: χ = π(1 − b/√(b² + c/E)), here without its cancellation. Landau and Lifshitz, §19, problem 3."""
    E = 1.0
    found = deflection(lambda r: c / r**2, lambda r: -2 * c / r**3, E, b, 20 * max(b, 1.0))
    s = sqrt(b * b + c / E)
    assert found is not None
    assert found.angle == pytest.approx(pi * (c / E) / (s * (s + b)), rel=2e-15)
    assert found.backward == pytest.approx(pi * b / s if c > 0 else pi - pi * -(c / E) / (s * (s + b)), rel=3e-15)


def test_hard_repulsion_scatters_like_a_sphere() -> None:
    """V = r^−400 is a sphere of radius 1, nearly: dσ/dΩ = 1/4 in all directions. Landau and Lifshitz, §18."""
    of = lambda b: deflection(lambda r: r**-400.0, lambda r: -400 * r**-401.0, 1.0, b, 5.0)
    for b in (0.0, 0.3, 0.7):
        found = of(b)
        assert found is not None
        assert found.angle == pytest.approx(2 * np.arccos(b), abs=0.02)
        assert cross_section(of, b, 1.0) == pytest.approx(0.25, rel=0.05)


def test_what_is_not_scattered() -> None:
    attracted = lambda E, b, begin=5.0: deflection(*coulomb(-1.0), E, b, begin)
    assert attracted(-0.1, 1.0) is None
    assert attracted(0.5, 0.0) is None
    assert deflection(lambda r: -2 / r**2, lambda r: 4 / r**3, 1.0, 1.0, 5.0) is None
    inside_a_wall = lambda r: 9 * np.exp(-((r - 10) ** 2))
    assert deflection(inside_a_wall, lambda r: -2 * (r - 10) * inside_a_wall(r), 1.0, 0.5, 5.0) is None
