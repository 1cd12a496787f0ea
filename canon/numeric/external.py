"""Orbits by heyoka, an adaptive Taylor method of high order: a reference that shares no line with this package.

heyoka is an optional dependency, in the extra `peers`. Biscani and Izzo (2021), Mon. Not. R. Astron. Soc. 504, 2614.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.gradient import gradient
from canon.numeric.pair_sum import PairSum


def external_orbit(
    H: sp.Expr,
    symbols: tuple[Sequence[sp.Symbol], Sequence[sp.Symbol], sp.Symbol],
    q: Sequence[float],
    p: Sequence[float],
    times: Sequence[float],
    force: Sequence[sp.Expr] = (),
) -> tuple[np.ndarray, np.ndarray]:
    """The states q and p (samples, n) at the times, of the orbit from (q, p) at the first of them.

    **Arguments:** `H`, with numbers for its parameters, in `symbols`, which are (q, p, t); `force` F(q, p, t) (n,),
    what no Hamiltonian has of ṗ.

    **Raises:** `InputError` where heyoka is not installed, cannot read a formula, or ends before the last time.
    """
    try:
        import heyoka  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise InputError("this needs the package heyoka: pip install 'canon-mechanics[peers]'") from None
    coordinates, momenta, t = symbols
    n = len(coordinates)
    written = sp.sympify(H, strict=True).replace(lambda x: isinstance(x, PairSum), lambda x: x.written_out())
    added = tuple(force) or (sp.S.Zero,) * n
    rates = [*gradient(written, tuple(momenta))]
    rates += [F - slope for slope, F in zip(gradient(written, tuple(coordinates)), added, strict=True)]
    variables = heyoka.make_vars(*(f"z{k}" for k in range(2 * n)))
    table: dict[Any, Any] = dict(zip((*coordinates, *momenta), variables, strict=True))
    table[t] = heyoka.time
    try:
        right = [heyoka.from_sympy(_in_doubles(rate), table) for rate in rates]
    except (TypeError, ValueError) as reason:
        raise InputError(f"heyoka does not take this Hamiltonian: {reason}") from None
    solver = heyoka.taylor_adaptive(list(zip(variables, right, strict=True)), [*map(float, q), *map(float, p)])
    solver.time = float(times[0])
    outcome, *_, grid = solver.propagate_grid([float(x) for x in times])
    if len(grid) != len(times) or not np.isfinite(grid).all():
        raise InputError(f"heyoka ended before t = {times[-1]:g}: {outcome}")
    return grid[:, :n], grid[:, n:]


def _in_doubles(formula: Any) -> Any:
    """The formula with its numbers as doubles: heyoka takes whole numbers and binary ones."""
    formula = sp.sympify(formula, strict=True)
    numbers = {x for x in formula.atoms(sp.Number, sp.NumberSymbol) if not x.is_Integer}
    return formula.xreplace({x: sp.Float(float(x), precision=53) for x in numbers})
