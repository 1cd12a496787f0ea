"""The image of a point near a caustic of a generating function, in more digits, and the type that is regular there.

Where F's second derivatives are large and cancel, double precision loses the image's digits although the map is regular
there. The type that is best conditioned for the map's Jacobian has no caustic near; its function is the Legendre
transform of F, evaluated by solving for F's own arguments. Newton's iterates are the same in both types, since the
variables that are exchanged enter linearly; so they are carried in F's arguments, in as many more digits as cancel.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from flint import arb, arb_mat

from canon.claims.mixed_derivatives import OnTape
from canon.decide.enclosure import Ball, OutOfDomain, precision
from canon.decide.tape import Unsupported
from canon.numeric.mixed_variables import Types, comparable, condition_of

Array = Any  # numpy arrays
STEPS: Final = 40
EXTRA_BITS: Final = 96
GUARD: Final = 2.0**-70
WELL: Final = 100.0
"""A type whose condition is less than this is as good as any."""


@dataclass(frozen=True)
class Deep:
    """An image (2n,), rounded to doubles, with the map's Jacobian M, found in `bits` bits.

    `regular` are the types that are best conditioned there, about equally: F's own alone, where no other is better.
    """

    image: Array
    M: Array
    regular: tuple[Types, ...]
    bits: int


def solve_deeply(
    F: OnTape, z: Array, y: Array, row: int, condition: float, known: tuple[Types, ...] = ()
) -> Deep | None:
    """The image of one phase point z (2n,), from a first guess y (n,) of the new arguments; None without convergence.

    **Arguments:** `condition`, by how much F's own type amplifies rounding there: so many bits are added; `known`,
    types that were best at another point: where the first is well conditioned here, no others are compared.
    """
    bits = EXTRA_BITS + 2 * int(np.ceil(np.log2(min(max(condition, 2.0), 2.0**200))))
    pattern, n = F.pattern, len(y)
    with precision(bits):
        x = [arb(float(value)) for value in z[pattern.old_arguments]]
        v = [arb(float(value)) for value in z[pattern.old_conjugates]]
        new = [arb(float(value)) for value in y]
        signs = [int(s) for s in pattern.old_signs]
        try:
            for _ in range(STEPS):
                gradient, hessian = F.deeply([*x, *new], row, bits)
                off = [[(s * g - t).mid()] for s, g, t in zip(signs, gradient[:n], v, strict=True)]
                block = [[(s * h).mid() for h in line[n:]] for s, line in zip(signs, hessian[:n], strict=True)]
                move = arb_mat(block).solve(arb_mat(off))
                steps = [move[k, 0].mid() for k in range(n)]
                new = [(value - step).mid() for value, step in zip(new, steps, strict=True)]
                if all(abs(float(s)) <= GUARD * abs(float(value)) for s, value in zip(steps, new, strict=True)):
                    return _rounded(F, x, new, row, bits, known)
        except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError):
            return None
    return None


def _rounded(F: OnTape, x: list[Ball], y: list[Ball], row: int, bits: int, known: tuple[Types, ...]) -> Deep:
    pattern, n = F.pattern, len(y)
    gradient, hessian = F.deeply([*x, *y], row, bits)
    image = np.empty(2 * n)
    image[pattern.new_arguments] = [float(value) for value in y]
    image[pattern.new_conjugates] = pattern.new_signs * [float(g) for g in gradient[n:]]
    M = _jacobian(F, hessian)
    if known and condition_of(known[0], M[None]) <= WELL:
        return Deep(image, M, known, bits)
    return Deep(image, M, comparable(M[None], pattern.types), bits)


def _jacobian(F: OnTape, hessian: list[list[Ball]]) -> Array:
    """M, its blocks combined before they are rounded, since second derivatives cancel in it."""
    pattern, n = F.pattern, len(F.u) // 2
    size = 2 * n
    old, new = ([[arb(0)] * size for _ in range(size)] for _ in range(2))
    for k in range(n):
        old[int(pattern.old_arguments[k])][k] = arb(1)
        new[int(pattern.new_arguments[k])][n + k] = arb(1)
        old[int(pattern.old_conjugates[k])] = [int(pattern.old_signs[k]) * h.mid() for h in hessian[k]]
        new[int(pattern.new_conjugates[k])] = [int(pattern.new_signs[k]) * h.mid() for h in hessian[n + k]]
    M = arb_mat(new) * arb_mat(old).inv()
    return np.array([[float(M[i, j]) for j in range(size)] for i in range(size)])
