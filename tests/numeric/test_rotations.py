"""Euler angles of attitudes and back, at gimbal lock too; kinetic energy of slow and fast particles."""

import mpmath as mp
import numpy as np
import pytest

from canon.numeric.precision import double
from canon.numeric.relativity import kinetic_energy, momentum_of
from canon.numeric.rotations import from_euler, momentum_in_body, to_euler


@pytest.mark.parametrize("theta", [1e-150, 1e-9, 0.3, 3.0, np.pi - 1e-9])
@pytest.mark.parametrize(("phi", "psi"), [(0.7, 0.4), (-2.5, 3.0), (3.1, 3.1)])
def test_euler_angles_there_and_back(phi: float, theta: float, psi: float) -> None:
    with double():
        found = [float(angle) for angle in to_euler(from_euler(phi, theta, psi))]
    assert found == pytest.approx([phi, theta, psi], rel=1e-6 if theta > 3.1 else 1e-14)


def test_one_angle_is_left_where_the_axes_coincide() -> None:
    with double():
        phi, theta, psi = (float(angle) for angle in to_euler(from_euler(0.7, 0.0, 0.4)))
    assert (theta, psi) == (0.0, 0.0)
    assert phi == pytest.approx(1.1)


@pytest.mark.parametrize(("theta", "p_phi"), [(0.5, 0.3), (2.9, -1.4), (1e-6, 1.3), (np.pi - 1e-6, -1.3)])
def test_momenta_of_a_top_in_its_frame(theta: float, p_phi: float) -> None:
    """Goldstein, Poole and Safko (2002), 5.7, in fifty digits."""
    psi, p_theta, p_psi = 0.4, 0.2, 1.3
    with double(), mp.workdps(50):
        found = momentum_in_body(theta, psi, p_phi, p_theta, p_psi)
        along = (p_phi - p_psi * mp.cos(theta)) / mp.sin(theta)
        exact = [along * mp.sin(psi) + p_theta * mp.cos(psi), along * mp.cos(psi) - p_theta * mp.sin(psi), p_psi]
    # next to π the angle itself is known to a part of 1e-10 of its distance
    assert [float(x) for x in found] == pytest.approx([float(x) for x in exact], rel=1e-9 if theta > 3 else 2e-15)


@pytest.mark.parametrize("p", [1e-10, 1e-3, 1.0, 1e10])
def test_kinetic_energy_and_momentum(p: float) -> None:
    m, c = 0.7, 3.0
    with mp.workdps(60):
        exact = mp.sqrt((mp.mpf(p) * c) ** 2 + mp.mpf(m) ** 2 * c**4) - mp.mpf(m) * c**2
    with double():
        T = float(kinetic_energy(p, m=m, c=c))
        assert float(kinetic_energy(-p, m=m, c=c)) == T
        assert float(momentum_of(T, m=m, c=c)) == pytest.approx(p, rel=1e-15)
    assert pytest.approx(float(exact), rel=5e-16) == T
