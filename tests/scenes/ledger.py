"""What the ledger says of each system that moves, as formulas and equations of motion written down by hand.

Nothing here is canon's: closed forms are textbooks' (with their period, rate or frequency written out), and where there
is none, Newton's, Lorentz's or Euler's equations are solved by scipy's DOP853 in coordinates that canon's scene doesn't
use, as far as there are such. All of them are for the scene files that `canon scenes NAME` prints.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.special import ellipj, ellipk, ellipkinc, gamma, jv

from tests.scenes.ledger_forces import (
    bead_on_a_curve,
    central_potential,
    coulomb_scattering,
    coupled_oscillators,
    damped_oscillator,
    forced_oscillator,
    free_particle,
    harmonic_oscillator,
    inverse_square_potential,
    isotropic_oscillator,
    kepler,
    linear_chain,
    pendulum,
    physical_pendulum,
    power_law_well,
    rotating_hoop,
    spherical_pendulum,
    spring_on_a_cart,
    three_body,
    two_body,
    uniform_gravity,
)
from tests.scenes.textbook import Array, axis_of, columns, solved, top

Rows = tuple[Array, Array, Array]
"""Times (samples,), q and p (samples, n)."""


def charge_in_uniform_fields(t: Array, q: Array, p: Array) -> Any:
    """ω = q B/m, radius m v/(q B) = 1/2."""
    place = columns(1.5 - 0.5 * np.cos(t), 0.5 * np.sin(t), 0.05 * t**2)
    guiding = columns(p[:, 0] - q[:, 1] / 2, p[:, 1] + q[:, 0] / 2)
    return {
        "cyclotron and fall": (q, place),
        "guiding centre": (guiding, np.array([0.0, 1.5])),
        "p_z − qEt": (p[:, 2] - 0.1 * t, 0.0),
    }


def charge_in_general_fields(t: Array, q: Array, p: Array) -> Any:
    """Lorentz's force with B = rot A = (−xz, −yz, 1 + z²) and E = (0, 0, −z/10)."""

    def rates(_: float, y: Array) -> Array:
        x, v = y[:3], y[3:]
        B = np.array([-x[0] * x[2], -x[1] * x[2], 1 + x[2] ** 2])
        return np.concatenate([v, np.array([0, 0, -x[2] / 10]) + np.cross(v, B)])

    made = solved(t, rates, [1, 0, 0, 0, 0.5, 0.1])
    return {
        "Lorentz's force": (q, made[:, :3]),
        "speed": (made[:, 3] ** 2 + made[:, 4] ** 2 + made[:, 5] ** 2 + made[:, 2] ** 2 / 10, 0.26),
    }


def free_symmetric_top(t: Array, q: Array, p: Array) -> Any:
    """The axis goes round M, which stays where it is, at the rate |M|/I1."""
    made = top(t, q[0], p[0], 1.0, 1.5, 0.0)
    e, M = made[0, :3], made[0, 3:6]
    size = np.linalg.norm(M)
    n, turn = M / size, (size * t)[:, None]
    round_M = e * np.cos(turn) + np.cross(n, e) * np.sin(turn) + n * (n @ e) * (1 - np.cos(turn))
    square = p[:, 0] ** 2 + (p[:, 1] - p[:, 2] * np.cos(q[:, 0])) ** 2 / np.sin(q[:, 0]) ** 2 + p[:, 2] ** 2
    return {
        "precession |M|/I1": (axis_of(q[:, 0], q[:, 1]), round_M),
        "ψ": (q[:, 2], made[:, 6]),
        "M²": (square, size**2),
    }


def heavy_symmetric_top(t: Array, q: Array, p: Array) -> Any:
    made = top(t, q[0], p[0], 1.0, 1.5, 9.81 * 0.2)
    u = made[:, 2]
    energy = (p[0, 1] - 4 * np.cos(0.5)) ** 2 / np.sin(0.5) ** 2 / 2 + 9.81 * 0.2 * np.cos(0.5)
    cubic = 2 * (1 - u * u) * (energy - 9.81 * 0.2 * u) - (3 - 4 * u) ** 2
    return {
        "Ṁ = −m g l e₃ × z": (axis_of(q[:, 0], q[:, 1]), made[:, :3]),
        "ψ": (q[:, 2], made[:, 6]),
        "nutation: p_θ² sin² θ is the cubic": ((p[:, 0] * np.sin(q[:, 0])) ** 2, cubic),
        "M_z, M_3": (p[:, 1:], np.array([3.0, 4.0])),
    }


def optical_rays(t: Array, q: Array, p: Array) -> Any:
    """n cos α = h is constant (Snell), and y'' = n n_y/h²."""
    h2 = (1.5 - 0.025) ** 2 - 0.04
    made = solved(t, lambda _, y: [y[1], -(1.5 - y[0] ** 2 / 10) * y[0] / 5 / h2], [0.5, 0.2 / np.sqrt(h2)])
    return {"the ray's equation": (q[:, 0], made[:, 0]), "p = h y'": (p[:, 0], made[:, 1] * np.sqrt(h2))}


def brachistochrone(t: Array, q: Array, p: Array) -> Any:
    """A cycloid h = (1 − cos φ)/2k, x = (φ − sin φ)/2k with k = 2 g p²."""
    k = 2 * 9.81 * 0.15**2
    angle = np.arccos(1 - 2 * k * t)
    x = (angle - np.sin(angle)) / (2 * k)
    return {"cycloid": (q[:, 0], x - x[0]), "p": (p[:, 0], 0.15)}


def relativistic_particle(t: Array, q: Array, p: Array) -> Any:
    made = solved(t, lambda _, y: [y[1] / np.sqrt(1 + y[1] ** 2), -y[0]], [1.0, 0.0])
    return {"ṗ = −q, p = γ m v": (columns(q[:, 0], p[:, 0]), made)}


def relativistic_charge(t: Array, q: Array, p: Array) -> Any:
    """ω = q B/(γ m)."""
    factor = np.sqrt(1 + 0.25 + 0.01)
    w = 1 / factor
    place = columns(1.5 - 0.5 * np.cos(w * t), 0.5 * np.sin(w * t), 0.1 * t / factor)
    return {"cyclotron at q B/(γ m)": (q, place)}


def rotating_frame(t: Array, q: Array, p: Array) -> Any:
    """Coriolis's and the centrifugal force, of velocities p/m − Ω × r."""
    W = 0.3

    def rates(_: float, y: Array) -> Array:
        x, z, u, v = y
        fx, fy = -(x + 2 * x * z / 5), -(z + x * x / 5)
        return np.array([u, v, fx + 2 * W * v + W * W * x, fy - 2 * W * u + W * W * z])

    made = solved(t, rates, [1, 0, 0, 0.5 - W])
    return {"Coriolis": (columns(*q.T, p[:, 0] + W * q[:, 1], p[:, 1] - W * q[:, 0]), made)}


def asymmetric_top(t: Array, q: Array, p: Array) -> Any:
    """Euler's equations in Jacobi's functions, Landau and Lifshitz § 37: M² < 2E I2, so axes 1 and 3 change places."""
    I1, I2, I3 = 2.7, 2.0, 1.0
    square, energy = 0.09 + 5.76 + 0.25, 0.09 / I3 + 5.76 / I2 + 0.25 / I1
    rate = np.sqrt(abs((I3 - I2) * (square - energy * I1) / (I1 * I2 * I3)))
    k2 = (I2 - I1) * (energy * I3 - square) / ((I3 - I2) * (square - energy * I1))
    size = np.sqrt(abs(I2 * (energy * I3 - square) / (I3 - I2)))
    made = solved(t, lambda _, M: np.cross(M, M / np.array([1.0, 2.0, 2.7])), [0.3, 2.4, -0.5])
    # Ṁ2 = (1/I1 − 1/I3) M1 M3 of the first state, the axes in their order: M2 grows or falls at first
    phase = ellipkinc(np.arcsin(2.4 / size), k2)
    phase = phase if (1 / 1.0 - 1 / 2.7) * 0.3 * -0.5 > 0 else 2 * ellipk(k2) - phase
    sn = ellipj(np.mod(rate * t + phase, 4 * ellipk(k2)), k2)[0]
    return {
        "Euler's equations": (p, made),
        "M2 = sn(τ), period 4K/rate": (p[:, 1], size * sn),
        "M²": (np.sum(p**2, axis=1), square),
    }


def skate_on_an_incline(t: Array, q: Array, p: Array) -> Any:
    """v = (g/w) sin wt: no descent on the average, and a drift across."""
    return {"cycloid": (q[:, :2], columns(np.sin(t) ** 2 / 2, (t - np.sin(t) * np.cos(t)) / 2))}


def riccati_flow(t: Array, q: Array, p: Array) -> Any:
    """x = t J_3/4(t²/2)/J_−1/4(t²/2), p = u² where x = −u'/u."""
    later = t[1:]
    u = gamma(0.75) / np.sqrt(2) * np.sqrt(later) * jv(-0.25, later**2 / 2)
    x = later * jv(0.75, later**2 / 2) / jv(-0.25, later**2 / 2)
    return {"Bessel's quotient": (q[1:, 0], x), "p = u²": (p[1:, 0], u**2)}


REFERENCES: Final[dict[str, Callable[[Array, Array, Array], Any]]] = {
    each.__name__: each
    for each in (
        asymmetric_top, bead_on_a_curve, brachistochrone, central_potential, charge_in_general_fields,
        charge_in_uniform_fields, coulomb_scattering, coupled_oscillators, damped_oscillator, forced_oscillator,
        free_particle, free_symmetric_top, harmonic_oscillator, heavy_symmetric_top, inverse_square_potential,
        isotropic_oscillator, kepler, linear_chain, optical_rays, pendulum, physical_pendulum, power_law_well,
        relativistic_charge, relativistic_particle, riccati_flow, rotating_frame, rotating_hoop, skate_on_an_incline,
        spherical_pendulum, spring_on_a_cart, three_body, two_body, uniform_gravity,
    )
}  # fmt: skip


def deviations(name: str, record: Any) -> dict[str, float]:
    """How far a run is from what is said of it, by what: the largest difference over the largest value."""
    t, q, p = (np.array(record[word], dtype=float) for word in ("times", "q", "p"))
    found = {}
    for what, (seen, said) in REFERENCES[name](t, q, p).items():
        size = max(float(np.abs(seen).max()), float(np.abs(said).max()), 1e-3)
        found[what] = float(np.abs(np.asarray(seen) - said).max()) / size
    return found
