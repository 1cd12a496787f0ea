"""Orbits in the plane and round, where classical elements and Delaunay's variables end: Poincaré's instead."""

from __future__ import annotations

import math
from typing import Any

from canon.hard.case import HardCase, Number, Point, Quantities, compiled, each

_INPUTS = ("x", "y", "z", "u", "v", "w")


def _momentum(x: Any, y: Any, z: Any, u: Any, v: Any, w: Any) -> tuple[Any, Any, Any]:
    return y * w - z * v, z * u - x * w, x * v - y * u


def _node_pair(m: Any, x: Number, y: Number, z: Number, u: Number, v: Number, w: Number) -> Quantities:
    """√(2(G − H)) (cos Ω, −sin Ω), Ω by the node, G − H = G (1 − cos i). Murray and Dermott (1999), 2.8, 2.10."""
    Lx, Ly, Lz = _momentum(x, y, z, u, v, w)
    G = m.sqrt(Lx * Lx + Ly * Ly + Lz * Lz)
    i = m.acos(Lz / G)
    node = m.atan2(Lx, -Ly)
    size = m.sqrt(2 * G * (1 - m.cos(i)))
    return ((size * m.cos(node), -size * m.sin(node)),)


def _our_node_pair(*state: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.poincare_pairs import poincare_pairs

    coordinates, momenta = poincare_pairs(jnp.stack(state[:3]), jnp.stack(state[3:]), 1.0)
    return jnp.stack([momenta[2], coordinates[2]])


def _rebound_node_pair(*state: float) -> Quantities:
    """By REBOUND's inclination and node."""
    orbit = _rebound_orbit(*state)
    Lx, Ly, Lz = _momentum(*state)
    size = 2 * math.sqrt(math.sqrt(Lx * Lx + Ly * Ly + Lz * Lz)) * math.sin(orbit.inc / 2)
    return ((size * math.cos(orbit.Omega), -size * math.sin(orbit.Omega)),)


def _rebound_orbit(x: float, y: float, z: float, u: float, v: float, w: float) -> Any:
    import rebound  # pyright: ignore[reportMissingImports]

    sim = rebound.Simulation()
    sim.add(m=1.0)
    sim.add(x=x, y=y, z=z, vx=u, vy=v, vz=w)
    return sim.particles[1].orbit(primary=sim.particles[0])


def _from_pole(m: Any, x: Number, y: Number, z: Number, u: Number, v: Number, w: Number) -> Quantities:
    """π − i = π − arccos(L_z/L)."""
    Lx, Ly, Lz = _momentum(x, y, z, u, v, w)
    return ((m.pi - m.acos(Lz / m.sqrt(Lx * Lx + Ly * Ly + Lz * Lz)),),)


def _our_from_pole(*state: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.poincare_pairs import tilt

    return tilt(jnp.stack(state[:3]), jnp.stack(state[3:]))[1]


def _rebound_from_pole(*state: float) -> Quantities:
    return ((math.pi - _rebound_orbit(*state).inc,),)


def _longitude(m: Any, x: Number, y: Number, z: Number, u: Number, v: Number, w: Number) -> Quantities:
    """λ = M + ω + Ω by the classical elements, each from an arc cosine. Curtis (2005), Orbital Mechanics, 4.4."""
    Lx, Ly, Lz = _momentum(x, y, z, u, v, w)
    r = m.sqrt(x * x + y * y + z * z)
    across = m.sqrt(Lx * Lx + Ly * Ly)
    radial = x * u + y * v + z * w
    ex, ey, ez = (
        b - a / r for a, b in zip((x, y, z), (v * Lz - w * Ly, w * Lx - u * Lz, u * Ly - v * Lx), strict=True)
    )
    e = m.sqrt(ex * ex + ey * ey + ez * ez)
    node = m.acos(-Ly / across) if Lx >= 0 else 2 * m.pi - m.acos(-Ly / across)
    pericentre = m.acos((-Ly * ex + Lx * ey) / (across * e))
    pericentre = pericentre if ez >= 0 else 2 * m.pi - pericentre
    true = m.acos((ex * x + ey * y + ez * z) / (e * r))
    true = true if radial >= 0 else 2 * m.pi - true
    eccentric = m.atan2(m.sqrt(1 - e * e) * m.sin(true), e + m.cos(true))
    whole = eccentric - e * m.sin(eccentric) + pericentre + node
    return ((m.atan2(m.sin(whole), m.cos(whole)),),)


def _our_longitude(*state: Any) -> Any:
    import jax.numpy as jnp

    from canon.numeric.poincare_pairs import poincare_pairs

    whole = poincare_pairs(jnp.stack(state[:3]), jnp.stack(state[3:]), 1.0)[0][0]
    return jnp.arctan2(jnp.sin(whole), jnp.cos(whole))


def _rebound_longitude(*state: float) -> Quantities:
    whole = _rebound_orbit(*state).l
    return ((math.atan2(math.sin(whole), math.cos(whole)),),)


def _tilted(i: float, side: float = 1.0) -> Point:
    """An ellipse that is tilted by i about the direction (0.8, 0.6, 0), passed one way or the other."""
    return (1.0, 0.2, 0.44 * i, side * -0.1, side * 0.9, side * 0.78 * i)


def _at_pericentre(small: float) -> Point:
    """An orbit in the plane but for a small part, next to its node and its pericentre."""
    return (0.8, 0.6, 0.0, -0.72 + 0.4 * small, 0.96 + 0.3 * small, 0.3 * small)


CASES = (
    HardCase(
        "inclination → 0",
        "elements",
        "Poincaré's pair √(2(G − H)) (cos Ω, −sin Ω) of an orbit that is hardly tilted",
        _INPUTS,
        tuple(_tilted(10.0**-k) for k in (3, 6, 9, 12)),
        _node_pair,
        compiled(_our_node_pair),
        peers={"rebound": each(_rebound_node_pair)},
        digits=80,
    ),
    HardCase(
        "inclination → π",
        "elements",
        "π − i of an orbit that is passed backwards",
        _INPUTS,
        tuple(_tilted(10.0**-k, -1.0) for k in (3, 6, 9, 12)),
        _from_pole,
        compiled(_our_from_pole),
        peers={"rebound": each(_rebound_from_pole)},
        digits=80,
    ),
    HardCase(
        "longitude next to node and pericentre",
        "elements",
        "the mean longitude λ, whose parts are arc cosines of nearly 1",
        _INPUTS,
        tuple(_at_pericentre(10.0**-k) for k in (3, 6, 9, 12)),
        _longitude,
        compiled(_our_longitude),
        peers={"rebound": each(_rebound_longitude)},
        digits=80,
    ),
)
