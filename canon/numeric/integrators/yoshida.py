"""Compositions of Störmer–Verlet: Verlet itself, the triple jump of order 4, and Yoshida's of orders 6 and 8."""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, from_composition
from canon.numeric.integrators.traits import Traits

_CUBE_ROOT: Final = 2.0 ** (1 / 3)
_OUTER: Final = 1 / (2 - _CUBE_ROOT)


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


def _symmetric(half: tuple[float, ...]) -> tuple[float, ...]:
    """γ_1 … γ_m, and the middle one that makes the sum 1, and back."""
    return (*half, 1 - 2 * sum(half), *reversed(half))


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
    _symmetric((0.784513610477560, 0.235573213359357, -1.17767998417887)),
    "Yoshida (1990), Phys. Lett. A 150, 262, table 1, solution A",
)
METHODS: Final[tuple[SplittingMethod, ...]] = (VERLET, YOSHIDA_4, YOSHIDA_6)
