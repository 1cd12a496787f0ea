"""Kepler's problem at the edges of its elements: e → 1, E → 0, falls into the centre, a million periods."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, compiled, each

_STATE = ("x", "y", "u", "v", "t")


def by_elements(m: Any, x: Number, y: Number, u: Number, v: Number, t: Number) -> Quantities:
    """Position and velocity after a time t by the anomalies of the ellipse or hyperbola, μ = 1.

    Danby (1988), Fundamentals of Celestial Mechanics, 6.1 to 6.6.
    """
    r, eta = m.sqrt(x * x + y * y), x * u + y * v
    a = 1 / (2 / r - (u * u + v * v))
    bound = a > 0
    sine, cosine = (m.sin, m.cos) if bound else (m.sinh, m.cosh)
    size, sign = abs(a), 1 if bound else -1
    along, across = 1 - r / a, eta / m.sqrt(size)  # e cos E and e sin E, or e cosh F and e sinh F
    e = m.sqrt(along * along + sign * across * across)
    begin = m.atan2(across, along) if bound else m.asinh(across / e)
    n = 1 / (size * m.sqrt(size))
    end = _anomaly(m, e, sign * (begin - e * sine(begin)) + n * t, sign)
    turn = end - begin
    later = size * sign * (1 - e * cosine(end))
    f, g = 1 - a * (1 - cosine(turn)) / r, t - sign * (turn - sine(turn)) / n
    f_dot, g_dot = -m.sqrt(size) * sine(turn) / (r * later), 1 - a * (1 - cosine(turn)) / later
    return (f * x + g * u, f * y + g * v), (f_dot * x + g_dot * u, f_dot * y + g_dot * v)


def _anomaly(m: Any, e: Number, mean: Number, sign: int) -> Number:
    """E with E − e sin E = M, or F with e sinh F − F = M: halving, then Newton's method to the digits there are."""
    sine, cosine = (m.sin, m.cos) if sign > 0 else (m.sinh, m.cosh)
    reach = e if sign > 0 else m.mpf(1)
    low, high = (mean - reach, mean + reach) if sign > 0 else (-1 - abs(mean), 1 + abs(mean))
    if sign < 0:  # e sinh F − F = M lies between the inverse sines of what is left and what there is
        high = m.asinh((abs(mean) + 800) / e)
        low = -high
    for _ in range(60):
        middle = (low + high) / 2
        if sign * (middle - e * sine(middle)) < mean:
            low = middle
        else:
            high = middle
    E = (low + high) / 2
    for _ in range(8):
        slope = sign * (1 - e * cosine(E))
        if slope == 0:
            break
        E = E - (sign * (E - e * sine(E)) - mean) / slope
    return E


def ours(x: Any, y: Any, u: Any, v: Any, t: Any) -> tuple[Any, Any]:
    """`canon.numeric.exact.kepler`."""
    import jax.numpy as jnp

    from canon.numeric.exact.kepler import kepler

    q, p = kepler((x, y), (u, v), 1.0, t)
    return jnp.stack(q), jnp.stack(p)


def rebound_wh(x: float, y: float, u: float, v: float, t: float) -> Quantities:
    """REBOUND's Wisdom–Holman integrator: one step is Kepler's motion."""
    import rebound  # pyright: ignore[reportMissingImports]

    sim = _simulation(rebound, x, y, u, v)
    sim.integrator = "whfast"
    sim.dt = t
    sim.steps(1)
    return _state(sim)


def rebound_ias15(x: float, y: float, u: float, v: float, t: float) -> Quantities:
    """REBOUND's IAS15, by its own choice of steps."""
    import rebound  # pyright: ignore[reportMissingImports]

    sim = _simulation(rebound, x, y, u, v)
    sim.integrator = "ias15"
    sim.integrate(t)
    return _state(sim)


def leapfrog(steps: int) -> Any:
    """canon's own leapfrog in equal steps, as many as it takes to see each period, as the naive route."""

    def route(x: float, y: float, u: float, v: float, t: float) -> Quantities:
        import numpy as np

        from canon.numeric.integrate import integrate
        from canon.numeric.integrators.yoshida import VERLET

        state = (np.array([x, y]), np.array([u, v]))
        q, p = integrate(_attraction(), VERLET, state, duration=t, steps=steps).state
        return (float(q[0]), float(q[1])), (float(p[0]), float(p[1]))

    return route


@lru_cache(maxsize=1)
def _attraction() -> Any:
    """ẍ = −x/r³ as a splitting."""
    import jax.numpy as jnp

    from canon.numeric.integrators import separable

    return separable(lambda p: p, lambda q: -q / jnp.sum(q * q) ** 1.5)


def _simulation(rebound: Any, x: float, y: float, u: float, v: float) -> Any:
    sim = rebound.Simulation()
    sim.add(m=1.0)
    sim.add(x=x, y=y, vx=u, vy=v)
    return sim


def _state(sim: Any) -> Quantities:
    body = sim.particles[1]
    return (body.x, body.y), (body.vx, body.vy)


def scipy_dop853(x: float, y: float, u: float, v: float, t: float) -> Quantities:
    """scipy's DOP853 with the smallest tolerance that it takes; absolute, one that components of 0 don't upset."""
    import numpy as np
    from scipy.integrate import solve_ivp

    def rate(_: float, z: Any) -> Any:
        r3 = (z[0] * z[0] + z[1] * z[1]) ** 1.5
        return np.array([z[2], z[3], -z[0] / r3, -z[1] / r3])

    z = solve_ivp(rate, (0.0, t), [x, y, u, v], method="DOP853", rtol=3e-14, atol=1e-20).y[:, -1]
    return (float(z[0]), float(z[1])), (float(z[2]), float(z[3]))


def _thrown(factor: float, t: float = 3.0) -> Point:
    """From (1, 0.3), aslant, with so many times the speed of escape."""
    speed = math.sqrt(2 / math.hypot(1.0, 0.3)) * factor
    return (1.0, 0.3, 0.6 * speed, 0.8 * speed, t)


def _from_pericentre(one_less_e: float, t: float) -> Point:
    """From the pericentre of the orbit with a = ±1."""
    return (one_less_e, 0.0, 0.0, math.sqrt((2 - one_less_e) / one_less_e), t)


def _next_to_the_centre(r: float, sign: int) -> Point:
    """On the slim orbit with a = ±1, close to the centre, on the way out."""
    speed = math.sqrt(2 / r - sign)
    return (0.6 * r, 0.8 * r, 0.59 * speed, 0.807 * speed, 2 * r**1.5)


def _radial_action(m: Any, r: Number, p: Number, L: Number, b: Number) -> Quantities:
    """J_r = 2π (1/√(−2E) − ½(L + √(L² + 4b))) of −1/(b + √(b² + r²)). Binney and Tremaine (2008), (3.225)."""
    E = (p * p + (L / r) ** 2) / 2 - 1 / (b + m.sqrt(b * b + r * r))
    return ((2 * m.pi * (1 / m.sqrt(-2 * E) - (L + m.sqrt(L * L + 4 * b)) / 2),),)


def _our_action(r: Any, p: Any, L: Any, b: Any) -> Any:
    from canon.numeric.actions.isochrone import isochrone_actions

    return isochrone_actions(r, p, L, b=b).radial


def _our_bounded_action(points: Sequence[Point]) -> list[Answer]:
    import numpy as np

    from canon.numeric.actions.isochrone import isochrone_actions

    r, p, L, b = np.array(points).T
    found = isochrone_actions(r, p, L, b=b)
    pairs = zip(np.asarray(found.radial), np.asarray(found.bound), strict=True)
    return [Answer(((float(value),),), (float(bound),)) for value, bound in pairs]


def galpy_isochrone(r: float, p: float, L: float, b: float) -> Quantities:
    """galpy's actions of the isochrone."""
    from galpy.actionAngle import actionAngleIsochrone  # pyright: ignore[reportMissingImports]
    from galpy.potential import IsochronePotential  # pyright: ignore[reportMissingImports]

    actions = actionAngleIsochrone(ip=IsochronePotential(amp=1.0, b=b))
    return ((2 * math.pi * float(actions(r, p, L / r, 0.0, 0.0)[0]),),)


def _case(
    name: str,
    states: str,
    points: tuple[Point, ...],
    peers: dict[str, Any],
    digits: int = 80,
    naive: Any = None,
) -> HardCase:
    return HardCase(
        name,
        "kepler",
        states,
        _STATE,
        points,
        by_elements,
        compiled(ours),
        naive and each(naive),
        {peer: each(route) for peer, route in peers.items()},
        digits=digits,
    )


WH = {"rebound WHFast": rebound_wh}
CASES = (
    _case(
        "E → 0 from below",
        "position and velocity on an ellipse that is hardly bound",
        tuple(_thrown(1 - 10.0**-k) for k in (4, 8, 12, 15)),
        WH,
    ),
    _case(
        "E → 0 from above",
        "position and velocity on a hyperbola that is hardly open",
        tuple(_thrown(1 + 10.0**-k) for k in (4, 8, 12, 15)),
        WH,
    ),
    _case(
        "e → 1 from below",
        "a slim ellipse, close to its pericentre",
        tuple(_next_to_the_centre(10.0**-k, 1) for k in (2, 5, 8, 12)),
        WH,
    ),
    _case(
        "e → 1 from above",
        "a slim hyperbola, close to its pericentre",
        tuple(_next_to_the_centre(10.0**-k, -1) for k in (2, 5, 8, 12)),
        WH,
    ),
    _case(
        "a hyperbola from far away",
        "a slim hyperbola, from far away past its pericentre and off again",
        tuple((2.0, 10.0**-k, -math.sqrt(2.0), 0.0, t) for k in (2, 8) for t in (0.1, 3.0, 90.0)),
        {"rebound WHFast": rebound_wh, "scipy DOP853": scipy_dop853},
    ),
    _case(
        "M → 0",
        "a slim ellipse soon after its pericentre",
        tuple(_from_pericentre(1e-6, 10.0**-k) for k in (11, 14, 20)),
        WH,
    ),
    _case(
        "near collision",
        "a fall past the centre at 1e-10 of the distance, and back",
        tuple((1.0, 0.0, 0.0, speed, t) for speed in (1e-3, 1e-5) for t in (1.0, 1.2)),
        {"rebound IAS15": rebound_ias15, "scipy DOP853": scipy_dop853},
        120,
        leapfrog(100_000),
    ),
    _case(
        "radial orbits",
        "a fall on a line through the centre, until 0.1 to 1e-5 before it is there; a throw outward",
        (
            (1.0, 0.0, 0.0, 0.0, 1.01),
            (1.0, 0.0, 0.0, 0.0, 1.1107),
            (3e-8, 0.0, 8e3, 0.0, 0.5),
            (0.6, 0.8, 0.9, 1.2, 9.0),
        ),
        {"rebound IAS15": rebound_ias15, "scipy DOP853": scipy_dop853},
        120,
        leapfrog(100_000),
    ),
    _case(
        "a million periods",
        "position and velocity after 1e6 turns and a bit",
        ((1.0, 0.0, 0.0, 1.2, 1.5e7),),
        WH,
        naive=leapfrog(30_000_000),
    ),
    HardCase(
        "e → 0",
        "kepler",
        "the radial action of an orbit that is nearly circular, b = 0 for Kepler's own",
        ("r", "p_r", "L", "b"),
        ((1.0, 1e-6, 1.0, 0.0), (1.0, 1e-12, 1.0, 0.0), (0.75, 1e-9, 0.5809475019311126, 0.0), (3.0, 1e-7, 2.0, 1.0)),
        _radial_action,
        _our_bounded_action,
        digits=80,
    ),
    HardCase(
        "a nearly circular orbit of the isochrone",
        "kepler",
        "its radial action",
        ("r", "p_r", "L", "b"),
        tuple((1.0, 10.0**-k, 0.3483106997, 1.0) for k in (3, 5, 7)),
        _radial_action,
        compiled(_our_action),
        peers={"galpy": each(galpy_isochrone)},
        digits=80,
    ),
)
