"""Actions of many orbits in a Stäckel potential that is given by its function G: blocks, doubling, and bounds."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from canon.errors import InputError
from canon.numeric.actions import staeckel
from canon.numeric.actions.central import doubled, sorted_out, spread
from canon.numeric.actions.orbit_blocks import as_function, blocks, formula_of, on_block
from canon.numeric.precision import double

NOT_BOUND = (
    "orbit {} has no turning points on both sides: it is not bound; bound ones have E below the limit of V at "
    "infinity, and G + E above 0 in the plane"
)


class StaeckelActions(NamedTuple):
    """J_λ, J_ν and J_φ = 2πL_z of each orbit, in the plane's terms radial, vertical and azimuthal, with two bounds."""

    radial: Any
    vertical: Any
    azimuthal: Any
    radial_bound: Any
    vertical_bound: Any


class _Kernels(NamedTuple):
    guess: Any
    near: Any
    ends: Any
    wide: Any
    top: Any
    across: Any


def staeckel_actions(
    G: Any,
    delta: float,
    R: Any,
    z: Any,
    p_R: Any,
    p_z: Any,
    L_z: Any,
    *,
    m: float = 1.0,
    variable: str = "t",
    parameters: Mapping[str, Any] | None = None,
) -> StaeckelActions:
    """The actions of orbits in V = −[l G(l) − n G(n)]/(l − n), in spheroidal coordinates with foci at z = ±`delta`.

    **Arguments:** `G`, a formula in `variable`: Kuzmin's and Kutuzov's −GM/(√λ + √ν) with ν ≥ c² is GM/(c + √(t + c²));
    `R` > 0, `z` and their momenta, and `L_z` ≠ 0, arrays of one shape; `m`, the mass.

    **Raises:** `InputError` where G is no such formula, or an orbit is not bound or on the axis, with its index.
    """
    formula, symbol, shape, state = read_orbits(G, delta, (R, z, p_R, p_z, L_z), variable, parameters)
    count = state[0].size
    radial, vertical = np.full((2, count), np.nan), np.full((2, count), np.nan)
    kernels = _kernels(formula, symbol, float(delta), float(m))
    with double():
        wide, ends = sorted_out(kernels, state, radial, _twice)
        top = np.concatenate([on_block(kernels.top, block, state)[0] for block in blocks(np.arange(count))])
        lost = ~np.isfinite(top)
        lost[wide] |= ~np.isfinite(ends).all(axis=0)
        if lost.any():
            raise InputError(NOT_BOUND.format(int(np.argmax(lost))), "E")
        doubled(kernels.wide, wide, [*state, *spread(ends, wide, count)], radial, _twice)
        doubled(kernels.across, np.arange(count), [*state, top], vertical, lambda *row: np.stack(row))
    azimuthal = 2 * np.pi * state[4]
    return StaeckelActions(*(x.reshape(shape) for x in (radial[0], vertical[0], azimuthal, radial[1], vertical[1])))


def read_orbits(
    G: Any, delta: float, rows: Any, variable: str, parameters: Mapping[str, Any] | None
) -> tuple[Any, Any, tuple[int, ...], list[Any]]:
    """The formula and its symbol, and the orbits' shape and flat states. **Raises:** `InputError`."""
    formula, symbol = formula_of(G, variable, parameters or {}, "G")
    if not delta > 0:
        raise InputError(f"the foci are at a distance above 0 from the centre, not {delta}", "delta")
    shape = np.broadcast_shapes(*(np.shape(x) for x in rows))
    state = [np.broadcast_to(np.asarray(x, dtype=float), shape).ravel() for x in rows]
    wrong = ~((state[0] > 0) & (state[4] != 0) & np.isfinite(np.sum(state, axis=0)))
    if wrong.any():
        raise InputError(f"orbit {int(np.argmax(wrong))} has no R > 0 and L_z ≠ 0, or is not finite", "R")
    return formula, symbol, shape, state


def _twice(action: Any, rounding: Any) -> Any:
    return np.stack([2 * action, rounding])


@lru_cache(maxsize=32)
def _kernels(formula: Any, symbol: Any, delta: float, m: float) -> _Kernels:
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
            return orbit.holds, *staeckel.narrow_action(orbit, m, at)

        return run

    @lru_cache(maxsize=8)
    def wide(count: int) -> Any:
        return jax.jit(lambda *row: staeckel.wide_radial(G, D2, m, place(*row[:5]), row[5], row[6], count))

    @lru_cache(maxsize=8)
    def across(count: int) -> Any:
        return jax.jit(lambda *row: staeckel.vertical(G, D2, m, place(*row[:5]), row[5], count))

    guess = jax.jit(lambda *state: (staeckel.amplitude(G, D2, place(*state)),))
    ends = jax.jit(lambda *state: staeckel.wide_ends(G, D2, place(*state)))
    top = jax.jit(lambda *state: (staeckel.vertical_end(G, D2, place(*state)),))
    return _Kernels(guess, near, ends, wide, top, across)
