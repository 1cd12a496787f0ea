"""Turning points and quadratures of many oscillations at once, in double precision: what all separable systems share.

Of one coordinate x, the square of the momentum is F(x) times a positive factor, F(x₀) ≥ 0 at the given state. A wide
oscillation is integrated at nodes that are even in θ, u = mid − half cos θ, where u is a logarithm of x: near an end F
is a difference of large numbers, but there it hardly counts. In a narrow one that difference would be all there is: F
is taken as F(x₀) + F′(x₀) y + …, whose further coefficients are those of a polynomial through F″; its zeros are the
turning points with the digits that the state has, and the factor that is left when they are divided out, which takes
none of the first two coefficients, loses none. Functions take arrays of one axis.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

Scalar = Callable[[Any], Any]

NARROW: Final = 0.05
NARROW_NODES: Final = 7
DEGREES: Final = ((0.0015, 5), (2 * NARROW, 11))
"""Those of the polynomial through F″, for oscillations that seem to have so small a part of the scale as amplitude."""

_WIDER: Final = 1.25
_LEAST: Final = 1e-12
_IMPROVED: Final = 4
_SMOOTH: Final = 2e-17
_STEP: Final = 0.2
_STEPS: Final = 400
_HALVINGS: Final = 60
_CLOSE: Final = 1e-14


def turning_points(F: Scalar, start: Any) -> tuple[Any, Any]:
    """The zeros of F(u) next to `start` on either side; nan where there is none within 80.

    It is walked towards them in steps of a fifth: what is narrower is walked over.
    """
    import jax.numpy as jnp
    from jax import lax

    def side(sign: float) -> Any:
        def walk(state: Any) -> Any:
            count, u, done = state
            beyond = u + sign * _STEP
            return count + 1, jnp.where(done, u, beyond), done | (F(beyond) < 0)

        _, u, found = lax.while_loop(
            lambda state: (state[0] < _STEPS) & ~jnp.all(state[2]), walk, (0, start, start != start)
        )
        return zero_between(F, jnp.where(found, u - sign * _STEP, jnp.nan), u)

    return side(-1.0), side(1.0)


def zero_between(F: Scalar, inner: Any, outer: Any, start: Any = None, close: float = _CLOSE) -> Any:
    """The zero between places where F ≥ 0 and F < 0: Newton's steps where they stay inside, halvings elsewhere."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    def improve(state: Any) -> Any:
        count, inner, outer, u, _ = state
        value, slope = jax.jvp(F, (u,), (jnp.ones_like(u),))
        inner, outer = jnp.where(value >= 0, u, inner), jnp.where(value >= 0, outer, u)
        target = u - value / slope
        inside = (target - inner) * (target - outer) <= 0
        new = jnp.where(inside, target, (inner + outer) / 2)
        return count + 1, inner, outer, new, jnp.abs(new - u) <= close * jnp.minimum(1.0, jnp.abs(new) + close)

    def going_on(state: Any) -> Any:
        return (state[0] < _HALVINGS) & ~jnp.all(state[4] | jnp.isnan(state[3]))

    first = (inner + outer) / 2 if start is None else start
    return lax.while_loop(going_on, improve, (0, inner, outer, first, first != first))[3]


def of_parabola(F0: Any, first: Any, second: Any) -> tuple[Any, Any]:
    """The zeros y of F0 + first y + second y², the farther one first; the nearer follows from their product."""
    import jax.numpy as jnp

    spread = jnp.sqrt(jnp.maximum(first * first - 4 * second * F0, 0.0))
    far = -(first + jnp.where(first >= 0, spread, -spread)) / (2 * second)
    return far, jnp.where(far != 0, F0 / (second * jnp.where(far != 0, far, 1.0)), 0.0)


def seeming_amplitude(F0: Any, first: Any, second: Any, scale: Any) -> Any:
    """How far the farther zero of a parabola is, in parts of a scale; infinite where it isn't one of an oscillation."""
    import jax.numpy as jnp

    return jnp.where(second < 0, jnp.abs(of_parabola(F0, first, second)[0]) / scale, jnp.inf)


class Narrow(NamedTuple):
    """A narrow oscillation, F = (y − low)(high − y) · `stiffness`(y) at x₀ + y; `holds` says whether it is one."""

    low: Any
    high: Any
    stiffness: Scalar
    holds: Any


def narrow_oscillation(F0: Any, first: Any, bend: Scalar, scale: Any, degree: int) -> Narrow:
    """The oscillation about x₀, if F and its slope `first` there and F″ = `bend`(y) make it a narrow one.

    `scale` is the length on which F may vary. It is one if its ends are near, F is positive between them and negative
    beyond, and smooth: the last coefficients of the polynomial through F″, of this degree, say that the next one, which
    an interpolation in Chebyshev's nodes counts 2^−degree times, and two integrations less, is below the rounding.
    """
    import jax.numpy as jnp

    far, near = of_parabola(F0, first, bend(jnp.zeros_like(F0)) / 2)
    h = jnp.minimum(_WIDER * jnp.maximum(jnp.abs(far), jnp.abs(near)), 2 * _WIDER * NARROW * scale)
    h = jnp.maximum(h, _LEAST * scale)
    nodes, series, powers = _chebyshev(degree)
    # in two steps: a small rounding of the series is a small polynomial, but one of each power wouldn't be
    bends = jnp.tensordot(powers, jnp.tensordot(series, bend(h * nodes[:, None]), axes=1), axes=1)
    # F as a polynomial in x = y/h
    coefficients = [F0, first * h, *(h * h * bends[k] / ((k + 1) * (k + 2)) for k in range(degree + 1))]

    def value(x: Any) -> Any:
        return horner(coefficients, x)

    slopes = [k * c for k, c in enumerate(coefficients)][1:]
    ends = []
    for x in (far / h, near / h):
        for _ in range(_IMPROVED):
            rate = horner(slopes, x)
            x = x - value(x) / jnp.where(rate != 0, rate, jnp.inf)
        ends.append(x)
    a, b = jnp.minimum(*ends), jnp.maximum(*ends)
    # without the factor (x − a)(x − b), from the highest coefficient down: the lowest two aren't used
    quotient = [coefficients[-1], coefficients[-2] + (a + b) * coefficients[-1]]
    for c in coefficients[-3:1:-1]:
        quotient.append(c + (a + b) * quotient[-1] - a * b * quotient[-2])
    quotient.reverse()
    half = (b - a) / 2
    inside = (value((a + b) / 2) > 0) & (value(a - half / 2) < 0) & (value(b + half / 2) < 0)
    # a circle has no inside; it is one where it is stable
    shaped = inside | ((half == 0) & (quotient[0] < 0))
    share = h / scale
    following = (jnp.abs(bends[degree]) + jnp.abs(bends[degree - 1]) * share) * 2 * share
    smooth = following <= _SMOOTH * 2**degree * (degree + 2) * (degree + 3) * jnp.abs(bends[0])
    close = (a <= 0) & (b >= 0) & (jnp.maximum(-a, b) * h < NARROW * scale)
    return Narrow(a * h, b * h, lambda y: -horner(quotient, y / h) / (h * h), close & shaped & smooth)


@lru_cache(maxsize=4)
def _chebyshev(degree: int) -> tuple[Any, Any, Any]:
    """Nodes in (−1, 1), the matrix that leads from values there to a series of Chebyshev's polynomials, and from it to
    powers."""
    count = degree + 1
    angles = (np.arange(count) + 0.5) * np.pi / count
    series = 2 / count * np.cos(np.outer(np.arange(count), angles))
    series[0] /= 2
    powers = np.zeros((count, count))
    for k in range(count):
        found = np.polynomial.chebyshev.cheb2poly(np.eye(count)[k])
        powers[: found.size, k] = found
    return np.cos(angles), series, powers


def horner(coefficients: Sequence[Any], x: Any) -> Any:
    """The polynomial with these coefficients, the constant first."""
    total = coefficients[-1]
    for c in coefficients[-2::-1]:
        total = total * x + c
    return total


def partial_quadrature(
    term: Callable[[Any, Any], tuple[Any, ...]], low: Any, high: Any, phase: Any, count: int
) -> tuple[Any, ...]:
    """∫ of each `term`(u, sin θ) dθ from 0 to the `phase`, for u = mid − half cos θ; the phase may be any angle.

    A function that is even in θ and smooth is a series of cosines, which the nodes of `quadrature` determine.
    """
    import jax.numpy as jnp
    from jax import lax

    mid, half = (low + high) / 2, (high - low) / 2
    angles = (np.arange(count) + 0.5) * np.pi / count
    cosines, sines = jnp.asarray(np.cos(angles)), jnp.asarray(np.sin(angles))
    orders = np.arange(1, count)
    waves = jnp.sin(orders[:, None] * phase) / orders[:, None]
    weights = (phase + 2 * jnp.asarray(np.cos(np.outer(angles, orders))) @ waves) / count

    def add(k: Any, sums: Any) -> Any:
        values = term(mid - half * cosines[k], sines[k])
        return tuple(a + weights[k] * b for a, b in zip(sums, values, strict=True))

    width = len(term(mid, sines[0]))
    return lax.fori_loop(0, count, add, (jnp.zeros_like(mid),) * width)


def quadrature(term: Callable[[Any, Any], tuple[Any, ...]], low: Any, high: Any, count: int) -> tuple[Any, ...]:
    """The sums over `count` nodes of `term`(u, sin θ) times π/count, for u = mid − half cos θ."""
    import jax.numpy as jnp
    from jax import lax

    mid, half = (low + high) / 2, (high - low) / 2
    angles = (np.arange(count) + 0.5) * np.pi / count
    cosines, sines = jnp.asarray(np.cos(angles)), jnp.asarray(np.sin(angles))

    def add(k: Any, sums: Any) -> Any:
        return tuple(a + b for a, b in zip(sums, term(mid - half * cosines[k], sines[k]), strict=True))

    width = len(term(mid, sines[0]))
    sums = lax.fori_loop(0, count, add, (jnp.zeros_like(mid),) * width)
    return tuple(np.pi / count * value for value in sums)
