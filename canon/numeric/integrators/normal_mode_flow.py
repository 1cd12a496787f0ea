"""The flow of H = ½ pᵀ D p + ½ qᵀ K q as a matrix, D diagonal: exact for springs of any sizes side by side.

With the modes v_k and squares λ_k of D^½ K D^½ each block of the matrix is Σ_k f(λ_k) times a projector. In double
precision two things go wrong. Eigenvectors are exact beside the stiffest spring alone: of a coupling 10¹² times weaker
four digits are left. So modes are found in as many digits as it takes, of each set of coupled coordinates by itself.
And where modes nearly agree, as of two equal pendulums with a weak spring between them, the entries that couple are
small differences of large numbers. So off the diagonal sums are made by parts, Σ_k P_k (f(λ_k) − f(λ_{k+1})) with P_k
the sum of the first k projectors, which all together vanish there; the differences are formulas in λ_k − λ_{k+1}, which
is known to all its digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial
from typing import Any, Final, NamedTuple

import mpmath
import numpy as np

from canon.numeric.exact.stumpff import stumpff

DIGITS: Final = 50
"""Decimal digits of the modes, and as many more as the matrix's entries are apart."""
NEAR: Final = 1.0
_TERMS: Final = 12


class Modes(NamedTuple):
    """The modes of all sets of coupled coordinates.

    `squares` λ (m,), and of each the diagonal of its projectors: `ones` of D^½ v vᵀ D^−½, `upper` of D^½ v vᵀ D^½, and
    `lower` of D^−½ v vᵀ D^−½, all (m, n). Of each pair of neighbouring modes of a set the `low` λ (g,) and the `gap`
    (g,), and the sums P of the same three, off the diagonal (g, n, n).
    """

    squares: np.ndarray
    ones: np.ndarray
    upper: np.ndarray
    lower: np.ndarray
    low: np.ndarray
    gap: np.ndarray
    sums: tuple[np.ndarray, np.ndarray, np.ndarray]


def modes_of(inverse_mass: Sequence[float], K: Any) -> Modes:
    """The modes of Σ p²/2m + ½ qᵀ K q: 1/m of n entries, positive, and K (n, n), symmetric."""
    sizes = np.abs(K[K != 0])
    spread = np.log10(sizes.max() / sizes.min()) if len(sizes) else 0.0
    mp = mpmath.mp.clone()  # other threads may set the digits of mpmath's own
    mp.dps = DIGITS + int(spread)  # the sums of projectors nearly cancel, too
    n = len(K)
    diagonals: list[list[Any]] = [[], [], [], []]
    between: list[list[Any]] = [[], [], [], [], []]
    for block in coupled(K):
        inside = np.ix_(block, block)
        squares, vectors, root = _eigen(mp, block, inverse_mass, K)
        running = [np.zeros((n, n), dtype=object) for _ in range(3)]
        for k, square in enumerate(squares):
            left, right = vectors[k] * root, vectors[k] / root
            found = [np.outer(*pair) for pair in ((left, right), (left, left), (right, right))]
            diagonals[0].append(float(square))
            for total, projector, rows in zip(running, found, diagonals[1:], strict=True):
                total[inside] += projector
                row = np.zeros(n)
                row[block] = np.diag(projector).astype(float)
                rows.append(row)
            if k + 1 < len(squares):
                off = [np.where(np.eye(n, dtype=bool), 0.0, total).astype(float) for total in running]
                for column, value in zip(between, (float(square), float(squares[k + 1] - square), *off), strict=True):
                    column.append(value)
    low, gap = (np.array(column) for column in between[:2])
    one, two, three = (np.reshape(column, (-1, n, n)) for column in between[2:])
    squares, ones, upper, lower = map(np.array, diagonals)
    return Modes(squares, ones, upper, lower, low, gap, (one, two, three))


def coupled(K: Any) -> list[np.ndarray]:
    """The sets of coordinates that a matrix couples, directly or by others."""
    near = (K != 0) | (K.T != 0) | np.eye(len(K), dtype=bool)
    for _ in range(len(K).bit_length()):
        near = (near.astype(int) @ near.astype(int)) > 0
    return [np.flatnonzero(row) for row in np.unique(near, axis=0)]


def _eigen(mp: Any, block: np.ndarray, inverse_mass: Sequence[float], K: Any) -> tuple[list[Any], list[Any], Any]:
    """λ in ascending order, the modes in rows, and D^½, of a set of coordinates, in mp's digits."""
    root = [mp.sqrt(mp.mpf(float(inverse_mass[i]))) for i in block]
    A = mp.matrix(len(block), len(block))
    for a, i in enumerate(block):
        for b, j in enumerate(block):
            A[a, b] = root[a] * mp.mpf(float(K[i, j])) * root[b]
    squares, columns = mp.eigsy(A)
    order = sorted(range(len(block)), key=lambda k: squares[k])
    vectors = [np.array([columns[a, k] for a in range(len(block))], dtype=object) for k in order]
    return [squares[k] for k in order], vectors, np.array(root, dtype=object)


def flow_blocks(modes: Modes, lengths: Any) -> tuple[Any, Any, Any, Any]:
    """The blocks (s, n, n) of q' = q + qq q + qp p, p' = p + pq q + pp p after times h (s,).

    An entry near 1 would be rounded the same way in every step, and its error add up; so 1 is left out.
    """
    import jax.numpy as jnp

    h = jnp.asarray(lengths)[:, None]
    x = jnp.asarray(modes.squares) * h * h
    _, c1, c2, _ = stumpff(x)
    on = jnp.asarray(np.eye(modes.ones.shape[1]))

    def diagonal(values: Any, weights: np.ndarray) -> Any:
        return (values @ jnp.asarray(weights))[:, :, None] * on

    qq, qp, pq = (
        diagonal(values, weights)
        for values, weights in (
            (-x * c2, modes.ones),
            (h * c1, modes.upper),
            (-jnp.asarray(modes.squares) * h * c1, modes.lower),
        )
    )
    if not len(modes.gap):
        return qq, qp, pq, qq
    one, two, three = _differences(jnp.asarray(modes.low) * h * h, jnp.asarray(modes.gap) * h * h)
    off = [
        jnp.einsum("gij,sg->sij", jnp.asarray(total), change)
        for total, change in zip(modes.sums, (one, h * two, -three / h), strict=True)
    ]
    return qq + off[0], qp + off[1], pq + off[2], qq + jnp.swapaxes(off[0], 1, 2)


def _differences(x: Any, gap: Any) -> tuple[Any, Any, Any]:
    """c_0(x) − c_0(y), c_1(x) − c_1(y) and x c_1(x) − y c_1(y) for y = x + gap, gap ≥ 0, to a few roundings of what the
    terms are of.

    For x, y of one sign, with u, v half the sum and difference of their roots: cos a − cos b = −2 sin u sin v, and
    sinc a − sinc b = (b − a)/b (sinc a − cos u sinc v); where both are small, series divided by the gap.
    """
    import jax.numpy as jnp

    y = x + gap
    sign = jnp.where(x > 0, 1.0, -1.0)
    alike = x * y > 0
    a, b = jnp.sqrt(jnp.abs(x)), jnp.sqrt(jnp.abs(y))
    total = jnp.where(alike, a + b, 1.0)
    u, v = sign * (a + b) ** 2 / 4, sign * (gap / total) ** 2 / 4
    cos_u, sinc_u, _, _ = stumpff(u)
    sinc_v = stumpff(v)[1]
    quarter = [stumpff(value / 4)[1] for value in (x, y)]
    apart = (y * quarter[1] ** 2 - x * quarter[0] ** 2) / 2
    first = jnp.where(alike, gap / 2 * sinc_u * sinc_v, apart)
    sinc_x, sinc_y = stumpff(x)[1], stumpff(y)[1]
    # the root of the larger size divides
    up = jnp.abs(y) >= jnp.abs(x)
    large, other = jnp.where(up, b, a), jnp.where(up, sinc_x, sinc_y)
    small = jnp.maximum(jnp.abs(x), jnp.abs(y)) <= NEAR
    far = sign * (other - cos_u * sinc_v) / jnp.where(small | ~alike, 1.0, total * large)
    slope = jnp.where(small, -_divided(jnp.where(small, x, 0.0), jnp.where(small, y, 0.0)), far)
    second = jnp.where(small | alike, gap * slope, sinc_x - sinc_y)
    return first, second, y * second - gap * sinc_x


def _divided(x: Any, y: Any) -> Any:
    """(c_1(x) − c_1(y))/(x − y) by its series Σ (−1)^j (x^j − y^j)/(x − y)/(2j + 1)!."""
    total, power, symmetric = 0.0 * x, x * 0.0 + 1.0, x * 0.0 + 1.0
    for j in range(1, _TERMS):
        total = total + (-1) ** j / factorial(2 * j + 1) * symmetric
        power = power * y
        symmetric = x * symmetric + power
    return total
