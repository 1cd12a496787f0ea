"""Turning points and quadratures of many oscillations at once, in double precision: what all separable systems share.

Of one coordinate x, the square of the momentum is F(x) times a positive factor, F(x₀) ≥ 0 at the given state. A wide
oscillation is integrated at nodes that are even in θ, u = mid − half cos θ, where u is a logarithm of x: near an end F
is a difference of large numbers, but there it hardly counts. In a narrow one that difference would be all there is: F
is taken as F(x₀) + y D(y), with a divided difference D, which gives the turning points with the digits that the state
has; and between them as their distances times a mean of −F″, which loses none. Functions take arrays of one axis.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

Scalar = Callable[[Any], Any]

NARROW: Final = 0.05
GAUSS: Final = 5
NARROW_NODES: Final = 10
_STEP: Final = 0.2
_STEPS: Final = 400
_HALVINGS: Final = 60
_CLOSE: Final = 1e-14
_NEWTON: Final = 8
_SMOOTH: Final = 1e-9


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


def mean_slope(f: Scalar, x: Any) -> Scalar:
    """The divided difference (f(x + y) − f(x))/y as a function of y, by Gauss's rule for ∫₀¹ f′(x + sy) ds."""
    import jax
    import jax.numpy as jnp

    nodes, weights = np.polynomial.legendre.leggauss(GAUSS)

    def slope(at: Any) -> Any:
        return jax.jvp(f, (at,), (jnp.ones_like(at),))[1]

    return lambda y: jnp.tensordot(weights / 2, slope(x + (nodes[:, None] + 1) / 2 * y), axes=1)


def mean_curvature(bend: Scalar, a: Any, b: Any, order: int = GAUSS) -> Scalar:
    """The second divided difference f[a, b, y] as a function of y, given f″ = `bend`.

    Hermite and Genocchi: f[a, b, y] = ∫₀¹∫₀¹ t f″(a + t (b − a) + tτ (y − b)) dτ dt. de Boor (2005), Surveys in
    Approximation Theory 1, 46.
    """
    import jax.numpy as jnp

    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2
    t, tau = np.repeat(nodes, order), np.tile(nodes, order)
    products = np.outer(weights * nodes, weights).ravel()
    return lambda y: jnp.tensordot(products, bend(a + t[:, None] * ((b - a) + tau[:, None] * (y - b))), axes=1)


def of_parabola(F0: Any, first: Any, second: Any) -> tuple[Any, Any]:
    """The zeros y of F0 + first y + second y², the farther one first; the nearer follows from their product."""
    import jax.numpy as jnp

    spread = jnp.sqrt(jnp.maximum(first * first - 4 * second * F0, 0.0))
    far = -(first + jnp.where(first >= 0, spread, -spread)) / (2 * second)
    return far, jnp.where(far != 0, F0 / (second * jnp.where(far != 0, far, 1.0)), 0.0)


def may_be_narrow(F0: Any, first: Any, second: Any, scale: Any) -> Any:
    """Whether the parabola's zeros are as near to each other as those of a narrow oscillation."""
    import jax.numpy as jnp

    return (second < 0) & (jnp.abs(of_parabola(F0, first, second)[0]) < 2 * NARROW * scale)


def narrow_ends(D: Scalar, F0: Any) -> tuple[Any, Any]:
    """The two zeros y of F0 + y D(y) about 0: by its parabola, then by Newton's method."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    zero = jnp.zeros_like(F0)
    far, near = of_parabola(F0, *jax.jvp(D, (zero,), (jnp.ones_like(F0),)))

    def improve(_: Any, y: Any) -> Any:
        value, slope = jax.jvp(D, (y,), (jnp.ones_like(y),))
        rate = value + y * slope
        return y - (F0 + y * value) / jnp.where(rate != 0, rate, jnp.inf)

    ends = [lax.fori_loop(0, _NEWTON, improve, y) for y in (far, near)]
    return jnp.minimum(*ends), jnp.maximum(*ends)


def is_narrow(D: Scalar, F0: Any, bend: Scalar, low: Any, high: Any, scale: Any) -> Any:
    """Whether F0 + y D(y) is positive between these ends and negative beyond, they are near, and F is smooth there.

    `bend` is F″ as a function of y; `scale` the length on which F may vary.
    """
    import jax.numpy as jnp

    half = (high - low) / 2

    def F(y: Any) -> Any:
        return F0 + y * D(y)

    near = (low <= 0) & (high >= 0) & (jnp.maximum(-low, high) < NARROW * scale)
    inside = (F((low + high) / 2) > 0) & (F(low - half / 2) < 0) & (F(high + half / 2) < 0)
    fine, coarse = (mean_curvature(bend, low, high, order)(low) for order in (GAUSS, GAUSS - 2))
    # a circle has no inside; it is one where it is stable
    return near & (inside | ((half == 0) & (fine < 0))) & (jnp.abs(fine - coarse) <= _SMOOTH * jnp.abs(fine))


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
