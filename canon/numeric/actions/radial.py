"""The radial motion of many orbits at once: turning points and ∮ p_r dr for any smooth potential, in double precision.

Two kinds of orbits are computed in two ways. Where the radius changes by more than a part in `NARROW`, p_r² is taken as
2m(E − V) − L²/r² at nodes that are even in θ, ln r = mid − half cos θ: near an end it is a difference of large numbers,
but there it hardly counts. Where the radius hardly changes, that difference would be all there is; p_r² is taken then
as what it is at the given point, plus (x − r) D(x), with the divided difference D = L²(x + r)/(rx)² − 2m V[r, x] by
Gauss's rule for ∫ V'(r + s(x − r)) ds, which gives the turning points with the digits that the state has; and between
them as their distances times a mean of its second derivative, which loses none.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np

Scalar = Callable[[Any], Any]

NARROW: Final = 0.05
_STEP: Final = 0.2
_STEPS: Final = 400
_GAUSS: Final = 5
_NEWTON: Final = 8
_HALVINGS: Final = 60
_CLOSE: Final = 1e-14
NEAR_NODES: Final = 10
_SMOOTH: Final = 1e-9


class Sums(NamedTuple):
    """∫ of p_r dr, of dr/p_r and of L dr/(r² p_r) between the turning points, and these, for every orbit."""

    action: Any
    time: Any
    angle: Any
    low: Any
    high: Any


def turning_points(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> tuple[Any, Any]:
    """The turning points next to r on either side, as ln r; nan where there is none within 80 powers of e.

    G = r² p_r² changes sign there. It is walked towards them in steps of a fifth in ln r: a barrier that is narrower is
    walked over.
    """
    import jax.numpy as jnp
    from jax import lax

    E2 = p * p + L * L / (r * r) + 2 * m * V(r)
    start = jnp.log(r)

    def G(u: Any) -> Any:
        x = jnp.exp(u)
        return x * x * (E2 - 2 * m * V(x)) - L * L

    def side(sign: float) -> Any:
        def walk(state: Any) -> Any:
            count, u, done = state
            beyond = u + sign * _STEP
            return count + 1, jnp.where(done, u, beyond), done | (G(beyond) < 0)

        _, u, found = lax.while_loop(
            lambda state: (state[0] < _STEPS) & ~jnp.all(state[2]), walk, (0, start, start != start)
        )
        root = _bisected(G, jnp.where(found, u - sign * _STEP, jnp.nan), u)
        return root

    return side(-1.0), side(1.0)


def _bisected(G: Scalar, inner: Any, outer: Any) -> Any:
    """The zero between places where G ≥ 0 and G < 0: Newton's steps where they stay inside, halvings elsewhere."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    def improve(state: Any) -> Any:
        count, inner, outer, u, _ = state
        value, slope = jax.jvp(G, (u,), (jnp.ones_like(u),))
        inner, outer = jnp.where(value >= 0, u, inner), jnp.where(value >= 0, outer, u)
        target = u - value / slope
        inside = (target - inner) * (target - outer) <= 0
        new = jnp.where(inside, target, (inner + outer) / 2)
        return count + 1, inner, outer, new, jnp.abs(new - u) <= _CLOSE

    def going_on(state: Any) -> Any:
        return (state[0] < _HALVINGS) & ~jnp.all(state[4] | jnp.isnan(state[3]))

    start = (inner + outer) / 2
    return lax.while_loop(going_on, improve, (0, inner, outer, start, start != start))[3]


def wide_sums(V: Scalar, r: Any, p: Any, L: Any, m: Any, low: Any, high: Any, count: int) -> Sums:
    """The integrals by Gauss–Chebyshev with `count` nodes in ln r, between turning points given as ln r."""
    import jax.numpy as jnp
    from jax import lax

    E2 = p * p + L * L / (r * r) + 2 * m * V(r)
    mid, half = (low + high) / 2, (high - low) / 2
    angles = (np.arange(count) + 0.5) * np.pi / count
    cosines, sines = jnp.asarray(np.cos(angles)), jnp.asarray(np.sin(angles))

    def add(k: Any, sums: Any) -> Any:
        x = jnp.exp(mid - half * cosines[k])
        square = E2 - 2 * m * V(x) - (L / x) ** 2
        momentum = jnp.sqrt(jnp.maximum(square, 0.0))
        weight = sines[k] * x
        rate = weight / jnp.where(momentum > 0, momentum, jnp.inf)
        return sums[0] + weight * momentum, sums[1] + rate, sums[2] + rate * L / (x * x)

    zero = jnp.zeros_like(r)
    sums = lax.fori_loop(0, count, add, (zero, zero, zero))
    unit = half * np.pi / count
    return Sums(unit * sums[0], unit * m * sums[1], unit * sums[2], jnp.exp(low), jnp.exp(high))


def narrow_ends(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> tuple[Any, Any]:
    """The distances y of the turning points from r, as roots of p² + y D(r + y): by its parabola, then by Newton."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    D = divided(V, r, L, m)
    zero = jnp.zeros_like(r)
    first, second = jax.jvp(D, (zero,), (jnp.ones_like(r),))
    spread = jnp.sqrt(jnp.maximum(first * first - 4 * second * p * p, 0.0))
    far = -(first + jnp.where(first >= 0, spread, -spread)) / (2 * second)
    near = jnp.where(far != 0, p * p / (second * jnp.where(far != 0, far, 1.0)), 0.0)

    def improve(_: Any, y: Any) -> Any:
        value, slope = jax.jvp(D, (y,), (jnp.ones_like(y),))
        rate = value + y * slope
        return y - (p * p + y * value) / jnp.where(rate != 0, rate, jnp.inf)

    ends = [lax.fori_loop(0, _NEWTON, improve, y) for y in (far, near)]
    return jnp.minimum(*ends), jnp.maximum(*ends)


def divided(V: Scalar, r: Any, L: Any, m: Any) -> Scalar:
    """D(y) = (p_r²(r + y) − p_r²(r))/y, which has no small denominator."""
    import jax
    import jax.numpy as jnp

    nodes, weights = np.polynomial.legendre.leggauss(_GAUSS)

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    def D(y: Any) -> Any:
        x = r + y
        mean = sum(w / 2 * slope(r + (s + 1) / 2 * y) for s, w in zip(nodes, weights, strict=True))
        return (L / (r * x)) ** 2 * (x + r) - 2 * m * mean

    return D


def curved(V: Scalar, r: Any, L: Any, m: Any, low: Any, high: Any, order: int = _GAUSS) -> Scalar:
    """g(y) = p_r²/((y − low)(high − y)): minus the second divided difference of p_r², a mean of its second derivative.

    Hermite and Genocchi: f[a, b, y] = ∫₀¹∫₀¹ t f″(a + t (b − a) + tτ (y − b)) dτ dt. de Boor (2005), Surveys in
    Approximation Theory 1, 46.
    """
    import jax
    import jax.numpy as jnp

    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    def curvature(x: Any) -> Any:
        return 6 * (L / (x * x)) ** 2 + 2 * m * jax.jvp(slope, (x,), (jnp.ones_like(x),))[1]

    def g(y: Any) -> Any:
        return sum(
            u * w * t * curvature(r + low + t * ((high - low) + tau * (y - high)))
            for t, u in zip(nodes, weights, strict=True)
            for tau, w in zip(nodes, weights, strict=True)
        )

    return g


def narrow_sums(V: Scalar, r: Any, p: Any, L: Any, m: Any, low: Any, high: Any, count: int) -> Sums:
    """The integrals of a nearly circular orbit between y = `low` and `high`, where p_r² = (y − low)(high − y) g(y)."""
    import jax.numpy as jnp
    from jax import lax

    g = curved(V, r, L, m, low, high)
    mid, half = (low + high) / 2, (high - low) / 2
    angles = (np.arange(count) + 0.5) * np.pi / count
    cosines, sines = jnp.asarray(np.cos(angles)), jnp.asarray(np.sin(angles))

    def add(k: Any, sums: Any) -> Any:
        y = mid - half * cosines[k]
        factor = jnp.sqrt(g(y))
        x = r + y
        return sums[0] + sines[k] ** 2 * factor, sums[1] + 1 / factor, sums[2] + L / (factor * x * x)

    zero = jnp.zeros_like(r)
    sums = lax.fori_loop(0, count, add, (zero, zero, zero))
    unit = np.pi / count
    return Sums(unit * half * half * sums[0], unit * m * sums[1], unit * sums[2], r + low, r + high)


def is_narrow(V: Scalar, r: Any, p: Any, L: Any, m: Any, low: Any, high: Any) -> Any:
    """Whether these are the two turning points of a nearly circular orbit: p_r² > 0 between, p_r² < 0 beyond."""
    import jax.numpy as jnp

    D = divided(V, r, L, m)
    half = (high - low) / 2

    def square(y: Any) -> Any:
        return p * p + y * D(y)

    found = (low <= 0) & (high >= 0) & (jnp.maximum(-low, high) < NARROW * r)
    inside = (square((low + high) / 2) > 0) & (square(low - half / 2) < 0) & (square(high + half / 2) < 0)
    # a circle has no inside; it is one where its radius is stable. V must be smooth on the scale of the radius
    bend, less = (curved(V, r, L, m, low, high, order)(low) for order in (_GAUSS, _GAUSS - 2))
    return found & (inside | ((half == 0) & (bend > 0))) & (jnp.abs(bend - less) <= _SMOOTH * jnp.abs(bend))
