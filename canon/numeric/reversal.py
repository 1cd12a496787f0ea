"""Time reversal of a map: with R (q, p) = (q, −p), is R f R f the identity?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from canon.errors import InputError
from canon.expected import real_array
from canon.numeric.differences import SAFETY, ULPS
from canon.numeric.differentiable import Differentiable
from canon.numeric.residuals import Residuals

Array = np.ndarray


def momentum_reversal(points: Array) -> Array:
    """(q, p) -> (q, −p) at points (N, 2n)."""
    n = points.shape[1] // 2
    return points * np.concatenate([np.ones(n), -np.ones(n)])


def reversal_residuals(map: Differentiable, points: Array, involution: Callable[[Array], Array]) -> Residuals:  # noqa: A002
    """|R f R f z − z| for each variable, beside an estimate of its rounding.

    The estimate is what a rounding of z and of f(z) becomes under f's derivatives, and how much the residual differs
    at a point a few roundings away.
    """

    def reversed_(z: Array) -> Array:
        turned = np.array(real_array(involution(np.array(z)), "involution"))  # it may change its argument in place
        if turned.shape != z.shape:
            raise InputError(f"an involution takes points {z.shape} to points, not to {turned.shape}", "involution")
        return turned

    def returned(z: Array) -> Array:
        return reversed_(map.evaluate(reversed_(map.evaluate(z)))) - z

    with np.errstate(all="ignore"):
        middle = map.evaluate(points)
        back, _ = map.linearise(reversed_(middle))
        residual = returned(points)
        carried = np.einsum("bij,bj->bi", np.abs(back), np.abs(middle) + np.abs(points))
        rng = np.random.default_rng(0)
        moved = points * (1 + 4 * map.unit * rng.choice([-1.0, 1.0], points.shape))
        noise = np.abs(returned(moved) - residual)
    return Residuals("reversal", np.abs(residual), ULPS * map.unit * (carried + np.abs(points)) + SAFETY * noise)
