"""The radial motion of many orbits at once in a potential V(r): turning points, ∮ p_r dr, and the two frequencies."""

from __future__ import annotations

from typing import Any, NamedTuple

from canon.numeric.actions.oscillation import (
    NARROW_NODES,
    Scalar,
    is_narrow,
    may_be_narrow,
    mean_curvature,
    mean_slope,
    narrow_ends,
    quadrature,
    turning_points,
)


class Sums(NamedTuple):
    """∫ of p_r dr, of dr/ṙ and of φ̇ dr/ṙ between the turning points."""

    action: Any
    time: Any
    angle: Any


class Narrow(NamedTuple):
    """A nearly circular orbit: p_r² = p² + y D(y) at r + y, its second derivative, and its turning points."""

    D: Scalar
    bend: Scalar
    low: Any
    high: Any
    holds: Any


def wide_ends(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> tuple[Any, Any]:
    """The turning points next to r, as ln r: the zeros of r² p_r²; nan where there is none."""
    import jax.numpy as jnp

    E2 = p * p + L * L / (r * r) + 2 * m * V(r)

    def F(u: Any) -> Any:
        x = jnp.exp(u)
        return x * x * (E2 - 2 * m * V(x)) - L * L

    return turning_points(F, jnp.log(r))


def wide_sums(V: Scalar, r: Any, p: Any, L: Any, m: Any, low: Any, high: Any, count: int) -> Sums:
    """The integrals between turning points given as ln r, with `count` nodes."""
    import jax.numpy as jnp

    E2 = p * p + L * L / (r * r) + 2 * m * V(r)

    def term(u: Any, sine: Any) -> tuple[Any, ...]:
        x = jnp.exp(u)
        momentum = jnp.sqrt(jnp.maximum(E2 - 2 * m * V(x) - (L / x) ** 2, 0.0))
        weight = sine * x
        rate = weight / jnp.where(momentum > 0, momentum, jnp.inf)
        return weight * momentum, rate, rate / (x * x)

    half = (high - low) / 2
    action, time, angle = quadrature(term, low, high, count)
    return Sums(half * action, half * m * time, half * L * angle)


def perhaps_narrow(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> Any:
    """Whether it is worth looking at the orbit as a nearly circular one, by two derivatives of V."""
    import jax
    import jax.numpy as jnp

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    first, second = jax.jvp(slope, (r,), (jnp.ones_like(r),))
    square = (L / (r * r)) ** 2
    return may_be_narrow(p * p, 2 * square * r - 2 * m * first, -3 * square - m * second, r)


def narrow(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> Narrow:
    """The orbit as a nearly circular one; `holds` says whether it is."""
    import jax
    import jax.numpy as jnp

    mean = mean_slope(V, r)

    def D(y: Any) -> Any:
        x = r + y
        return (L / (r * x)) ** 2 * (x + r) - 2 * m * mean(y)

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    def bend(y: Any) -> Any:
        x = r + y
        return -6 * (L / (x * x)) ** 2 - 2 * m * jax.jvp(slope, (x,), (jnp.ones_like(x),))[1]

    low, high = narrow_ends(D, p * p)
    return Narrow(D, bend, low, high, is_narrow(D, p * p, bend, low, high, r))


def narrow_sums(orbit: Narrow, r: Any, L: Any, m: Any) -> Sums:
    """The integrals of a nearly circular orbit, where p_r² = (y − low)(high − y) g(y)."""
    import jax.numpy as jnp

    mean = mean_curvature(orbit.bend, orbit.low, orbit.high)

    def term(y: Any, sine: Any) -> tuple[Any, ...]:
        factor = jnp.sqrt(-mean(y))
        x = r + y
        return sine * sine * factor, 1 / factor, 1 / (factor * x * x)

    half = (orbit.high - orbit.low) / 2
    action, time, angle = quadrature(term, orbit.low, orbit.high, NARROW_NODES)
    return Sums(half * half * action, m * time, L * angle)
