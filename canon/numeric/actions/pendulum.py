"""Action, period and angle of the pendulum H = p²/2I − k cos q by Gauss's mean, on both sides of the separatrix.

The energy is given by the complementary parameter m_1 = (k − H)/2k = 1 − m, which is positive for librations, negative
for rotations and 0 on the separatrix: as a number of its own it keeps all digits where 1 − m has none. With q = 0 and
momentum p at the bottom, or at any other point, it is (C − P)(C + P) with C = cos(q/2) and P = p/2√(Ik).

Librations there and back have J = 16√(Ik) [E(m) − m_1 K(m)], rotations over one turn J = 8√(Ik) √m E(1/m): on the
separatrix 16√(Ik) and 8√(Ik). Lawden (1989), Elliptic Functions and Applications, 3.8 and 5.1; Abramowitz and Stegun
17.6. Conditioning: all three are known to a part of themselves, by m_1 next to the separatrix and by m next to the
bottom.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from canon.errors import InputError
from canon.numeric.exact.carlson import carlson_rf
from canon.numeric.precision import doubles

_MEANS: Final = 14
"""Steps of the mean that a parameter of 1e-300 takes, and a few more."""


class PendulumActions(NamedTuple):
    """J, the period T and the frequency 1/T, each to a relative error of 1e-15; T is infinite at m_1 = 0."""

    action: Any
    period: Any
    frequency: Any


def pendulum_actions(
    m1: Any = None, *, above_bottom: Any = None, inertia: Any = 1.0, strength: Any = 1.0
) -> PendulumActions:
    """The actions at complementary parameters m_1 < 1, elementwise; nan where there is no motion.

    **Arguments:** `m1`; or `above_bottom` m = (H + k)/2k, which keeps the digits of small librations; `inertia` I and
    `strength` k > 0.
    """
    import jax.numpy as jnp

    inertia, strength = doubles(inertia=inertia, strength=strength)
    if above_bottom is None and m1 is None:
        raise InputError("a complementary parameter m1, or m above_bottom, is needed", "m1")
    given: Any = None if m1 is None else doubles(m1=m1)[0]
    m = 1 - given if above_bottom is None else doubles(above_bottom=above_bottom)[0]
    m1 = 1 - m if given is None else given
    turning = m1 < 0
    # of rotations, 1/m in the place of m, and −m1/m in that of m1
    small = jnp.where(turning, 1 / jnp.where(turning, m, 2.0), m)
    other = jnp.where(turning, -m1 * small, m1)
    K, K_other, tail, tail_other = _mean(small, other)
    near = other < 0.5
    # E − m1 K and E, from whichever of the two means does not cancel; Legendre's relation joins them
    swing = jnp.where(near, jnp.pi / (2 * K_other) - K * (other / 2 - tail_other), K * (small / 2 - tail))
    whole = jnp.where(near, jnp.pi / (2 * K_other) + K * (other / 2 + tail_other), K * (1 - small / 2 - tail))
    swing, whole = (jnp.where(other == 0, 1.0, value) for value in (swing, whole))
    root = jnp.sqrt(inertia * strength)
    action = jnp.where(turning, 8 * root * jnp.sqrt(m) * whole, 16 * root * swing)
    period = jnp.sqrt(inertia / strength) * jnp.where(turning, 2 * K * jnp.sqrt(small), 4 * K)
    period = jnp.where(m1 == 0, jnp.inf, period)
    known = (m > 0) & (other >= 0) & (inertia > 0) & (strength > 0)
    action, period = (jnp.where(known, value, jnp.nan) for value in (action, period))
    return PendulumActions(action, period, 1 / period)


def _mean(m: Any, m1: Any) -> tuple[Any, Any, Any, Any]:
    """(K(m), K(m1), Σ 2^(n−1) c_n² from n = 1 for either), by Gauss's mean of 1 and √m1, and of 1 and √m."""
    import jax.numpy as jnp

    found = []
    for parameter, complement in ((m, m1), (m1, m)):
        # c_1 = (1 − √m1)/2 without a difference, where the parameter is small
        a, b = (1 + jnp.sqrt(complement)) / 2, jnp.sqrt(jnp.sqrt(complement))
        c = parameter / (4 * a)
        tail, weight = c * c, 1.0
        for _ in range(_MEANS):
            weight = 2 * weight
            nearer = (a + b) / 2
            c = c * c / (4 * nearer)
            tail = tail + weight * c * c
            a, b = nearer, jnp.sqrt(a * b)
        found += [jnp.pi / (2 * a), tail]
    return found[0], found[2], found[1], found[3]


def pendulum_angle(half_sine: Any, half_cosine: Any, momentum: Any) -> Any:
    """The angle variable w in [0, 1) from S = sin(q/2), C = cos(q/2) and P = p/2√(Ik), elementwise.

    w is 0 at the left turning point, or at q = −π of a rotation to the right; of one to the left at q = π. The time
    from the bottom is S/√m R_F(P²/m, C², 1), of a rotation in units of 1/√m S R_F(C², P²/m, 1): Carlson's integral of
    squares that are known to their last digits also next to the unstable point. nan on the separatrix.
    """
    import jax.numpy as jnp

    S, C, P = doubles(half_sine=half_sine, half_cosine=half_cosine, momentum=momentum)
    S = jnp.where(C < 0, -S, S)  # q and q + 2π are one place: S and C both change their signs
    m1, m = (C - P) * (C + P), S * S + P * P
    turning = m1 < 0
    K, _, _, _ = _mean(jnp.where(turning, 1 / m, m), jnp.where(turning, -m1 / m, m1))
    root = jnp.sqrt(m)
    swing = S / root * carlson_rf(P * P / m, C * C, jnp.ones_like(C)) / K
    turn = S * carlson_rf(C * C, P * P / m, jnp.ones_like(C)) / K
    # in quarters of a libration, or halves of a rotation, from the bottom on
    quarter = jnp.where(P < 0, 2 - swing, swing)
    w = jnp.where(turning, (1 + jnp.where(P < 0, -turn, turn)) / 2, (1 + quarter) / 4)
    w = jnp.where(m1 == 0, jnp.nan, w)
    return w - jnp.floor(w)
