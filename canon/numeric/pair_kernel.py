"""The sums over pairs themselves, as small programs of constant length.

A few bodies: all B² pairs at once. More: body by body, each with all others at once, so that memory is O(B) and the
inner loop is one of SIMD instructions. Each pair is met twice, which costs less than adding to two places would.
`numbers` is the module to compute with, jax.numpy or numpy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

AT_ONCE: Final = 32
"""Bodies up to which all pairs of one orbit are computed at once."""
LANES: Final = 4
"""Doubles in a SIMD instruction that XLA makes."""

Law = Callable[[Any], Any]
"""r² to U, or to U′(r)/r, elementwise."""


def pair_slopes(slope: Law, places: Any, weights: Sequence[float], numbers: Any) -> Any:
    """w_i Σ_j w_j (U′(r)/r)(r_ij²) (x_i − x_j), (B, d, …), of places (B, d, …)."""
    bodies, extra = len(places), places.ndim - 2
    w = _factors(weights)
    if bodies <= AT_ONCE and not extra:
        total = _at_once(slope, places, w, numbers)
    else:
        count = np.arange(bodies).reshape(-1, *(1,) * extra)
        each = None if w is None else numbers.asarray(w)

        def add(j: Any, total: Any) -> Any:
            apart = places - places[j]
            pull = _pull(slope, (apart * apart).sum(axis=1), count == j, None if each is None else each[j], numbers)
            return total + numbers.expand_dims(pull, 1) * apart

        total = _summed(bodies, add, numbers.zeros_like(places), numbers)
    return total if w is None else w.reshape(-1, *(1,) * (extra + 1)) * total


def _at_once(slope: Law, places: Any, w: Any, numbers: Any) -> Any:
    """All pairs in one program without a loop, with as many columns as fill the lanes of SIMD instructions."""
    bodies = len(places)
    more = -bodies % LANES if bodies > LANES else 0
    same = np.eye(bodies, bodies + more, dtype=bool)
    same[:, bodies:] = True
    others = numbers.concatenate([places, np.zeros((more, places.shape[1]))]) if more else places
    weight = None if w is None else np.pad(w, (0, more))[None, :]
    apart = places[:, None] - others[None, :]
    pull = _pull(slope, (apart * apart).sum(axis=2), same, weight, numbers)
    return (pull[:, :, None] * apart).sum(axis=1)


def _pull(slope: Law, square: Any, same: Any, weight: Any, numbers: Any) -> Any:
    """w_j U′(r)/r, and 0 for a body with itself: also where that would be infinite, and for derivatives."""
    found = slope(numbers.where(same, 1.0, square))
    return numbers.where(same, 0.0, found if weight is None else weight * found)


def pair_total(law: Law, places: Any, weights: Sequence[float], numbers: Any) -> Any:
    """Σ_{i<j} w_i w_j U(r_ij²), with the axes of the places (B, d, …) after their second one."""
    bodies, extra = len(places), places.ndim - 2
    count = np.arange(bodies).reshape(-1, *(1,) * extra)
    each = numbers.asarray(np.asarray(weights, dtype=float))

    def add(j: Any, total: Any) -> Any:
        apart = places - places[j]
        same = count >= j
        values = law(numbers.where(same, 1.0, (apart * apart).sum(axis=1)))
        return total + numbers.where(same, 0.0, each[j] * each.reshape(count.shape) * values).sum(axis=0)

    return _summed(bodies, add, numbers.zeros(places.shape[2:], places.dtype), numbers)


def _summed(bodies: int, add: Callable[[Any, Any], Any], total: Any, numbers: Any) -> Any:
    """What all bodies add: in a loop of Python's for numpy, of the program's own for jax."""
    if numbers is np:
        for j in range(bodies):
            total = add(j, total)
        return total
    from jax import lax

    return lax.fori_loop(0, bodies, add, total)


def _factors(weights: Sequence[float]) -> Any:
    """The weights as an array; None where all are 1."""
    found = np.asarray(weights, dtype=float)
    return None if np.all(found == 1.0) else found
