"""The oscillator q̈ + 2γ q̇ + k q = f cos Ωt at resonance and at critical damping, and next to both."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from canon.hard.case import HardCase, Number, Quantities, compiled, each

_INPUTS = ("q", "v", "t", "k", "gamma", "f", "Omega")


def three_exponentials(
    m: Any, q: Number, v: Number, t: Number, k: Number, g: Number, f: Number, W: Number
) -> Quantities:
    """The sum of exponentials at the two roots and at iΩ, each over the product of its distances from the others.

    Where two coincide, one is moved by less than the digits wanted: their contributions cancel all but as much.
    """
    tiny = m.mpf(10) ** -(m.dps // 4)
    root = m.sqrt(m.mpc(g * g - k)) or tiny
    low, high, wave = -g - root, -g + root, m.mpc(0, W)
    if min(abs(wave - low), abs(wave - high)) < tiny:
        wave += 2 * tiny
    points = (wave, low, high)
    terms = [
        m.exp(z * t) / m.fprod([z - other for j, other in enumerate(points) if i != j]) for i, z in enumerate(points)
    ]
    slide = (m.exp(high * t) - m.exp(low * t)) / (high - low)
    even = (high * m.exp(low * t) - low * m.exp(high * t)) / (high - low)
    slope = (high * m.exp(high * t) - low * m.exp(low * t)) / (high - low)
    forced = m.fsum(terms)
    return (m.re(q * even + v * slide + f * forced),), (m.re(v * slope - q * k * slide + f * (slide + wave * forced)),)


def naive(q: float, v: float, t: float, k: float, g: float, f: float, W: float) -> Quantities:
    """The same in double precision, nothing moved."""
    import numpy as np

    root = np.sqrt(complex(g * g - k))
    low, high, wave = -g - root, -g + root, 1j * W
    slide = (np.exp(high * t) - np.exp(low * t)) / (high - low)
    even = (high * np.exp(low * t) - low * np.exp(high * t)) / (high - low)
    slope = (high * np.exp(high * t) - low * np.exp(low * t)) / (high - low)
    forced = (
        np.exp(wave * t) / ((wave - low) * (wave - high))
        + np.exp(low * t) / ((low - wave) * (low - high))
        + np.exp(high * t) / ((high - wave) * (high - low))
    )
    position = q * even + v * slide + f * forced
    velocity = v * slope - q * k * slide + f * (slide + wave * forced)
    return (float(position.real),), (float(velocity.real),)


def ours(q: Any, v: Any, t: Any, k: Any, g: Any, f: Any, W: Any) -> tuple[Any, Any]:
    """`canon.numeric.exact.oscillator`."""
    from canon.numeric.exact.oscillator import oscillator

    return oscillator(q, v, t, omega2=k, damping=g, force=f, drive=W)


def numpy_eig(q: float, v: float, t: float, k: float, g: float, f: float, W: float) -> Quantities:
    """By the eigenvectors of the first-order system, with cos Ωt and sin Ωt as variables of their own."""
    import numpy as np

    A = _system(k, g, f, W)
    values, vectors = np.linalg.eig(A)
    z = (vectors @ (np.exp(values * t) * np.linalg.solve(vectors, np.array([q, v, 1.0, 0.0], complex)))).real
    return (float(z[0]),), (float(z[1]),)


def scipy_expm(q: float, v: float, t: float, k: float, g: float, f: float, W: float) -> Quantities:
    """By scipy's exponential of the same matrix."""
    import numpy as np
    from scipy.linalg import expm

    z = expm(_system(k, g, f, W) * t) @ np.array([q, v, 1.0, 0.0])
    return (float(z[0]),), (float(z[1]),)


def _system(k: float, g: float, f: float, W: float) -> Any:
    import numpy as np

    return np.array([[0, 1, 0, 0], [-k, -2 * g, f, 0], [0, 0, 0, -W], [0, 0, W, 0]], dtype=float)


def sympy_dsolve(q: float, v: float, t: float, k: float, g: float, f: float, W: float) -> Quantities:
    """sympy's solution of the equation with parameters, its numbers put in by lambdify."""
    position, velocity = _solution(g == 0)(q, v, t, complex(k), g, f, W)
    return (complex(position).real,), (complex(velocity).real,)


@lru_cache(maxsize=2)
def _solution(undamped: bool) -> Any:
    import sympy as sp

    q0, v0, t, k, g, f, W = sp.symbols("q0 v0 t k g f W", positive=True)
    x = sp.Function("x")
    damping = 0 if undamped else 2 * g * x(t).diff(t)
    equation = sp.Eq(x(t).diff(t, 2) + damping + k * x(t), f * sp.cos(W * t))
    solution: Any = sp.dsolve(equation, x(t), ics={x(0): q0, x(t).diff(t).subs(t, 0): v0})
    found = solution.rhs
    return sp.lambdify((q0, v0, t, k, g, f, W), [found, found.diff(t)], "numpy")


def _case(name: str, states: str, points: tuple[tuple[float, ...], ...], *, driven: bool = True) -> HardCase:
    peers = {"numpy.linalg.eig": each(numpy_eig), "scipy.linalg.expm": each(scipy_expm)}
    if driven:
        peers["sympy dsolve"] = each(sympy_dsolve)
    return HardCase(
        name, "resonance", states, _INPUTS, points, three_exponentials, compiled(ours), each(naive), peers, digits=240
    )


CASES = (
    _case(
        "driven at resonance",
        "position and velocity of an undamped oscillator driven at its own frequency",
        tuple((1.0, 0.3, t, k, 0.0, 0.4, k**0.5) for t, k in ((7.0, 1.0), (40.0, 1.0), (7.0, 2.25))),
    ),
    _case(
        "within 1e-15 of resonance",
        "the same with a frequency that is hardly another",
        tuple((1.0, 0.3, 7.0, 1.0, 0.0, 0.4, 1 + d) for d in (1e-6, -1e-10, 1e-13, 1e-15)),
    ),
    _case(
        "resonance with hardly any damping",
        "the same with a damping of 1e-9 to 1e-15",
        tuple((1.0, 0.3, 7.0, 1.0, d, 0.4, 1.0) for d in (1e-9, 1e-12, 1e-15)),
    ),
    _case(
        "critical damping, below",
        "position and velocity of a free oscillator whose two decays nearly coincide",
        tuple((1.0, 0.3, 3.0, 1.0, 1 - d, 0.0, 0.0) for d in (0.0, 1e-6, 1e-11, 1e-15)),
        driven=False,
    ),
    _case(
        "critical damping, above",
        "the same, overdamped",
        tuple((1.0, 0.3, 3.0, 1.0, 1 + d, 0.0, 0.0) for d in (1e-6, 1e-11, 1e-15)),
        driven=False,
    ),
    _case(
        "heavily overdamped",
        "position and velocity long after the fast decay, free and driven",
        (
            (1.0, 0.3, 3.4, 0.36, 27.0, 0.0, 0.0),
            (1.0, 0.3, 80.0, 5.7, 65.0, 0.0, 0.0),
            (1.0, 0.3, 14.0, 0.38, 23.0, 0.4, 0.36),
            (1.0, 0.3, 140.0, 0.26, 18.0, 0.4, 0.22),
        ),
    ),
)
