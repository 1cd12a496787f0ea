"""Compositions of Störmer–Verlet: Verlet itself, the triple jump of order 4, and Yoshida's of orders 6 and 8."""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, from_composition, palindrome
from canon.numeric.integrators.traits import Traits

_CUBE_ROOT: Final = 2.0 ** (1 / 3)
_OUTER: Final = 1 / (2 - _CUBE_ROOT)


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


VERLET: Final = from_composition(
    "verlet", _traits(2), (1.0,), "Störmer (1907); Verlet (1967), Phys. Rev. 159, 98; Hairer, Lubich, Wanner, I.1.4"
)
YOSHIDA_4: Final = from_composition(
    "yoshida4",
    _traits(4),
    (_OUTER, -_CUBE_ROOT * _OUTER, _OUTER),
    "Forest and Ruth (1990), Physica D 43, 105; Yoshida (1990), Phys. Lett. A 150, 262, eq. 2.12",
)
YOSHIDA_6: Final = from_composition(
    "yoshida6",
    _traits(6),
    palindrome((0.78451361047755726382, 0.23557321335935813368, -1.17767998417887100695)),
    "Yoshida (1990), Phys. Lett. A 150, 262, table 1, solution A",
)
YOSHIDA_8: Final = from_composition(
    "yoshida8",
    _traits(8),
    palindrome(
        (
            0.91484424622979156675,
            0.25369333656621135415,
            -1.4448522368606051577,
            -0.1582406353680501752,
            1.9381391376225259866,
            -1.9606102329753108076,
            0.1027998493917964407,
        )
    ),
    "Yoshida (1990), Phys. Lett. A 150, 262, table 2, solution D; its 15 digits carried on by Newton's method",
)
METHODS: Final[tuple[SplittingMethod, ...]] = (VERLET, YOSHIDA_4, YOSHIDA_6, YOSHIDA_8)
