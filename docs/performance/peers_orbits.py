"""Hénon–Heiles: a thousand orbits to t = 100, beside heyoka and diffrax; and what `peers_orbit` shares."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from itertools import product

import numpy as np
import sympy as sp
from peers_common import Row, Setting, cheapest, compared

ENERGY = 1 / 12
COUNT, TIME = 1000, 100.0
FEW, LONG = 5, 10_000.0
TARGETS = (1e-6, 1e-9, 1e-12)
METHODS = ("nystrom6", "nystrom6a", "nystrom8", "sofroniou_spaletta10")
MULTISTEP = ("stormer8", "stormer10", "stormer12")
FORCES = np.geomspace(8, 180, 28)
"""Forces in a unit of time that are tried."""
FEW_FORCES = np.geomspace(24, 60, 14)
"""The same with compensated sums, by multistep methods: what they reach beyond the rounding of plain sums."""
x, y, px, py = sp.symbols("x y p_x p_y", real=True)
H = (px**2 + py**2) / 2 + (x**2 + y**2) / 2 + x**2 * y - y**3 / 3


@cache
def states() -> np.ndarray:
    """Points (1000, 4) of the surface H = 1/12, at random."""
    random, found = np.random.default_rng(0), list[tuple[float, ...]]()
    while len(found) < COUNT:
        a, b, u = random.uniform(-0.4, 0.4, 3)
        left = 2 * (ENERGY - (a * a + b * b) / 2 - a * a * b + b**3 / 3) - u * u
        if left > 0:
            found.append((a, b, u, left**0.5))
    return np.array(found)


def equations():
    import heyoka as hy

    a, b, u, v = hy.make_vars("x", "y", "u", "v")
    return [(a, u), (b, v), (u, -a - 2 * a * b), (v, -b - a * a + b * b)]


@cache
def reference(time: float, count: int) -> np.ndarray:
    """The end positions (count, 2), by heyoka in extended precision."""
    import heyoka as hy

    zero = np.longdouble(0)
    solver = hy.taylor_adaptive(equations(), [zero] * 4, tol=np.longdouble(1e-19), fp_type=np.longdouble)
    ends = np.empty((count, 2))
    for k, state in enumerate(states()[:count]):
        solver.time = zero
        solver.state[:] = state.astype(np.longdouble)
        solver.propagate_until(np.longdouble(time))
        ends[k] = solver.state[:2].astype(float)
    return ends


def by_canon(time: float, count: int) -> Iterator[Setting]:
    from canon.numeric.integrate import integrate
    from canon.numeric.integrators.catalogue import method
    from canon.numeric.split_hamiltonian import split_hamiltonian

    z = states()[:count].T
    many = ((z[0], z[1]), (z[2], z[3]))
    few = [(z[:2, k].copy(), z[2:, k].copy()) for k in range(FEW)]
    for split in split_hamiltonian(H, (x, y), (px, py)):
        problem = split.splitting()
        for name in (*METHODS, *(MULTISTEP if split.kind == "T(p) + V(q)" else ())):
            chosen = method(name)
            for forces, kept in [
                *product(FORCES, [False]),
                *(product(FEW_FORCES, [True]) if name in MULTISTEP else ()),
            ]:
                steps = max(round(forces * time / chosen.stages), 1)

                def run(problem=problem, chosen=chosen, steps=steps, kept=kept) -> np.ndarray:
                    shared = {"duration": time, "steps": steps, "compensated": kept}
                    if count == FEW:
                        return np.array([integrate(problem, chosen, one, **shared).state[0] for one in few])
                    return np.array(integrate(problem, chosen, many, batched=True, **shared).state[0]).T

                sums = ", compensated sums" if kept else ""
                yield Setting(f"{name}, {split.kind}, {steps} steps{sums}", run)


def by_heyoka(time: float, count: int) -> Iterator[Setting]:
    import heyoka as hy

    width = hy.recommended_simd_size()
    for tol in (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16):
        if count == FEW:
            solver = hy.taylor_adaptive(equations(), [0.0] * 4, tol=tol)

            def one_by_one(solver=solver) -> np.ndarray:
                ends = np.empty((FEW, 2))
                for k in range(FEW):
                    solver.time = 0.0
                    solver.state[:] = states()[k]
                    solver.propagate_until(time)
                    ends[k] = solver.state[:2]
                return ends

            yield Setting(f"tol {tol:.0e}", one_by_one)
            continue
        batch = hy.taylor_adaptive_batch(equations(), np.zeros((4, width)), tol=tol)

        def many(batch=batch) -> np.ndarray:
            ends = np.empty((count, 2))
            for k in range(0, count, width):
                batch.set_time(0.0)
                batch.state[:] = states()[k : k + width].T
                batch.propagate_until(time)
                ends[k : k + width] = batch.state[:2].T
            return ends

        yield Setting(f"batches of {width}, tol {tol:.0e}", many)


def by_diffrax(time: float, count: int) -> Iterator[Setting]:
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    def field(t, z, args):
        a, b, u, v = z
        return jnp.stack([u, v, -a - 2 * a * b, -b - a * a + b * b])

    term = diffrax.ODETerm(field)
    for tol in (1e-8, 1e-11, 1e-13):
        control = diffrax.PIDController(rtol=tol, atol=tol)

        def solve(z, control=control):
            return diffrax.diffeqsolve(
                term, diffrax.Dopri8(), 0.0, time, None, z, stepsize_controller=control, max_steps=None
            ).ys[0]

        program = jax.jit(jax.vmap(solve))
        yield Setting(f"Dopri8, tol {tol:.0e}", lambda program=program: np.asarray(program(states()[:count]))[:, :2])


def rows() -> Iterator[Row]:
    metrics: dict[str, Callable] = {"largest": np.max, "median": np.median}
    many = {
        "canon": [*by_canon(TIME, COUNT)],
        "heyoka": [*by_heyoka(TIME, COUNT)],
        "diffrax": [*by_diffrax(TIME, COUNT)],
    }
    for word, metric in metrics.items():
        for target, goal in zip(TARGETS, (8, 4, 2.5), strict=True):
            yield row(f"1000 orbits, t = 100, {word} error", many, metric, target, goal, TIME, COUNT, diffrax=50)


def row(
    task: str, settings: dict, metric: Callable, target: float, goal: float, time: float, count: int, **more: float
) -> Row:
    ends = reference(time, count)

    def error(found: np.ndarray) -> float:
        with np.errstate(invalid="ignore"):
            value = float(metric(np.abs(found - ends).max(axis=1)))
        return value if np.isfinite(value) else np.inf

    chosen = {name: cheapest(each, error, target) for name, each in settings.items()}
    return compared(task, f"{target:.0e}", chosen, {"heyoka": goal, **more})
