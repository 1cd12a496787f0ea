"""Rigid bodies as symbols: the attitude, a unit quaternion from body to space, and M, the angular momentum in the body.

Their brackets are {M_i, M_j} = −ε_ijk M_k and {a, M_i} = a e_i/2, in quaternions: with H = Σ M_i²/2I_i they make
Euler's equations Ṁ = M × ω and ȧ = a ω/2. Marsden and Ratiu (1999), Introduction to Mechanics and Symmetry, 15.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import sympy as sp

from canon.scenes.model import Bracket, Formula

PARTS: Final = "wxyz"
AXES: Final = "xyz"


@dataclass(frozen=True)
class RigidBody:
    """A body with its principal `moments` (3,) and the symbols of its `attitude` (4,) and of `M` (3,)."""

    name: str
    moments: tuple[Formula, ...]
    attitude: tuple[sp.Symbol, ...]
    M: tuple[sp.Symbol, ...]

    @property
    def kinetic(self) -> Formula:
        """Σ M_i²/2I_i."""
        return sp.Add(*(M**2 / (2 * moment) for M, moment in zip(self.M, self.moments, strict=True)))

    @property
    def rotation(self) -> tuple[tuple[Formula, ...], ...]:
        """The matrix of the attitude, body to space: quadratic, so that brackets vanish off the unit sphere too."""
        w, x, y, z = self.attitude
        return (
            (w**2 + x**2 - y**2 - z**2, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w**2 - x**2 + y**2 - z**2, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w**2 - x**2 - y**2 + z**2),
        )

    @property
    def M_in_space(self) -> tuple[Formula, ...]:  # noqa: N802 - the angular momentum is M
        """The angular momentum's components in space."""
        return self.to_space(self.M)

    def to_space(self, vector: tuple[Formula, ...]) -> tuple[Formula, ...]:
        """A vector of the body, in space."""
        return tuple(sp.Add(*(r * v for r, v in zip(row, vector, strict=True))) for row in self.rotation)

    def to_body(self, vector: tuple[Formula, ...]) -> tuple[Formula, ...]:
        """A vector of space, in the body."""
        columns = zip(*self.rotation, strict=True)
        return tuple(sp.Add(*(r * v for r, v in zip(column, vector, strict=True))) for column in columns)

    @property
    def brackets(self) -> tuple[Bracket, ...]:
        """The brackets of its coordinates that are not 0."""
        one, two, three = self.M
        own = ((one, two, -three), (two, three, -one), (three, one, -two))
        w, x, y, z = self.attitude
        turned = ((-x, -y, -z), (w, -z, y), (z, w, -x), (-y, x, w))
        rows = zip(self.attitude, turned, strict=True)
        return (*own, *((a, M, part / 2) for a, row in rows for M, part in zip(self.M, row, strict=True)))


def rigid_body_named(name: str, moments: tuple[Formula, ...], suffix: str = "") -> RigidBody:
    """The body with symbols of its own: q_w … q_z and M_1 … M_3, and the suffix."""
    attitude = tuple(sp.Symbol(f"q_{part}{suffix}", real=True) for part in PARTS)
    return RigidBody(name, moments, attitude, tuple(sp.Symbol(f"M_{k}{suffix}", real=True) for k in (1, 2, 3)))
