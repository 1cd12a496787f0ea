"""Actions of many orbits in a central potential that is given by a formula.

The nodes are doubled for the orbits that need it. The error falls geometrically in their number, so that it is about
the square of what the last doubling changed: that, with a margin, and the rounding are the bound.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.expression import read
from canon.numeric.actions.isochrone import CentralActions
from canon.numeric.actions.radial import (
    NEAR_NODES,
    is_narrow,
    narrow_ends,
    narrow_sums,
    turning_points,
    wide_sums,
)
from canon.numeric.lower import lower
from canon.numeric.precision import UNIT, double
from canon.vocabulary import Vocabulary

COUNTS: Final = (24, 48, 96, 192, 384)
_SETTLED: Final = 1e-7
_MARGIN: Final = 1e2
_BLOCK: Final = 4096


class _Kernels(NamedTuple):
    """Compiled once for a formula: blocks of orbits in, arrays out."""

    sort: Any
    near: Any
    sums: Any


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

    **Arguments:** `V`, the potential energy as a formula (text or sympy) in `variable`; `parameters`, numbers for its
    other names; `m`, the mass.

    **Raises:** `InputError` where V is no such formula, or an orbit is not bound, with its index.
    """
    formula, symbol = _formula(V, variable, parameters or {})
    shape = np.broadcast_shapes(np.shape(r), np.shape(p_r), np.shape(L))
    state = [np.broadcast_to(np.asarray(x, dtype=float), shape).ravel() for x in (r, p_r, L)]
    _check(state)
    found = np.full((5, state[0].size), np.nan)
    kernels = _kernels(formula, symbol, float(m))
    with double():
        narrow = np.empty(state[0].size, dtype=bool)
        ends = np.empty((2, state[0].size))
        for block in _blocks(np.arange(state[0].size)):
            rows = [_padded(x[block]) for x in state]
            near, low, high = (np.asarray(x)[: block.size] for x in kernels.sort(*rows))
            narrow[block], ends[0, block], ends[1, block] = near, low, high
        lost = ~narrow & ~np.isfinite(ends).all(axis=0)
        if lost.any():
            raise InputError(_unbound(formula, symbol, int(np.argmax(lost)), state))
        for block in _blocks(np.flatnonzero(narrow)):
            found[:, block] = _near(kernels, [x[block] for x in state])
        _wide(kernels, np.flatnonzero(~narrow), state, ends, found, float(m))
    action, frequency, azimuthal, bound, _ = found
    return CentralActions(*(x.reshape(shape) for x in (action, 2 * np.pi * state[2], frequency, azimuthal, bound)))


def _near(kernels: _Kernels, state: list[Any]) -> Any:
    size = state[0].size
    action, time, angle, r, rounding = (np.asarray(x)[:size] for x in kernels.near(*map(_padded, state)))
    return np.stack([2 * action, 1 / (2 * time), angle / time / (2 * np.pi), rounding, r])


def _wide(kernels: _Kernels, todo: Any, state: list[Any], ends: Any, found: Any, m: float) -> None:
    """The orbits of `todo`, with more and more nodes for those whose action still changes."""
    before = np.full(state[0].size, np.nan)
    for count in COUNTS:
        for block in _blocks(todo):
            rows = [_padded(x[block]) for x in (*state, ends[0], ends[1])]
            action, time, angle, scale = (np.asarray(x)[: block.size] for x in kernels.sums(count)(*rows))
            change = np.abs(2 * action - before[block])
            part = change / (2 * np.abs(action))
            settled = part < _SETTLED if count < COUNTS[-1] else np.ones_like(part, dtype=bool)
            left = np.where(part < _SETTLED, _MARGIN * part * change, change)
            row = np.stack([2 * action, 1 / (2 * time), angle / time / (2 * np.pi), left + 32 * UNIT * scale, scale])
            before[block] = 2 * action
            found[:, block[settled]] = row[:, settled]
        todo = todo[np.isnan(found[0, todo])]
        if not todo.size:
            return


@lru_cache(maxsize=32)
def _kernels(formula: Any, symbol: Any, m: float) -> _Kernels:
    import jax
    import jax.numpy as jnp

    lowered = lower((formula,), (symbol,))

    def V(x: Any) -> Any:
        return jnp.broadcast_to(lowered(x)[0], jnp.shape(x))

    def sort(r: Any, p: Any, L: Any) -> Any:
        a, b = narrow_ends(V, r, p, L, m)
        near = is_narrow(V, r, p, L, m, a, b)
        low, high = turning_points(V, r, p, L, m)
        return near, low, high

    def near(r: Any, p: Any, L: Any) -> Any:
        low, high = narrow_ends(V, r, p, L, m)
        sums = narrow_sums(V, r, p, L, m, low, high, NEAR_NODES)
        # p_r² = p² + y D: D is a difference of two terms of the size of L²/r³
        off = 8 * UNIT * (L * L / r**3) * jnp.maximum(jnp.abs(low), jnp.abs(high))
        return sums.action, sums.time, sums.angle, r, 2 * (off * sums.time / m + 16 * UNIT * sums.action)

    def sums(count: int) -> Any:
        @jax.jit
        def run(r: Any, p: Any, L: Any, low: Any, high: Any) -> Any:
            found = wide_sums(V, r, p, L, m, low, high, count)
            size = p * p + (L / r) ** 2 + 4 * m * jnp.abs(V(r))
            return found.action, found.time, found.angle, 2 * (size * found.time / m + 4 * found.action)

        return run

    return _Kernels(jax.jit(sort), jax.jit(near), lru_cache(maxsize=8)(sums))


def _blocks(indices: Any) -> Any:
    for start in range(0, indices.size, _BLOCK):
        yield indices[start : start + _BLOCK]


def _padded(x: Any) -> Any:
    """An array of a whole power of two, or a whole block: few shapes are compiled."""
    size = max(64, 1 << max(0, x.size - 1).bit_length())
    return np.pad(x, (0, size - x.size), mode="edge") if x.size < size else x


def _formula(V: Any, variable: str, parameters: Mapping[str, Any]) -> tuple[Any, Any]:
    symbol = sp.Symbol(variable, real=True)
    if isinstance(V, str):
        names = {name: sp.Symbol(name, real=True) for name in (variable, *parameters)}
        V = read(V, Vocabulary(names), "V").expr
    V = sp.sympify(V)
    values = {name: sp.Rational(value) if isinstance(value, float) else value for name, value in parameters.items()}
    V = V.subs({s: symbol if s.name == variable else values.get(s.name, s) for s in V.free_symbols})
    strange = V.free_symbols - {symbol}
    if strange:
        raise InputError(f"no value is given for {', '.join(sorted(map(str, strange)))}", "V")
    return V, symbol


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
