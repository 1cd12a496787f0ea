"""Kepler's motion: a thousand periods at e = 0.99 by stepping, and exact steps of many orbits at once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy as sp
from peers_common import Row, Setting, Side, cheapest, compared, interleaved

ECCENTRICITY, PERIODS = 0.99, 1000
TURN = 2 * np.pi
Q, P = np.array([1 - ECCENTRICITY, 0.0]), np.array([0.0, ((1 + ECCENTRICITY) / (1 - ECCENTRICITY)) ** 0.5])
ORBITS = (125, 500, 1000, 2000)


def by_canon() -> Iterator[Setting]:
    from canon.numeric.integrators.catalogue import method
    from canon.numeric.regularise import regularise
    from canon.numeric.transformed import integrate_transformed

    x, y, px, py = sp.symbols("x y p_x p_y", real=True)
    kepler = regularise((px**2 + py**2) / 2, -1 / sp.sqrt(x**2 + y**2), (x, y), (px, py))
    state = kepler.state(Q, P)
    for name in ("sofroniou_spaletta10", "kahan_li8"):
        chosen = method(name)
        for steps in (5, 6, 7, 8, 9, 10, 12, 14, 17, 20, 24):

            def run(chosen=chosen, steps=steps) -> np.ndarray:
                made = integrate_transformed(kepler.problem, chosen, state, [0.0, PERIODS * TURN], step=TURN / steps)
                return np.asarray(made.states[0][-1])

            yield Setting(f"{name} in logarithmic time, {steps} steps a period", run)


def by_heyoka() -> Iterator[Setting]:
    import heyoka as hy

    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    cube = (x * x + y * y) ** -1.5
    for tol in (1e-9, 1e-11, 1e-13, 1e-15, 1e-16, 1e-18):
        solver = hy.taylor_adaptive([(x, u), (y, v), (u, -x * cube), (v, -y * cube)], [1.0, 0, 0, 1], tol=tol)

        def run(solver=solver) -> np.ndarray:
            solver.time = 0.0
            solver.state[:] = [*Q, *P]
            solver.propagate_until(PERIODS * TURN)
            return solver.state[:2].copy()

        yield Setting(f"tol {tol:.0e}", run)


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


def rows() -> Iterator[Row]:
    settings = {"canon": [*by_canon()], "heyoka": [*by_heyoka()], "REBOUND": [*by_rebound()]}
    for target in (1e-6, 1e-8):
        chosen = {
            name: cheapest(each, lambda end: float(np.abs(end - Q).max()), target) for name, each in settings.items()
        }
        yield compared(
            "Kepler by steps, e = 0.99, 1000 periods", f"{target:.0e}", chosen, {"heyoka": 8, "REBOUND": 100}
        )
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
