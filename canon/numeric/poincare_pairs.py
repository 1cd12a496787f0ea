"""Poincaré's canonical variables of a bound Kepler orbit: regular where Delaunay's and the classical elements are not.

With Delaunay's Λ = √(μa), G = |L| and H = L_z the momenta are Λ, √(2(Λ − G)) cos ϖ and √(2(G − H)) cos Ω, the
coordinates λ = M + ϖ, −√(2(Λ − G)) sin ϖ and −√(2(G − H)) sin Ω. Circles and orbits in the plane are no special cases:
G − H is (L_x² + L_y²)/(G + H), and neither an angle of a node nor one of a pericentre is formed.

Conditioning: relative errors of a state are errors of that part of the three pairs' sizes √Λ; a tilt is known to a
part of itself, an eccentricity, being a difference of vectors, to a part of 1. At i = π the variables end: look at the
motion in a mirror. Poincaré (1897); Murray and Dermott (1999), Solar System Dynamics, 2.10; Broucke and Cefola (1972),
Celest. Mech. 5, 303, for the frame.
"""

from __future__ import annotations

from typing import Any

from canon.numeric.compensated import sum_of_products


def poincare_pairs(x: Any, v: Any, mu: Any) -> tuple[Any, Any]:
    """(coordinates, momenta), (3, …) each, of position and velocity (3, …) on an ellipse; nan where it is none.

    Per unit of mass: with x the coordinates and v the momenta the transformation is canonical.
    """
    import jax.numpy as jnp

    r = jnp.sqrt(_dot(x, x))
    a = 1 / (2 / r - _dot(v, v) / mu)
    scale = jnp.sqrt(mu * a)
    L = angular_momentum(x, v)
    G = jnp.sqrt(_dot(L, L))
    w = L / G
    over = 1 + w[2]
    # axes in the orbit's plane that are those of space but for the tilt
    f = jnp.stack([1 - w[0] * w[0] / over, -w[0] * w[1] / over, -w[0]])
    g = jnp.stack([-w[0] * w[1] / over, 1 - w[1] * w[1] / over, -w[1]])
    X, Y, U, V = _dot(x, f), _dot(x, g), _dot(v, f), _dot(v, g)
    k, h = V * G / mu - X / r, -U * G / mu - Y / r  # e cos ϖ and e sin ϖ
    root = G / scale
    beta = 1 / (1 + root)
    cosine = k + ((1 - k * k * beta) * X - h * k * beta * Y) / (a * root)
    sine = h + ((1 - h * h * beta) * Y - h * k * beta * X) / (a * root)
    longitude = jnp.arctan2(sine, cosine) + h * cosine - k * sine
    eccentric = scale * jnp.sqrt(2 / (scale + G))
    tilted = jnp.sqrt(2 / (G + L[2]))
    coordinates = jnp.stack([longitude, -h * eccentric, -L[0] * tilted])
    return coordinates, jnp.stack([scale, k * eccentric, -L[1] * tilted])


def tilt(x: Any, v: Any) -> tuple[Any, Any]:
    """The inclination i of an orbit's plane and π − i, each to a part of itself."""
    import jax.numpy as jnp

    L = angular_momentum(x, v)
    across = jnp.hypot(L[0], L[1])
    return jnp.arctan2(across, L[2]), jnp.arctan2(across, -L[2])


def angular_momentum(x: Any, v: Any) -> Any:
    """x × v (3, …), each component as in twice the working precision."""
    import jax.numpy as jnp

    pairs = ((1, 2), (2, 0), (0, 1))
    return jnp.stack([sum_of_products([(x[i], v[j]), (-x[j], v[i])])[0] for i, j in pairs])


def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
