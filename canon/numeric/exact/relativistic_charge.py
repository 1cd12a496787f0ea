"""A relativistic charge in uniform, constant electric and magnetic fields of any kind and direction.

dU/dτ = F U for U = (γc, u), u = γv, has a polynomial in F as its solution, by the eigenvalues ±κ and ±iω of F; all its
coefficients are sums of positive terms, also where κ or ω or both vanish. The proper time of a time t comes from t(τ) =
∫γ dτ by Newton's method. Conditioning: a turn by so many radians is off by as many roundings. Landau and Lifshitz
(1975), The Classical Theory of Fields, §§ 20–25; Gordon and Hafizi (2021), Comput. Phys. Commun. 258, 107628.
"""

from __future__ import annotations

from typing import Any, Final

from canon.numeric.exact.stumpff import stumpff, stumpff_4
from canon.numeric.rotations import cross

MOST_ITERATIONS: Final = 50


def relativistic_charge(x: Any, u: Any, e: Any, w: Any, c: Any, t: Any) -> tuple[Any, Any]:
    """Position and u = γv (3, …) after a time t.

    **Arguments:** `x`, `u` (3, …); `e` = qE/m and `w` = qB/m, (3, …); `c`; `t`, of any sign.
    """
    import jax.numpy as jnp
    from jax import lax

    field = e / c
    g = jnp.sqrt(1 + jnp.sum(u * u, axis=0) / (c * c))

    def times(vector: Any) -> Any:
        """F U, for U = (U_0, U_1, U_2, U_3)."""
        zeroth = jnp.sum(field * vector[1:], axis=0)
        return jnp.concatenate([zeroth[None], field * vector[0] + cross(vector[1:], w)])

    powers = [jnp.concatenate([(g * c)[None], u])]
    for _ in range(3):
        powers.append(times(powers[-1]))
    invariant = jnp.sum(field * field, axis=0) - jnp.sum(w * w, axis=0)
    across = 2 * jnp.sum(field * w, axis=0)
    length = jnp.hypot(invariant, across)
    grow = jnp.where(invariant >= 0, (length + invariant) / 2, across**2 / (2 * (length - invariant) + 1e-300))
    turn = jnp.where(invariant < 0, (length - invariant) / 2, across**2 / (2 * (length + invariant) + 1e-300))

    def moved(tau: Any) -> tuple[Any, Any]:
        """∫U dτ and U after a proper time."""
        a, b = grow * tau * tau, turn * tau * tau
        total = jnp.where(a + b > 0, a + b, 1.0)
        share = jnp.where(a + b > 0, a / total, 0.5)
        first, second = [*stumpff(-a), stumpff_4(-a)], [*stumpff(b), stumpff_4(b)]
        even = [(1 - share) * p + share * q for p, q in zip(first, second, strict=True)]
        odd = [share * p + (1 - share) * q for p, q in zip(first, second, strict=True)]
        rates = (even[0], tau * even[1], tau**2 * odd[2], tau**3 * odd[3])
        sums = (tau * even[1], tau**2 * even[2], tau**3 * odd[3], tau**4 * odd[4])
        return tuple(
            sum((k * vector for k, vector in zip(row[1:], powers[1:], strict=True)), row[0] * powers[0])
            for row in (sums, rates)
        )  # pyright: ignore[reportReturnType]

    def improve(loop: Any) -> Any:
        count, tau, low, high, _ = loop
        path, velocity = moved(tau)
        miss = path[0] / c - t
        after = jnp.where(jnp.isfinite(miss), miss > 0, t > 0)  # too far where it overflows
        low, high = jnp.where(after, low, tau), jnp.where(after, tau, high)
        # beyond the root t(τ) grows as an exponential, and its logarithm as a line
        ratio = path[0] / (c * t)
        off = jnp.where(ratio > 1, t * ratio * jnp.log(jnp.where(ratio > 1, ratio, 1.0)), miss)
        new = tau - off * c / velocity[0]
        new = jnp.where((new >= low) & (new <= high), new, (low + high) / 2)
        return count + 1, new, low, high, jnp.any(jnp.abs(new - tau) > 4e-16 * jnp.abs(tau))

    start = t / g + 0.0 * invariant
    low, high = jnp.minimum(0.0, t + 0.0 * start), jnp.maximum(0.0, t + 0.0 * start)
    begin = (0, start, low, high, jnp.asarray(True))
    tau = lax.while_loop(lambda loop: (loop[0] < MOST_ITERATIONS) & loop[4], improve, begin)[1]
    # one more step of Newton's carries the derivatives
    fixed = lax.stop_gradient(tau)
    path, velocity = moved(fixed)
    tau = fixed - (path[0] - c * t) / velocity[0]
    path, velocity = moved(tau)
    return x + path[1:], velocity[1:]
