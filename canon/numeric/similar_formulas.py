"""Formulas that differ in their coordinates alone, as the rods of a chain do, are evaluated as one formula of arrays.

A program with every one written out grows with their number, and with it what compiles it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import sympy as sp

from canon.numeric.lower import lower


def similar_formulas(formulas: Sequence[sp.Expr], q: Sequence[sp.Symbol], t: sp.Symbol) -> Callable[[Any, Any], Any]:
    """The function of (q, t), arrays (n, …) and a number, whose values (m, …) are those of the formulas.

    Two formulas are computed together where one becomes the other, but for a number that is added, when its coordinates
    are replaced by as many others in their order.
    """
    place = {symbol: k for k, symbol in enumerate(q)}
    names = [sp.Dummy(real=True) for _ in q]
    shapes: dict[Any, list[tuple[int, list[int], float]]] = {}
    for row, formula in enumerate(formulas):
        constant, rest = formula.as_independent(*q, t, as_Add=True)
        own = sorted(place[symbol] for symbol in q if rest.has(symbol))
        shape = rest.xreplace({q[k]: name for name, k in zip(names, own, strict=False)})
        shapes.setdefault((shape, len(own)), []).append((row, own, float(constant)))
    groups = [
        (
            lower((shape,), (*names[:count], t)),
            np.array([own for _, own, _ in members], dtype=int).reshape(len(members), count).T,
            np.array([constant for _, _, constant in members]),
        )
        for (shape, count), members in shapes.items()
    ]
    back = np.argsort([row for members in shapes.values() for row, _, _ in members])

    def values(x: Any, now: Any) -> Any:
        import jax.numpy as jnp

        found = []
        for function, columns, constants in groups:
            (value,) = function(*(x[column] for column in columns), now)
            added = constants.reshape(-1, *(1,) * (x.ndim - 1))
            found.append(jnp.broadcast_to(value + added, (len(constants), *x.shape[1:])))
        return jnp.concatenate(found)[back]

    return values
