"""What the benchmark's cases are made of: the case itself, brackets, and the residuals of a map."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import sympy as sp

ERROR = sp.Rational(1, 1000)
"""By how much a near miss misses: one coefficient is changed by this fraction."""


@dataclass(frozen=True)
class Map:
    """A transformation with its variables: (Q, P) as functions of (q, p)."""

    Q: tuple[sp.Expr, ...]
    P: tuple[sp.Expr, ...]
    q: tuple[sp.Symbol, ...]
    p: tuple[sp.Symbol, ...]

    def residuals(self) -> list[sp.Expr]:
        """The entries above the diagonal of M J Mᵀ − J, with sympy's derivatives."""
        n, variables = len(self.q), (*self.q, *self.p)
        jacobian = [[sp.diff(f, x) for x in variables] for f in (*self.Q, *self.P)]
        return [
            sp.Add(*(jacobian[a][k] * jacobian[b][n + k] - jacobian[a][n + k] * jacobian[b][k] for k in range(n)))
            - int(b == a + n)
            for a, b in combinations(range(2 * n), 2)
        ]


@dataclass(frozen=True)
class Case:
    """Expressions that vanish together, or of which at least one does not.

    **Arguments:** `map`, the transformation that is canonical if they do (canon is given that and differentiates by
    itself; sympy is given the residuals); `more`, residuals besides those of the map; `holds`, the truth.
    """

    map: Map | None = None
    more: tuple[sp.Expr, ...] = ()
    holds: bool = True

    @cached_property
    def residuals(self) -> list[sp.Expr]:
        """All residuals as sympy expressions."""
        return (self.map.residuals() if self.map else []) + list(self.more)

    def missed(self) -> Case:
        """The same expressions, known not to vanish."""
        return replace(self, holds=False)


Builder = Callable[..., Case]


def reals(names: str) -> tuple[sp.Symbol, ...]:
    """Real symbols."""
    return sp.symbols(names, real=True, seq=True)


def positives(names: str) -> tuple[sp.Symbol, ...]:
    """Positive symbols."""
    return sp.symbols(names, positive=True, seq=True)


def pb(f: sp.Expr, g: sp.Expr, q: Iterable[sp.Symbol], p: Iterable[sp.Symbol]) -> sp.Expr:
    """The Poisson bracket {f, g}."""
    return sp.Add(*(sp.diff(f, a) * sp.diff(g, b) - sp.diff(f, b) * sp.diff(g, a) for a, b in zip(q, p, strict=True)))


def of_map(Q: Iterable[sp.Expr], P: Iterable[sp.Expr], q: Iterable[sp.Symbol], p: Iterable[sp.Symbol]) -> Case:
    """The case that a map is canonical."""
    return Case(Map(tuple(Q), tuple(P), tuple(q), tuple(p)))


def of_residuals(*residuals: sp.Expr) -> Case:
    """The case that these vanish."""
    return Case(more=residuals)


def lifted(x: Sequence[sp.Expr], u: Sequence[sp.Symbol], momenta: str) -> Case:
    """The lift of a point transformation x = x(u): p_x = (∂x/∂u)^-T p_u, by the adjugate matrix."""
    n, p = len(u), reals(momenta)
    jacobian = sp.Matrix(n, n, lambda i, j: sp.diff(x[i], u[j]))
    inverse = jacobian.adjugate() / jacobian.det()
    return of_map(x, list(inverse.T * sp.Matrix(p)), u, p)


def cyclic() -> tuple[tuple[int, int, int], ...]:
    """The even permutations of (0, 1, 2)."""
    return (0, 1, 2), (1, 2, 0), (2, 0, 1)
