"""Brackets that cancel or overflow, and expressions of a hundred thousand terms."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, each


def _overflowing(m: Any, q: Number, p: Number) -> Quantities:
    """{p² e^(900q), p e^(−900q)}, its exponentials multiplied out last."""
    up, down = m.exp(900 * q), m.exp(-900 * q)
    return (((900 * p * p * up) * down - (2 * p * up) * (-900 * p * down),),)


def _vanishing(m: Any, x: Number, y: Number, u: Number, v: Number, delta: Number) -> Quantities:
    """{A_x, H} of Kepler's problem, A = p × L − (1 + δ) r/r: −δ d(x/r)/dt."""
    r = m.sqrt(x * x + y * y)
    return ((-delta * (u / r - x * (x * u + y * v) / r**3),),)


@lru_cache(maxsize=1)
def _brackets() -> dict[str, tuple[tuple[Any, ...], Any]]:
    import sympy as sp

    from canon.mechanics.poisson import bracket_in

    q, p, x, y, u, v = sp.symbols("q p x y u v", real=True)
    delta = sp.Symbol("delta", positive=True)
    r = sp.sqrt(x**2 + y**2)
    A = v * (x * v - y * u) - (1 + delta) * x / r
    H = (u**2 + v**2) / 2 - 1 / r
    up, down = p**2 * sp.exp(900 * q), p * sp.exp(-900 * q)
    overflowing = up.diff(q) * down.diff(p) - sp.Mul(up.diff(p), down.diff(q), evaluate=False)
    return {
        "overflowing": ((q, p), overflowing),
        "vanishing": ((x, y, u, v, delta), bracket_in(A, H, (x, y), (u, v))),
    }


def _our(name: str) -> Any:
    def route(points: Sequence[Point]) -> list[Answer]:
        from canon.numeric.values import value_at

        symbols, bracket = _brackets()[name]
        found = [value_at(bracket, dict(zip(symbols, point, strict=True))) for point in points]
        return [Answer(((each.value,),), (each.bound,)) for each in found]

    return route


def _lambdified(name: str) -> Any:
    """sympy's own function of doubles."""

    @lru_cache(maxsize=1)
    def function() -> Any:
        import sympy as sp

        symbols, bracket = _brackets()[name]
        return sp.lambdify(symbols, bracket, "math")

    return lambda *point: function()(*point)


def _telescope(pairs: int) -> Any:
    """Σ_{k=1}^n (1/(x + k) − 1/(x + k + 1)) = n/((x + 1)(x + n + 1)): all that is left of it."""
    return lambda m, x: ((pairs / ((1 + x) * (pairs + 1 + x)),),)


def _our_sum(pairs: int) -> Any:
    """The sum as a formula of 2n terms, as it is written."""

    def route(points: Sequence[Point]) -> list[Answer]:
        import sympy as sp

        from canon.numeric.values import value_at

        x = sp.Symbol("x", positive=True)
        shifted = [sp.Pow(sp.Add(x, sp.Integer(k), evaluate=False), -1, evaluate=False) for k in range(1, pairs + 2)]
        terms = [*shifted[:-1], *(sp.Mul(-1, term, evaluate=False) for term in shifted[1:])]
        expression = sp.Add(*terms, evaluate=False)
        found = [value_at(expression, {x: point[0]}) for point in points]
        return [Answer(((each.value,),), (each.bound,)) for each in found]

    return route


def _plain_sum(pairs: int) -> Any:
    return lambda x: sum(1 / (x + k) for k in range(1, pairs + 1)) - sum(1 / (x + k + 1) for k in range(1, pairs + 1))


def _long(pairs: int, name: str, *, slow: bool) -> HardCase:
    return HardCase(
        name,
        "brackets",
        "the value of a sum whose terms cancel but for the first and the last",
        ("x",),
        ((1e3,), (1e8,)),
        _telescope(pairs),
        _our_sum(pairs),
        each(_plain_sum(pairs)),
        slow=slow,
    )


CASES = (
    HardCase(
        "brackets of functions that overflow",
        "brackets",
        "{p² e^(900q), p e^(−900q)}, whose factors are beyond 1e308",
        ("q", "p"),
        ((1.0, 0.3), (3.0, 1.0), (-2.0, 1e-3)),
        _overflowing,
        _our("overflowing"),
        peers={"sympy": each(_lambdified("overflowing"))},
    ),
    HardCase(
        "a bracket that all but vanishes",
        "brackets",
        "the Laplace–Runge–Lenz vector's with H, its strength off by 1e-6 to 1e-20",
        ("x", "y", "u", "v", "delta"),
        tuple((1.0, 0.3, 0.2, 0.9, 10.0**-k) for k in (6, 12, 20)),
        _vanishing,
        _our("vanishing"),
        each(_lambdified("vanishing")),
        peers={"sympy": each(_lambdified("vanishing"))},
    ),
    _long(5_000, "an expression of 1e4 terms", slow=False),
    _long(50_000, "an expression of 1e5 terms", slow=True),
)
