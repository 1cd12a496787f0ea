"""Maps of generating functions near a caustic of their type, and next to a function's poles.

ours is `ImplicitMap`, which changes the type, or takes more bits, where F's own equations lose digits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, each

_INPUTS = ("q", "p", "h")
TOLERATED = 4.0
"""Roundings: all digits are asked for."""


@lru_cache(maxsize=8)
def _generating(name: str) -> Any:
    """The generating functions by name."""
    import sympy as sp

    from canon.mechanics import GeneratingFunction, PhaseSpace

    symbols: Any
    if name == "cot":
        space = PhaseSpace("q", "p", new=("phi", "I"))
        symbols = space.symbols("q phi")
        q, phi = symbols
        return GeneratingFunction(space, type=1, F=q**2 * sp.cot(phi) / 2)
    if name == "mixed":
        space = PhaseSpace("q1 q2", "p1 p2", new=("Q1 Q2", "P1 P2"), symbols={"h": "real"})
        symbols = space.symbols("q1 q2 Q1 Q2 h")
        q1, q2, Q1, Q2, h = symbols
        F = -((Q1 - q1) ** 2) / (2 * h) - ((Q2 - q2) ** 2) / 2 + h * sp.cos(q1) * q2
        return GeneratingFunction(space, type=1, F=F)
    space = PhaseSpace("q", "p", new=("Q", "P"), symbols={"h": "real"})
    symbols = space.symbols("q Q h")
    q, Q, h = symbols
    formulas = {
        "flow": ((q**2 + Q**2) * sp.cos(h) - 2 * q * Q) / (2 * sp.sin(h)),
        "leapfrog": -((Q - q) ** 2) / (2 * h) + h * (sp.cos(q) + sp.cos(Q)) / 2,
    }
    return GeneratingFunction(space, type=1, F=formulas[name])


def _our(
    name: str, count: int = 1, near: Callable[[Point], float] | None = None
) -> Callable[[Sequence[Point]], list[Answer]]:
    """Images of points (q, p, h); `near` is a guess of the new argument, which chooses a branch."""

    def route(points: Sequence[Point]) -> list[Answer]:
        import numpy as np

        from canon.claims.implicit_map import ImplicitMap

        answers = []
        for point in points:
            z, parameters = point[: 2 * count], {"h": point[-1]} if len(point) % 2 else {}
            guess = None if near is None else np.array([near(point)])
            image = ImplicitMap(_generating(name), parameters, TOLERATED).solve(np.array([z]), guess).images[0]
            answers.append(Answer(tuple((float(x),) for x in image)))
        return answers

    return route


def _flow(m: Any, q: Number, p: Number, h: Number) -> Quantities:
    """p = ∂F/∂q and P = −∂F/∂Q of F = ((q² + Q²) cos h − 2qQ)/(2 sin h), as they stand: h turns about the origin."""
    Q = q * m.cos(h) - p * m.sin(h)
    return (Q,), ((q - Q * m.cos(h)) / m.sin(h),)


def _leapfrog(m: Any, q: Number, p: Number, h: Number) -> Quantities:
    """p = ∂F/∂q and P = −∂F/∂Q of F = −(Q − q)²/2h + h (cos q + cos Q)/2: a kick, a drift, a kick."""
    Q = q + h * (p + h / 2 * m.sin(q))
    return (Q,), ((Q - q) / h + h / 2 * m.sin(Q),)


def _mixed(m: Any, q1: Number, q2: Number, p1: Number, p2: Number, h: Number) -> Quantities:
    """Two degrees of freedom, of which the first alone is near a caustic."""
    Q1 = q1 + h * (p1 + h * m.sin(q1) * q2)
    Q2 = q2 + p2 - h * m.cos(q1)
    return (Q1,), (Q2,), ((Q1 - q1) / h,), (Q2 - q2,)


def _scipy_newton(name: str) -> Callable[..., Quantities]:
    """F's equations, differentiated by sympy, solved by scipy's root finder for the new variables."""

    @lru_cache(maxsize=1)
    def equations() -> Any:
        import sympy as sp

        generating = _generating(name)
        space, F = generating.space, generating.F.expr
        old, new = (sp.Symbol(x) for x in ("old_p", "new_p"))
        off = [F.diff(space.q[0]) - old, -F.diff(space.Q[0]) - new]
        return sp.lambdify((space.q[0], old, sp.Symbol("h", real=True), space.Q[0], new), off, "math")

    def route(q: float, p: float, h: float) -> Quantities:
        from scipy.optimize import root

        found = root(lambda z: equations()(q, p, h, *z), [q + h * p, p], method="hybr", options={"xtol": 1e-15})
        return (float(found.x[0]),), (float(found.x[1]),)

    return route


def _pole(m: Any, q: Number, p: Number) -> Quantities:
    """φ and I of p = q cot φ, I = q²/(2 sin²φ): the oscillator's angle and action next to the poles of cot."""
    phi = m.atan2(q, p)
    return (phi,), (q * q / (2 * m.sin(phi) ** 2),)


SWEPT = tuple((0.7, 0.3, 10.0**-k) for k in (2, 5, 8, 11, 14))


def _swept(what: str, about: str, exact: Any, name: str) -> HardCase:
    """Type 1 of a map by h, which is the identity at h = 0: there Q = q, and no F(q, Q)."""
    return HardCase(
        f"{what}'s type 1, h = 1e-2 to 1e-14",
        "caustics",
        about,
        _INPUTS,
        SWEPT,
        exact,
        _our(name),
        peers={"scipy.optimize": each(_scipy_newton(name))},
        digits=80,
    )


CASES = (
    _swept("a flow", "images by F(q, Q) of a turn by h, whose second derivatives go as 1/h", _flow, "flow"),
    _swept("a leapfrog step", "images by an F(q, Q) that has no formula of another type", _leapfrog, "leapfrog"),
    HardCase(
        "a caustic in one of two degrees of freedom",
        "caustics",
        "images by F(q, Q), where types may differ by degree of freedom",
        ("q1", "q2", "p1", "p2", "h"),
        tuple((0.7, -0.4, 0.3, 0.2, 10.0**-k) for k in (2, 8, 14)),
        _mixed,
        _our("mixed", 2),
        digits=80,
    ),
    HardCase(
        "next to the poles of cot",
        "caustics",
        "the oscillator's angle and action by F = ½ q² cot φ, 1e-3 to 1e-14 from φ = 0 and φ = π",
        ("q", "p"),
        tuple((10.0**-k, p) for p in (0.8, -0.8) for k in (3, 8, 14)),
        _pole,
        _our("cot", near=lambda point: 0.1 if point[1] > 0 else 3.1),
        digits=80,
    ),
)
