"""Motions as textbooks write them down, and Newton's, Lorentz's or Euler's equations solved by scipy's DOP853."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

Array = Any


def solved(t: Array, rates: Callable[..., Any], start: Any) -> Array:
    """The states at the times t, one a row, of ẏ = rates(t, y)."""
    answer = solve_ivp(rates, (t[0], t[-1]), start, "DOP853", t_eval=t, rtol=3e-14, atol=1e-15)
    return answer.y.T


def anomaly(mean: Array, e: float) -> Array:
    """Kepler's equation, by Newton's iteration."""
    E = mean + e * np.sin(mean)
    for _ in range(60):
        E = E - (E - e * np.sin(E) - mean) / (1 - e * np.cos(E))
    return E


def columns(*columns: Any) -> Array:
    return np.column_stack([np.broadcast_to(c, np.shape(columns[0])) for c in columns])


def swing(t: Array, w: float, first: float) -> tuple[Array, Array]:
    """A pendulum from rest at an angle: sin(θ/2) = k cd(ωt), of period 4 K(k²)/ω."""
    k = np.sin(first / 2)
    t = np.mod(t, 4 * ellipk(k * k) / w)
    sn, cn, dn, _ = ellipj(w * t, k * k)
    angle = 2 * np.arcsin(k * cn / dn)
    rate = -2 * k * w * (1 - k * k) * sn / dn**2 / np.sqrt(1 - (k * cn / dn) ** 2)
    return angle, rate


def modes(t: Array, masses: Any, K: Any, q: Any, p: Any) -> tuple[Array, Array]:
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


def axis_of(theta: Array, phi: Array) -> Array:
    return np.stack([np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)], axis=-1)


def top(t: Array, q: Any, p: Any, I1: float, I3: float, weight: float) -> Array:
    """A symmetric top by vectors: Ṁ = −m g l e₃ × z, ė₃ = M × e₃/I₁, and ψ̇ = M₃/I₃ − φ̇ cos θ. Columns e₃, M, ψ."""
    theta, phi, psi = q
    e = axis_of(theta, phi)
    node = np.array([np.cos(phi), np.sin(phi), 0.0])
    M = p[0] * node + p[2] * e + (p[1] - p[2] * np.cos(theta)) / np.sin(theta) * np.cross(e, node)

    def rates(_: float, y: Array) -> Array:
        e, M = y[:3], y[3:6]
        spin = M @ e
        turn = (M[2] - spin * e[2]) / (I1 * (1 - e[2] ** 2))
        return np.concatenate([np.cross(M, e) / I1, weight * np.cross(e, [0.0, 0.0, -1.0]), [spin / I3 - turn * e[2]]])

    return solved(t, rates, np.concatenate([e, M, [psi]]))
