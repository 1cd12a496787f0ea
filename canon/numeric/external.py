"""Orbits by heyoka, an adaptive Taylor method of high order: a reference that shares no line with this package.

heyoka is an optional dependency, in the extra `peers`. Biscani and Izzo (2021), Mon. Not. R. Astron. Soc. 504, 2614.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.expected import formula_of
from canon.interruption import underway
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
    found = external_grid(H, symbols, q, p, times, force)
    if len(found.q) != len(times):
        raise InputError(f"heyoka ended before t = {times[-1]:g}: {found.outcome}")
    return found.q, found.p


@dataclass(frozen=True)
class Grid:
    """The states q and p (k, n) at the first k of the times that were asked for: all of them, or those before the
    orbit's end. `steps` of a Taylor polynomial of this `order` led there; `outcome` is what heyoka says of it, and
    `compile_seconds` of CPU time its program took to make. `interrupted`: somebody pressed Ctrl-C.
    """

    q: np.ndarray
    p: np.ndarray
    steps: int
    order: int
    outcome: str
    compile_seconds: float
    interrupted: bool = False


def external_grid(
    H: sp.Expr,
    symbols: tuple[Sequence[sp.Symbol], Sequence[sp.Symbol], sp.Symbol],
    q: Sequence[float],
    p: Sequence[float],
    times: Sequence[float],
    force: Sequence[sp.Expr] = (),
    tolerance: float | None = None,
) -> Grid:
    """The same as far as the orbit goes; `tolerance` of a step's relative error, 2^−52 where it is left out.

    **Raises:** `InputError` where heyoka is not installed, or cannot read a formula.
    """
    try:
        import heyoka  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise InputError("this needs the package heyoka: pip install 'canon-mechanics[peers]'") from None
    coordinates, momenta, t = symbols
    n = len(coordinates)
    written = formula_of(H, "H").replace(lambda x: isinstance(x, PairSum), lambda x: x.written_out())
    added = tuple(force) or (sp.S.Zero,) * n
    rates = [*gradient(written, tuple(momenta))]
    rates += [F - slope for slope, F in zip(gradient(written, tuple(coordinates)), added, strict=True)]
    variables = heyoka.make_vars(*(f"z{k}" for k in range(2 * n)))
    names = [sp.Symbol(symbol.name) for symbol in (*coordinates, *momenta)]
    table: dict[Any, Any] = dict(zip(names, variables, strict=True))
    table[sp.Symbol(t.name)] = heyoka.time
    try:
        right = [heyoka.from_sympy(_with_roots(_in_doubles(rate)), table) for rate in rates]
    except (TypeError, ValueError) as reason:
        raise InputError(f"heyoka does not take this Hamiltonian: {reason}") from None
    options = {} if tolerance is None else {"tol": tolerance}
    begun = time.process_time()
    start = [*map(float, q), *map(float, p)]
    solver = heyoka.taylor_adaptive(list(zip(variables, right, strict=True)), start, **options)
    compiling = time.process_time() - begun
    solver.time = float(times[0])
    pressed, heard = underway(), list[bool]()

    def go_on(_: Any) -> bool:
        heard[:] = [pressed()]
        return not heard[0]

    outcome, _, _, steps, _, grid = solver.propagate_grid([float(x) for x in times], callback=go_on)
    finite = np.isfinite(grid).all(axis=1)
    good = len(grid) if finite.all() else int(np.argmin(finite))
    said = str(outcome).rpartition(".")[2]
    return Grid(grid[:good, :n], grid[:good, n:], int(steps), int(solver.order), said, compiling, heard == [True])


def _in_doubles(formula: Any) -> Any:
    """The formula with its numbers as doubles: heyoka takes whole numbers and binary ones."""
    formula = formula_of(formula, "")
    numbers = {x for x in formula.atoms(sp.Number, sp.NumberSymbol) if not x.is_Integer}
    return formula.xreplace({x: sp.Float(float(x), precision=53) for x in numbers})


def _with_roots(formula: Any) -> Any:
    """The formula with √(x²) in place of |x|, which heyoka doesn't know: in symbols of which nothing is assumed."""
    formula = formula.replace(sp.sign, lambda x: x / sp.Abs(x))
    formula = formula.xreplace({symbol: sp.Symbol(symbol.name) for symbol in formula.free_symbols})
    return formula.replace(sp.Abs, lambda x: sp.sqrt(x**2))
