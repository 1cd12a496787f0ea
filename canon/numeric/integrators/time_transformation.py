"""Steps that shorten by themselves at close approaches: transformations of time that stay explicit, or symplectic.

The independent variable is a fictitious time s, and the time is one of the slots: `canon.numeric.transformed` stops
at times. In the logarithmic Hamiltonian Γ = ln(T + b) − ln(−V), with b = −E kept, a splitting moves along Kepler's
orbits exactly, and errs in time alone. Mikkola and Tanikawa (1999), Mon. Not. R. Astron. Soc. 310, 745; Preto and
Tremaine (1999), Astron. J. 118, 2532; Mikkola and Aarseth (2002), Celest. Mech. Dyn. Astron. 84, 343.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from canon.numeric.integrators.fields import hamiltonian_field
from canon.numeric.integrators.problem import ExactPart, Field, Shear, Splitting, State

CLOCK_SLOT: Final = 2
"""The slot that holds the time."""


def logarithmic(velocity: Callable[[Any], Any], kinetic: Callable[[Any], Any], pull: Callable[[Any], Any]) -> Splitting:
    """The logarithmic Hamiltonian of T(p) + V(q) with V < 0, on slots (q, p, t, b), for splitting methods of any kind.

    **Arguments:** functions of p and of q: `velocity` ∂T/∂p, arrays (n, …); `kinetic` T, (…); `pull`, the gradient of
    ln(−V), arrays (n, …): for −a/r it is −q/r², without a root. ds = −V dt on the orbit.
    """

    def drift(state: State, t: Any) -> tuple[Any, Any]:
        _, p, _, b = state
        rate = 1 / (kinetic(p) + b)
        return velocity(p) * rate, rate

    return Splitting((Shear((0, CLOCK_SLOT), drift, "ln(T + b)"), Shear((1,), lambda z, t: (pull(z[0]),), "ln(−V)")))


def logarithmic_state(q: Any, p: Any, t: Any, kinetic: Callable[[Any], Any], potential: Callable[[Any], Any]) -> State:
    """(q, p, t, b) with b = −H(q, p)."""
    import jax.numpy as jnp

    b = -(kinetic(p) + potential(q))
    return q, p, jnp.broadcast_to(jnp.asarray(t, dtype=float), jnp.shape(b)), b


def weighted(velocity: Callable[[Any], Any], force: Callable[[Any], Any], weight: Callable[[Any], Any]) -> Splitting:
    """Leapfrogs with dt = ds/Ω(q) for any positive weight Ω, on slots (q, p, t, w), with w = Ω along the orbit.

    Symmetric, so that errors of energy stay bounded; not symplectic. `weight` takes arrays (n, …) to (…); T is
    quadratic, so that `velocity` is linear.
    """

    def drift(state: State, t: Any) -> tuple[Any, Any]:
        _, p, _, w = state
        return velocity(p) / w, 1 / w

    def kick(state: State, h: Any, t: Any) -> State:
        import jax
        import jax.numpy as jnp

        q, p, time, w = state
        length = h / weight(q)
        after = p + length * force(q)
        slope = jax.grad(lambda x: jnp.sum(weight(x)))(q)
        mean = (velocity(p) + velocity(after)) / 2
        return q, after, time, w + length * jnp.sum(slope * mean, axis=0)

    return Splitting((Shear((0, CLOCK_SLOT), drift, "drift"), ExactPart(kick, name="kick")))


def weighted_state(q: Any, p: Any, t: Any, weight: Callable[[Any], Any]) -> State:
    """(q, p, t, w) with w = Ω(q)."""
    import jax.numpy as jnp

    w = weight(q)
    return q, p, jnp.broadcast_to(jnp.asarray(t, dtype=float), jnp.shape(w)), w


def sundman(H: Callable[[Any, Any], Any], scale: Callable[[Any, Any], Any]) -> Field:
    """Poincaré's form of dt = g(q, p) ds: the field of g (H − E) on slots (q, p, t, E), Hamiltonian for each E.

    For `Gauss` and other methods for whole fields, where H does not separate. `H` and `scale` g take arrays (n, …) to
    (…).
    """

    def rate(state: State, s: Any) -> State:
        import jax.numpy as jnp

        q, p, _, energy = state
        field = hamiltonian_field(lambda x, y: scale(x, y) * (H(x, y) - energy))
        return (*field.rate((q, p), None), scale(q, p), jnp.zeros_like(energy))

    return Field(rate)


def sundman_state(q: Any, p: Any, t: Any, H: Callable[[Any, Any], Any]) -> State:
    """(q, p, t, E) with E = H(q, p)."""
    import jax.numpy as jnp

    energy = H(q, p)
    return q, p, jnp.broadcast_to(jnp.asarray(t, dtype=float), jnp.shape(energy)), energy
