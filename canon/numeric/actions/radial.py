"""The radial motion of many orbits at once in a potential V(r): turning points, ∮ p_r dr, and the two frequencies."""

from __future__ import annotations

from typing import Any, NamedTuple

from canon.numeric.actions.oscillation import (
    NARROW_NODES,
    Narrow,
    Scalar,
    narrow_oscillation,
    quadrature,
    seeming_amplitude,
    turning_points,
)


class Sums(NamedTuple):
    """∫ of p_r dr, of dr/ṙ and of φ̇ dr/ṙ between the turning points."""

    action: Any
    time: Any
    angle: Any


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


def amplitude(V: Scalar, r: Any, p: Any, L: Any, m: Any) -> Any:
    """The amplitude that the orbit seems to have as a nearly circular one, by two derivatives of V, in parts of r."""
    import jax
    import jax.numpy as jnp

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    first, second = jax.jvp(slope, (r,), (jnp.ones_like(r),))
    square = (L / (r * r)) ** 2
    return seeming_amplitude(p * p, 2 * square * r - 2 * m * first, -3 * square - m * second, r)


def narrow(V: Scalar, r: Any, p: Any, L: Any, m: Any, degree: int) -> Narrow:
    """The orbit as a nearly circular one: p_r² as a function of the distance from r."""
    import jax
    import jax.numpy as jnp

    def slope(x: Any) -> Any:
        return jax.jvp(V, (x,), (jnp.ones_like(x),))[1]

    def bend(y: Any) -> Any:
        x = r + y
        return -6 * (L / (x * x)) ** 2 - 2 * m * jax.jvp(slope, (x,), (jnp.ones_like(x),))[1]

    return narrow_oscillation(p * p, 2 * (L / (r * r)) ** 2 * r - 2 * m * slope(r), bend, r, degree)


def narrow_sums(orbit: Narrow, r: Any, L: Any, m: Any) -> Sums:
    """The integrals of a nearly circular orbit."""
    import jax.numpy as jnp

    def term(y: Any, sine: Any) -> tuple[Any, ...]:
        factor = jnp.sqrt(orbit.stiffness(y))
        x = r + y
        return sine * sine * factor, 1 / factor, 1 / (factor * x * x)

    half = (orbit.high - orbit.low) / 2
    action, time, angle = quadrature(term, orbit.low, orbit.high, NARROW_NODES)
    return Sums(half * half * action, m * time, L * angle)
