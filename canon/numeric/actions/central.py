"""Actions of many orbits in a central potential that is given by a formula.

The nodes are doubled until that changes nothing to speak of. The error falls at least geometrically in their number, so
that what the last doubling changed is more than what is left: that and the rounding are the bound. To square a larger
change instead, as one that is of the whole of J_r, would be less than what is left where the orbit passes by a small
core, of which J_r has a part alone. Conditioning: the bound takes the state as exact. Next to a circle J_r is as the
square of the eccentricity e, so that relative errors ε of the state are errors of some ε/e of J_r.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

from canon.errors import InputError
from canon.expected import finite_number
from canon.numeric.actions.isochrone import CentralActions
from canon.numeric.actions.orbit_blocks import as_function, blocks, formula_of, on_block, orbits_of
from canon.numeric.actions.oscillation import DEGREES
from canon.numeric.actions.radial import amplitude, narrow, narrow_sums, wide_ends, wide_sums
from canon.numeric.precision import UNIT, double

COUNTS: Final = (16, 32, 64, 128, 256, 512)
SETTLED: Final = 1e-12


class _Kernels(NamedTuple):
    """Compiled once for a formula: blocks of orbits in, arrays out."""

    guess: Any
    near: Any
    ends: Any
    wide: Any


def central_actions(
    V: Any,
    r: Any,
    p_r: Any,
    L: Any,
    *,
    m: float = 1.0,
    variable: str = "r",
    parameters: Mapping[str, Any] | None = None,
) -> CentralActions:
    """The actions of orbits given by radius r > 0, radial momentum and angular momentum L ≥ 0, arrays of one shape.

    **Arguments:** `V`, the potential energy as a formula (text or sympy) in `variable`, smooth on the scale of r;
    `parameters`, numbers for its other names; `m`, the mass.

    **Raises:** `InputError` where V is no such formula, or an orbit is not bound, with its index.
    """
    formula, symbol = formula_of(V, variable, {} if parameters is None else parameters, "V")
    state, shape = orbits_of((r, p_r, L), ("r", "p_r", "L"))
    finite_number(m, "m")
    _check(state)
    count = state[0].size
    found = np.full((4, count), np.nan)
    kernels = _kernels(formula, symbol, float(m))
    with double():
        wide, ends = sorted_out(kernels, state, found, _row)
        lost = ~np.isfinite(ends).all(axis=0)
        if lost.any():
            raise InputError(_unbound(formula, symbol, int(wide[np.argmax(lost)]), state))
        doubled(kernels.wide, wide, [*state, *spread(ends, wide, count)], found, _row)
    radial, frequency, azimuthal, bound = (row.reshape(shape) for row in found)
    return CentralActions(radial, 2 * np.pi * state[2].reshape(shape), frequency, azimuthal, bound)


def _row(action: Any, time: Any, angle: Any, rounding: Any) -> Any:
    """J_r, both frequencies and the rounding, from what one way between the turning points gives."""
    return np.stack([2 * action, 1 / (2 * time), angle / time / (2 * np.pi), rounding])


def sorted_out(kernels: Any, state: Any, found: Any, row: Any) -> tuple[Any, Any]:
    """Fill `found` for the narrow orbits; return the indices of all others, with their turning points (2, …)."""
    everything = np.arange(found.shape[1])
    guessed = np.concatenate([np.empty(0), *(on_block(kernels.guess, block, state)[0] for block in blocks(everything))])
    for most, degree in DEGREES:
        for block in blocks(np.flatnonzero((guessed < most) & np.isnan(found[0]))):
            holds, *values = on_block(kernels.near(degree), block, state)
            found[:, block[holds]] = row(*values)[:, holds]
    wide = np.flatnonzero(np.isnan(found[0]))
    ends = [np.stack(on_block(kernels.ends, block, state)) for block in blocks(wide)]
    return wide, np.concatenate([np.empty((2, 0)), *ends], axis=1)


def spread(rows: Any, indices: Any, count: int) -> Any:
    """Rows of some orbits as rows of all."""
    found = np.full((len(rows), count), np.nan)
    found[:, indices] = rows
    return found


def doubled(kernels: Any, todo: Any, rows: Any, found: Any, row: Any, watched: int = 1) -> None:
    """Fill `found`, whose last row is the rounding of its first, with as many nodes as it takes.

    There are enough when each of the first `watched` rows is settled; the largest part of itself by which one of them
    changed last joins the rounding.
    """
    before = np.full((watched, found.shape[1]), np.nan)
    for count in COUNTS:
        for block in blocks(todo):
            values = row(*on_block(kernels(count), block, rows))
            size = np.abs(values[:watched])
            change = np.abs(values[:watched] - before[:, block])
            part = np.max(change / np.where(size > 0, size, 1.0), axis=0)
            settled = part * size[0] <= np.maximum(SETTLED * size[0], values[-1])
            values[-1] += part * size[0]
            before[:, block] = values[:watched]
            if count == COUNTS[-1]:
                settled = np.ones_like(settled)
            found[:, block[settled]] = values[:, settled]
        todo = todo[np.isnan(found[0, todo])]
        if not todo.size:
            return


@lru_cache(maxsize=32)
def _kernels(formula: Any, symbol: Any, m: float) -> _Kernels:
    import jax
    import jax.numpy as jnp

    V = as_function(formula, symbol)

    @lru_cache(maxsize=4)
    def near(degree: int) -> Any:
        @jax.jit
        def run(r: Any, p: Any, L: Any) -> Any:
            orbit = narrow(V, r, p, L, m, degree)
            sums = narrow_sums(orbit, r, L, m)
            # the slope of p_r² is a difference of two terms of the size of L²/r³
            off = 8 * UNIT * (L * L / r**3) * jnp.maximum(-orbit.low, orbit.high)
            return orbit.holds, *sums, 2 * (off * sums.time / m + 16 * UNIT * sums.action)

        return run

    @lru_cache(maxsize=8)
    def wide(count: int) -> Any:
        @jax.jit
        def run(r: Any, p: Any, L: Any, low: Any, high: Any) -> Any:
            sums = wide_sums(V, r, p, L, m, low, high, count)
            size = p * p + (L / r) ** 2 + 4 * m * jnp.abs(V(r))
            return *sums, 64 * UNIT * (size * sums.time / m + 4 * sums.action)

        return run

    guess = jax.jit(lambda r, p, L: (amplitude(V, r, p, L, m),))
    return _Kernels(guess, near, jax.jit(lambda r, p, L: wide_ends(V, r, p, L, m)), wide)


def _check(state: list[Any]) -> None:
    r, p, L = state
    for name, wrong in (("r", ~(r > 0)), ("L", ~(L >= 0)), ("p_r", ~np.isfinite(p))):
        if wrong.any():
            k = int(np.argmax(wrong))
            raise InputError(
                f"orbit {k} has r = {r[k]:g}, p_r = {p[k]:g}, L = {L[k]:g}: r > 0 and L ≥ 0 are needed", name
            )


def _unbound(formula: Any, symbol: Any, k: int, state: list[Any]) -> str:
    r, p, L = (float(x[k]) for x in state)
    return (
        f"orbit {k} (r = {r:.6g}, p_r = {p:.6g}, L = {L:.6g}) has no turning points on both sides: it is not bound in "
        f"V = {formula}, or falls into the centre. A bound one has an energy between the minimum of V + L²/2m{symbol}² "
        f"and the lower of its limits at {symbol} = 0 and infinity"
    )
