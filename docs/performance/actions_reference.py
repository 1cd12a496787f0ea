"""References of 40 digits for the table of actions: closed forms where there are any, else the integral itself."""

from __future__ import annotations

from typing import Any

import mpmath as mp

DIGITS = 40
Number = Any


def isochrone(r: Number, p: Number, L: Number, b: Number) -> mp.mpf:
    """J_r = 2π [1/√(−2E) − ½(L + √(L² + 4b))] of −1/(b + √(b² + r²)). Binney and Tremaine (2008), (3.225)."""
    with mp.workdps(DIGITS):
        r, p, L, b = (mp.mpf(float(x)) for x in (r, p, L, b))
        E = (p**2 + (L / r) ** 2) / 2 - 1 / (b + mp.sqrt(b * b + r * r))
        return 2 * mp.pi * (1 / mp.sqrt(-2 * E) - (L + mp.sqrt(L * L + 4 * b)) / 2)


def pendulum(m1: Number) -> tuple[mp.mpf, mp.mpf]:
    """(J, T) of p²/2 − cos q at 1 − m = m1, negative for rotations. Lawden (1989), 5.1."""
    with mp.workdps(DIGITS + 320):
        m1 = mp.mpf(m1)
        m = 1 - m1
        if m1 > 0:
            return 16 * (mp.ellipe(m) - m1 * mp.ellipk(m)), 4 * mp.ellipk(m)
        return 8 * mp.sqrt(m) * mp.ellipe(1 / m), 2 * mp.ellipk(1 / m) / mp.sqrt(m)


def staeckel(
    R: Number, z: Number, p_R: Number, p_z: Number, L: Number, c: Number, delta: Number, nodes: int = 100
) -> tuple[mp.mpf, mp.mpf]:
    """(J_λ, J_ν) of −1/(√λ + √ν), by halving for the turning points and Gauss–Chebyshev. de Zeeuw (1985)."""
    with mp.workdps(DIGITS):
        R, z, p_R, p_z, L, c, delta = (mp.mpf(float(x)) for x in (R, z, p_R, p_z, L, c, delta))
        D2 = delta**2
        S = R * R + z * z + D2
        l = (S + mp.sqrt(S * S - 4 * z * z * D2)) / 2
        n = z * z * D2 / l
        E = (p_R**2 + p_z**2 + (L / R) ** 2) / 2 - 1 / (mp.sqrt(l + c * c) + mp.sqrt(n + c * c))
        p_l = p_R * R / (2 * (l - D2)) + p_z * z / (2 * l)

        def depth(t: mp.mpf) -> mp.mpf:
            return t * (1 / (c + mp.sqrt(t + c * c)) + E - L * L / (2 * (t - D2)))

        I3 = depth(l) - 2 * (l - D2) * l * p_l**2

        def zero(a: mp.mpf, b: mp.mpf) -> mp.mpf:
            positive = depth(a) >= I3
            for _ in range(4 * DIGITS):
                half = (a + b) / 2
                a, b = (half, b) if (depth(half) >= I3) == positive else (a, half)
            return a

        low = high = l
        while depth(low) >= I3:
            low = D2 + (low - D2) / 2
        while depth(high) >= I3:
            high = D2 + (high - D2) * 2
        low, high = zero(l, low), zero(l, high)
        top = zero(n / 2, D2 * (1 - mp.mpf(10) ** -DIGITS))
        angles = [mp.pi * (2 * k + 1) / (2 * nodes) for k in range(nodes)]
        radial = vertical = mp.mpf(0)
        for x in angles:
            u, w = mp.cos(x), mp.sin(x) * mp.pi / nodes
            t = (low + high) / 2 + (high - low) / 2 * u
            radial += w * (high - low) / 2 * mp.sqrt(max((depth(t) - I3) / (2 * (t - D2) * t), 0))
            t = top * (1 + u) / 2
            vertical += w * top / 2 * mp.sqrt(max((I3 - depth(t)) / (2 * (D2 - t) * t), 0))
        return 2 * radial, 4 * vertical
