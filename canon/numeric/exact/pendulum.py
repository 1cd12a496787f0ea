"""The pendulum H = p²/2I − k cos q through the separatrix, to rounding.

With S = sin(q/2), C = cos(q/2), P = p/(2√(Ik)) and time in units of √(I/k), Ṡ = PC, Ċ = −SP and Ṗ = −SC. The
complementary parameter m_1 = (C − P)(C + P) says on which side of the separatrix the motion is without subtracting
energies. Conditioning: near the separatrix errors of the state grow as e^t while the pendulum is near the top, where
the angle is to be counted from there. Whittaker (1937), Analytical Dynamics, 44; Lawden (1989), Elliptic Functions and
Applications, 5.1.
"""

from __future__ import annotations

from typing import Any

from canon.numeric.exact.carlson import complete_k
from canon.numeric.exact.euler_rotor import rotor


def pendulum(
    q: Any, p: Any, t: Any, *, inertia: Any = 1.0, strength: Any = 1.0, from_top: bool = False
) -> tuple[Any, Any]:
    """The angle and momentum after a time t: `inertia` I = m R², `strength` k = m g R > 0, q = 0 hanging down.

    With `from_top` the angle is 0 standing upright, before and after: next to the top it keeps the digits that π + q
    has no room for. The angle is continuous: it counts the turns of a pendulum that rotates.
    """
    import jax.numpy as jnp

    rate = jnp.sqrt(strength / inertia)
    scale = 2 * jnp.sqrt(inertia * strength)
    turns = jnp.round(q / (2 * jnp.pi))
    half = (q - 2 * jnp.pi * turns) / 2
    # the sines are those of q itself: of a large angle less whole turns, rounded, the first digits would be lost
    side = 1 - 2 * (jnp.abs(turns) % 2)
    S, C, P = side * jnp.sin(q / 2), side * jnp.cos(q / 2), p / scale
    if from_top:
        S, C = C, -S
    X, Y, Z = rotor(P, S, C, rate * t)
    angle = jnp.arctan2(-Z, Y) if from_top else jnp.arctan2(Y, Z)
    mean = _mean_turn(S, C, P, rate * t)
    return 2 * jnp.pi * turns + 2 * (angle + 2 * jnp.pi * jnp.round((half + mean - angle) / (2 * jnp.pi))), scale * X


def period(q: Any, p: Any, *, inertia: Any = 1.0, strength: Any = 1.0) -> Any:
    """The time of an oscillation, or of one turn: 4 K(m)√(I/k), or 2 K(1/m)√(I/km); infinite on the separatrix."""
    import jax.numpy as jnp

    S, C, P = jnp.sin(q / 2), jnp.cos(q / 2), p / (2 * jnp.sqrt(inertia * strength))
    m1, m = (C - P) * (C + P), S * S + P * P
    turning = m1 < 0
    root = jnp.sqrt(jnp.where(turning, m, 1.0))
    quarter = complete_k(jnp.where(turning, -m1 / jnp.where(turning, m, 1.0), m1)) / root
    return jnp.where(turning, 2.0, 4.0) * quarter * jnp.sqrt(inertia / strength)


def _mean_turn(S: Any, C: Any, P: Any, u: Any) -> Any:
    """How far q/2 turns in a time u at its mean rate: 0 for oscillations. It is off by less than π."""
    import jax.numpy as jnp

    m1, m = (C - P) * (C + P), S * S + P * P
    turning = m1 < 0
    root = jnp.sqrt(jnp.where(turning, m, 1.0))
    quarter = complete_k(jnp.where(turning, -m1 / jnp.where(turning, m, 1.0), 0.5))
    return jnp.where(turning, jnp.sign(P) * jnp.pi * root * u / (2 * quarter), 0.0)
