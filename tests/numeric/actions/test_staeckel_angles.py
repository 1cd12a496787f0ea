"""Angles in Stäckel potentials: canonical with the actions, even in time, and with the digits that their bound says."""

from typing import Any

import mpmath as mp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from canon.numeric.actions.separable import staeckel_actions
from canon.numeric.actions.staeckel_angles import staeckel_angles
from tests.numeric.actions.spheroidal import spheroidal_orbit

pytestmark = pytest.mark.slow
C, DELTA, M = 0.6, 0.8, 2.0
G = "k/(c + sqrt(t + c**2))"
MORE: Any = {"m": M, "parameters": {"c": C, "k": 1}}
STATES = np.array([
    [1.0, 0.2, 0.3, 0.15, -0.1, 0.7], [0.7, -0.4, 5.0, -0.2, 0.1, -0.5], [1.3, 0.01, 1.0, 0.05, 0.2, 0.9],
    [1.1, 0.0, 0.0, 0.1, -0.05, 0.8], [0.3, 1.2, 0.3, 0.35, -0.1, 0.01],
]).T  # fmt: skip


def angles(rows: Any) -> tuple[Any, Any]:
    R, z, phi, p_R, p_z, L = rows
    found = staeckel_angles(G, DELTA, R, z, p_R, p_z, L, phi, **MORE)
    return np.array(found[:3]), found.bound


def test_angles_and_actions_are_canonical() -> None:
    """M J Mᵀ = J, by differences of fourth order."""
    h, J = 1e-4, np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
    shifts = np.array([[k * h * (i == j) for j in range(6)] for i in range(6) for k in (-2, -1, 0, 1, 2)]).T
    some = STATES[:, :2]
    rows = (some[:, :, None] + shifts[:, None, :]).reshape(6, -1)
    R, z, _, p_R, p_z, L = rows
    w, _ = angles(rows)
    values = np.concatenate([w, staeckel_actions(G, DELTA, R, z, p_R, p_z, L, **MORE)[:3]]).reshape(6, 2, 6, 5)
    change = values - values[..., 2:3]
    change[:3] -= np.round(change[:3])
    slopes = change @ np.array([1, -8, 0, 8, -1]) / (12 * h)
    for k in range(2):
        assert np.abs(slopes[:, k] @ J @ slopes[:, k].T - J).max() < 1e-7


def force(_: float, x: Any) -> Any:
    R, z, _, p_R, p_z, L = x

    def V(R: Any, z: Any) -> Any:
        S = R * R + z * z + DELTA**2
        l = (S + np.sqrt(S * S - 4 * z * z * DELTA**2)) / 2
        return -1 / (np.sqrt(l + C * C) + np.sqrt(z * z * DELTA**2 / l + C * C))

    h = 1e-3
    steps, weights = np.arange(-3, 4) * h, np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * h)
    slope_R, slope_z = weights @ V(R + steps, z), weights @ V(R, z + steps)
    return [p_R / M, p_z / M, L / (M * R * R), L * L / (M * R**3) - slope_R, -slope_z, 0.0]


@pytest.mark.parametrize("k", [0, 1, 4])
def test_angles_grow_evenly(k: int) -> None:
    """Over some ten oscillations, on both sides of the plane and of the turning points, the last by the axis."""
    times = np.linspace(0, 60, 25)
    orbit = solve_ivp(force, (0, 60), STATES[:, k], "DOP853", times, rtol=1e-12, atol=1e-13).y
    w, bound = angles(orbit)
    w = np.unwrap(w, period=1)
    for row in w:
        rate, start = np.polyfit(times, row, 1)
        assert np.abs(row - start - rate * times).max() < 1e-9
        assert abs(rate) > 0.03
    assert bound.max() < (1e-7 if k == 4 else 1e-9)


def test_symmetries() -> None:
    """The mirror image in the plane is half a vertical turn ahead; backwards in time they run back."""
    w, bound = angles(STATES)
    mirrored, _ = angles(STATES * np.array([1, -1, 1, 1, -1, 1])[:, None])
    half = mirrored - w - np.array([0, 0.5, 0])[:, None]
    backward, _ = angles(STATES * np.array([1, 1, -1, -1, -1, 1])[:, None])  # φ → −φ turns L back
    sums = backward + w - np.array([0, 0.5, 0])[:, None]  # the plane is crossed downwards then
    for off in (half, sums):
        assert np.all(np.abs(off - np.round(off)) <= 4 * bound)


def test_turning_points_and_narrow_orbits() -> None:
    """At rest at a turning point in the plane, and on orbits whose l varies by 1e-9 of itself."""
    inner, outer = (angles([R, 0.0, 0.0, 0.0, 0.0, L])[0] for R, L in ((1.0, 1.0), (1.0, 0.5)))
    assert abs(inner[0]) < 1e-12
    assert abs(outer[0] - 0.5) < 1e-12
    R, a = 1.0, np.hypot(C, DELTA)
    s = np.sqrt(R * R + a * a)
    circular = M * R * R / np.sqrt(M * s) / (C + s)
    kick = 1e-9 * np.array([1.0, -1.0])
    w, bound = angles([R, 0.0, 0.0, kick, 0.0, circular])  # as fast as it gets: a quarter, three quarters
    assert np.all(np.abs(w[0] - [0.25, 0.75]) < 1e-6)
    assert np.all(np.isfinite(bound))


@pytest.mark.parametrize("k", [0, 1, 2])
def test_against_forty_digits(k: int) -> None:
    state = [float(x) for x in STATES[:, k]]
    w, bound = angles(STATES[:, k])
    for found, exact in zip(w, reference(state), strict=True):
        off = mp.mpf(float(found)) - exact
        assert abs(off - mp.nint(off)) <= bound


def reference(state: list[float]) -> list[Any]:
    """By derivatives of S = ∫ p_l dl + ∫ p_n dn + Lφ, and of the actions, each an integral in 40 digits."""
    with mp.workdps(40):
        R, z, phi, p_R, p_z, L = map(mp.mpf, state)
        m, D2, l, n, p_l, depth, I3, low, high, top = spheroidal_orbit(R, z, p_R, p_z, L, c=C, delta=DELTA, m=M)
        p_n = -p_R * R / (2 * (D2 - n)) + p_z * z / (2 * n)

        def slopes(a: Any, b: Any, x: Any) -> tuple[list[Any], list[Any]]:
            """∫ ∂p/∂(E, I₂, I₃) from a to b, and to x."""
            mid, half = (a + b) / 2, (b - a) / 2
            end = mp.acos((mid - x) / half)

            def rate(theta: Any, kind: int) -> Any:
                t = mid - half * mp.cos(theta)
                under = m * (depth(t) - I3) / (2 * (t - D2) * t)
                plain = m * half * mp.sin(theta) / (4 * (t - D2) * mp.sqrt(under))
                return plain * (1, -1 / (t - D2), -1 / t)[kind]

            def upto(e: Any) -> list[Any]:
                return [mp.quad(lambda y, k=k: rate(y, k), [0, e / 2, e], method="gauss-legendre") for k in range(3)]

            return upto(mp.pi), upto(end)

        whole_l, part_l = slopes(low, high, l)
        whole_n, part_n = slopes(mp.mpf(0), top, n)
        if p_l < 0:
            part_l = [2 * a - b for a, b in zip(whole_l, part_l, strict=True)]
        if p_n < 0:  # falling towards the plane
            part_n = [2 * a - b for a, b in zip(whole_n, part_n, strict=True)]
        if z < 0:
            part_n = [2 * a + b for a, b in zip(whole_n, part_n, strict=True)]
        dS = [a + b for a, b in zip(part_l, part_n, strict=True)]
        dS[1] = dS[1] * L / m + phi  # by L
        rows = [[2 * a for a in whole_l], [4 * a for a in whole_n], [0, 1, 0]]
        for row in rows[:2]:
            row[1] *= L / m
        rows[2][1] = 2 * mp.pi
        back = mp.matrix(rows) ** -1
        return [sum(dS[i] * back[i, j] for i in range(3)) for j in range(3)]
