"""Antiderivatives of rational functions of one cosine or sine, without jumps.

∫ dφ/(a + b cos φ) = (φ − 2 atan(b sin φ/(a + b cos φ + c)))/c, with c = √(a² − b²), is smooth for all φ where a > |b|,
as the usual one with tan(φ/2) isn't (it is Kepler's equation: the true anomaly is the eccentric one and twice an
angle). Higher powers follow by recursion (Gradshteyn & Ryzhik 2.553, 2.554).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

STEEPEST = 8
"""The largest power of a + b cos φ below."""


@dataclass(frozen=True)
class _Sum:
    """Σ terms[n] · (a + b c)**−n + polynomial(c) for a name c."""

    a: Any
    b: Any
    terms: dict[int, Any]
    polynomial: Any
    c: sp.Symbol


def wave_integrals(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """Antiderivatives of f by x, where f is a rational function of the sine and cosine of k x + d, with a power of
    a + b cos, or sin, of that angle or of twice it below."""
    phases = {wave.args[0] for wave in f.atoms(sp.sin, sp.cos) if wave.has(x)}
    if len(phases) != 1:
        return
    (phase,) = phases
    rate = sp.diff(phase, x)
    if rate.has(x) or rate.is_zero:
        return
    c, s = sp.Symbol("c", real=True), sp.Symbol("s", real=True)
    plain = f.xreplace({sp.cos(phase): c, sp.sin(phase): s})
    if plain.has(x) or not plain.is_rational_function(c, s):
        return
    by_sine = _without(plain, c, 1 - s**2)
    ways = (
        (_without(plain, s, 1 - c**2), phase, sp.cos(phase), sp.sin(phase)),
        (None if by_sine is None else by_sine.xreplace({s: c}), phase - sp.pi / 2, sp.sin(phase), -sp.cos(phase)),
        (_by_double_angle(plain, c, s), 2 * phase, sp.cos(2 * phase), sp.sin(2 * phase)),
    )
    for in_one, angle, cosine, sine in ways:
        parts = None if in_one is None else _divided(in_one, c)
        if parts is not None:
            yield _assembled(parts, angle, cosine, sine) / sp.diff(angle, x)


def _without(f: Any, gone: sp.Symbol, square: Any) -> Any | None:
    """The function with `square` for the square of a name that stands in it in even powers; None where it doesn't."""
    parts = []
    for part in sp.fraction(sp.together(f)):
        polynomial = sp.Poly(sp.expand(part), gone)
        if any(n % 2 for (n,) in polynomial.monoms()):
            return None
        parts.append(sp.Add(*(value * square ** (n // 2) for (n,), value in polynomial.terms())))
    return sp.cancel(parts[0] / parts[1])


def _by_double_angle(f: Any, c: sp.Symbol, s: sp.Symbol) -> Any | None:
    """A function of even powers of cosine and sine in the cosine of twice the angle, for which c stands."""
    square = sp.Dummy("square")
    found = _without(f, s, square)
    found = None if found is None else _without(found, c, 1 - square)
    return None if found is None else sp.cancel(found.subs(square, (1 - c) / 2))


def _divided(f: Any, c: sp.Symbol) -> _Sum | None:
    """By powers of the one linear factor below; None for other denominators."""
    above, below = sp.fraction(sp.cancel(f))
    factored: Any = sp.factor_list(below, c)
    content, factors = factored
    if len(factors) != 1:
        return None
    base, n = factors[0]
    line = sp.Poly(base, c)
    if line.degree() != 1 or n > STEEPEST:
        return None
    b, a = line.all_coeffs()
    sign = -1 if a.could_extract_minus_sign() else 1  # a is to be positive
    rest, terms = sp.Poly(above / content, c), dict[int, Any]()
    for k in range(n, 0, -1):
        rest, remainder = sp.div(rest, line)
        terms[k] = sp.together(remainder.as_expr()) * sign**k
    return _Sum(sign * a, sign * b, terms, rest.as_expr(), c)


def _assembled(parts: _Sum, angle: Any, cosine: Any, sine: Any) -> Any:
    """The antiderivative by the angle."""
    a, b = parts.a, parts.b
    c = sp.sqrt(sp.factor(a**2 - b**2))
    below = a + b * cosine
    first = (
        (sp.log(1 + sine) - sp.log(sp.Abs(cosine))) / b if a == 0 else (angle - 2 * sp.atan(b * sine / (below + c))) / c
    )
    known = {0: angle, 1: first}
    for n in range(2, max(parts.terms) + 1):
        edge = -b * sine / below ** (n - 1)
        known[n] = (edge + (2 * n - 3) * a * known[n - 1] - (n - 2) * known[n - 2]) / ((n - 1) * c**2)
    total = sp.Add(*(value * known[n] for n, value in parts.terms.items()))
    for (n,), value in sp.Poly(parts.polynomial, parts.c).terms():
        for k in range(n + 1):  # cosⁿ φ = 2⁻ⁿ Σ binomial(n, k) cos (n − 2k)φ
            m = n - 2 * k
            wave = sp.sin(m * angle) / m if m else angle
            total += value * sp.binomial(n, k) / sp.Integer(2) ** n * wave
    return total
