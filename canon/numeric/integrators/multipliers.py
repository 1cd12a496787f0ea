"""The linear algebra of a few multipliers, written out, and of many, in arrays.

Gradients of constraints are the rows of a matrix: a list of arrays (n, …) where there are few, which a compiled loop
keeps in scalars, and one array (m, n, …) where there are many: a program that has every entry of m rows by m rows
written out, and their elimination, grows as m³, and what compiles it with that.
"""

from __future__ import annotations

from typing import Any, Final

from canon.numeric.small_systems import solve

FEW: Final = 3
"""So many constraints are written out: from four on arrays are quicker, to compile and to run."""

Rows = Any
"""A list of m arrays (n, …), or an array (m, n, …)."""


def dot(a: Any, b: Any) -> Any:
    """Σ a b over coordinates."""
    import jax.numpy as jnp

    return jnp.sum(a * b, axis=0)


def products(rows: Rows, pulls: Rows) -> Any:
    """The matrix of all row · pull."""
    import jax.numpy as jnp

    if isinstance(rows, list):
        return [[dot(a, b) for b in pulls] for a in rows]
    return jnp.einsum("kn...,ln...->kl...", rows, pulls)


def along(rows: Rows, velocity: Any, rates: Any) -> Any:
    """row · velocity + rate of each: how fast the constraints' values change."""
    import jax.numpy as jnp

    if isinstance(rows, list):
        return [dot(row, velocity) + rate for row, rate in zip(rows, rates, strict=True)]
    return jnp.einsum("kn...,n...->k...", rows, velocity) + rates


def combined(weights: Any, rows: Rows) -> Any:
    """Σ w_k row_k."""
    import jax.numpy as jnp

    if not isinstance(rows, list):
        return jnp.einsum("k...,kn...->n...", jnp.asarray(weights), rows)
    total = weights[0] * rows[0]
    for weight, row in zip(weights[1:], rows[1:], strict=True):
        total = total + weight * row
    return total


def solve_active(active: Any, matrix: Any, right: Any) -> Any:
    """The multipliers x with A x = b of the constraints that act, all where `active` is None, and 0 of the others."""
    import jax.numpy as jnp

    if not isinstance(matrix, list):
        if active is not None:
            on = jnp.asarray(active).reshape(-1, *(1,) * (matrix.ndim - 2))
            matrix = matrix * on[:, None] * on + jnp.eye(len(on)).reshape(matrix.shape[:2] + on.shape[1:]) * (1 - on)
            right = on * jnp.asarray(right)
        return _solve_many(matrix, jnp.asarray(right))
    if active is None:
        return solve(matrix, right)
    on = [active[k] for k in range(len(right))]
    rows = [
        [entry * on[i] * on[j] + (1 - on[i] if i == j else 0.0) for j, entry in enumerate(row)]
        for i, row in enumerate(matrix)
    ]
    return solve(rows, [on[k] * value for k, value in enumerate(right)])


def _solve_many(matrix: Any, right: Any) -> Any:
    """x with A x = b of matrices (m, m, …)."""
    import jax.numpy as jnp

    A = jnp.moveaxis(matrix, (0, 1), (-2, -1))
    b = jnp.moveaxis(right, 0, -1)[..., None]
    return jnp.moveaxis(jnp.linalg.solve(A, b)[..., 0], -1, 0)


def stacked(values: Any) -> Any:
    """A few arrays as a list, many as one array."""
    import jax.numpy as jnp

    if not isinstance(values, list | tuple):
        return values
    if len(values) <= FEW:
        return [*values]
    shape = jnp.broadcast_shapes(*(jnp.shape(value) for value in values))
    return jnp.stack([jnp.broadcast_to(value, shape) for value in values])
