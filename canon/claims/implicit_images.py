"""Images under the map of a generating function, with all that is known of them, those near a caustic found anew."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.claims.mixed_derivatives import OnTape
from canon.claims.near_caustic import solve_deeply
from canon.numeric.implicit import MixedSolution, solve_mixed
from canon.numeric.mixed_variables import Types
from canon.numeric.precision import UNIT

Array = Any  # numpy arrays

LOSES: Final = 1e3
DEEP: Final = 1e6
"""Where an image's error is more roundings than these, it is found by a formula of another type; or in more digits."""

DOUBLE: Final = 53
AGREES: Final = 4.0
"""So many estimated errors apart, two images are taken for the same."""

MOST_TYPES: Final = 8
"""So many types are asked for a formula at a point."""

ROUGH: Final = 1e-3
"""An image whose error is a larger part of it can't confirm another."""


@dataclass(frozen=True)
class ImplicitImages:
    """Images of N points under the map of a generating function.

    **Fields:** `images` (N, 2n), nan where the equations were not solved (`solved`, (N,)); `jacobians` (N, 2n, 2n) of
    the map; `errors` (N, 2n), estimates of the images' rounding; `condition` (N,), by how much that is larger than one
    roundoff; `own_condition` (N,), the same for the equations of F itself in double precision; `iterations` (N,) of
    Newton's method; `types`, for each point that by which it was found: F's `own`, or near a caustic the one that is
    best conditioned for the map's Jacobian; `bits` (N,) in which the equations were solved.
    """

    images: Array
    jacobians: Array
    errors: Array
    condition: Array
    own_condition: Array
    iterations: Array
    own: Types
    types: tuple[Types, ...]
    bits: Array

    @property
    def solved(self) -> Array:
        """At which points (N,) the equations were solved."""
        return np.isfinite(self.images).all(axis=1)

    @property
    def notes(self) -> tuple[str, ...]:
        """What is worth saying: points not solved, and those near a caustic, with the type that was chosen there."""
        lines = []
        count = len(self.images)
        if not self.solved.all():
            lines.append(f"not solved at {int((~self.solved).sum())} of {count} points")
        again = np.flatnonzero(self.condition != self.own_condition)
        for types in dict.fromkeys(self.types[k] for k in again):
            near = [k for k in again if self.types[k] == types]
            most, direct = max(int(self.bits[k]) for k in near), any(self.bits[k] == DOUBLE for k in near)
            how = " or ".join(["by its own formula"] * direct + [f"in {most} bits"] * (most > DOUBLE))
            where = "ill-conditioned" if types == self.own else "near a caustic"
            what = "F's own type" if types == self.own else f"type {_name(types)} in place of {_name(self.own)}"
            lines.append(
                f"{where} at {len(near)} of {count} points: {what}, {how}; "
                f"condition {self.condition[near].max():.2g} instead of {self.own_condition[near].max():.2g}"
            )
        return tuple(lines)

    def __str__(self) -> str:
        found = self.condition[self.solved]
        most = f"{found.max():.2g}" if len(found) else "unknown"
        return "; ".join(
            (f"{int(self.solved.sum())} of {len(self.images)} points, condition at most {most}", *self.notes)
        )


def _name(types: Types) -> str:
    return str(types[0] if len(set(types)) == 1 else list(types))


def with_caustics(
    F: OnTape,
    z: Array,
    found: MixedSolution,
    *,
    most: int | None = None,
    of_type: Callable[[Types], OnTape | None] | None = None,
    tolerated: float = DEEP,
) -> ImplicitImages:
    """The solution with points near a caustic found again (`most` of them at most, the worst).

    At the worst point F's equations are solved in more digits. That tells the map's Jacobian there, and by it the type
    that is best conditioned. Where `of_type` gives the function of that type, all points that lose digits are found by
    it, in double precision; where it doesn't, or what it gives isn't confirmed, those that are off by more than the
    `tolerated` number of roundings are found in more digits.
    """
    count = len(z)
    n = z.shape[1] // 2
    images, M = found.images.copy(), found.M.copy()
    errors, condition = found.errors.copy(), found.condition.copy()
    types = [F.pattern.types] * count
    bits = np.full(count, DOUBLE)
    order = np.argsort(-np.where(found.solved, found.condition, 0.0))
    least = tolerated if of_type is None else min(LOSES, tolerated)
    waiting = [int(k) for k in order if found.solved[k] and found.condition[k] > least][:most]
    tried = {F.pattern.types}
    regular: tuple[Types, ...] = ()
    while waiting:
        k, *waiting = waiting
        far = found.condition[k] > tolerated
        deep = solve_deeply(F, z[k], found.u[k, n:], k, float(found.condition[k]), regular)
        regular = regular if deep is None else deep.regular
        if deep is not None and far:
            images[k], M[k], types[k], bits[k] = deep.image, deep.M, deep.regular[0], deep.bits
            errors[k], condition[k] = UNIT * np.abs(deep.image), 1.0
        other = None if deep is None or of_type is None else _first(of_type, deep.regular[:MOST_TYPES], tried)
        if deep is None or other is None:
            if far:
                continue
            break
        rows = np.array([k, *waiting])
        near, off = images[rows], errors[rows]
        near[0], off[0] = deep.image, UNIT * np.abs(deep.image)
        again = solve_mixed(other, other.pattern, z[rows], near[:, other.pattern.new_arguments])
        kept = confirmed(again, near, off) & (again.condition < found.condition[rows])
        kept &= again.condition <= tolerated
        if not kept[0]:  # not what more digits gave
            continue
        for row in np.flatnonzero(kept):
            k = rows[row]
            images[k], M[k], types[k], bits[k] = again.images[row], again.M[row], other.pattern.types, DOUBLE
            errors[k], condition[k] = again.errors[row], again.condition[row]
        waiting = [int(k) for k in rows[1:][~kept[1:]]]
    return ImplicitImages(
        images, M, errors, condition, found.condition, found.iterations, F.pattern.types, tuple(types), bits
    )


def _first(of_type: Callable[[Types], OnTape | None], regular: Sequence[Types], tried: set[Types]) -> OnTape | None:
    """The first function that there is, of types that have not been tried."""
    for types in regular:
        if types not in tried:
            tried.add(types)
            found = of_type(types)
            if found is not None:
                return found
    return None


def confirmed(again: MixedSolution, images: Array, errors: Array) -> Array:
    """Which images of another type (N,) have kept their digits, and agree with those known (N, 2n) up to `errors`."""
    sizes = np.abs(images).max(axis=1, keepdims=True)
    with np.errstate(all="ignore"):
        agree = np.abs(again.images - images) <= AGREES * (errors + again.errors)
        known = errors <= ROUGH * sizes
        return again.solved & (again.condition <= DEEP) & (agree & known).all(axis=1)


def joined(parts: list[ImplicitImages]) -> ImplicitImages:
    """The images of several blocks of points as one."""
    return ImplicitImages(
        images=np.concatenate([part.images for part in parts]),
        jacobians=np.concatenate([part.jacobians for part in parts]),
        errors=np.concatenate([part.errors for part in parts]),
        condition=np.concatenate([part.condition for part in parts]),
        own_condition=np.concatenate([part.own_condition for part in parts]),
        iterations=np.concatenate([part.iterations for part in parts]),
        own=parts[0].own,
        types=tuple(types for part in parts for types in part.types),
        bits=np.concatenate([part.bits for part in parts]),
    )
