"""What the ledger says of each system that moves, as formulas and equations of motion written down by hand.

Nothing here is canon's: closed forms are textbooks' (with their period, rate or frequency written out), and where there
is none, Newton's, Lorentz's or Euler's equations are solved by scipy's DOP853 in coordinates that canon's scene doesn't
use, as far as there are such. All of them are for the scene files that `canon scenes NAME` prints.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk, ellipkinc, gamma, jv

Array = Any
Rows = tuple[Array, Array, Array]
"""Times (samples,), q and p (samples, n)."""


def _orbit(t: Array, rates: Callable[..., Any], start: Any) -> Array:
    solved = solve_ivp(rates, (t[0], t[-1]), start, "DOP853", t_eval=t, rtol=3e-14, atol=1e-15)
    return solved.y.T


def _anomaly(mean: Array, e: float) -> Array:
    """Kepler's equation, by Newton's iteration."""
    E = mean + e * np.sin(mean)
    for _ in range(60):
        E = E - (E - e * np.sin(E) - mean) / (1 - e * np.cos(E))
    return E


def _columns(*columns: Any) -> Array:
    return np.column_stack([np.broadcast_to(c, np.shape(columns[0])) for c in columns])


def _swing(t: Array, w: float, first: float) -> tuple[Array, Array]:
    """A pendulum from rest at an angle: sin(θ/2) = k cd(ωt), of period 4 K(k²)/ω."""
    k = np.sin(first / 2)
    t = np.mod(t, 4 * ellipk(k * k) / w)
    sn, cn, dn, _ = ellipj(w * t, k * k)
    angle = 2 * np.arcsin(k * cn / dn)
    rate = -2 * k * w * (1 - k * k) * sn / dn**2 / np.sqrt(1 - (k * cn / dn) ** 2)
    return angle, rate


def _modes(t: Array, masses: Any, K: Any, q: Any, p: Any) -> tuple[Array, Array]:
    """Normal modes by the eigenvectors of M^−½ K M^−½."""
    root = np.sqrt(np.array(masses))
    squares, vectors = np.linalg.eigh(np.array(K) / np.outer(root, root))
    w = np.sqrt(np.abs(squares))
    first, rate = vectors.T @ (root * np.array(q)), vectors.T @ (np.array(p) / root)
    wt = np.outer(t, w)
    slow = w < 1e-7
    sine = np.where(slow, t[:, None], np.sin(wt) / np.where(slow, 1.0, w))
    x, v = first * np.cos(wt) + rate * sine, -first * w * np.sin(wt) + rate * np.cos(wt)
    return x @ vectors.T / root, v @ vectors.T * root


def _axis(theta: Array, phi: Array) -> Array:
    return np.stack([np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)], axis=-1)


def _top(t: Array, q: Any, p: Any, I1: float, I3: float, weight: float) -> Array:
    """A symmetric top by vectors: Ṁ = −m g l e₃ × z, ė₃ = M × e₃/I₁, and ψ̇ = M₃/I₃ − φ̇ cos θ. Columns e₃, M, ψ."""
    theta, phi, psi = q
    e = _axis(theta, phi)
    node = np.array([np.cos(phi), np.sin(phi), 0.0])
    M = p[0] * node + p[2] * e + (p[1] - p[2] * np.cos(theta)) / np.sin(theta) * np.cross(e, node)

    def rates(_: float, y: Array) -> Array:
        e, M = y[:3], y[3:6]
        spin = M @ e
        turn = (M[2] - spin * e[2]) / (I1 * (1 - e[2] ** 2))
        return np.concatenate([np.cross(M, e) / I1, weight * np.cross(e, [0.0, 0.0, -1.0]), [spin / I3 - turn * e[2]]])

    return _orbit(t, rates, np.concatenate([e, M, [psi]]))


def free_particle(t: Array, q: Array, p: Array) -> Any:
    return {"r = r0 + p t/m": (q, np.outer(t, [1.0, 0.5, -0.2])), "C = m r − p t": (q - p * t[:, None], 0 * q)}


def uniform_gravity(t: Array, q: Array, p: Array) -> Any:
    return {
        "parabola": (q, _columns(3 * t, 10 * t - 9.81 * t**2 / 2)),
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
    made = _orbit(t, lambda _, y: [y[1], -y[0] * (1 + y[1] ** 2) / (1 + y[0] ** 2)], [1.0, 0.0])
    return {"Lagrange's equation": (_columns(q[:, 0], p[:, 0] / (1 + q[:, 0] ** 2)), made)}


def pendulum(t: Array, q: Array, p: Array) -> Any:
    angle, rate = _swing(t, np.sqrt(9.81), 3.1)
    return {"sin θ/2 = k cd(ωt), period 4K/ω": (q[:, 0], angle), "p = m R² θ̇": (p[:, 0], rate)}


def spherical_pendulum(t: Array, q: Array, p: Array) -> Any:
    """r̈ = g − r (v² + g·r)/R² in space."""
    g = np.array([0.0, 0.0, -9.81])

    def rates(_: float, y: Array) -> Array:
        r, v = y[:3], y[3:]
        return np.concatenate([v, g - r * (v @ v + g @ r)])

    rate = 1.0 / np.sin(1.0) ** 2
    made = _orbit(t, rates, [np.sin(1.0), 0, -np.cos(1.0), 0, rate * np.sin(1.0), 0])
    theta, phi = q.T
    place = _columns(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), -np.cos(theta))
    return {"Newton and the rod's force": (place, made[:, :3]), "M_z": (p[:, 1], 1.0)}


def rotating_hoop(t: Array, q: Array, p: Array) -> Any:
    made = _orbit(t, lambda _, y: [y[1], np.sin(y[0]) * (16 * np.cos(y[0]) - 9.81)], [0.5, 0.0])
    jacobi = p[:, 0] ** 2 / 2 - 8 * np.sin(q[:, 0]) ** 2 - 9.81 * np.cos(q[:, 0])
    return {"θ̈ = sin θ (Ω² cos θ − g/R)": (_columns(q[:, 0], p[:, 0]), made), "H": (jacobi, jacobi[0])}


def spring_on_a_cart(t: Array, q: Array, p: Array) -> Any:
    x = 0.5 * t + np.cos(t) - 0.5 * np.sin(t)
    v = 0.5 - np.sin(t) - 0.5 * np.cos(t)
    moving = p[:, 0] ** 2 / 2 + (q[:, 0] - 0.5 * t) ** 2 / 2 - 0.5 * p[:, 0]
    return {"x = v0 t + A cos": (q[:, 0], x), "p": (p[:, 0], v), "H − v0 p": (moving, 0.5)}


def physical_pendulum(t: Array, q: Array, p: Array) -> Any:
    inertia = 0.25 + 0.1
    angle, rate = _swing(t, np.sqrt(9.81 * 0.5 / inertia), 2.0)
    return {"ω² = m g l/(m l² + I)": (q[:, 0], angle), "p": (p[:, 0], inertia * rate)}


def central_potential(t: Array, q: Array, p: Array) -> Any:
    a, e = 1 / 0.56, 0.44
    E = _anomaly(t / a**1.5, e)
    beta = e / (1 + np.sqrt(1 - e * e))
    angle = E + 2 * np.arctan(beta * np.sin(E) / (1 - beta * np.cos(E)))
    r = a * (1 - e * np.cos(E))
    return {
        "r, θ by Kepler's equation": (q, _columns(r, angle)),
        "p_r": (p[:, 0], e * np.sqrt(a) * np.sin(E) / r),
        "M": (p[:, 1], 1.2),
    }


def kepler(t: Array, q: Array, p: Array) -> Any:
    E = _anomaly(t, 0.6)
    x, y = np.cos(E) - 0.6, 0.8 * np.sin(E)
    r = 1 - 0.6 * np.cos(E)
    lrl = np.cross(p, np.cross(q, p)) - q / np.linalg.norm(q, axis=1)[:, None]
    return {
        "Kepler's equation, period 2π a^3/2": (q, _columns(x, y, 0.0)),
        "p": (p, _columns(-np.sin(E) / r, 0.8 * np.cos(E) / r, 0.0)),
        "A = e m a x": (lrl, np.array([0.6, 0.0, 0.0])),
    }


def two_body(t: Array, q: Array, p: Array) -> Any:
    """The relative motion begins at its apocentre."""
    a = 3 / (2 * (3 / 1.5 - 1.35**2 / 2))
    e = 1.5 / a - 1
    E = _anomaly(np.pi + np.sqrt(3 / a**3) * t, e)
    r = -a * _columns(np.cos(E) - e, np.sqrt(1 - e * e) * np.sin(E))
    centre = (q[:, :2] + 2 * q[:, 2:]) / 3
    return {"r by Kepler's equation": (q[:, :2] - q[:, 2:], r), "centre of mass": (centre, 0.0)}


def three_body(t: Array, q: Array, p: Array) -> Any:
    def rates(_: float, y: Array) -> Array:
        x, v = y[:6].reshape(3, 2), y[6:]
        apart = x[None] - x[:, None]
        cubes = np.sum(apart**2, axis=2) ** 1.5
        np.fill_diagonal(cubes, 1.0)
        return np.concatenate([v, np.sum(apart / cubes[..., None], axis=1).ravel()])

    made = _orbit(t, rates, np.concatenate([q[0], p[0]]))
    return {
        "Newton's equations": (q, made[:, :6]),
        "p": (p, made[:, 6:]),
        "two periods of 6.32591398, to the data's eight digits": (1e-4 * (q[-1] - q[0]), 0.0),
    }


def isotropic_oscillator(t: Array, q: Array, p: Array) -> Any:
    fradkin = p[:, 0] * p[:, 1] + q[:, 0] * q[:, 1]
    return {"ellipse": (q, _columns(np.cos(t), 0.5 * np.sin(t))), "Fradkin's tensor": (fradkin, 0.0)}


def coulomb_scattering(t: Array, q: Array, p: Array) -> Any:
    """A·r = M² + m a r of a hyperbola about its outer focus, and Newton's equation."""
    made = _orbit(t, lambda _, y: [*y[2:], *(y[:2] / np.hypot(y[0], y[1]) ** 3)], [-20.0, 0.5, 1.0, 0.0])
    M = -0.5
    r0 = np.hypot(20.0, 0.5)
    A = np.array([-20 / r0, -M + 0.5 / r0])
    return {
        "Newton's equation": (_columns(*q.T, *p.T), made),
        "A·r = M² + m a r": (q @ A, M * M + np.linalg.norm(q, axis=1)),
    }


def power_law_well(t: Array, q: Array, p: Array) -> Any:
    """q̈ = −4q³: q = cn(2t | ½), of period 2 K(½)."""
    sn, cn, dn, _ = ellipj(np.mod(2 * t, 4 * ellipk(0.5)), 0.5)
    return {"q = cn(2t | 1/2)": (q[:, 0], cn), "p": (p[:, 0], -2 * sn * dn)}


def coupled_oscillators(t: Array, q: Array, p: Array) -> Any:
    x, y = _modes(t, [1, 1], [[1.1, -0.1], [-0.1, 1.1]], [1, 0], [0, 0])
    energies = _columns(
        (p.sum(1) ** 2 + q.sum(1) ** 2) / 4, ((p[:, 0] - p[:, 1]) ** 2 + 1.2 * (q[:, 0] - q[:, 1]) ** 2) / 4
    )
    return {"ω² = k/m, (k + 2kc)/m": (q, x), "p": (p, y), "mode energies": (energies, np.array([0.25, 0.3]))}


def linear_chain(t: Array, q: Array, p: Array) -> Any:
    """ω² = 0, k/m1, k/m1 + 2k/m2."""
    K = [[1, -1, 0], [-1, 2, -1], [0, -1, 1]]
    x, y = _modes(t, [1, 2, 1], K, [-0.5, 0, 0.2], [0, 0.1, 0])
    return {"normal modes": (q, x), "p": (p, y), "P": (p.sum(1), 0.1)}


def charge_in_uniform_fields(t: Array, q: Array, p: Array) -> Any:
    """ω = q B/m, radius m v/(q B) = 1/2."""
    place = _columns(1.5 - 0.5 * np.cos(t), 0.5 * np.sin(t), 0.05 * t**2)
    guiding = _columns(p[:, 0] - q[:, 1] / 2, p[:, 1] + q[:, 0] / 2)
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

    made = _orbit(t, rates, [1, 0, 0, 0, 0.5, 0.1])
    return {
        "Lorentz's force": (q, made[:, :3]),
        "speed": (made[:, 3] ** 2 + made[:, 4] ** 2 + made[:, 5] ** 2 + made[:, 2] ** 2 / 10, 0.26),
    }


def free_symmetric_top(t: Array, q: Array, p: Array) -> Any:
    """The axis goes round M, which stays where it is, at the rate |M|/I1."""
    made = _top(t, q[0], p[0], 1.0, 1.5, 0.0)
    e, M = made[0, :3], made[0, 3:6]
    size = np.linalg.norm(M)
    n, turn = M / size, (size * t)[:, None]
    round_M = e * np.cos(turn) + np.cross(n, e) * np.sin(turn) + n * (n @ e) * (1 - np.cos(turn))
    square = p[:, 0] ** 2 + (p[:, 1] - p[:, 2] * np.cos(q[:, 0])) ** 2 / np.sin(q[:, 0]) ** 2 + p[:, 2] ** 2
    return {
        "precession |M|/I1": (_axis(q[:, 0], q[:, 1]), round_M),
        "ψ": (q[:, 2], made[:, 6]),
        "M²": (square, size**2),
    }


def heavy_symmetric_top(t: Array, q: Array, p: Array) -> Any:
    made = _top(t, q[0], p[0], 1.0, 1.5, 9.81 * 0.2)
    u = made[:, 2]
    energy = (p[0, 1] - 4 * np.cos(0.5)) ** 2 / np.sin(0.5) ** 2 / 2 + 9.81 * 0.2 * np.cos(0.5)
    cubic = 2 * (1 - u * u) * (energy - 9.81 * 0.2 * u) - (3 - 4 * u) ** 2
    return {
        "Ṁ = −m g l e₃ × z": (_axis(q[:, 0], q[:, 1]), made[:, :3]),
        "ψ": (q[:, 2], made[:, 6]),
        "nutation: p_θ² sin² θ is the cubic": ((p[:, 0] * np.sin(q[:, 0])) ** 2, cubic),
        "M_z, M_3": (p[:, 1:], np.array([3.0, 4.0])),
    }


def optical_rays(t: Array, q: Array, p: Array) -> Any:
    """n cos α = h is constant (Snell), and y'' = n n_y/h²."""
    h2 = (1.5 - 0.025) ** 2 - 0.04
    made = _orbit(t, lambda _, y: [y[1], -(1.5 - y[0] ** 2 / 10) * y[0] / 5 / h2], [0.5, 0.2 / np.sqrt(h2)])
    return {"the ray's equation": (q[:, 0], made[:, 0]), "p = h y'": (p[:, 0], made[:, 1] * np.sqrt(h2))}


def brachistochrone(t: Array, q: Array, p: Array) -> Any:
    """A cycloid h = (1 − cos φ)/2k, x = (φ − sin φ)/2k with k = 2 g p²."""
    k = 2 * 9.81 * 0.15**2
    angle = np.arccos(1 - 2 * k * t)
    x = (angle - np.sin(angle)) / (2 * k)
    return {"cycloid": (q[:, 0], x - x[0]), "p": (p[:, 0], 0.15)}


def relativistic_particle(t: Array, q: Array, p: Array) -> Any:
    made = _orbit(t, lambda _, y: [y[1] / np.sqrt(1 + y[1] ** 2), -y[0]], [1.0, 0.0])
    return {"ṗ = −q, p = γ m v": (_columns(q[:, 0], p[:, 0]), made)}


def relativistic_charge(t: Array, q: Array, p: Array) -> Any:
    """ω = q B/(γ m)."""
    factor = np.sqrt(1 + 0.25 + 0.01)
    w = 1 / factor
    place = _columns(1.5 - 0.5 * np.cos(w * t), 0.5 * np.sin(w * t), 0.1 * t / factor)
    return {"cyclotron at q B/(γ m)": (q, place)}


def inverse_square_potential(t: Array, q: Array, p: Array) -> Any:
    energy = p[:, 0] ** 2 / 2 + 0.5 / q[:, 0] ** 2
    expansion = q[:, 0] ** 2 / 2 - t * q[:, 0] * p[:, 0] + t**2 * energy
    return {
        "m q²/2 is quadratic in t": (q[:, 0] ** 2, 1 - 2 * t + 2 * t**2),
        "dilation": (q[:, 0] * p[:, 0] - 2 * t * energy, -1.0),
        "expansion": (expansion, 0.5),
    }


def rotating_frame(t: Array, q: Array, p: Array) -> Any:
    """Coriolis's and the centrifugal force, of velocities p/m − Ω × r."""
    W = 0.3

    def rates(_: float, y: Array) -> Array:
        x, z, u, v = y
        fx, fy = -(x + 2 * x * z / 5), -(z + x * x / 5)
        return np.array([u, v, fx + 2 * W * v + W * W * x, fy - 2 * W * u + W * W * z])

    made = _orbit(t, rates, [1, 0, 0, 0.5 - W])
    return {"Coriolis": (_columns(*q.T, p[:, 0] + W * q[:, 1], p[:, 1] - W * q[:, 0]), made)}


def asymmetric_top(t: Array, q: Array, p: Array) -> Any:
    """Euler's equations in Jacobi's functions, Landau and Lifshitz § 37: M² < 2E I2, so axes 1 and 3 change places."""
    I1, I2, I3 = 2.7, 2.0, 1.0
    square, energy = 0.09 + 5.76 + 0.25, 0.09 / I3 + 5.76 / I2 + 0.25 / I1
    rate = np.sqrt(abs((I3 - I2) * (square - energy * I1) / (I1 * I2 * I3)))
    k2 = (I2 - I1) * (energy * I3 - square) / ((I3 - I2) * (square - energy * I1))
    size = np.sqrt(abs(I2 * (energy * I3 - square) / (I3 - I2)))
    made = _orbit(t, lambda _, M: np.cross(M, M / np.array([1.0, 2.0, 2.7])), [0.3, 2.4, -0.5])
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
    return {"cycloid": (q[:, :2], _columns(np.sin(t) ** 2 / 2, (t - np.sin(t) * np.cos(t)) / 2))}


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
