"""The ledger's points under forces: oscillators, pendulums, central forces and chains."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.special import ellipj, ellipk

from tests.scenes.textbook import Array, anomaly, columns, modes, solved, swing


def free_particle(t: Array, q: Array, p: Array) -> Any:
    return {"r = r0 + p t/m": (q, np.outer(t, [1.0, 0.5, -0.2])), "C = m r − p t": (q - p * t[:, None], 0 * q)}


def uniform_gravity(t: Array, q: Array, p: Array) -> Any:
    return {
        "parabola": (q, columns(3 * t, 10 * t - 9.81 * t**2 / 2)),
        "p_z + m g t": (p[:, 1] + 9.81 * t, 10.0),
    }


def harmonic_oscillator(t: Array, q: Array, p: Array) -> Any:
    return {"q = cos t": (q[:, 0], np.cos(t)), "p = −sin t": (p[:, 0], -np.sin(t))}


def damped_oscillator(t: Array, q: Array, p: Array) -> Any:
    w, lam = np.sqrt(1 - 0.1**2), 0.1
    energy = np.exp(-0.2 * t) * p[:, 0] ** 2 / 2 + np.exp(0.2 * t) * q[:, 0] ** 2 / 2
    x = np.exp(-lam * t) * (np.cos(w * t) + lam / w * np.sin(w * t))
    v = -np.exp(-lam * t) * np.sin(w * t) / w
    return {
        "e^−λt (cos ωt + …)": (q[:, 0], x),
        "p = e^2λt m v": (p[:, 0], np.exp(2 * lam * t) * v),
        "E + λ p q": (energy + lam * p[:, 0] * q[:, 0], 0.5),
    }


def forced_oscillator(t: Array, q: Array, p: Array) -> Any:
    x = 0.5 / (1 - 0.81) * (np.cos(0.9 * t) - np.cos(t))
    v = 0.5 / (1 - 0.81) * (np.sin(t) - 0.9 * np.sin(0.9 * t))
    return {"f (cos γt − cos ωt)/(ω² − γ²)": (q[:, 0], x), "p": (p[:, 0], v)}


def bead_on_a_curve(t: Array, q: Array, p: Array) -> Any:
    """(1 + q²) q̈ + q q̇² + q = 0."""
    made = solved(t, lambda _, y: [y[1], -y[0] * (1 + y[1] ** 2) / (1 + y[0] ** 2)], [1.0, 0.0])
    return {"Lagrange's equation": (columns(q[:, 0], p[:, 0] / (1 + q[:, 0] ** 2)), made)}


def pendulum(t: Array, q: Array, p: Array) -> Any:
    angle, rate = swing(t, np.sqrt(9.81), 3.1)
    return {"sin θ/2 = k cd(ωt), period 4K/ω": (q[:, 0], angle), "p = m R² θ̇": (p[:, 0], rate)}


def spherical_pendulum(t: Array, q: Array, p: Array) -> Any:
    """r̈ = g − r (v² + g·r)/R² in space."""
    g = np.array([0.0, 0.0, -9.81])

    def rates(_: float, y: Array) -> Array:
        r, v = y[:3], y[3:]
        return np.concatenate([v, g - r * (v @ v + g @ r)])

    rate = 1.0 / np.sin(1.0) ** 2
    made = solved(t, rates, [np.sin(1.0), 0, -np.cos(1.0), 0, rate * np.sin(1.0), 0])
    theta, phi = q.T
    place = columns(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), -np.cos(theta))
    return {"Newton and the rod's force": (place, made[:, :3]), "M_z": (p[:, 1], 1.0)}


def rotating_hoop(t: Array, q: Array, p: Array) -> Any:
    made = solved(t, lambda _, y: [y[1], np.sin(y[0]) * (16 * np.cos(y[0]) - 9.81)], [0.5, 0.0])
    jacobi = p[:, 0] ** 2 / 2 - 8 * np.sin(q[:, 0]) ** 2 - 9.81 * np.cos(q[:, 0])
    return {"θ̈ = sin θ (Ω² cos θ − g/R)": (columns(q[:, 0], p[:, 0]), made), "H": (jacobi, jacobi[0])}


def spring_on_a_cart(t: Array, q: Array, p: Array) -> Any:
    x = 0.5 * t + np.cos(t) - 0.5 * np.sin(t)
    v = 0.5 - np.sin(t) - 0.5 * np.cos(t)
    moving = p[:, 0] ** 2 / 2 + (q[:, 0] - 0.5 * t) ** 2 / 2 - 0.5 * p[:, 0]
    return {"x = v0 t + A cos": (q[:, 0], x), "p": (p[:, 0], v), "H − v0 p": (moving, 0.5)}


def physical_pendulum(t: Array, q: Array, p: Array) -> Any:
    inertia = 0.25 + 0.1
    angle, rate = swing(t, np.sqrt(9.81 * 0.5 / inertia), 2.0)
    return {"ω² = m g l/(m l² + I)": (q[:, 0], angle), "p": (p[:, 0], inertia * rate)}


def central_potential(t: Array, q: Array, p: Array) -> Any:
    a, e = 1 / 0.56, 0.44
    E = anomaly(t / a**1.5, e)
    beta = e / (1 + np.sqrt(1 - e * e))
    angle = E + 2 * np.arctan(beta * np.sin(E) / (1 - beta * np.cos(E)))
    r = a * (1 - e * np.cos(E))
    return {
        "r, θ by Kepler's equation": (q, columns(r, angle)),
        "p_r": (p[:, 0], e * np.sqrt(a) * np.sin(E) / r),
        "M": (p[:, 1], 1.2),
    }


def kepler(t: Array, q: Array, p: Array) -> Any:
    E = anomaly(t, 0.6)
    x, y = np.cos(E) - 0.6, 0.8 * np.sin(E)
    r = 1 - 0.6 * np.cos(E)
    lrl = np.cross(p, np.cross(q, p)) - q / np.linalg.norm(q, axis=1)[:, None]
    return {
        "Kepler's equation, period 2π a^3/2": (q, columns(x, y, 0.0)),
        "p": (p, columns(-np.sin(E) / r, 0.8 * np.cos(E) / r, 0.0)),
        "A = e m a x": (lrl, np.array([0.6, 0.0, 0.0])),
    }


def two_body(t: Array, q: Array, p: Array) -> Any:
    """The relative motion begins at its apocentre."""
    a = 3 / (2 * (3 / 1.5 - 1.35**2 / 2))
    e = 1.5 / a - 1
    E = anomaly(np.pi + np.sqrt(3 / a**3) * t, e)
    r = -a * columns(np.cos(E) - e, np.sqrt(1 - e * e) * np.sin(E))
    centre = (q[:, :2] + 2 * q[:, 2:]) / 3
    return {"r by Kepler's equation": (q[:, :2] - q[:, 2:], r), "centre of mass": (centre, 0.0)}


def three_body(t: Array, q: Array, p: Array) -> Any:
    def rates(_: float, y: Array) -> Array:
        x, v = y[:6].reshape(3, 2), y[6:]
        apart = x[None] - x[:, None]
        cubes = np.sum(apart**2, axis=2) ** 1.5
        np.fill_diagonal(cubes, 1.0)
        return np.concatenate([v, np.sum(apart / cubes[..., None], axis=1).ravel()])

    made = solved(t, rates, np.concatenate([q[0], p[0]]))
    return {
        "Newton's equations": (q, made[:, :6]),
        "p": (p, made[:, 6:]),
        "two periods of 6.32591398, to the data's eight digits": (1e-4 * (q[-1] - q[0]), 0.0),
    }


def isotropic_oscillator(t: Array, q: Array, p: Array) -> Any:
    fradkin = p[:, 0] * p[:, 1] + q[:, 0] * q[:, 1]
    return {"ellipse": (q, columns(np.cos(t), 0.5 * np.sin(t))), "Fradkin's tensor": (fradkin, 0.0)}


def coulomb_scattering(t: Array, q: Array, p: Array) -> Any:
    """A·r = M² + m a r of a hyperbola about its outer focus, and Newton's equation."""
    made = solved(t, lambda _, y: [*y[2:], *(y[:2] / np.hypot(y[0], y[1]) ** 3)], [-20.0, 0.5, 1.0, 0.0])
    M = -0.5
    r0 = np.hypot(20.0, 0.5)
    A = np.array([-20 / r0, -M + 0.5 / r0])
    return {
        "Newton's equation": (columns(*q.T, *p.T), made),
        "A·r = M² + m a r": (q @ A, M * M + np.linalg.norm(q, axis=1)),
    }


def power_law_well(t: Array, q: Array, p: Array) -> Any:
    """q̈ = −4q³: q = cn(2t | ½), of period 2 K(½)."""
    sn, cn, dn, _ = ellipj(np.mod(2 * t, 4 * ellipk(0.5)), 0.5)
    return {"q = cn(2t | 1/2)": (q[:, 0], cn), "p": (p[:, 0], -2 * sn * dn)}


def coupled_oscillators(t: Array, q: Array, p: Array) -> Any:
    x, y = modes(t, [1, 1], [[1.1, -0.1], [-0.1, 1.1]], [1, 0], [0, 0])
    energies = columns(
        (p.sum(1) ** 2 + q.sum(1) ** 2) / 4, ((p[:, 0] - p[:, 1]) ** 2 + 1.2 * (q[:, 0] - q[:, 1]) ** 2) / 4
    )
    return {"ω² = k/m, (k + 2kc)/m": (q, x), "p": (p, y), "mode energies": (energies, np.array([0.25, 0.3]))}


def linear_chain(t: Array, q: Array, p: Array) -> Any:
    """ω² = 0, k/m1, k/m1 + 2k/m2."""
    K = [[1, -1, 0], [-1, 2, -1], [0, -1, 1]]
    x, y = modes(t, [1, 2, 1], K, [-0.5, 0, 0.2], [0, 0.1, 0])
    return {"normal modes": (q, x), "p": (p, y), "P": (p.sum(1), 0.1)}


def inverse_square_potential(t: Array, q: Array, p: Array) -> Any:
    energy = p[:, 0] ** 2 / 2 + 0.5 / q[:, 0] ** 2
    expansion = q[:, 0] ** 2 / 2 - t * q[:, 0] * p[:, 0] + t**2 * energy
    return {
        "m q²/2 is quadratic in t": (q[:, 0] ** 2, 1 - 2 * t + 2 * t**2),
        "dilation": (q[:, 0] * p[:, 0] - 2 * t * energy, -1.0),
        "expansion": (expansion, 0.5),
    }
