"""Kepler's motion: a thousand periods at e = 0.99 by stepping, and exact steps of many orbits at once."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from peers_common import Row, Setting, Side, cheapest, compared, interleaved

ECCENTRICITY, PERIODS = 0.99, 1000
TURN = 2 * np.pi
Q, P = np.array([1 - ECCENTRICITY, 0.0]), np.array([0.0, ((1 + ECCENTRICITY) / (1 - ECCENTRICITY)) ** 0.5])
STEPS = {"stormer12": (36, 40, 44, 48, 54, 60, 80), "nystrom8": (12, 16, 20), "sofroniou_spaletta10": (10, 12, 16)}
ORBITS = (125, 500, 1000, 2000)


def by_canon(field: float = 0.0) -> Iterator[Setting]:
    from canon.numeric.integrators.catalogue import method
    from canon.numeric.levi_civita import regularised
    from canon.numeric.regularised_orbit import regularised_orbit

    x, y, px, py = sp.symbols("x y p_x p_y", real=True)
    H = (px**2 + py**2) / 2 - 1 / sp.sqrt(x**2 + y**2) - field * y
    kepler = regularised(H, (x, y), (px, py))
    for name, counts in STEPS.items():
        chosen = method(name)
        for steps in counts:
            for compensated in (False, True):

                def run(chosen=chosen, steps=steps, compensated=compensated) -> np.ndarray:
                    made = regularised_orbit(
                        kepler, chosen, Q, P, [0.0, PERIODS * TURN], step=TURN / steps, compensated=compensated
                    )
                    return made.q[-1]

                kept = ", compensated" if compensated else ""
                yield Setting(f"{name} in Levi-Civita's coordinates, {steps} steps a period{kept}", run)


def in_logarithmic_time() -> Iterator[Setting]:
    from canon.numeric.integrators.catalogue import method
    from canon.numeric.regularise import regularise
    from canon.numeric.transformed import integrate_transformed

    x, y, px, py = sp.symbols("x y p_x p_y", real=True)
    kepler = regularise((px**2 + py**2) / 2, -1 / sp.sqrt(x**2 + y**2), (x, y), (px, py))
    state = kepler.state(Q, P)
    chosen = method("sofroniou_spaletta10")
    for steps in (6, 7, 8, 9, 10, 12, 14, 17):

        def run(steps=steps) -> np.ndarray:
            made = integrate_transformed(kepler.problem, chosen, state, [0.0, PERIODS * TURN], step=TURN / steps)
            return np.asarray(made.states[0][-1])

        yield Setting(f"{chosen.name} in logarithmic time, {steps} steps a period", run)


def by_heyoka(field: float = 0.0, kind: Any = float) -> Iterator[Setting]:
    """In the coordinates as they are; with `kind` a longer number the finest setting alone."""
    import heyoka as hy

    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    cube = (x * x + y * y) ** kind(-1.5)
    system = [(x, u), (y, v), (u, -x * cube), (v, -y * cube + kind(field))]
    for tol in (1e-9, 1e-11, 1e-13, 1e-15, 1e-16, 1e-18) if kind is float else (1e-19,):
        solver = hy.taylor_adaptive(system, [kind(x) for x in (1, 0, 0, 1)], tol=kind(tol), fp_type=kind)

        def run(solver=solver) -> np.ndarray:
            solver.time = kind(0)
            solver.state[:] = [kind(x) for x in (*Q, *P)]
            solver.propagate_until(kind(PERIODS * TURN))
            return solver.state[:2].astype(float)

        yield Setting(f"tol {tol:.0e}", run)


def regularised_by_heyoka() -> Iterator[Setting]:
    """heyoka's method for the same regularised equations: u'' = −b u/2, t' = |u|², b = −E, up to the time."""
    import heyoka as hy

    x, y, u, v, t = hy.make_vars("x", "y", "u", "v", "t")
    b = -exact_energy()
    system = [(x, u), (y, v), (u, -b / 2 * x), (v, -b / 2 * y), (t, x * x + y * y)]
    root = Q[0] ** 0.5
    for tol in (1e-9, 1e-11, 1e-13, 1e-15, 1e-16, 1e-18):
        ends = hy.t_event(t - PERIODS * TURN, direction=hy.event_direction.positive)
        solver = hy.taylor_adaptive(system, [1.0, 0, 0, 1, 0], tol=tol, t_events=[ends])

        def run(solver=solver) -> np.ndarray:
            solver.reset_cooldowns()
            solver.time = 0.0
            solver.state[:] = [root, 0.0, 0.0, P[1] * root / 2, 0.0]
            solver.propagate_until(2.0 * PERIODS * TURN)
            x, y = solver.state[:2]
            return np.array([x * x - y * y, 2 * x * y])

        yield Setting(f"regularised, tol {tol:.0e}", run)


def by_rebound() -> Iterator[Setting]:
    import rebound

    for epsilon in (1e-6, 1e-9, 1e-11):

        def run(epsilon=epsilon) -> np.ndarray:
            simulation = rebound.Simulation()
            simulation.add(m=1.0)
            simulation.add(m=0.0, x=Q[0], y=Q[1], vx=P[0], vy=P[1])
            simulation.integrator = "ias15"
            simulation.integrator.epsilon = epsilon
            simulation.integrate(PERIODS * TURN)
            body, star = simulation.particles[1], simulation.particles[0]
            return np.array([body.x - star.x, body.y - star.y])

        yield Setting(f"IAS15, epsilon {epsilon:.0e}", run)


def exact_energy() -> float:
    """The energy of (Q, P), which is a difference of sums two hundred times as large, to the last digit."""
    x, v = (sp.Rational(float(each)) for each in (Q[0], P[1]))
    return float(v**2 / 2 - 1 / x)


def exact_end() -> np.ndarray:
    """Where the orbit from (Q, P), as the doubles that they are, is at the time, as a double: in 50 digits."""
    with mpmath.workdps(50):
        x, v, t = (mpmath.mpf(float(each)) for each in (Q[0], P[1], PERIODS * TURN))
        a = 1 / (2 / x - v**2)
        e = 1 - x / a
        mean = t * a ** mpmath.mpf(-1.5) - 2 * mpmath.pi * PERIODS
        turned = mpmath.findroot(lambda E: E - e * mpmath.sin(E) - mean, mean / (1 - e))
        return np.array([float(a * (mpmath.cos(turned) - e)), float(a * mpmath.sqrt(1 - e**2) * mpmath.sin(turned))])


def rows() -> Iterator[Row]:
    end = exact_end()
    error = lambda found: float(np.abs(found - end).max())
    settings = {"canon": [*by_canon()], "heyoka": [*by_heyoka()], "REBOUND": [*by_rebound()]}
    for target in (1e-6, 1e-8):
        chosen = {name: cheapest(each, error, target) for name, each in settings.items()}
        goals = {"heyoka": 8, "REBOUND": 100}
        yield compared("Kepler by steps, e = 0.99, 1000 periods", f"{target:.0e}", chosen, goals)
    others = {"logarithmic time": [*in_logarithmic_time()], "heyoka, regularised": [*regularised_by_heyoka()]}
    for target in (1e-6, 1e-9):
        chosen = {name: cheapest(each, error, target) for name, each in {"canon": settings["canon"], **others}.items()}
        yield compared("the same, beside other ways to regularise", f"{target:.0e}", chosen, {})
    field = 2.0**-17
    (reference,) = (setting.run() for setting in by_heyoka(field, np.longdouble))
    apart = lambda found: float(np.abs(found - reference).max())
    settings = {"canon": [*by_canon(field)], "heyoka": [*by_heyoka(field)]}
    for target in (1e-6, 1e-8):
        chosen = {name: cheapest(each, apart, target) for name, each in settings.items()}
        yield compared("Kepler in a uniform field of 2^-17, 1000 periods", f"{target:.0e}", chosen, {})
    for orbits in ORBITS:
        yield exact_steps(orbits)


def exact_steps(orbits: int) -> Row:
    """One step of a tenth of a period for each of many orbits with e = 0.99, beside one of WHFast's."""
    import jax
    import jax.numpy as jnp
    import rebound

    from canon.numeric.exact.kepler import kepler
    from canon.numeric.precision import double

    random = np.random.default_rng(1)
    step, count = TURN / 10, 100
    with double():
        anomalies = random.uniform(0, TURN, orbits)
        begin = (np.tile(Q[:, None], orbits), np.tile(P[:, None], orbits))
        q, v = jax.jit(lambda t: kepler(*begin, 1.0, t))(jnp.asarray(anomalies))
        state = ((q[0], q[1]), (v[0], v[1]))
        program = jax.jit(lambda z: jax.lax.fori_loop(0, count, lambda _, w: kepler(*w, 1.0, step), z))

        def ours() -> object:
            with double():
                return jax.block_until_ready(program(state))

        end = ours()
    energy = lambda z: (z[1][0] ** 2 + z[1][1] ** 2) / 2 - 1 / np.hypot(*z[0])
    drift = float(np.abs(energy(jax.tree.map(np.asarray, end)) + 0.5).max()) * 2
    simulation = rebound.Simulation()
    simulation.add(m=1.0)
    for a, b, c, d in np.array([*q, *v]).T:
        simulation.add(m=0.0, x=a, y=b, vx=c, vy=d)
    simulation.N_active = 1
    simulation.integrator, simulation.dt = "whfast", step
    medians = interleaved({"canon": ours, "REBOUND": lambda: simulation.steps(count)})
    per = {name: seconds / count / orbits for name, seconds in medians.items()}
    far = [(p.x**2 + p.y**2) ** 0.5 for p in simulation.particles[1:]]
    speeds = [(p.vx**2 + p.vy**2) / 2 for p in simulation.particles[1:]]
    off = float(np.abs(np.array(speeds) - 1 / np.array(far) + 0.5).max()) * 2
    sides = {
        "canon": Side("universal variables, one step", per["canon"], drift),
        "REBOUND": Side("WHFast, one step", per["REBOUND"], off),
    }
    return Row(f"exact Kepler, e = 0.99, {orbits} orbits; error: of the energy", "one step", sides, {"REBOUND": 1})
