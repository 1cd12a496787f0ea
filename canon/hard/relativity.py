"""Relativistic motion from p/mc = 1e-10 to 1e10."""

from __future__ import annotations

import math
from typing import Any

from canon.hard.case import HardCase, Number, Quantities, compiled, each

LIGHT = 299792458.0
CHARGE_BY_MASS = 1.75882e11
"""e/m of an electron, in C/kg."""


def _kinetic(m: Any, p: Number) -> Quantities:
    """√(p² + 1) − 1, with m = c = 1."""
    return ((m.sqrt(p * p + 1) - 1,),)


def _momentum(m: Any, T: Number) -> Quantities:
    """√((T + 1)² − 1)."""
    return ((m.sqrt((T + 1) ** 2 - 1),),)


def _our_kinetic(p: Any) -> Any:
    from canon.numeric.relativity import kinetic_energy

    return kinetic_energy(p)


def _our_momentum(T: Any) -> Any:
    from canon.numeric.relativity import momentum_of

    return momentum_of(T)


def _sympy_kinetic(p: float) -> Quantities:
    """The textbook's formula, simplified by sympy and lambdified."""
    import sympy as sp

    P = sp.Symbol("p", positive=True)
    return ((float(sp.lambdify(P, sp.simplify(sp.sqrt(P**2 + 1) - 1), "math")(p)),),)


def _pushed(m: Any, u: Number, v: Number, e: Number, t: Number) -> Quantities:
    """The path of a charge in a uniform electric field along x, γ(ẋ, ẏ) = (u, v) at first, c = 1.

    x = (γ − γ₀)/e and y = (v/e)(arsinh((u + et)/√(1 + v²)) − arsinh(u/√(1 + v²))). Landau and Lifshitz (1975), § 20.
    """
    across = m.sqrt(1 + v * v)
    after = u + e * t
    x = (m.sqrt(1 + v * v + after * after) - m.sqrt(1 + v * v + u * u)) / e
    return (x,), (v / e * (m.asinh(after / across) - m.asinh(u / across)),)


def _our_pushed(u: Any, v: Any, e: Any, t: Any) -> tuple[Any, Any]:
    import jax.numpy as jnp

    from canon.numeric.exact.relativistic_charge import relativistic_charge

    zero = 0.0 * u
    place, _ = relativistic_charge(
        jnp.stack([zero, zero, zero]),
        jnp.stack([u, v, zero]),
        jnp.stack([e, zero, zero]),
        jnp.stack([zero, zero, zero]),
        1.0,
        t,
    )
    return place[0], place[1]


def _sideways(m: Any, across: Number, B: Number, E: Number, t: Number) -> Quantities:
    """γ(ẋ, ẏ) of an electron that gyrates about E ∥ B, in SI units, from u = (across, 0, 0).

    It turns by eBτ/m in its proper time τ = (mc/eE) arsinh(eEt/mc γ₀). Landau and Lifshitz (1975), § 22, problem 1.
    """
    c, q = m.mpf(LIGHT), m.mpf(CHARGE_BY_MASS)
    gamma = m.sqrt(1 + (across / c) ** 2)
    tau = c / (q * E) * m.asinh(q * E * t / (c * gamma))
    return ((across * m.cos(q * B * tau), -across * m.sin(q * B * tau)),)


def _our_sideways(across: Any, B: Any, E: Any, t: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.exact.relativistic_charge import relativistic_charge

    zero = 0.0 * across
    _, u = relativistic_charge(
        jnp.stack([zero, zero, zero]),
        jnp.stack([across, zero, zero]),
        jnp.stack([zero, zero, CHARGE_BY_MASS * E]),
        jnp.stack([zero, zero, CHARGE_BY_MASS * B]),
        LIGHT,
        t,
    )
    return u[:2]


def _boris(across: float, B: float, E: float, t: float, steps: int = 4000) -> Quantities:
    """Boris's pusher, as particle codes have it: half a push by E, a turn by B, half a push. Boris (1970)."""
    h = t / steps
    push, turn = CHARGE_BY_MASS * E * h / 2, CHARGE_BY_MASS * B * h / 2
    x, y, z = across, 0.0, 0.0
    for _ in range(steps):
        z += push
        s = turn / math.sqrt(1 + (x * x + y * y + z * z) / LIGHT**2)
        x1, y1 = x + s * y, y - s * x
        twice = 2 * s / (1 + s * s)
        x, y = x + twice * y1, y - twice * x1
        z += push
    return ((x, y),)


def _scipy_dop853(across: float, B: float, E: float, t: float) -> Quantities:
    """scipy's DOP853 with the smallest tolerance that it takes."""
    import numpy as np
    from scipy.integrate import solve_ivp

    def rate(_: float, u: Any) -> Any:
        g = math.sqrt(1 + (u @ u) / LIGHT**2)
        return CHARGE_BY_MASS * (np.array([0.0, 0.0, E]) + np.cross(u, [0.0, 0.0, B]) / g)

    u = solve_ivp(rate, (0.0, t), [across, 0.0, 0.0], method="DOP853", rtol=3e-14, atol=1e-12).y[:, -1]
    return ((float(u[0]), float(u[1])),)


CASES = (
    HardCase(
        "kinetic energy, p/mc = 1e-10 to 1e10",
        "relativity",
        "√(p²c² + m²c⁴) − mc²",
        ("p",),
        tuple((10.0**k,) for k in (-10, -7, -4, 0, 4, 10)),
        _kinetic,
        compiled(_our_kinetic),
        peers={"sympy": each(_sympy_kinetic)},
        digits=80,
    ),
    HardCase(
        "momentum of a kinetic energy",
        "relativity",
        "√((T + mc²)² − m²c⁴)/c",
        ("T",),
        tuple((10.0**k,) for k in (-20, -12, -4, 0, 10)),
        _momentum,
        compiled(_our_momentum),
        digits=80,
    ),
    HardCase(
        "a charge in an electric field",
        "relativity",
        "its path, from speeds of 1e-9 c to γ = 1e8",
        ("u", "v", "e", "t"),
        (
            (1e-9, 1e-9, 1e-9, 1.0),
            (0.0, 1e-6, 1e-3, 1e-3),
            (0.3, 0.2, 1e-9, 2.0),
            (1e8, 1.0, 1.0, 3.0),
            (0.0, 0.006, 9.0, 97.0),
        ),
        _pushed,
        compiled(_our_pushed),
        digits=100,
    ),
    HardCase(
        "an electron in E ∥ B, in SI units",
        "relativity",
        "γ times its velocity across the fields",
        ("u", "B", "E", "t"),
        ((1e6, 1.0, 1e-3, 1e-10), (1e9, 0.1, 1.0, 1e-9), (1e6, 0.01, 1e6, 1e-9)),
        _sideways,
        compiled(_our_sideways),
        each(_boris),
        {"scipy DOP853": each(_scipy_dop853)},
        digits=80,
    ),
)
