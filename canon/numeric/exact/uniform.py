"""Free motion, uniform fields of force, and a charge in uniform electric and magnetic fields, with any of them zero.

ẍ = a + ẋ × w. With N v = v × w, N³ = −|w|² N, and the exponential of Nt and its integrals are polynomials in N with
Stumpff's functions of |w|²t². Landau and Lifshitz (1975), The Classical Theory of Fields, §§ 20–22.

Conditioning: a turn by so many radians is off by as many roundings of w and t; nothing else is amplified.
"""

from __future__ import annotations

from typing import Any

from canon.numeric.exact.stumpff import stumpff, stumpff_4
from canon.numeric.rotations import cross


def uniform_acceleration(x: Any, v: Any, a: Any, t: Any) -> tuple[Any, Any]:
    """x + vt + at²/2 and v + at, in components (n, …)."""
    return x + t * (v + a * t / 2), v + a * t


def uniform_fields(x: Any, v: Any, a: Any, w: Any, t: Any) -> tuple[Any, Any]:
    """Position and velocity (3, …) after a time t, for a = qE/m and w = qB/m, arrays (3, …)."""
    square = w[0] ** 2 + w[1] ** 2 + w[2] ** 2
    psi = square * t * t
    _, c1, c2, c3 = stumpff(psi)
    c4 = stumpff_4(psi)
    v1, a1 = cross(v, w), cross(a, w)
    v2, a2 = cross(v1, w), cross(a1, w)
    moved = x + t * (v + t * (c2 * v1 + t * c3 * v2)) + t * t * (a / 2 + t * (c3 * a1 + t * c4 * a2))
    return moved, v + t * (c1 * v1 + t * c2 * v2) + t * (a + t * (c2 * a1 + t * c3 * a2))
