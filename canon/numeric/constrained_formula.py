"""A mechanical system with holonomic constraints, from formulas to functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp

from canon.numeric.gradient import gradient
from canon.numeric.integrators.constrained import Constrained, ConstrainedHamiltonian, Drag, Held
from canon.numeric.integrators.multipliers import FEW
from canon.numeric.lower import lower
from canon.numeric.similar_formulas import similar_formulas


def constrained(
    mass: Sequence[float],
    H: sp.Expr,
    constraints: Sequence[sp.Expr],
    q: Sequence[sp.Symbol],
    p: Sequence[sp.Symbol],
    t: sp.Symbol,
    drag: Drag | None = None,
    strings: tuple[int, ...] = (),
) -> Held:
    """H(q, p, t) on the surface where all `constraints` g(q, t) vanish, with friction; those in `strings` may also be
    negative.

    Where H is Σ p²/2m + V(q, t), with the `mass` of every coordinate, it is taken so.
    """
    surfaces = _surfaces(constraints, q, t)
    moving = any(t in g.free_symbols for g in constraints)
    kinetic = sp.Add(*(y**2 / (2 * m) for y, m in zip(p, mass, strict=True)))
    V: Any = H - kinetic
    momenta = {*p}
    if V.free_symbols & momenta:
        V = sp.Add(*(term for term in sp.Add.make_args(sp.expand(V)) if term != 0))
    if not V.free_symbols & momenta:
        force = _stacked([-slope for slope in gradient(V, tuple(q))], (*q, t))
        return Constrained(
            tuple(map(float, mass)),
            force,
            surfaces,
            moving,
            drag,
            strings,
        )
    velocity, force = gradient(H, tuple(p)), [-slope for slope in gradient(H, tuple(q))]
    rates = lower((*velocity, *force), (*q, *p, t))
    n = len(q)

    def hamilton(x: Any, y: Any, now: Any) -> tuple[Any, Any]:
        import jax.numpy as jnp

        found = [jnp.broadcast_to(jnp.asarray(v, x.dtype), x.shape[1:]) for v in rates(*x, *y, now)]
        return jnp.stack(found[:n]), jnp.stack(found[n:])

    linear = all(rate.is_polynomial(*p) and sp.Poly(rate, *p).total_degree() <= 1 for rate in velocity)
    return ConstrainedHamiltonian(hamilton, surfaces, moving, drag, linear, strings)


def _surfaces(constraints: Sequence[sp.Expr], q: Sequence[sp.Symbol], t: sp.Symbol) -> Callable[[Any, Any], Any]:
    """The constraints as functions: a few written out, many by their similarity."""
    if len(constraints) > FEW:
        return similar_formulas(constraints, q, t)
    lowered = lower(tuple(constraints), (*q, t))
    return lambda x, now: lowered(*x, now)


def drag_of(matrix: Any, rest: Sequence[sp.Expr], q: Sequence[sp.Symbol], t: sp.Symbol) -> Drag:
    """The friction −D (p − s(q, t)), from formulas."""
    rows = tuple(tuple(float(entry) for entry in row) for row in matrix)
    if all(value == 0 for value in rest):
        return Drag(rows)
    return Drag(rows, _stacked(rest, (*q, t)))


def _stacked(formulas: Sequence[Any], symbols: tuple[sp.Symbol, ...]) -> Callable[[Any, Any], Any]:
    lowered = lower(tuple(formulas), symbols)

    def function(x: Any, now: Any) -> Any:
        import jax.numpy as jnp

        return jnp.stack([jnp.broadcast_to(jnp.asarray(v, x.dtype), x.shape[1:]) for v in lowered(*x, now)])

    return function
