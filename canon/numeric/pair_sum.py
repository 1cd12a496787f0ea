"""Sums over all pairs of bodies that stay sums: to sympy an atom, to a program a loop.

V = Σ_{i<j} w_i w_j U(r_ij, t) of B bodies has B(B − 1)/2 terms. Written out it is a program of that length, slow to
build and to compile; as one atom with its law U it is a program of constant length.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any, Final

import sympy as sp

from canon.expected import formula_of

RADIUS: Final[Any] = sp.Symbol("r", positive=True)
"""The distance of a pair, in its law."""
SQUARE: Final[Any] = sp.Symbol("s", positive=True)
"""Its square, in the law's derivative."""


class PairSum(sp.Expr):
    """Σ_{i<j} w_i w_j U(r_ij, t) as one formula, whose derivatives are `PairSlope`s.

    **Arguments:** `law` U, a formula in `RADIUS` and, where it depends on it, the time; `places` (B, d) symbols, the
    bodies' coordinates; `weights` w (B,) numbers, 1 each where they are left out.
    """

    __slots__ = ("_free", "law", "places", "weights")
    is_Atom = True
    is_commutative = True

    def __new__(cls, law: Any, places: Any, weights: Any = None) -> PairSum:
        made = super().__new__(cls)
        made.law = formula_of(law, "law")
        made.places = sp.Tuple(*(sp.Tuple(*place) for place in places))
        made.weights = sp.Tuple(*([1] * len(made.places) if weights is None else weights))
        made._free = {x for place in made.places for x in place} | (made.law.free_symbols - {RADIUS})
        return made

    def __getnewargs__(self) -> tuple[Any, ...]:
        return self.law, self.places, self.weights

    def _hashable_content(self) -> tuple[Any, ...]:
        return self.law, self.places, self.weights

    @property
    def free_symbols(self) -> set[Any]:
        """All coordinates, and the time if the law has it."""
        return self._free

    @property
    def coordinates(self) -> tuple[Any, ...]:
        """The coordinates, body by body (B·d,)."""
        return tuple(x for place in self.places for x in place)

    @property
    def slope(self) -> Any:
        """U′(r)/r in terms of r² (`SQUARE`): with x_i − x_j it makes the force of a pair, without a distance of 0/0."""
        return (self.law.diff(RADIUS) / RADIUS).xreplace({RADIUS: sp.sqrt(SQUARE)})

    @property
    def squared_law(self) -> Any:
        """U in terms of r² (`SQUARE`)."""
        return self.law.xreplace({RADIUS: sp.sqrt(SQUARE)})

    def written_out(self) -> Any:
        """The sum with all its terms."""
        terms = []
        for (x, v), (y, w) in combinations(zip(self.places, self.weights, strict=True), 2):
            apart = [a - b for a, b in zip(x, y, strict=True)]
            distance = sp.Abs(apart[0]) if len(apart) == 1 else sp.sqrt(sp.Add(*(a**2 for a in apart)))
            terms.append(v * w * self.law.xreplace({RADIUS: distance}))
        return sp.Add(*terms)

    def slopes(self) -> Iterator[tuple[Any, Any]]:
        """Every coordinate with the derivative by it; the time, where the law has it, too."""
        for k, symbol in enumerate(self.coordinates):
            yield symbol, PairSlope(self, k)
        for symbol in self.law.free_symbols - {RADIUS}:
            yield symbol, self.diff(symbol)

    def _eval_derivative(self, s: Any) -> Any:
        if s not in self._free:
            return sp.S.Zero
        if s in self.law.free_symbols:
            return PairSum(self.law.diff(s), self.places, self.weights)
        return PairSlope(self, self.coordinates.index(s))

    def _eval_is_polynomial(self, syms: Any) -> bool:
        return not self._free & {*syms}

    _eval_is_rational_function = _eval_is_polynomial

    def _sympystr(self, printer: Any) -> str:
        law, bodies = printer.doprint(self.law), len(self.places)
        if all(w == 1 for w in self.weights):
            return f"Sum({law} over the {bodies * (bodies - 1) // 2} pairs of {bodies} bodies)"
        return f"Sum(m_i*m_j*({law}) over the {bodies * (bodies - 1) // 2} pairs of {bodies} bodies)"


class PairSlope(sp.Expr):
    """∂/∂x_k of a `PairSum`, k counting its coordinates body by body: Σ_j w_i w_j U′(r_ij) (x_i − x_j)/r_ij."""

    __slots__ = ("index", "of")
    is_Atom = True
    is_commutative = True

    def __new__(cls, of: PairSum, index: int) -> PairSlope:
        made = super().__new__(cls)
        made.of, made.index = of, int(index)
        return made

    def __getnewargs__(self) -> tuple[Any, ...]:
        return self.of, self.index

    def _hashable_content(self) -> tuple[Any, ...]:
        return self.of, self.index

    @property
    def free_symbols(self) -> set[Any]:
        """Those of the sum: every body pulls at this one."""
        return self.of.free_symbols

    def _eval_derivative(self, s: Any) -> Any:
        if s not in self.free_symbols:
            return sp.S.Zero
        return self.of.written_out().diff(self.of.coordinates[self.index]).diff(s)

    def _eval_is_polynomial(self, syms: Any) -> bool:
        return not self.free_symbols & {*syms}

    _eval_is_rational_function = _eval_is_polynomial

    def _sympystr(self, printer: Any) -> str:
        return f"d/d{self.of.coordinates[self.index]} {printer.doprint(self.of)}"
