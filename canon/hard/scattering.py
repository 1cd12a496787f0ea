"""Scattering nearly forwards and nearly straight back."""

from __future__ import annotations

import math
from typing import Any

from canon.hard.case import HardCase, Number, Quantities, each

_INPUTS = ("k", "E", "b")


def _forward(m: Any, k: Number, E: Number, b: Number) -> Quantities:
    """χ = π − 2 arccos 1/ε of V = k/r, ε = √(1 + (2Eb/k)²). Goldstein, Poole and Safko (2002), 3.96–3.100."""
    return ((m.pi - 2 * m.acos(1 / m.sqrt(1 + (2 * E * b / k) ** 2)),),)


def _backward(m: Any, k: Number, E: Number, b: Number) -> Quantities:
    """π − χ."""
    return ((2 * m.acos(1 / m.sqrt(1 + (2 * E * b / k) ** 2)),),)


def _cross_section(m: Any, k: Number, E: Number, b: Number) -> Quantities:
    """dσ/dΩ = (k/4E)²/sin⁴(χ/2), by χ. Rutherford (1911)."""
    return (((k / (4 * E)) ** 2 / m.sin(_forward(m, k, E, b)[0][0] / 2) ** 4,),)


def _our_forward(k: float, E: float, b: float) -> float:
    from canon.numeric.deflection import rutherford

    return rutherford(k, E, b).angle


def _our_backward(k: float, E: float, b: float) -> float:
    from canon.numeric.deflection import rutherford

    return rutherford(k, E, b).backward


def _our_cross_section(k: float, E: float, b: float) -> float:
    from canon.numeric.deflection import rutherford_cross_section

    return rutherford_cross_section(k, E, b)


def _screened(m: Any, k: Number, E: Number, b: Number) -> Quantities:
    """χ = π − 2b∫ dr/(r²√(1 − V/E − b²/r²)) of V = k e^(−r)/r, in w with r = r₀/(1 − w²)."""
    r0 = _turning(m, k, E, b)

    def integrand(w: Number) -> Number:
        u = 1 - w * w
        room = 1 - k * m.exp(-r0 / u) * u / (r0 * E) - (b * u / r0) ** 2
        # the root of `room` goes as w at the turning point, so that this is smooth there
        return 2 * w / m.sqrt(room) if room > 0 else m.mpf(0)

    whole = m.quad(integrand, [m.mpf(k) / 32 for k in range(33)], method="gauss-legendre")
    return ((m.pi - 2 * b / r0 * whole,),)


def _turning(m: Any, k: Number, E: Number, b: Number) -> Number:
    """The zero of 1 − V/E − b²/r², by Newton's method from outside."""
    r = b + k / E
    for _ in range(200):
        V = k * m.exp(-r) / (r * E)
        step = (1 - V - (b / r) ** 2) / (V * (1 + 1 / r) + 2 * b * b / r**3)
        r = r - step
        if abs(step) <= abs(r) * m.mpf(10) ** -(getattr(m, "dps", 16) - 2):
            break
    return r


def _our_screened(k: float, E: float, b: float) -> float:
    import numpy as np

    from canon.numeric.deflection import deflection

    V = lambda r: k * np.exp(-r) / r
    found = deflection(V, lambda r: -V(r) * (1 + 1 / r), E, b, 1e3 * b)
    return found.angle if found else math.nan


CASES = (
    HardCase(
        "Rutherford, forward",
        "scattering",
        "the deflection of a particle that passes far away",
        _INPUTS,
        tuple((1.0, 0.7, 10.0**k) for k in (2, 6, 12, 100)),
        _forward,
        each(_our_forward),
        digits=280,
    ),
    HardCase(
        "Rutherford, backward",
        "scattering",
        "what a particle lacks to coming straight back",
        _INPUTS,
        tuple((1.0, 0.7, 10.0**-k) for k in (2, 6, 12, 100)),
        _backward,
        each(_our_backward),
        digits=280,
    ),
    HardCase(
        "Rutherford's cross-section, forward",
        "scattering",
        "dσ/dΩ at the angle of an impact parameter",
        _INPUTS,
        tuple((1.0, 0.7, 10.0**k) for k in (0, 4, 8, 12)),
        _cross_section,
        each(_our_cross_section),
        digits=120,
    ),
    HardCase(
        "a screened charge, forward",
        "scattering",
        "the deflection by e^(−r)/r, which far away is exponentially small",
        _INPUTS,
        ((1.0, 0.7, 5.0), (1.0, 0.7, 30.0)),
        _screened,
        each(_our_screened),
    ),
)
