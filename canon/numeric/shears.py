"""Parts of a Hamiltonian that a shear solves: of every degree of freedom they have q or p, but not both.

Few coordinates are written out, as arrays or one by one; where there are many, formulas of one shape are rows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.numeric.gradient import gradient
from canon.numeric.integrators.problem import Shear
from canon.numeric.lower import lower
from canon.numeric.pair_sum import PairSum
from canon.numeric.rows import lower_rows, same_shape

WRITTEN_OUT: Final = 12
"""Coordinates up to which every formula is written out: one orbit of a small system is fastest so."""
Parameters = Mapping[sp.Symbol, Any]
Formula = Any
"""A sympy expression: its operations have no useful types."""


def sides_of(term: Formula, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> tuple[int, ...] | None:
    """For each degree of freedom 1 if q occurs, -1 if p does, 0 if neither; None if both do."""
    free = term.free_symbols
    sides = []
    for x, y in zip(q, p, strict=True):
        if x in free and y in free:
            return None
        sides.append(1 if x in free else -1 if y in free else 0)
    return tuple(sides)


def shear(
    H: sp.Expr,
    q: Sequence[sp.Symbol],
    p: Sequence[sp.Symbol],
    t: sp.Symbol | None,
    parameters: Parameters,
    name: str = "",
) -> Shear:
    """The part with Hamiltonian H, which has q or p, not both, of every degree of freedom, on slots (q, p)."""
    if sides_of(H, q, p) is None:
        raise InputError(f"{H} has a coordinate together with its own momentum: no shear solves it")
    rates = [gradient(H, tuple(p)), tuple(-slope for slope in gradient(H, tuple(q)))]
    slots = tuple(k for k in (0, 1) if any(rate != 0 for rate in rates[k]))
    values = {symbol: float(value) for symbol, value in parameters.items()}
    place = (*q, *p, *(() if t is None else (t,)), *values)
    wanted = tuple(rate for k in slots for rate in rates[k])
    count = len(q)
    moment = () if t is None else (0.0,)
    if wanted and (count > WRITTEN_OUT or H.atoms(PairSum) or same_shape(wanted, (*q, *p), place[2 * count :])):
        return Shear(slots, _rows(H, wanted, q, p, t, values), name)
    lowered = lower(wanted, place)

    def rate(state: Any, t_now: Any) -> tuple[Any, ...]:
        import jax.numpy as jnp

        times = moment if t is None or t_now is None else (t_now,)
        found = lowered(*state[0], *state[1], *times, *values.values())
        chunks = []
        for index, slot in enumerate(slots):
            components = found[index * count : (index + 1) * count]
            old = state[slot]
            if isinstance(old, tuple):
                chunks.append(tuple(components))
            else:
                chunks.append(
                    jnp.stack([jnp.broadcast_to(jnp.asarray(x, old.dtype), old.shape[1:]) for x in components])
                )
        return tuple(chunks)

    return Shear(slots, rate, name)


def _rows(H: Formula, wanted: Any, q: Any, p: Any, t: sp.Symbol | None, values: Mapping[Any, float]) -> Any:
    """The rates of a part with many coordinates: one small program, for slots that are arrays or tuples of them."""
    free = H.free_symbols
    read = [k for k, symbols in enumerate((q, p)) if free & {*symbols}]
    symbols = tuple(symbol for k in read for symbol in (q, p)[k])
    program = lower_rows(wanted, symbols, (*(() if t is None else (t,)), *values))
    count = len(q)

    def rate(state: Any, now: Any) -> tuple[Any, ...]:
        import jax.numpy as jnp

        slots = [jnp.stack(slot) if isinstance(slot, tuple) else slot for slot in (state[k] for k in read)]
        z = slots[0] if len(slots) == 1 else jnp.concatenate(slots)
        times = () if t is None else (0.0 if now is None else now,)
        found = program(z, *times, *values.values())
        chunks = [found[k : k + count] for k in range(0, len(wanted), count)]
        return tuple(tuple(x) if isinstance(state[read[0]], tuple) else x for x in chunks)

    return rate
