"""Actions, digits and microseconds: canon beside galpy, gala, nafflib and the formulas of textbooks.

    pip install -e '.[peers]' && python docs/performance/actions.py [--json FILE]

Errors are relative, the median and the largest over the orbits of a row, against 40 digits of the closed form or of the
same integral (`actions_reference.py`). Times are CPU times per orbit, medians of interleaved runs in one process;
compilation is not counted. What is not installed is left out.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
from actions_reference import isochrone, pendulum, staeckel
from peers import machine
from peers_common import interleaved

import canon

jax.config.update("jax_enable_x64", True)
B, C, DELTA = 1.0, 0.6, 0.8
CHECKED = 24
TURN = 2 * np.pi


@dataclass(frozen=True)
class Side:
    """One program in one row: the errors' median and largest, and the CPU time per orbit in microseconds."""

    program: str
    median: float
    worst: float
    microseconds: float


@dataclass(frozen=True)
class Row:
    """A task, and what each program makes of it."""

    task: str
    orbits: int
    sides: Sequence[Side]


@dataclass(frozen=True)
class Program:
    """A way to compute: `run` takes the number of orbits that it is to do, and returns their actions."""

    name: str
    run: Callable[[int], np.ndarray]
    orbits: int


def row(task: str, programs: Sequence[Program], exact: Callable[[int], mp.mpf]) -> Row:
    """Errors of the first orbits, then interleaved times of all."""
    sides = {}
    reference = [exact(k) for k in range(CHECKED)]
    for program in programs:
        found = program.run(program.orbits)
        errors = [_error(float(found[k]), reference[k]) for k in range(min(CHECKED, program.orbits))]
        sides[program.name] = (float(np.median(errors)), max(errors))
    times = interleaved({p.name: (lambda p=p: p.run(p.orbits)) for p in programs}, rounds=5)
    found_sides = [Side(p.name, *sides[p.name], times[p.name] / p.orbits * 1e6) for p in programs]
    return Row(task, max(p.orbits for p in programs), found_sides)


def _error(value: float, exact: mp.mpf) -> float:
    return 1.0 if not math.isfinite(value) else float(abs(mp.mpf(value) / exact - 1))


def isochrone_orbits(kind: str, count: int) -> tuple[np.ndarray, ...]:
    """Radius, radial momentum, angular momentum: about circles, or nearly through the centre."""
    rng = np.random.default_rng(3)
    r = np.exp(0.4 * rng.normal(size=count))
    s = np.sqrt(B * B + r * r)
    L = np.sqrt(r**4 / (s * (B + s) ** 2))
    if kind == "nearly radial":
        return r, 0.5 * np.sqrt(2 / (B + s)) * rng.random(count), 1e-4 * L
    width = {"eccentric": 0.5, "nearly circular, 1e-6": 1e-6}[kind]
    return r, width * rng.normal(size=count) * 0.5 * L / r, L * (1 - width * rng.random(count))


def isochrone_rows() -> Iterator[Row]:
    count = 100_000
    closed = jax.jit(lambda r, p, L: canon.isochrone_actions(r, p, L, b=B).radial)
    V = "-1/(1 + sqrt(1 + r**2))"
    for kind in ("eccentric", "nearly circular, 1e-6", "nearly radial"):
        r, p, L = isochrone_orbits(kind, count)
        on_device = [jnp.asarray(x) for x in (r, p, L)]
        exact = lambda k, r=r, p=p, L=L: isochrone(r[k], p[k], L[k], B)  # noqa: E731

        def ours(n: int, rows: list = on_device) -> np.ndarray:
            return np.asarray(jax.block_until_ready(closed(*rows)))

        programs = [Program("canon", ours, count)]
        general = [Program("canon", lambda n, s=(r, p, L): canon.central_actions(V, *(x[:n] for x in s)).radial, 65536)]
        if find_spec("galpy"):
            programs.append(Program("galpy", lambda n, s=(r, p, L): TURN * galpy_isochrone(*(x[:n] for x in s)), 2000))
            general.append(Program("galpy", lambda n, s=(r, p, L): TURN * galpy_spherical(*(x[:n] for x in s)), 24))
        if find_spec("gala"):
            programs.append(Program("gala", lambda n, s=(r, p, L): TURN * gala_isochrone(*(x[:n] for x in s)), 2000))
        yield row(f"isochrone, closed form, {kind}", programs, exact)
        yield row(f"isochrone as any potential V(r), {kind}", general, exact)


def galpy_isochrone(r: np.ndarray, p: np.ndarray, L: np.ndarray) -> np.ndarray:
    from galpy.actionAngle import actionAngleIsochrone
    from galpy.potential import IsochronePotential

    zero = np.zeros_like(r)
    return actionAngleIsochrone(ip=IsochronePotential(amp=1.0, b=B))(r, p, L / r, zero, zero)[0]


def galpy_spherical(r: np.ndarray, p: np.ndarray, L: np.ndarray) -> np.ndarray:
    from galpy.actionAngle import actionAngleSpherical
    from galpy.potential import IsochronePotential

    zero = np.zeros_like(r)
    return actionAngleSpherical(pot=IsochronePotential(amp=1.0, b=B))(r, p, L / r, zero, zero)[0]


def gala_isochrone(r: np.ndarray, p: np.ndarray, L: np.ndarray) -> np.ndarray:
    import gala.dynamics as gd
    import gala.potential as gp
    from gala.dynamics.actionangle import isochrone_xv_to_aa
    from gala.units import dimensionless

    zero = np.zeros_like(r)
    place = gd.PhaseSpacePosition(pos=np.stack([r, zero, zero]), vel=np.stack([p, L / r, zero]))
    actions = isochrone_xv_to_aa(place, gp.IsochronePotential(m=1.0, b=B, units=dimensionless))[0]
    return np.asarray(actions.value)[0]


def staeckel_orbits(height: float, count: int) -> list[np.ndarray]:
    """Orbits about circles of the plane, and how far they leave it."""
    rng = np.random.default_rng(4)
    R = np.exp(0.3 * rng.normal(size=count))
    s = np.sqrt(R * R + C * C + DELTA * DELTA)
    L = R * R / np.sqrt(s) / (C + s)
    p = L / R
    return [
        R,
        height * rng.normal(size=count),
        0.3 * p * rng.normal(size=count),
        height * p * rng.normal(size=count),
        L * (1 - 0.3 * rng.random(count)),
    ]


def staeckel_rows() -> Iterator[Row]:
    for words, height in (("far from the plane", 0.2), ("within 1e-5 of the plane", 1e-5)):
        rows = staeckel_orbits(height, 16384)
        for which, name in enumerate(("J_r", "J_z")):

            def ours(n: int, rows: list = rows, which: int = which) -> np.ndarray:
                found = canon.staeckel_actions("1/(c + sqrt(t + c**2))", DELTA, *rows, parameters={"c": C})
                return found[which]

            programs = [Program("canon", ours, 16384)]
            if find_spec("galpy"):
                programs.append(
                    Program("galpy (C)", lambda n, s=rows, k=which: 2 * np.pi * galpy_staeckel(s, n)[k], 4096)
                )
            yield row(
                f"Kuzmin and Kutuzov, {words}: {name}",
                programs,
                lambda k, rows=rows, which=which: staeckel(*(x[k] for x in rows), C, DELTA)[which],
            )


def galpy_staeckel(rows: Sequence[np.ndarray], count: int) -> tuple[np.ndarray, np.ndarray]:
    from galpy.actionAngle import actionAngleStaeckel
    from galpy.potential import KuzminKutuzovStaeckelPotential

    potential = KuzminKutuzovStaeckelPotential(amp=1.0, ac=math.hypot(C, DELTA) / C, Delta=DELTA)
    R, z, p_R, p_z, L = (x[:count] for x in rows)
    found = actionAngleStaeckel(pot=potential, delta=DELTA, c=True, order=20)(R, p_R, L / R, z, p_z)
    return found[0], found[2]


def pendulum_rows() -> Iterator[Row]:
    compiled = jax.jit(lambda m1: canon.pendulum_actions(m1).action)
    for words, low, high in (("1 − m from 0.5 to 1e-3", 0.5, 1e-3), ("1 − m from 1e-10 to 1e-300", 1e-10, 1e-300)):
        for side, sign in (("librations", 1), ("rotations", -1)):
            m1 = sign * np.geomspace(low, high, CHECKED)
            many = jnp.asarray(np.resize(m1, 50_000))
            period = jax.jit(lambda m1: canon.pendulum_actions(m1).period)
            for name, which, run in (("J", 0, compiled), ("T", 1, period)):
                programs = [Program("canon", lambda n, f=run, x=many: np.asarray(f(x)), 50_000)]
                if find_spec("scipy"):
                    programs.append(
                        Program("E(m), K(m) of scipy", lambda n, x=m1, k=which: textbook(np.resize(x, n))[k], 50_000)
                    )
                yield row(f"pendulum, {side}, {words}: {name}", programs, lambda k, x=m1, w=which: pendulum(x[k])[w])


def textbook(m1: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """J and T by the formulas as they are printed, from m = 1 − m1 in double precision."""
    from scipy.special import ellipe, ellipk

    m = 1 - m1
    turning = m1 < 0
    k = np.where(turning, 1 / m, m)
    with np.errstate(all="ignore"):
        J = np.where(turning, 8 * np.sqrt(m) * ellipe(k), 16 * (ellipe(k) - (1 - m) * ellipk(k)))
        T = np.where(turning, 2 * ellipk(k) / np.sqrt(m), 4 * ellipk(k))
    return J, T


def motion_rows() -> Iterator[Row]:
    """One orbit at a time with a proved rounding: what `canon actions` does."""
    quartic = canon.motion("p**2/2 + q**4")
    with mp.workdps(40):
        exact = mp.sqrt(2) * mp.beta(mp.mpf(1) / 4, mp.mpf(3) / 2)
    run = lambda n: np.array([quartic.orbit(1).action.value for _ in range(n)])  # noqa: E731
    yield row("quartic well, with a bound", [Program("canon", run, CHECKED)], lambda k: exact)
    swing = canon.motion("p**2/2 + 2*sin(q/2)**2 - 1", period="2*pi")  # not seen to be a pendulum: no mean
    near = lambda n: np.array([swing.orbit(below_separatrix="1e-12").action.value for _ in range(n)])  # noqa: E731
    yield row(
        "pendulum as any H(q, p), 1e-12 below the separatrix",
        [Program("canon", near, CHECKED)],
        lambda k: pendulum(mp.mpf("1e-12") / 2)[0],
    )


def frequency_rows() -> Iterator[Row]:
    t = np.arange(4096)
    signal = np.exp(2j * np.pi * 0.12345678901234 * t) + 0.1 * np.exp(2j * np.pi * 0.2718281828459 * t)
    ours = lambda n: np.full(n, canon.frequency_lines(signal, 1.0, 2).frequencies[0])  # noqa: E731
    programs = [Program("canon", lambda n: np.concatenate([ours(1) for _ in range(n)]), CHECKED)]
    if find_spec("nafflib"):
        import nafflib

        def theirs(n: int) -> np.ndarray:
            return np.array([nafflib.harmonics(signal, num_harmonics=2, window_order=4)[1][0] for _ in range(n)])

        programs.append(Program("nafflib", theirs, CHECKED))
    yield row("frequency of the larger of two lines, 4096 samples", programs, lambda k: mp.mpf(0.12345678901234))


def table(rows: Sequence[Row]) -> Iterator[str]:
    yield "| task | program | error, median | largest | µs per orbit | times canon's |"
    yield "|---|---|--:|--:|--:|--:|"
    for each in rows:
        base = each.sides[0].microseconds
        for k, side in enumerate(each.sides):
            yield (
                f"| {'' if k else each.task} | {side.program} | {side.median:.0e} | {side.worst:.0e} "
                f"| {side.microseconds:.3g} | {'' if k == 0 else f'{side.microseconds / base:.3g}'} |"
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", metavar="FILE")
    arguments = parser.parse_args()
    rows = [
        each
        for family in (isochrone_rows, staeckel_rows, pendulum_rows, motion_rows, frequency_rows)
        for each in family()
    ]
    print(machine())
    print("\n".join(table(rows)))
    if arguments.json:
        Path(arguments.json).write_text(json.dumps([asdict(each) for each in rows], indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
