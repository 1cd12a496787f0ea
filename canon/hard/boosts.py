"""Boosts of any size, from their matrices and back."""

from __future__ import annotations

import math
from typing import Any

from canon.hard.case import HardCase, Number, Quantities, compiled, each
from canon.hard.rotations import VECTOR, along


def _rapidity(m: Any, x: Number, y: Number, z: Number) -> Quantities:
    return ((x, y, z),)


def _our_boost(x: Any, y: Any, z: Any) -> Any:
    """log exp of a rapidity on SO(3,1), by the matrix."""
    import jax.numpy as jnp

    from canon.numeric.groups import lorentz

    zeta = jnp.stack([x, y, z], -1)
    return jnp.moveaxis(lorentz.log(lorentz.exp(0.0 * zeta, zeta))[1], -1, 0)


def _naive_slow(x: float, y: float, z: float) -> Quantities:
    """The rapidity as arcosh γ."""
    gamma, column = _first_column(x, y, z)
    found = math.acosh(gamma)
    size = math.sqrt(gamma**2 - 1)
    return (tuple(found * u / size for u in column),)


def _naive_fast(x: float, y: float, z: float) -> Quantities:
    """The rapidity as artanh β."""
    gamma, column = _first_column(x, y, z)
    beta = math.sqrt(sum(u * u for u in column)) / gamma
    return (tuple(math.atanh(beta) * u / gamma / beta for u in column),)


def _first_column(x: float, y: float, z: float) -> tuple[float, tuple[float, ...]]:
    """γ and γβ of a boost's matrix."""
    zeta = math.sqrt(x * x + y * y + z * z)
    return math.cosh(zeta), tuple(math.sinh(zeta) * u / zeta for u in (x, y, z))


def _naive_matrix(x: float, y: float, z: float) -> Quantities:
    """The boost's matrix by β and γ = 1/√(1 − β²). Jackson (1999), 11.98."""
    zeta = math.sqrt(x * x + y * y + z * z)
    beta = math.tanh(zeta)
    gamma = 1 / math.sqrt(1 - beta * beta)
    b = [beta * u / zeta for u in (x, y, z)]
    rest = [
        (gamma * b[k], *((1 if i == k else 0) + (gamma - 1) * b[i] * b[k] / beta**2 for i in range(3)))
        for k in range(3)
    ]
    return ((gamma, *(gamma * u for u in b)), *rest)


def _scipy_boost(x: float, y: float, z: float) -> Quantities:
    from scipy.linalg import expm, logm

    L: Any = logm(expm([[0, x, y, z], [x, 0, 0, 0], [y, 0, 0, 0], [z, 0, 0, 0]]))
    return (tuple(float(u.real) for u in (L[0, 1], L[0, 2], L[0, 3])),)


def _boost_matrix(m: Any, x: Number, y: Number, z: Number) -> Quantities:
    """γ − 1 is not asked for: the columns of the boost, each by its own length."""
    zeta = m.sqrt(x * x + y * y + z * z)
    n = (x / zeta, y / zeta, z / zeta)
    c, s = m.cosh(zeta), m.sinh(zeta)
    first = (c, *(s * u for u in n))
    rest = [(s * n[k], *((1 if i == k else 0) + (c - 1) * n[i] * n[k] for i in range(3))) for k in range(3)]
    return (first, *rest)  # type: ignore[return-value]


def _our_boost_matrix(x: Any, y: Any, z: Any) -> tuple[Any, ...]:
    import jax.numpy as jnp

    from canon.numeric.groups import lorentz

    zeta = jnp.stack([x, y, z], -1)
    matrix = jnp.moveaxis(lorentz.exp(0.0 * zeta, zeta), (-2, -1), (0, 1))
    return tuple(matrix[:, k] for k in range(4))


def _scipy_boost_matrix(x: float, y: float, z: float) -> Quantities:
    from scipy.linalg import expm

    matrix = expm([[0, x, y, z], [x, 0, 0, 0], [y, 0, 0, 0], [z, 0, 0, 0]])
    return tuple(tuple(float(u) for u in matrix[:, k]) for k in range(4))


BOOSTS = {"scipy.linalg.logm": each(_scipy_boost)}
CASES = (
    HardCase(
        "boosts with γ − 1 down to 1e-16",
        "rotations",
        "the rapidity of a slow boost, from its matrix",
        VECTOR,
        tuple(along(math.sqrt(2) * 10.0**-k) for k in (2, 5, 8, 100)),
        _rapidity,
        compiled(_our_boost),
        each(_naive_slow),
        BOOSTS,
    ),
    HardCase(
        "boosts up to γ = 1e8",
        "rotations",
        "the rapidity of a fast boost, from its matrix",
        VECTOR,
        tuple(along(z) for z in (3.0, 10.0, 19.1138)),
        _rapidity,
        compiled(_our_boost),
        each(_naive_fast),
        BOOSTS,
    ),
    HardCase(
        "the matrix of a boost, γ = 1 to 1e8",
        "rotations",
        "its columns",
        VECTOR,
        tuple(along(z) for z in (1e-8, 3.0, 10.0, 19.1138)),
        _boost_matrix,
        compiled(_our_boost_matrix),
        each(_naive_matrix),
        peers={"scipy.linalg.expm": each(_scipy_boost_matrix)},
    ),
)
