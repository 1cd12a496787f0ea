"""H as degrees of freedom inside one another: f(r, p_r, g), g = g(θ, p_θ, p_φ), and φ doesn't occur.

So are the central potentials in polar and spherical coordinates: g is the square of the angular momentum. Each level,
g and at last H itself, is a constant of the motion, and the motion on it one of one degree of freedom.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp


@dataclass(frozen=True, slots=True)
class Degree:
    """The motion of one coordinate.

    **Arguments:** the coordinate and its momentum; `H`, which stays at `level`, a name; `value`, that level in terms of
    all coordinates and momenta.
    """

    q: sp.Symbol
    p: sp.Symbol
    H: sp.Expr
    level: sp.Symbol
    value: sp.Expr


def nested_degrees(
    H: sp.Expr, q: tuple[sp.Symbol, ...], p: tuple[sp.Symbol, ...]
) -> tuple[tuple[Degree, ...], tuple[tuple[sp.Symbol, sp.Symbol], ...]] | None:
    """The degrees of freedom from the inmost outwards, and the pairs whose coordinate doesn't occur in H.

    None where H isn't of that form.
    """
    pairs = list(zip(q, p, strict=True))
    cyclic = tuple(pair for pair in pairs if pair[0] not in H.free_symbols)
    left = [pair for pair in pairs if pair not in cyclic]
    outer: Any = sp.expand(H)
    values: dict[sp.Symbol, Any] = {}
    found: list[Degree] = []
    while len(left) > 1:
        for pair in left:
            inner = _inner(outer, pair, [x for other in left if other != pair for x in other])
            if inner is not None:
                break
        else:
            return None
        level = sp.Dummy("g", real=True)
        function, outer = inner[0], inner[1] + inner[2] * level
        values[level] = function.xreplace(values)
        found.append(Degree(*pair, function, level, values[level]))
        left.remove(pair)
    for pair in left:
        found.append(Degree(*pair, outer, sp.Dummy("E", real=True), H))
    return tuple(found), cyclic


def _inner(H: Any, pair: tuple[sp.Symbol, sp.Symbol], others: list[sp.Symbol]) -> tuple[Any, Any, Any] | None:
    """(g, rest, factor) with H = rest + factor · g, g a function of this pair alone and the others' not."""
    x, p = pair
    moving = [term for term in sp.Add.make_args(H) if term.has(x, p)]
    part: Any = sp.Add(*moving)
    if not part.is_polynomial(p) or sp.Poly(part, p).degree() != 2:
        return None
    factor = sp.factor(sp.Poly(part, p).coeff_monomial(p**2))
    if factor.has(x):
        return None
    function = sp.Add(
        *(sp.cancel(term / factor) if not term.has(sp.sin, sp.cos) else sp.simplify(term / factor) for term in moving)
    )
    if function.has(*others):
        return None
    return function, H - part, factor
