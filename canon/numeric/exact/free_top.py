"""Free rigid bodies: Euler's equations and the attitude, for symmetric and asymmetric tops, in closed form.

With M_i scaled by the square roots of the differences of 1/I, Euler's equations are those of `rotor`. The precession
about the angular momentum is an elliptic integral of the third kind, taken about the body's axis that M never points
along. Differences of moments of inertia are factored. Conditioning: near the middle axis errors of the state grow as
those of an unstable rotation do; moments that nearly coincide know their differences only. Landau and Lifshitz (1976),
Mechanics, § 37; van Zon and Schofield (2007), J. Comput. Phys. 225, 145; Whittaker (1937), 69.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from canon.numeric.exact.carlson import carlson_rf, carlson_rj
from canon.numeric.exact.euler_rotor import rotor
from canon.numeric.rotations import about_axis, about_vector, conjugate, multiply, normalised


def free_top(attitude: Any, M: Any, moments: tuple[float, float, float], t: Any) -> tuple[Any, Any]:
    """The attitude and the angular momentum in the body's frame after a time t.

    **Arguments:** `attitude`, a unit quaternion (4, …) from body to space; `M` (3, …); the principal `moments`.
    """
    equal = [k for k in range(3) if moments[(k + 1) % 3] == moments[(k + 2) % 3]]
    if equal:
        return symmetric_top(attitude, M, moments[(equal[0] + 1) % 3], moments[equal[0]], equal[0], t)
    return asymmetric_top(attitude, M, moments, t)


def symmetric_top(attitude: Any, M: Any, across: float, along: float, axis: int, t: Any) -> tuple[Any, Any]:
    """A body with the moment `along` its `axis` and `across` it: a precession about M and a turn about the axis."""
    import jax.numpy as jnp

    M = jnp.asarray(M)
    precession = about_vector(M * (t / across))
    turn = about_axis(axis, M[axis] * (across - along) / (across * along) * t)
    return normalised(multiply(attitude, multiply(precession, turn))), _turned(M, across, along, axis, t)


def _turned(M: Any, across: float, along: float, axis: int, t: Any) -> Any:
    """The angular momentum of a symmetric top, which turns about the axis as seen from the body."""
    import jax.numpy as jnp

    angle = M[axis] * (across - along) / (across * along) * t
    j, k = (axis + 1) % 3, (axis + 2) % 3
    c, s = jnp.cos(angle), jnp.sin(angle)
    turned = [M[axis]] * 3
    turned[j], turned[k] = c * M[j] + s * M[k], c * M[k] - s * M[j]
    return jnp.stack(turned)


def asymmetric_top(attitude: Any, M: Any, moments: tuple[float, float, float], t: Any) -> tuple[Any, Any]:
    """A body with three different moments, also at and near the middle axis."""
    import jax.numpy as jnp

    order, (small, _, large), (a, b, c), rate = _top_of(moments)
    M = jnp.asarray(M)
    new = free_momentum(M, moments, t)
    X, Y, Z = _scaled(M, order, (a, b, c))
    X1, Y1, Z1 = _scaled(new, order, (a, b, c))
    # seen from the axis whose component passes through 0, M never points along it
    from_small = jnp.abs(X) <= jnp.abs(Z)
    norm = jnp.sqrt(jnp.sum(M * M, axis=0))
    mean = _mean_of(
        (jnp.where(from_small, X, Z), Y, jnp.where(from_small, Z, X)),
        (jnp.where(from_small, X1, Z1), Y1, jnp.where(from_small, Z1, X1)),
        rate * t,
        jnp.where(from_small, a / c, c / a),
    )
    angle = norm * t * jnp.where(from_small, 1 / small - b * mean, 1 / large + b * mean)
    first = _attitude(attitude, M, new, int(order[0]), angle)
    last = _attitude(attitude, M, new, int(order[2]), angle)
    return jnp.where(from_small, first, last), new


def free_momentum(M: Any, moments: tuple[float, float, float], t: Any) -> Any:
    """Euler's equations alone: the angular momentum in the body's frame (3, …) after a time t."""
    import jax.numpy as jnp

    M = jnp.asarray(M)
    equal = [k for k in range(3) if moments[(k + 1) % 3] == moments[(k + 2) % 3]]
    if equal:
        return _turned(M, moments[(equal[0] + 1) % 3], moments[equal[0]], equal[0], t)
    order, _, scales, rate = _top_of(moments)
    found = rotor(*_scaled(M, order, scales), rate * t)
    after = [found[0]] * 3
    for value, scale, place in zip(found, scales, order, strict=True):
        after[place] = value * scale**0.5
    new = jnp.stack(after)
    return new * jnp.sqrt(jnp.sum(M * M, axis=0) / jnp.maximum(jnp.sum(new * new, axis=0), 1e-300))


def _top_of(moments: tuple[float, float, float]) -> tuple[tuple[int, ...], tuple[float, ...], tuple[float, ...], float]:
    """The axes from the smallest moment to the largest, these moments, (a, b, c) of ẋ = −a yz, ẏ = b zx, ż = −c xy
    along them, and the rate of the rotor's time.
    """
    order = tuple(int(k) for k in np.argsort(moments))
    small, middle, large = (float(moments[k]) for k in order)
    a = (large - middle) / (middle * large)
    b = (large - small) / (small * large)
    c = (middle - small) / (small * middle)
    sign = 1.0 if order in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else -1.0
    return order, (small, middle, large), (a, b, c), sign * (a * b * c) ** 0.5


def _scaled(M: Any, order: tuple[int, ...], scales: tuple[float, ...]) -> tuple[Any, Any, Any]:
    X, Y, Z = (M[place] / scale**0.5 for place, scale in zip(order, scales, strict=True))
    return X, Y, Z


def _mean_of(before: tuple[Any, Any, Any], after: tuple[Any, Any, Any], time: Any, strength: Any) -> Any:
    """The mean of 1/(1 + ν w²) over the motion, w = Y/√(Y² + Z²) = k sn u: a difference of integrals Π(−ν m; u)."""
    import jax.numpy as jnp

    X, Y, Z = before
    size = jnp.sqrt(Y * Y + Z * Z)
    safe = jnp.where(size > 0, size, 1.0)
    m = jnp.minimum((X * X + Y * Y) / (safe * safe), 1.0)
    m1 = jnp.maximum((Z - X) * (Z + X) / (safe * safe), 1e-300)
    k = jnp.sqrt(jnp.where(m > 0, m, 1.0))
    n = -strength * m
    quarter = carlson_rf(0.0 * m1, m1, 1.0)
    whole = quarter + n / 3 * carlson_rj(0.0 * m1, m1, 1.0, 1 - n)

    def integrals(point: tuple[Any, Any, Any]) -> tuple[Any, Any]:
        """(u, Π) of a state, with −2K < u ≤ 2K."""
        X, Y, Z = point
        sn, cn, dn = Y / (k * safe), jnp.sign(Z) * X / (k * safe), jnp.abs(Z) / safe
        first = carlson_rf(cn * cn, dn * dn, 1.0)
        third = carlson_rj(cn * cn, dn * dn, 1.0, 1 - n * sn * sn)
        u, pi = sn * first, sn * (first + n / 3 * sn * sn * third)
        turned = jnp.where(sn < 0, -2.0, 2.0)
        return jnp.where(cn < 0, turned * quarter - u, u), jnp.where(cn < 0, turned * whole - pi, pi)

    (u0, pi0), (u1, pi1) = integrals(before), integrals(after)
    span = safe * time
    turns = jnp.round((u0 + span - u1) / (4 * quarter))
    total = (pi1 - pi0) + 4 * turns * whole
    # on the middle axis, and with no m, w does not change
    moving = (m > 0) & (span != 0) & (jnp.abs(X) + jnp.abs(Z) > 0) & jnp.isfinite(total)
    return jnp.where(moving, total / jnp.where(moving, span, 1.0), 1 / (1 + strength * Y * Y / (safe * safe)))


def _attitude(attitude: Any, M: Any, new: Any, axis: int, angle: Any) -> Any:
    """The attitude after a precession by the angle, from the directions of M in the body before and after.

    M turns about the axis by less than half a turn, so that the quaternion's sign is that of the motion.
    """
    import jax.numpy as jnp

    before, after = _directions(M, axis), _directions(new, axis)
    turned = after[0] - before[0]
    azimuth = before[0] + turned - 2 * jnp.pi * jnp.round(turned / (2 * jnp.pi))
    there = multiply(multiply(attitude, conjugate(_tilt(*before, axis))), about_axis(axis, angle))
    return normalised(multiply(there, _tilt(azimuth, after[1], axis)))


def _directions(M: Any, axis: int) -> tuple[Any, Any]:
    """The azimuth of M about a coordinate axis, and its angle from it."""
    import jax.numpy as jnp

    j, k = (axis + 1) % 3, (axis + 2) % 3
    return jnp.arctan2(M[k], M[j]), jnp.arctan2(jnp.hypot(M[j], M[k]), M[axis])


def _tilt(azimuth: Any, polar: Any, axis: int) -> Any:
    """The rotation of that direction onto the axis that keeps no turn about the axis."""
    return multiply(about_axis((axis + 2) % 3, -polar), about_axis(axis, -azimuth))
