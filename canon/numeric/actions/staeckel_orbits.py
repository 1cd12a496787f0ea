"""Sums along many orbits in a Stäckel potential, of l and of n: what actions, frequencies and angles have in common.

Orbits whose l hardly changes are told from others; for these the turning points are found, and the nodes of the
quadratures doubled until nothing changes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from canon.errors import InputError
from canon.expected import finite_number
from canon.numeric.actions import staeckel
from canon.numeric.actions.central import doubled, sorted_out, spread
from canon.numeric.actions.orbit_blocks import as_function, blocks, formula_of, on_block, orbits_of
from canon.numeric.precision import double

NOT_BOUND = (
    "orbit {} has no turning points on both sides: it is not bound; bound ones have E below the limit of V at "
    "infinity, and G + E above 0 in the plane"
)

NAMES = ("R", "z", "p_R", "p_z", "L_z")

Sums = Callable[..., tuple[Any, ...]]


class Parts(NamedTuple):
    """What is summed: tuples whose first entries tell when there are nodes enough, and whose last is a rounding.

    `near`(G, Δ², orbit, m, place) of an orbit whose l hardly changes; `wide`(G, Δ², m, place, low, high, count) of any
    other, between the turning points in ln(l − Δ²); `across`(G, Δ², m, place, swing, count), up to the largest n.
    """

    near: Sums
    wide: Sums
    across: Sums
    watched: int


class Orbits(NamedTuple):
    """The orbits' common shape, their flat states (R, z, p_R, p_z, L), and the two tables of sums, a row for each."""

    shape: tuple[int, ...]
    state: list[Any]
    along: Any
    across: Any


class _Kernels(NamedTuple):
    guess: Any
    near: Any
    ends: Any
    wide: Any
    top: Any
    across: Any


def sums_of(
    parts: Parts,
    widths: tuple[int, int],
    G: Any,
    delta: float,
    rows: Any,
    m: float,
    variable: str,
    parameters: Mapping[str, Any] | None,
) -> Orbits:
    """The sums of each orbit.

    **Arguments:** `widths`, how many sums there are along l and across; `rows`, (R, z, p_R, p_z, L); the others as of
    `staeckel_actions`.

    **Raises:** `InputError` where G is no such formula, or an orbit is not bound or on the axis, with its index.
    """
    formula, symbol = formula_of(G, variable, {} if parameters is None else parameters, "G")
    finite_number(delta, "delta")
    finite_number(m, "m")
    if not delta > 0:
        raise InputError(f"the foci are at a distance above 0 from the centre, not {delta}", "delta")
    state, shape = orbits_of(rows, NAMES)
    wrong = ~((state[0] > 0) & (state[4] != 0) & np.isfinite(np.sum(state, axis=0)))
    if wrong.any():
        raise InputError(f"orbit {int(np.argmax(wrong))} has no R > 0 and L_z ≠ 0, or is not finite", "R")
    count = state[0].size
    along, across = (np.full((width, count), np.nan) for width in widths)
    kernels = _kernels(formula, symbol, float(delta), float(m), parts)
    with double():
        wide, ends = sorted_out(kernels, state, along, _stacked)
        tops = [np.stack(on_block(kernels.top, block, state)) for block in blocks(np.arange(count))]
        top = np.concatenate([np.empty((2, 0)), *tops], axis=1)
        lost = ~(np.isfinite(top[0]) & np.isfinite(top[1]))
        lost[wide] |= ~np.isfinite(ends).all(axis=0)
        if lost.any():
            raise InputError(NOT_BOUND.format(int(np.argmax(lost))), "E")
        doubled(kernels.wide, wide, [*state, *spread(ends, wide, count)], along, _stacked, parts.watched)
        doubled(kernels.across, np.arange(count), [*state, *top], across, _stacked, parts.watched)
    return Orbits(shape, state, along, across)


def _stacked(*row: Any) -> Any:
    return np.stack(row)


@lru_cache(maxsize=32)
def _kernels(formula: Any, symbol: Any, delta: float, m: float, parts: Parts) -> _Kernels:
    import jax

    G, D2 = as_function(formula, symbol), delta * delta

    def place(*state: Any) -> staeckel.Place:
        return staeckel.place_of(G, delta, m, *state)

    @lru_cache(maxsize=4)
    def near(degree: int) -> Any:
        @jax.jit
        def run(*state: Any) -> Any:
            at = place(*state)
            orbit = staeckel.narrow_radial(G, D2, at, degree)
            return orbit.holds, *parts.near(G, D2, orbit, m, at)

        return run

    @lru_cache(maxsize=8)
    def wide(count: int) -> Any:
        return jax.jit(lambda *row: parts.wide(G, D2, m, place(*row[:5]), row[5], row[6], count))

    @lru_cache(maxsize=8)
    def across(count: int) -> Any:
        return jax.jit(lambda *row: parts.across(G, D2, m, place(*row[:5]), staeckel.Swing(*row[5:]), count))

    guess = jax.jit(lambda *state: (staeckel.amplitude(G, D2, place(*state)),))
    ends = jax.jit(lambda *state: staeckel.wide_ends(G, D2, place(*state)))
    top = jax.jit(lambda *state: staeckel.vertical_end(G, D2, place(*state)))
    return _Kernels(guess, near, ends, wide, top, across)
