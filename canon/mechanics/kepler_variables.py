"""Variables in which Kepler's problem doesn't move but for one angle: Delaunay's, and Poincaré's, which are regular.

Goldstein, Poole and Safko (2002), section 10.8; Poincaré (1905), Leçons de mécanique céleste I, chapter 3.
"""

from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.mechanics.formulas import Expression, as_formula
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.transformation import Transformation


def delaunay_variables(space: PhaseSpace, k: Expression = 1, m: Expression = 1) -> Transformation:
    """Polar coordinates (r, θ), or spherical ones (r, θ, φ), to Delaunay's angles and actions (over 2π).

    For the attraction −k/r of a mass m, where H < 0: l is the mean anomaly, g the angle of the pericentre (from the
    node, in space), h that of the node; L = k √(m/−2H), G is the angular momentum, and the third action its part along
    the axis. The new Hamiltonian is −m k²/2L².

    **Arguments:** a space of two or three degrees of freedom with these coordinates in order, r positive and, in space,
    0 < θ < π, and new pairs (l, g; L, G) or (l, g, h; L, G, H).

    **Raises:** `InputError` for another number of degrees of freedom.
    """
    check_space(space)
    if space.n not in (2, 3) or len(space.Q) != space.n:
        raise InputError("Delaunay's variables are those of two or three degrees of freedom", "space")
    strength: Any = as_formula(k).expr
    mass: Any = as_formula(m).expr
    r, p_r = space.q[0], space.p[0]
    if space.n == 2:
        theta, G = space.q[1], space.p[1]
        square: Any = G**2
        latitude, node, axis = theta, (), ()
    else:
        _, polar, phi = space.q
        _, p_polar, p_phi = space.p
        square = p_polar**2 + p_phi**2 / sp.sin(polar) ** 2
        G = sp.sqrt(square)
        latitude = sp.atan2(G * sp.cos(polar), -sp.sin(polar) * p_polar)
        node, axis = (phi - sp.atan2(p_phi * sp.cos(polar), -sp.sin(polar) * p_polar),), (p_phi,)
    E = (p_r**2 + square / r**2) / (2 * mass) - strength / r
    L = strength * sp.sqrt(mass / (-2 * E))
    sine = r * p_r / L  # e sin u of the eccentric anomaly u
    mean = sp.atan2(sine, 1 + 2 * E * r / strength) - sine
    true = sp.atan2(G * p_r / (mass * strength), square / (mass * strength * r) - 1)
    return Transformation(space, Q=(mean, latitude - true, *node), P=(L, G, *axis))


def poincare_variables(space: PhaseSpace) -> Transformation:
    """Delaunay's variables to Poincaré's, which are regular at vanishing eccentricity and inclination.

    λ = l + g (+ h) with Λ = L, and (η, ξ) = √(2(L − G)) (−sin, cos)(g + h) beside a like pair of G − H and h.

    **Arguments:** a space with old pairs (l, g; L, G) or (l, g, h; L, G, H), and new pairs (λ, η; Λ, ξ) or
    (λ, η, ζ; Λ, ξ, κ).

    **Raises:** `InputError` for another number of degrees of freedom.
    """
    check_space(space)
    if space.n not in (2, 3) or len(space.Q) != space.n:
        raise InputError("Poincaré's variables are those of two or three degrees of freedom", "space")
    angles, actions = space.q, space.p
    Q: list[Any] = [sp.Add(*angles)]
    P: list[Any] = [actions[0]]
    for k in range(1, space.n):
        turned, size = sp.Add(*angles[k:]), sp.sqrt(2 * (actions[k - 1] - actions[k]))
        Q.append(-size * sp.sin(turned))
        P.append(size * sp.cos(turned))
    return Transformation(space, Q=Q, P=P)
