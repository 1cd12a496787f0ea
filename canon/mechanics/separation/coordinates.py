"""Orthogonal coordinates of the plane and of space in which the free particle's Hamilton–Jacobi equation separates.

Each comes with its Stäckel matrix S: its i-th row contains the i-th coordinate alone, and 1/h² is the first row of S⁻¹.
Morse and Feshbach (1953), section 5.1; Goldstein, Poole and Safko (2002), 10.4; Binney and Tremaine (2008), 3.5.3.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import whole_number
from canon.mechanics.formulas import as_expression


@dataclass(frozen=True)
class OrthogonalCoordinates:
    """Coordinates u with x(u).

    **Arguments:** `u`, their symbols; `cartesian`, x, y, … as functions of u; `squares`, the squared scale factors h²;
    `staeckel`, the matrix S; `bases`, points at which nothing vanishes that shouldn't, in the coordinates' order.
    """

    name: str
    u: tuple[sp.Symbol, ...]
    cartesian: tuple[Any, ...]
    squares: tuple[Any, ...]
    staeckel: sp.ImmutableMatrix
    bases: tuple[tuple[Any, ...], ...]


def _symbols(names: str) -> tuple[Any, ...]:
    """Symbols, positive where a + stands behind the name."""
    return tuple(sp.Symbol(n.rstrip("+"), positive=True) if n[-1] == "+" else sp.Symbol(n, real=True)
                 for n in names.split())  # fmt: skip


def _cartesian(dimension: int, _c: Any) -> OrthogonalCoordinates:
    u = _symbols("x y z")[:dimension]
    rows = [[1, *[-1] * (dimension - 1)]] + [[int(i == j) for j in range(dimension)] for i in range(1, dimension)]
    bases = ((sp.S.One,) * dimension, (sp.S.Half,) * dimension)
    return OrthogonalCoordinates("cartesian", u, u, (sp.S.One,) * dimension, sp.ImmutableMatrix(rows), bases)


def _polar(_dimension: int, _c: Any) -> OrthogonalCoordinates:
    r, phi = _symbols("r+ phi")
    matrix = sp.ImmutableMatrix([[1, -1 / r**2], [0, 1]])
    bases = ((sp.S.One, sp.S.Zero), (sp.S.One, sp.pi / 4))
    return OrthogonalCoordinates("polar", (r, phi), (r * sp.cos(phi), r * sp.sin(phi)), (sp.S.One, r**2), matrix, bases)


def _cylindrical(_dimension: int, _c: Any) -> OrthogonalCoordinates:
    rho, phi, z = _symbols("rho+ phi z")
    matrix = sp.ImmutableMatrix([[1, -1 / rho**2, -1], [0, 1, 0], [0, 0, 1]])
    x = (rho * sp.cos(phi), rho * sp.sin(phi), z)
    bases = ((sp.S.One, sp.S.Zero, sp.S.One), (sp.S.One, sp.pi / 4, sp.S.Half))
    return OrthogonalCoordinates("cylindrical", (rho, phi, z), x, (sp.S.One, rho**2, sp.S.One), matrix, bases)


def _spherical(_dimension: int, _c: Any) -> OrthogonalCoordinates:
    r, theta, phi = _symbols("r+ theta phi")
    s = sp.sin(theta)
    x = (r * s * sp.cos(phi), r * s * sp.sin(phi), r * sp.cos(theta))
    matrix = sp.ImmutableMatrix([[1, -1 / r**2, 0], [0, 1, -1 / s**2], [0, 0, 1]])
    bases = ((sp.S.One, sp.pi / 2, sp.S.Zero), (sp.S.One, sp.pi / 3, sp.pi / 4))
    return OrthogonalCoordinates("spherical", (r, theta, phi), x, (sp.S.One, r**2, r**2 * s**2), matrix, bases)


def _parabolic(dimension: int, _c: Any) -> OrthogonalCoordinates:
    xi, eta, phi = _symbols("xi+ eta+ phi")
    h = xi**2 + eta**2
    if dimension == 2:
        matrix = sp.ImmutableMatrix([[xi**2, 1], [eta**2, -1]])
        bases = ((sp.S.One, sp.S.One), (sp.Integer(2), sp.S.One))
        return OrthogonalCoordinates("parabolic", (xi, eta), ((xi**2 - eta**2) / 2, xi * eta), (h, h), matrix, bases)
    x = (xi * eta * sp.cos(phi), xi * eta * sp.sin(phi), (xi**2 - eta**2) / 2)
    matrix = sp.ImmutableMatrix([[xi**2, 1, -1 / xi**2], [eta**2, -1, -1 / eta**2], [0, 0, 1]])
    bases = ((sp.S.One, sp.S.One, sp.S.Zero), (sp.Integer(2), sp.S.One, sp.pi / 4))
    return OrthogonalCoordinates("parabolic", (xi, eta, phi), x, (h, h, xi**2 * eta**2), matrix, bases)


def _elliptic(_dimension: int, c: Any) -> OrthogonalCoordinates:
    mu, nu = _symbols("mu+ nu")
    h = c**2 * (sp.cosh(mu) ** 2 - sp.cos(nu) ** 2)
    x = (c * sp.cosh(mu) * sp.cos(nu), c * sp.sinh(mu) * sp.sin(nu))
    matrix = sp.ImmutableMatrix([[c**2 * sp.cosh(mu) ** 2, 1], [-(c**2) * sp.cos(nu) ** 2, -1]])
    bases = ((sp.log(2), sp.pi / 2), (sp.log(3), sp.pi / 4))
    return OrthogonalCoordinates("elliptic", (mu, nu), x, (h, h), matrix, bases)


def _prolate(_dimension: int, c: Any) -> OrthogonalCoordinates:
    mu, nu, phi = _symbols("mu+ nu phi")
    sinh, sin = sp.sinh(mu), sp.sin(nu)
    h = c**2 * (sp.cosh(mu) ** 2 - sp.cos(nu) ** 2)
    x = (c * sinh * sin * sp.cos(phi), c * sinh * sin * sp.sin(phi), c * sp.cosh(mu) * sp.cos(nu))
    matrix = sp.ImmutableMatrix(
        [
            [c**2 * sp.cosh(mu) ** 2, 1, -1 / sinh**2],
            [-(c**2) * sp.cos(nu) ** 2, -1, -1 / sin**2],
            [0, 0, 1],
        ]
    )
    bases = ((sp.log(2), sp.pi / 2, sp.S.Zero), (sp.log(3), sp.pi / 3, sp.pi / 4))
    return OrthogonalCoordinates("prolate spheroidal", (mu, nu, phi), x, (h, h, c**2 * sinh**2 * sin**2), matrix, bases)


_SYSTEMS: Mapping[str, tuple[tuple[int, ...], Callable[[int, Any], OrthogonalCoordinates]]] = {
    "cartesian": ((2, 3), _cartesian),
    "polar": ((2,), _polar),
    "cylindrical": ((3,), _cylindrical),
    "spherical": ((3,), _spherical),
    "parabolic": ((2, 3), _parabolic),
    "elliptic": ((2,), _elliptic),
    "prolate spheroidal": ((3,), _prolate),
}


def orthogonal_coordinates(name: str, dimension: int, focus: sp.Expr | int = 1) -> OrthogonalCoordinates:
    """The system of this name in the plane or in space.

    **Arguments:** `focus`, half the distance of the foci of elliptic and prolate spheroidal coordinates: a positive
    number or symbol. Foci lie on the x axis in the plane, on the z axis in space; so does the axis of parabolic ones.

    **Raises:** `InputError` for an unknown name, and for a dimension in which there is no such system.
    """
    if not isinstance(name, str) or name not in _SYSTEMS:
        raise InputError(f"unknown coordinates {name!r}: there are {', '.join(_SYSTEMS)}")
    dimensions, make = _SYSTEMS[name]
    whole_number(dimension, "dimension")
    if dimension not in dimensions:
        raise InputError(f"{name} coordinates are those of {' or '.join(map(str, dimensions))} dimensions")
    half = as_expression(focus, "focus")
    if half.is_positive is False:
        raise InputError(f"half the distance of the foci is a positive number or symbol, not {half}", "focus")
    return make(dimension, half)


def systems_of(dimension: int) -> tuple[str, ...]:
    """The names of the systems in so many dimensions."""
    return tuple(name for name, (dimensions, _) in _SYSTEMS.items() if dimension in dimensions)
