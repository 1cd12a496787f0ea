"""On both sides of separatrices, down to distances of 1e-300 in the form that has them as a number of its own."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, compiled, each

BELOW, ABOVE = -1, 1


def _librations(m: Any, m1: Number) -> Quantities:
    """J = 16 [E(m) − m₁ K(m)] and T = 4 K(m) of p²/2 − cos q, m = 1 − m₁. Lawden (1989), 5.1."""
    whole, quarter = m.ellipe(1 - m1), m.ellipk(1 - m1)
    return (16 * (whole - m1 * quarter),), (4 * quarter,)


def _rotations(m: Any, m1: Number) -> Quantities:
    """J = 8 √m E(1/m) and T = 2 K(1/m)/√m, m = 1 − m₁ > 1."""
    root = m.sqrt(1 - m1)
    return (8 * root * m.ellipe(1 / (1 - m1)),), (2 * m.ellipk(1 / (1 - m1)) / root,)


def _small(m: Any, above: Number) -> Quantities:
    """J of a libration that is `above` × 2k above the bottom."""
    return ((16 * (m.ellipe(above) - (1 - above) * m.ellipk(above)),),)


def _our_pendulum(m1: Any) -> tuple[Any, Any]:
    from canon.numeric.actions.pendulum import pendulum_actions

    found = pendulum_actions(m1)
    return found.action, found.period


def _our_small(above: Any) -> Any:
    from canon.numeric.actions.pendulum import pendulum_actions

    return pendulum_actions(above_bottom=above).action


def _scipy_librations(m1: float) -> Quantities:
    from scipy import special

    return (16 * (special.ellipe(1 - m1) - m1 * special.ellipkm1(m1)),), (4 * special.ellipkm1(m1),)


def _scipy_small(above: float) -> Quantities:
    from scipy import special

    return ((16 * (special.ellipe(above) - (1 - above) * special.ellipk(above)),),)


def _fall(m: Any, delta: Number, t: Number) -> Quantities:
    """How far from the top a pendulum is that was let go at a distance δ of it. Whittaker (1937), 44."""
    k = m.sin((m.pi - delta) / 2)
    cn, dn = (_real(m.ellipfun(name, t, k * k)) for name in ("cn", "dn"))
    return ((m.pi - 2 * m.asin(k * cn / dn),),)


def _our_fall(delta: Any, t: Any) -> Any:
    from canon.numeric.exact.pendulum import pendulum

    return pendulum(delta, 0.0 * delta, t, from_top=True)[0]


def _duffing(m: Any, below: Number) -> Quantities:
    """J and T of p²/2 − q²/2 + q⁴/4 in a well, `below` its barrier, with a² ≥ q² ≥ b². Byrd and Friedman, 217–218."""
    root = m.sqrt(1 - 4 * below)
    a2, b2 = 1 + root, 1 - root
    a, parameter = m.sqrt(a2), 1 - b2 / a2
    K, E = m.ellipk(parameter), m.ellipe(parameter)
    return (m.sqrt(m.mpf(2)) * a / 3 * ((a2 + b2) * E - 2 * b2 * K),), (2 * m.sqrt(m.mpf(2)) * K / a,)


def _duffing_above(m: Any, above: Number) -> Quantities:
    """The same over both wells, `above` the barrier: a² ≥ q² ≥ −b²."""
    root = m.sqrt(1 + 4 * above)
    a2, b2 = 1 + root, root - 1
    across, parameter = m.sqrt(a2 + b2), a2 / (a2 + b2)
    K, E = m.ellipk(parameter), m.ellipe(parameter)
    J = 4 / m.sqrt(m.mpf(2)) * across / 3 * (b2 * K + (a2 - b2) * E)
    return (J,), (4 * m.sqrt(m.mpf(2)) * K / across,)


@lru_cache(maxsize=1)
def _double_well() -> Any:
    from canon.numeric.actions.motion import motion

    return motion("p**2/2 - q**2/2 + q**4/4")


def _our_duffing(side: int) -> Callable[[Sequence[Point]], list[Answer]]:
    def route(points: Sequence[Point]) -> list[Answer]:
        found = []
        for (distance,) in points:
            where = {"below_separatrix" if side == BELOW else "above_separatrix": distance}
            orbit = _double_well().orbit(**where, well=1.0)
            found.append(
                Answer(((orbit.action.value,), (orbit.period.value,)), (orbit.action.bound, orbit.period.bound))
            )
        return found

    return route


def _scipy_duffing(side: int) -> Callable[[float], Quantities]:
    """∮ p dq and ∮ dq/p by scipy's adaptive quadrature between the turning points."""

    def route(distance: float) -> Quantities:
        from scipy.integrate import quad

        E = side * distance
        root = math.sqrt(1 + 4 * E)
        low, high = (0.0 if side == ABOVE else math.sqrt(1 - root)), math.sqrt(1 + root)
        p = lambda q: math.sqrt(max(2 * E + q * q - q**4 / 2, 0.0))
        twice = 2 if side == BELOW else 4
        J = quad(p, low, high, epsabs=0.0, epsrel=1e-13, limit=500)[0]
        T = quad(lambda q: 1 / p(q), low, high, epsabs=0.0, epsrel=1e-13, limit=500)[0]
        return (twice * J,), (twice * T,)

    return route


MOMENTS = (1.0, 2.0, 3.0)


def _tumble(m: Any, small: Number, t: Number, moments: tuple[float, float, float] = MOMENTS) -> Quantities:
    """M of a free body from (δ, 1, 0) in its frame: M₁ = δ nd, M₂ = cd, M₃ ~ sd of λt. Landau and Lifshitz, § 37.

    λ² = c(a + bδ²) and 1 − m = bδ²/(a + bδ²), with a, b, c the differences of 1/I, all positive.
    """
    I1, I2, I3 = (m.mpf(x) for x in moments)
    a, b, c = 1 / I2 - 1 / I3, 1 / I1 - 1 / I3, 1 / I1 - 1 / I2
    lam = m.sqrt(c * (a + b * small * small))
    parameter = 1 - b * small * small / (a + b * small * small)
    sn, cn, dn = (_real(m.ellipfun(name, lam * t, parameter)) for name in ("sn", "cn", "dn"))
    return ((small / dn, cn / dn, -c * small / lam * sn / dn),)


def _our_tumble(small: Any, t: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.exact.free_top import free_momentum

    return free_momentum(jnp.stack([small, 1.0 + 0.0 * small, 0.0 * small]), MOMENTS, t)


def _tumble_beyond(m: Any, small: Number, t: Number) -> Quantities:
    """The same from (0, 1, δ), on the other side of the separatrix: the axes 1 and 3 change places, and time turns."""
    ((first, second, third),) = _tumble(m, small, -t, (MOMENTS[2], MOMENTS[1], MOMENTS[0]))
    return ((third, second, first),)


def _our_tumble_beyond(small: Any, t: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.exact.free_top import free_momentum

    return free_momentum(jnp.stack([0.0 * small, 1.0 + 0.0 * small, small]), MOMENTS, t)


def _scipy_tumble_beyond(small: float, t: float) -> Quantities:
    return _scipy_solved([0.0, 1.0, small], t)


def _scipy_tumble(small: float, t: float) -> Quantities:
    return _scipy_solved([small, 1.0, 0.0], t)


def _scipy_solved(begin: list[float], t: float) -> Quantities:
    """scipy's ODE solver DOP853 with the smallest tolerance that it takes."""
    import numpy as np
    from scipy.integrate import solve_ivp

    I = np.array(MOMENTS)
    rate = lambda _, M: np.cross(M, M / I)
    M = solve_ivp(rate, (0.0, t), begin, method="DOP853", rtol=3e-14, atol=1e-300).y[:, -1]
    return (tuple(float(x) for x in M),)


def _real(x: Any) -> Any:
    return getattr(x, "real", x)


DISTANCES = ((1e-4,), (1e-12,), (1e-30,), (1e-300,))
CASES = (
    HardCase(
        "pendulum, below",
        "separatrix",
        "∮ p dq and period of librations, by m₁ = (k − H)/2k",
        ("m1",),
        DISTANCES,
        _librations,
        compiled(_our_pendulum),
        peers={"scipy.special": each(_scipy_librations)},
        digits=360,
    ),
    HardCase(
        "pendulum, above",
        "separatrix",
        "∮ p dq and period of rotations, by m₁ = (k − H)/2k",
        ("m1",),
        tuple((-x,) for (x,) in DISTANCES),
        _rotations,
        compiled(_our_pendulum),
        digits=360,
    ),
    HardCase(
        "pendulum at the bottom",
        "separatrix",
        "∮ p dq of small librations, by m = (H + k)/2k",
        ("m",),
        ((1e-4,), (1e-12,), (1e-30,), (1e-100,)),
        _small,
        compiled(_our_small),
        peers={"scipy.special": each(_scipy_small)},
        digits=260,
    ),
    HardCase(
        "pendulum let go near the top",
        "separatrix",
        "its distance from the top after a time",
        ("delta", "t"),
        ((1e-4, 5.0), (1e-10, 3.0), (1e-16, 30.0), (1e-100, 200.0)),
        _fall,
        compiled(_our_fall),
        digits=280,
    ),
    HardCase(
        "Duffing, below",
        "separatrix",
        "∮ p dq and period in one of two wells",
        ("below",),
        ((1e-4,), (1e-12,), (1e-30,), (1e-300,)),
        _duffing,
        _our_duffing(BELOW),
        peers={"scipy.integrate": each(_scipy_duffing(BELOW))},
        digits=660,
    ),
    HardCase(
        "Duffing, above",
        "separatrix",
        "∮ p dq and period over both wells",
        ("above",),
        ((1e-4,), (1e-12,), (1e-30,), (1e-300,)),
        _duffing_above,
        _our_duffing(ABOVE),
        peers={"scipy.integrate": each(_scipy_duffing(ABOVE))},
        digits=660,
    ),
    HardCase(
        "top at its middle axis",
        "separatrix",
        "angular momentum of a free body that turns about the axis of the middle moment, but for δ",
        ("delta", "t"),
        ((1e-3, 30.0), (1e-10, 60.0), (1e-20, 100.0), (1e-100, 700.0)),
        _tumble,
        compiled(_our_tumble),
        peers={"scipy DOP853": each(_scipy_tumble)},
        digits=280,
    ),
    HardCase(
        "top at its middle axis, beyond",
        "separatrix",
        "the same on the other side of the separatrix: but for δ along the axis of the largest moment",
        ("delta", "t"),
        ((1e-3, 30.0), (1e-10, 60.0), (1e-20, 100.0), (1e-100, 700.0)),
        _tumble_beyond,
        compiled(_our_tumble_beyond),
        peers={"scipy DOP853": each(_scipy_tumble_beyond)},
        digits=280,
    ),
)
