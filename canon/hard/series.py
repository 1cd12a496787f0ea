"""Lie series at and beyond the edge of their convergence, and brackets nested twelve deep."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, each

ORDER = 20
DEEP = 12


def _symbols() -> tuple[Any, Any]:
    import sympy as sp

    return sp.symbols("q p", real=True)


def _summed(hamiltonian: Callable[[Any, Any], Any]) -> Callable[[Sequence[Point]], list[Answer]]:
    """exp(s {·, G}) q from points (q, p, s)."""

    def route(points: Sequence[Point]) -> list[Answer]:
        from canon.numeric.lie_sum import lie_sum

        q, p = _symbols()
        found = [lie_sum(q, hamiltonian(q, p), (q,), (p,), {q: a, p: b}, s) for a, b, s in points]
        return [Answer(((each.value.value,),), (each.value.bound,)) for each in found]

    return route


def _moebius(m: Any, q: Number, p: Number, s: Number) -> Quantities:
    """The flow of q²p takes q into q/(1 − sq): its series has the radius 1/q."""
    return ((q / (1 - s * q),),)


def _moebius_series(q: float, p: float, s: float) -> Quantities:
    """The series up to a fixed order."""
    return ((sum(q * (s * q) ** k for k in range(ORDER + 1)),),)


def _fall(m: Any, q: Number, p: Number, s: Number) -> Quantities:
    """The pendulum from the bottom, q = 0, below the separatrix: 2 arcsin(k sn s). Whittaker (1937), 44."""
    k = p / 2
    sn = m.ellipfun("sn", s, k * k)
    return ((2 * m.asin(k * getattr(sn, "real", sn)),),)


def _fall_series(q: float, p: float, s: float) -> Quantities:
    """The series up to a fixed order, its coefficients by the recurrence of sin and cos."""
    x, y, sine, cosine = [q], [p], [0.0], [1.0]
    for k in range(ORDER):
        x.append(y[k] / (k + 1))
        y.append(-sine[k] / (k + 1))
        sine.append(sum((j + 1) * x[j + 1] * cosine[k - j] for j in range(k + 1)) / (k + 1))
        cosine.append(-sum((j + 1) * x[j + 1] * sine[k - j] for j in range(k + 1)) / (k + 1))
    return ((sum(a * s**k for k, a in enumerate(x)),),)


def _pendulum(q: Any, p: Any) -> Any:
    import sympy as sp

    return p**2 / 2 - sp.cos(q)


def _duffing(q: Any, p: Any) -> Any:
    return p**2 / 2 - q**2 / 2 + q**4 / 4


def _deep(m: Any, q: Number, p: Number) -> Quantities:
    """The twelfth derivative of q along q̈ = q − q³, by the recurrence of Taylor's coefficients."""
    x, y = [q], [p]
    for k in range(DEEP):
        square = [sum(x[i] * x[j - i] for i in range(j + 1)) for j in range(k + 1)]
        cube = sum(x[i] * square[k - i] for i in range(k + 1))
        x.append(y[k] / (k + 1))
        y.append((x[k] - cube) / (k + 1))
    value = x[DEEP]
    for k in range(1, DEEP + 1):
        value = value * k
    return ((value,),)


def _our_deep(points: Sequence[Point]) -> list[Answer]:
    from canon.numeric.lie_sum import nested_bracket

    q, p = _symbols()
    found = [nested_bracket(q, _duffing(q, p), (q,), (p,), {q: a, p: b}, DEEP) for a, b in points]
    return [Answer(((each.value,),), (each.bound,)) for each in found]


@lru_cache(maxsize=1)
def _expanded() -> Any:
    import sympy as sp

    q, p = _symbols()
    H = sp.Poly(_duffing(q, p), q, p)
    f = sp.Poly(q, q, p)
    for _ in range(DEEP):
        f = f.diff(q) * H.diff(p) - f.diff(p) * H.diff(q)
    return sp.lambdify((q, p), f.as_expr(), "math")


def _sympy_deep(q: float, p: float) -> Quantities:
    """The nested brackets multiplied out by sympy, and lambdified."""
    return ((_expanded()(q, p),),)


_INPUTS = ("q", "p", "s")
CASES = (
    HardCase(
        "Lie series at the edge of convergence",
        "series",
        "exp(s {·, q²p}) q within 1% of its radius on both sides, and beyond it",
        _INPUTS,
        tuple((1.0, 0.5, s) for s in (0.5, 0.9, 0.99, -0.99, -5.0)),
        _moebius,
        _summed(lambda q, p: q**2 * p),
        each(_moebius_series),
    ),
    HardCase(
        "the pendulum's Lie series beyond its radius",
        "series",
        "the angle of a pendulum at twice the time up to which its series converges",
        _INPUTS,
        ((0.0, 1.7, 1.0), (0.0, 1.7, 3.0), (0.0, 0.5, 6.0)),
        _fall,
        _summed(_pendulum),
        each(_fall_series),
    ),
    HardCase(
        "brackets nested twelve deep",
        "series",
        "{…{q, H}, …, H} of the Duffing oscillator, near its equilibrium at q = 1",
        ("q", "p"),
        ((1 + 2.0**-10, 1e-3), (1 - 2.0**-14, 1e-5), (1.4, 0.2)),
        _deep,
        _our_deep,
        each(_sympy_deep),
        peers={"sympy": each(_sympy_deep)},
    ),
)
