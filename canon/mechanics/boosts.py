"""Lorentz boosts, their composition, and the rotation of Wigner that is left over; exact, with sympy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError

Vector = Sequence[Any]


def boost(velocity: Vector, c: Any = 1) -> sp.ImmutableMatrix:
    """The boost that brings what rests to the velocity (3,), in components (ct, x, y, z).

    Jackson, Classical Electrodynamics (1999), eq. 11.19 with the opposite velocity: active.

    **Raises:** `InputError` where the speed is certainly not below c.
    """
    beta = sp.Matrix([sp.sympify(v) / c for v in velocity])
    if beta.shape != (3, 1):
        raise InputError(f"three components are expected, not {beta.rows}", "velocity")
    square = sp.simplify(beta.dot(beta))
    if (1 - square).is_nonpositive:
        raise InputError("the speed isn't below that of light", "velocity")
    return _boost(1 / sp.sqrt(1 - square), beta)


def _boost(gamma: Any, beta: Any) -> sp.ImmutableMatrix:
    # gamma²/(1 + gamma) is (gamma − 1)/beta², without a division by 0 at rest
    space = sp.eye(3) + gamma**2 / (1 + gamma) * beta * beta.T
    top = sp.Matrix([[gamma]]).row_join(gamma * beta.T)
    return sp.ImmutableMatrix(top.col_join((gamma * beta).row_join(space)))


@dataclass(frozen=True)
class BoostAndRotation:
    """Λ = boost(velocity) · rotation: the velocity (3,) to which Λ brings what rests, and Wigner's rotation (3, 3)."""

    velocity: sp.ImmutableMatrix
    rotation: sp.ImmutableMatrix

    @property
    def cosine(self) -> Any:
        """cos of the angle of the rotation: (trace − 1)/2."""
        return _neat((self.rotation.trace() - 1) / 2)


def split_boost(matrix: Any, c: Any = 1) -> BoostAndRotation:
    """A proper orthochronous Lorentz matrix as a rotation followed by a boost.

    The first column is γ (1, v/c); the rotation is what boost(−v) leaves (Jackson, section 11.8).

    **Raises:** `InputError` where ΛᵀgΛ isn't g, or Λ turns time or handedness round.
    """
    Lambda = sp.ImmutableMatrix(matrix)
    g = sp.diag(1, -1, -1, -1)
    if Lambda.shape != (4, 4) or not (Lambda.T * g * Lambda - g).applyfunc(sp.simplify).is_zero_matrix:
        raise InputError("no Lorentz matrix: transpose(L) g L is not g", "matrix")
    first: Any = Lambda[0, 0]
    handed: Any = Lambda.det()
    if first.is_negative or sp.simplify(handed) == -1:
        raise InputError("a Lorentz matrix that turns time or handedness round is no boost and rotation", "matrix")
    return _split(Lambda, c)


def _split(Lambda: sp.ImmutableMatrix, c: Any) -> BoostAndRotation:
    gamma: Any = Lambda[0, 0]
    beta = sp.Matrix([_neat(Lambda[k, 0] / gamma) for k in (1, 2, 3)])
    rest = (_boost(gamma, -beta) * Lambda).applyfunc(_neat)
    velocity = sp.ImmutableMatrix([_neat(c * b) for b in beta])
    return BoostAndRotation(velocity, sp.ImmutableMatrix(rest[1:, 1:]))


def _neat(value: Any) -> Any:
    """A short form: numbers with their roots above the line, formulas as sympy simplifies them."""
    return sp.simplify(value) if value.free_symbols else sp.radsimp(sp.expand(sp.radsimp(value)))


def compose_boosts(second: Vector, first: Vector, c: Any = 1) -> BoostAndRotation:
    """boost(second) · boost(first): the composed velocity, and Wigner's rotation, 1 only where they are parallel."""
    return _split(sp.ImmutableMatrix((boost(second, c) * boost(first, c)).applyfunc(_neat)), c)
