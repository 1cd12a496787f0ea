"""Actions of many orbits in a Stäckel potential, in prolate spheroidal coordinates.

With foci at z = ±Δ, R² = (l − Δ²)(Δ² − n)/Δ² and z² = ln/Δ², 0 ≤ n ≤ Δ² ≤ l, and V = −[l G(l) − n G(n)]/(l − n) with
any function G, the Hamilton–Jacobi equation separates: 2(t − Δ²) t p_t²/m = F(t) = t [G(t) + E − I₂/(t − Δ²)] − I₃ for
t = l and for t = n, where I₂ = L_z²/2m. I₃ is taken from n, as n [G(n) + E + I₂/(Δ² − n)] + 2(Δ² − n) n p_n²/m: a sum
of positive terms that are as small as the motion across the plane, none of them a difference. So J_z has all digits
there. de Zeeuw (1985), Mon. Not. R. Astron. Soc. 216, 273 (with t = τ + γ, l = λ + γ, n = ν + γ).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np

from canon.numeric.actions.oscillation import (
    NARROW_NODES,
    Narrow,
    Scalar,
    narrow_oscillation,
    quadrature,
    seeming_amplitude,
    turning_points,
    zero_between,
)
from canon.numeric.exact.carlson import complete_k
from canon.numeric.exact.euler_rotor import sn_cn_dn

CLOSE: Final = 0.1
AXIS: Final = 0.25
"""The part of Δ² below which Δ² − n is small, at an orbit's largest n."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

Scalars = Callable[[Any, Any], tuple[Any, ...]]


class Place(NamedTuple):
    """A phase point by what separates: l and l − Δ², n and Δ² − n, E, I₂, I₃, F(l), the size of E's terms;
    `outward` and `across`, √(l − Δ²) p_l and √n p_n, each with the size of its terms, and the sign of z."""

    l: Any
    beyond: Any
    n: Any
    within: Any
    E: Any
    I2: Any
    I3: Any
    F: Any
    size: Any
    outward: Any
    outward_size: Any
    across: Any
    across_size: Any
    side: Any


def place_of(G: Scalar, delta: Any, m: Any, R: Any, z: Any, p_R: Any, p_z: Any, L: Any) -> Place:
    """The place of R > 0, z and their momenta."""
    import jax.numpy as jnp

    D2 = delta * delta
    excess = R * R + (jnp.abs(z) - delta) * (jnp.abs(z) + delta)
    spread = jnp.sqrt((R * R + (z - delta) ** 2) * (R * R + (z + delta) ** 2))
    # l − Δ² and Δ² − n have the product R²Δ²; the one that is a sum is taken as such
    large = (spread + jnp.abs(excess)) / 2
    small = R * R * D2 / large
    beyond, within = jnp.where(excess >= 0, large, small), jnp.where(excess >= 0, small, large)
    l = D2 + beyond
    n = z * z * D2 / l
    kinetic = (p_R * p_R + p_z * p_z + (L / R) ** 2) / (2 * m)
    depth = (l * G(l) - n * G(n)) / spread
    E, I2 = kinetic - depth, L * L / (2 * m)
    # √n p_n and √(l − Δ²) p_l, which are finite where n or l − Δ² vanish
    side = jnp.where(z < 0, -1.0, 1.0)
    risen, sunk = side * jnp.sqrt(l) * p_z / (2 * delta), jnp.sqrt(n) * R * p_R / (2 * within)
    pushed, pulled = jnp.sqrt(within) * p_R / (2 * delta), jnp.sqrt(beyond) * z * p_z / (2 * l)
    across, across_size = risen - sunk, jnp.abs(risen) + jnp.abs(sunk)
    outward, outward_size = pushed + pulled, jnp.abs(pushed) + jnp.abs(pulled)
    I3 = n * (G(n) + E + I2 / within) + 2 * within * across * across / m
    F = 2 * l * outward * outward / m
    size = kinetic + jnp.abs(depth)
    return Place(l, beyond, n, within, E, I2, I3, F, size, outward, outward_size, across, across_size, side)


def wide_ends(G: Scalar, D2: Any, place: Place) -> tuple[Any, Any]:
    """The turning points in l, as ln(l − Δ²)."""
    import jax.numpy as jnp

    def F(u: Any) -> Any:
        beyond = jnp.exp(u)
        l = D2 + beyond
        return beyond * (l * (G(l) + place.E) - place.I3) - place.I2 * l

    return turning_points(F, jnp.log(place.beyond))


def wide_radial(G: Scalar, D2: Any, m: Any, place: Place, low: Any, high: Any, count: int) -> tuple[Any, Any]:
    """∫ p_l dl between the turning points, and the rounding of twice that."""
    import jax.numpy as jnp

    def term(u: Any, sine: Any) -> tuple[Any, ...]:
        beyond = jnp.exp(u)
        l = D2 + beyond
        F = jnp.maximum(l * (G(l) + place.E - place.I2 / beyond) - place.I3, 0.0)
        momentum = sine * jnp.sqrt(m * F * beyond / (2 * l))
        return momentum, momentum * l / jnp.where(F > 0, F, jnp.inf)

    half = (high - low) / 2
    action, slope = quadrature(term, low, high, count)
    return half * action, 2.0**-47 * half * (action + slope * place.size)


def amplitude(G: Scalar, D2: Any, place: Place) -> Any:
    """The amplitude that l seems to have as one that hardly changes, by two derivatives of t G, in parts of l − Δ²."""
    import jax
    import jax.numpy as jnp

    def slope(t: Any) -> Any:
        return jax.jvp(lambda x: x * G(x), (t,), (jnp.ones_like(t),))[1]

    first, second = jax.jvp(slope, (place.l,), (jnp.ones_like(place.l),))
    pull = place.I2 * D2 / place.beyond**2
    return seeming_amplitude(place.F, first + place.E + pull, second / 2 - pull / place.beyond, place.beyond)


def narrow_radial(G: Scalar, D2: Any, place: Place, degree: int) -> Narrow:
    """The orbit as one whose l hardly changes: F as a function of the change of l."""
    import jax
    import jax.numpy as jnp

    def slope(t: Any) -> Any:
        return jax.jvp(lambda x: x * G(x), (t,), (jnp.ones_like(t),))[1]

    def bend(y: Any) -> Any:
        t = place.l + y
        return jax.jvp(slope, (t,), (jnp.ones_like(t),))[1] - 2 * place.I2 * D2 / (place.beyond + y) ** 3

    first = slope(place.l) + place.E + place.I2 * D2 / place.beyond**2
    return narrow_oscillation(place.F, first, bend, place.beyond, degree)


def narrow_action(orbit: Narrow, m: Any, place: Place) -> tuple[Any, Any]:
    """∫ p_l dl of such an orbit, and the rounding of twice that."""
    import jax.numpy as jnp

    def term(y: Any, sine: Any) -> tuple[Any, ...]:
        rate = jnp.sqrt(m / (2 * (place.beyond + y) * (place.l + y)))
        root = jnp.sqrt(orbit.stiffness(y))
        return sine * sine * root * rate, rate / root

    half = (orbit.high - orbit.low) / 2
    action, slope = quadrature(term, orbit.low, orbit.high, NARROW_NODES)
    # F' is a sum of terms of the size of E's
    off = 2.0**-48 * place.size * jnp.maximum(-orbit.low, orbit.high)
    return half * half * action, 2 * (off * slope + 2.0**-48 * half * half * action)


class Swing(NamedTuple):
    """How n goes from the plane to its largest value `end`, and Δ² − `end`, with the digits of either."""

    end: Any
    left: Any


def vertical_end(G: Scalar, D2: Any, place: Place) -> Swing:
    """The largest n of the orbit, where n [G(n) + E + I₂/(Δ² − n)] = I₃.

    Of an orbit that passes by the axis beyond the foci, Δ² − n is as small there as I₂: it is solved for by itself.
    """
    import jax.numpy as jnp

    def rest(n: Any) -> Any:
        return place.I3 - n * (G(n) + place.E + place.I2 / (D2 - n))

    def rest_within(within: Any) -> Any:
        n = D2 - within
        return within * (place.I3 + place.I2 - n * (G(n) + place.E)) - place.I2 * D2

    stiffness = G(place.n) + place.E + place.I2 / place.within
    guess = jnp.clip(place.I3 / stiffness, place.n, (place.n + D2) / 2)
    end = zero_between(rest, place.n, jnp.full_like(place.n, D2), guess)
    left = zero_between(rest_within, place.within, jnp.zeros_like(end), jnp.minimum(D2 - end, place.within))
    low = end < D2 / 2
    end, left = jnp.where(low, end, D2 - left), jnp.where(low, D2 - end, left)
    moves = place.I3 > 0
    return Swing(jnp.where(moves, end, 0.0), jnp.where(moves, left, D2))


def swing_parameter(D2: Any, swing: Swing) -> Any:
    """The complementary parameter m₁ of the functions by which `along_swing` goes: 1 where n stays away from Δ²."""
    import jax.numpy as jnp

    return jnp.where(swing.left < AXIS * D2, swing.left / D2, 1.0)


def along_swing(D2: Any, swing: Swing, term: Callable[[Any, Any, Any], tuple[Any, ...]]) -> Scalars:
    """Functions `term`(n, Δ² − n, (end − n)/end) times dψ, n = end sin² ψ, as ones of −cos θ and sin θ of nodes in θ.

    sin ψ = sn w and w = Kθ/π, with a parameter of 0, or of end/Δ² where n comes near to Δ². There the orbit passes by
    the axis, and the nodes are as dense as in a logarithm: 64 are enough where Δ² − n is 10⁻¹⁰ Δ² at the end. Nodes
    that are even in ψ would pass over it.
    """
    import jax.numpy as jnp
    from jax import lax

    m1 = swing_parameter(D2, swing)
    K = complete_k(m1)
    even = jnp.all(m1 == 1)

    def of_nodes(half_turn: Any, sine: Any) -> tuple[Any, ...]:
        half = jnp.arctan2(sine, -half_turn) / 2
        sn, cn, dn = lax.cond(
            even,
            lambda: (jnp.sin(half) + 0 * m1, jnp.cos(half) + 0 * m1, jnp.ones_like(m1)),
            lambda: sn_cn_dn(2 / jnp.pi * half * K, m1),
        )
        values = term(swing.end * sn * sn, swing.left + swing.end * cn * cn, cn * cn)
        return tuple(K / jnp.pi * dn * value for value in values)

    return of_nodes


def vertical_slope(G: Scalar, D2: Any, place: Place, swing: Swing, n: Any, within: Any, part: Any) -> Any:
    """[I₃ − n (G(n) + E + I₂/(Δ² − n))]/(end − n), with `within` for Δ² − n and `part` for (end − n)/end."""
    import jax.numpy as jnp

    close = mean_slope(lambda t: t * G(t), n, swing.end) + place.E + place.I2 * D2 / (within * swing.left)
    rest = place.I3 - n * (G(n) + place.E + place.I2 / within)
    far = (part > CLOSE) & (swing.end > 0)
    return jnp.where(far, rest / jnp.where(far, part * swing.end, 1.0), close)


def vertical(G: Scalar, D2: Any, m: Any, place: Place, swing: Swing, count: int) -> tuple[Any, Any]:
    """4 ∫ p_n dn from 0 to the largest n, which is ∮ p_n dn across the plane and back, and its rounding."""
    import jax.numpy as jnp

    def term(n: Any, within: Any, part: Any) -> tuple[Any]:
        rest = jnp.maximum(place.I3 - n * (G(n) + place.E + place.I2 / within), 0.0)
        return (jnp.sqrt(2 * m * swing.end * part * rest / within),)

    ones = jnp.ones_like(swing.end)
    (sums,) = quadrature(along_swing(D2, swing, term), -ones, ones, count)
    stiffness = G(jnp.zeros_like(ones)) + place.E + place.I2 / D2
    return 4 * sums, 2.0**-47 * 4 * sums * (1 + place.size / jnp.abs(stiffness))


def mean_slope(f: Scalar, start: Any, end: Any) -> Any:
    """[f(end) − f(start)]/(end − start), by Gauss's rule for the derivative: no difference is taken."""
    import jax
    import jax.numpy as jnp

    places = start + (end - start) * (_NODES[:, None] + 1) / 2
    slopes = jax.jvp(f, (places,), (jnp.ones_like(places),))[1]
    return jnp.tensordot(_WEIGHTS / 2, slopes, axes=1)
