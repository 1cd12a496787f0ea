"""Bodies under gravity beside a double loop written by hand for numba: the same steps of leapfrog on both sides."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

import numba
import numpy as np
from peers_common import Row, Side, interleaved

BODIES = (3, 4, 6, 8, 12, 30, 100, 300, 1000)
STEP = 1e-4


@numba.njit
def leapfrog(x, v, m, steps, h):
    a = np.zeros_like(x)
    for _ in range(steps):
        for i in range(len(x)):
            for c in range(3):
                x[i, c] += h / 2 * v[i, c]
                a[i, c] = 0.0
        for i in range(len(x)):
            for j in range(i + 1, len(x)):
                dx, dy, dz = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1], x[i, 2] - x[j, 2]
                s = dx * dx + dy * dy + dz * dz
                w = 1.0 / (s * sqrt(s))
                a[i, 0] -= m[j] * w * dx
                a[i, 1] -= m[j] * w * dy
                a[i, 2] -= m[j] * w * dz
                a[j, 0] += m[i] * w * dx
                a[j, 1] += m[i] * w * dy
                a[j, 2] += m[i] * w * dz
        for i in range(len(x)):
            for c in range(3):
                v[i, c] += h * a[i, c]
                x[i, c] += h / 2 * v[i, c]


def scene_text(x: np.ndarray, v: np.ndarray, m: np.ndarray) -> str:
    bodies = "".join(
        f"[[body]]\nmass = {mass!r}\nposition = {a.tolist()}\nvelocity = {b.tolist()}\n"
        for mass, a, b in zip(m.tolist(), x, v, strict=True)
    )
    return f'{bodies}[[effect]]\nkind = "mutual_gravity"\n[run]\nduration = 1.0\n'


def rows() -> Iterator[Row]:
    from canon.numeric.integrate import integrate
    from canon.numeric.integrators.yoshida import VERLET
    from canon.scenes.problem import problem_of
    from canon.scenes.reader import read_scene_text

    for bodies in BODIES:
        random = np.random.default_rng(bodies)
        x, v = random.standard_normal((2, bodies, 3))
        m = np.full(bodies, 1 / bodies)
        scene = read_scene_text(scene_text(x, v / 10, m))
        problem = problem_of(scene.model).value
        state = (np.array(scene.q), np.array(scene.p))
        steps = max(int(4e6 / bodies**2), 10)

        def ours(problem=problem, state=state, steps=steps) -> np.ndarray:
            return integrate(problem, VERLET, state, duration=steps * STEP, steps=steps, compensated=False).state[0]

        def theirs(x=x, v=v, m=m, steps=steps) -> np.ndarray:
            places, speeds = x.copy(), v / 10
            leapfrog(places, speeds, m, steps, STEP)
            return places

        apart = float(np.abs(ours(steps=10).reshape(-1, 3) - theirs(steps=10)).max())
        medians = interleaved({"canon": ours, "numba": theirs})
        sides = {name: Side("leapfrog, one step", seconds / steps, apart) for name, seconds in medians.items()}
        yield Row(f"{bodies} bodies; error: between the sides after 10 steps", "one step", sides, {"numba": 1 / 1.5})
