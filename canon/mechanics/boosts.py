"""Lorentz boosts, their composition, and the rotation of Wigner that is left over; exact, with sympy."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import listed
from canon.mechanics.formulas import as_expression
from canon.mechanics.vanishing import sign_at_a_point, vanishes

Vector = Sequence[Any]


def boost(velocity: Vector, c: Any = 1) -> sp.ImmutableMatrix:
    """The boost that brings what rests to the velocity (3,), in components (ct, x, y, z).

    Jackson, Classical Electrodynamics (1999), eq. 11.19 with the opposite velocity: active.

    **Arguments:** components and c exact: whole numbers, fractions, or sympy expressions.

    **Raises:** `InputError` where the speed is certainly not below c, or isn't real, or for text and floats.
    """
    light = as_expression(c, "c")
    if vanishes(light) or (light.is_number and sign_at_a_point(light) != 1):
        raise InputError("the speed of light is positive", "c")
    beta = sp.Matrix([as_expression(v, "velocity") / light for v in listed(velocity, "components", "velocity")])
    if beta.shape != (3, 1):
        raise InputError(f"three components are expected, not {beta.rows}", "velocity")
    if any(b.is_real is False for b in beta.flat()):
        raise InputError("the components of a velocity are real", "velocity")
    square: Any = sp.simplify(beta.dot(beta))
    slower: Any = 1 - square
    if vanishes(slower) or (slower.is_number and sign_at_a_point(slower) != 1) or slower.is_nonpositive:
        raise InputError("the speed isn't below that of light", "velocity")
    try:
        return _boost(1 / sp.sqrt(slower), beta)
    except ValueError as reason:
        raise InputError("numbers of so many digits are too long for sympy's roots", "velocity, c") from reason


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

    The first column is γ (1, v/c); the rotation is what boost(−v) leaves (Jackson, section 11.8). That ΛᵀgΛ = g and
    det Λ = 1 is proved, for all values of parameters; of Λ₀₀, which then is at least 1 or at most −1, the sign is
    looked at for one value of each that its assumptions allow.

    **Arguments:** `matrix`, 4 rows of exact numbers or sympy expressions; the matrix of numbers with a point (floats)
    is none, exactly: see `canon.numeric.groups.lorentz`.

    **Raises:** `InputError` where ΛᵀgΛ isn't g, or Λ turns time or handedness round, or where that isn't seen.
    """
    Lambda = _exact_matrix(matrix)
    g = sp.diag(1, -1, -1, -1)
    preserved = _answer((Lambda.T * g * Lambda - g)[i, j] for i in range(4) for j in range(i, 4))
    if preserved is not True:
        seen = "is not g" if preserved is False else "is not seen to be g: simplify its entries"
        raise InputError(f"no Lorentz matrix: transpose(L) g L {seen}", "matrix")
    proper, sign = vanishes(sp.expand(Lambda.det()) - 1), sign_at_a_point(Lambda[0, 0])
    if proper is False or sign == -1:
        raise InputError("a Lorentz matrix that turns time or handedness round is no boost and rotation", "matrix")
    if proper is None or sign is None:
        raise InputError(
            "whether the matrix turns time or handedness round is not seen: simplify its entries", "matrix"
        )
    return _split(Lambda, as_expression(c, "c"))


def _exact_matrix(matrix: Any) -> sp.ImmutableMatrix:
    given = (
        matrix.tolist() if isinstance(matrix, sp.MatrixBase) else listed(matrix, "four rows of four entries", "matrix")
    )
    rows = [listed(row, "entries", "matrix") for row in given]
    if len(rows) != 4 or any(len(row) != 4 for row in rows):
        raise InputError("no Lorentz matrix: four rows of four entries are expected", "matrix")
    return sp.ImmutableMatrix([[as_expression(entry, "matrix") for entry in row] for row in rows])


def _answer(entries: Iterable[Any]) -> bool | None:
    """Whether all entries are 0: False where one certainly isn't, None where that isn't known."""
    answers = [vanishes(entry) for entry in entries]
    return False if False in answers else True if all(answers) else None


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
    try:
        return _split(sp.ImmutableMatrix((boost(second, c) * boost(first, c)).applyfunc(_neat)), c)
    except (ValueError, OverflowError) as reason:
        raise InputError("numbers of so many digits are too long for sympy's roots", "velocities, c") from reason
