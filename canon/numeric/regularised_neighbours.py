"""What the flow of `regularised_orbit` does to neighbours of an orbit: its derivative, points along it, the way back.

Each neighbour has an energy of its own, and so other states after the same number of steps: all are carried along by
steps of one length in the fictitious time, each is then found at the time that is asked for. Of the derivative that is
the implicit function theorem: with z(s) and t(s) after s of the fictitious time, and s kept so that t is the same,

    M = ∂z/∂z₀ − ∂z/∂s (∂t/∂z₀)/(∂t/∂s),

between the two changes of coordinates: the variational equations, solved by the very steps that made the orbit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from canon.numeric.compiled import compiled_soon
from canon.numeric.integrate import Run, advance, flow_map, start
from canon.numeric.integrators.stepper import Method
from canon.numeric.levi_civita import Regularised, entries
from canon.numeric.lower import lower
from canon.numeric.precision import double
from canon.numeric.regularised_orbit import KEPT, PIECE, foreseen, halley, longer

Array = np.ndarray
ROWS: Final = (256, 1 << 18)
"""States that are kept of each neighbour at least, and of all of them together."""
MOST_STEPS: Final = 100_000_000


@dataclass(frozen=True)
class RegularisedNeighbours:
    """Neighbours of an orbit about a `centre` (d,), from `t0` over `duration`, by steps of a `method` of this length in
    the fictitious time.
    """

    kepler: Regularised
    method: Method
    centre: tuple[float, ...]
    step: float
    t0: float
    duration: float

    def jacobian(self, q: Array, p: Array) -> Array:
        """M (2d, 2d), the derivative of the flow over the whole duration at (q, p) (d,)."""
        import jax
        import jax.numpy as jnp

        begin = np.concatenate([q - np.array(self.centre), p])
        where = _found(self.kepler, self.method, begin[None], self.t0, np.array([[self.duration]]), self.step)
        row, between, rest = int(where.rows[0, 0]), where.between, float(where.lengths[0, 0])
        starter, few = _short(self.method, between)
        problem, d, started = self.kepler.problem, len(q), self.kepler.t0 - self.t0
        with double():
            before = flow_map(problem, self.method, steps=row * between, h=self.step) if row else lambda state: state

            def whole(z: Any) -> Any:
                coordinates, momenta = _lifted(self.kepler, z[: 2 * d, None], self.t0, started, jnp)
                state = before((coordinates[:, 0], momenta[:, 0]))
                last = flow_map(problem, starter, steps=few, h=z[2 * d] / few)(state)
                return jnp.concatenate([_shown(self.kepler, last, jnp), -last[1][-1:]])

            at = jnp.asarray(np.append(begin, rest))
            slopes = np.asarray(compiled_soon(jax.jacfwd(whole))(at))
        return slopes[:-1, :-1] - np.outer(slopes[:-1, -1], slopes[-1, :-1] / slopes[-1, -1])

    def along(self, points: Array, samples: int) -> Array:
        """Phase points (k, 2d) at `samples` equidistant times (samples, k, 2d), both ends included."""
        moments = self.duration * (np.arange(samples) / (samples - 1))
        return self._carried(points, self.t0, np.repeat(moments[:, None], len(points), axis=1))

    def back(self, points: Array) -> Array:
        """Phase points (k, 2d) of the end, by the same steps backwards at the beginning."""
        return self._carried(points, self.t0 + self.duration, np.full((1, len(points)), -self.duration))[0]

    def shifted(self, points: Array, late: Array, steps: int) -> Array:
        """Phase points (k, 2d) of the end, each after a time (k,) of its own, or that much before."""
        found, after = np.array(points, dtype=float), late > 0
        for side in (after, ~after):
            if side.any():
                found[side] = self._carried(points[side], self.t0 + self.duration, late[side][None])[0]
        return found

    def _carried(self, points: Array, begin: float, wanted: Array) -> Array:
        shift = np.concatenate([self.centre, np.zeros(len(self.centre))])
        found = _found(self.kepler, self.method, points - shift, begin, wanted, self.step).points + shift
        found[wanted == 0] = np.broadcast_to(points, found.shape)[wanted == 0]  # not rounded there and back
        return found


@dataclass(frozen=True)
class _Found:
    """Points (samples, k, 2d); they are `lengths` of the fictitious time beyond the states in these `rows`, which are
    `between` steps apart.
    """

    points: Array
    rows: Array
    lengths: Array
    between: int


def _found(kepler: Regularised, method: Method, points: Array, begin: float, wanted: Array, step: float) -> _Found:
    """Points (k, 2d) at the time `begin`, after times `wanted` (samples, k), which are all of one sign; nan where an
    orbit is lost.
    """
    started = kepler.t0 - begin
    with np.errstate(all="ignore"):
        state = _lifted(kepler, points.T, begin, started, np)
    span = float(np.abs(wanted).max())
    ahead = -1.0 if wanted.min() < 0 else 1.0
    energies = state[0][-1][np.isfinite(state[0][-1])]
    longest = max((foreseen(kepler, float(b), span) for b in energies), default=step)
    most = max(ROWS[0], ROWS[1] // len(points))
    between = max(KEPT, math.ceil(longest / step / most))
    rows = max(math.ceil(longest / step / between), 1) + 1
    run = start(
        kepler.problem, method, state, duration=ahead * step * between * rows, steps=between * rows, samples=rows + 1
    )
    run = _passed(kepler, method, run, ahead, started, span)
    kept = tuple(np.asarray(slot) for slot in run.states)
    clock = ahead * (started - kept[1][:, -1])
    width = ahead * step * between
    row = np.empty(wanted.shape, dtype=int)
    part = np.empty(wanted.shape)
    for k, times in enumerate(clock.T):
        last = max(int(np.isfinite(times).sum()) - 2, 0)
        row[:, k] = np.clip(np.searchsorted(times, np.abs(wanted[:, k]), side="right") - 1, 0, last)
        gaps = np.diff(times, append=np.inf)[row[:, k]]
        part[:, k] = np.clip((np.abs(wanted[:, k]) - times[row[:, k]]) / np.maximum(gaps, 1e-300), 0, 1)
    each = np.broadcast_to(np.arange(len(points)), wanted.shape)
    lost = np.abs(wanted) > np.nanmax(clock, axis=0, initial=0.0)
    starter, few = _short(method, between)
    begun = tuple(slot[row, :, each].reshape(-1, slot.shape[1]) for slot in kept)
    low, high = (np.full(row.size, edge) for edge in sorted((0.0, width)))
    with double():
        program = halley(kepler.problem, starter, few)
        late, length = program(
            begun, (wanted - started).ravel(), part.ravel() * width, low, high, 1 / (2 * kepler.mass)
        )
        late = tuple(np.asarray(slot).T for slot in late)
    with np.errstate(all="ignore"):
        found = _shown(kepler, late, np).T.reshape(*wanted.shape, -1)
    found[lost] = np.nan
    return _Found(found, row, np.asarray(length).reshape(row.shape), between)


def _short(method: Method, between: int) -> tuple[Method, int]:
    """A method that needs no past, and its steps for so many of the method's: one that begins others is so accurate
    that it can take two of them at once.
    """
    starter = getattr(method, "starter", None)
    return (method, between) if starter is None else (starter, between // 2)


def _passed(kepler: Regularised, method: Method, run: Run, ahead: float, started: float, span: float) -> Run:
    """The run, as far as every neighbour that isn't lost needs it."""
    while run.steps < MOST_STEPS:
        run = advance(kepler.problem, method, run, chunks=max(PIECE // run.per_chunk, 1), batched=True)
        clock = ahead * (started - np.asarray(run.stored[1][run.completed - 1, -1]))
        slowest = float(np.min(clock[np.isfinite(clock)], initial=np.inf))
        if run.ended or slowest >= span:
            break
        if run.done == run.chunks:
            run = longer(replace(run, stored=tuple(np.asarray(x) for x in run.stored)), span, slowest)
    return run


def _lifted(kepler: Regularised, z: Any, begin: float, started: float, numbers: Any) -> tuple[Any, Any]:
    """(u…, b) and (w…, t0 − begin), each (n, k), of phase points (2d, k) relative to the centre."""
    d = len(z) // 2
    q, p = z[:d], z[d:]
    x, y = kepler.sign * q, kepler.sign * p
    r = numbers.sqrt(numbers.sum(x**2, axis=0))
    if d == 1:
        u = [numbers.sqrt(x[0])]
    else:
        right = x[0] >= 0
        large = numbers.sqrt((r + numbers.where(right, x[0], -x[0])) / 2)
        small = [each / (2 * large) for each in x[1:]]
        u = [numbers.where(right, large, small[0]), numbers.where(right, small[0], large)]
        u += [numbers.where(side, each, 0.0) for each in small[1:] for side in (right, ~right)]
    L = entries(u)
    w = [2 * sum(L[i][j] * y[i] for i in range(d)) for j in range(len(u))]
    times = (begin,) if len(kepler.place) > 2 * d else ()
    (rest,) = lower((kepler.rest,), kepler.place)(*q, *p, *times, numbers=numbers)
    energy = numbers.sum(y**2, axis=0) / (2 * kepler.mass) - kepler.strength / r + rest
    return numbers.stack([*u, -energy]), numbers.stack([*w, numbers.zeros_like(energy) + started])


def _shown(kepler: Regularised, state: Any, numbers: Any) -> Any:
    """Phase points (2d[, k]) of states (n[, k])."""
    u, w = state[0][:-1], state[1][:-1]
    L, r = entries(u), sum(x**2 for x in u)
    q = [sum(row[j] * u[j] for j in range(len(u))) for row in L]
    p = [sum(row[j] * w[j] for j in range(len(w))) / (2 * r) for row in L]
    return kepler.sign * numbers.stack([*q, *p])
