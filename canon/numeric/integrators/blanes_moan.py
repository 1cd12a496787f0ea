"""Optimised splittings into two parts of any kind (and, by their α, into more): McLachlan's, and Blanes and Moan's."""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, mirrored, palindrome
from canon.numeric.integrators.traits import Traits

_ROOT: Final = 19.0**0.5


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


MCLACHLAN_4: Final = SplittingMethod(
    "mclachlan4",
    _traits(4),
    mirrored(((14 - _ROOT) / 108, (20 - 7 * _ROOT) / 108)),
    palindrome((2 / 5, -1 / 10)),
    "McLachlan (1995), SIAM J. Sci. Comput. 16, 151, S, m = 5",
)
BLANES_MOAN_4: Final = SplittingMethod(
    "blanes_moan4",
    _traits(4),
    palindrome((0.0792036964311957, 0.353172906049774, -0.0420650803577195)),
    mirrored((0.209515106613362, -0.143851773179818)),
    "Blanes and Moan (2002), J. Comput. Appl. Math. 142, 313, table 2, S6",
)
BLANES_MOAN_6: Final = SplittingMethod(
    "blanes_moan6",
    _traits(6),
    palindrome((0.0502627644003922, 0.413514300428344, 0.0450798897943977, -0.188054853819569, 0.541960678450780)),
    mirrored((0.148816447901042, -0.132385865767784, 0.067307604692185, 0.432666402578175)),
    "Blanes and Moan (2002), J. Comput. Appl. Math. 142, 313, table 2, S10",
)
METHODS: Final[tuple[SplittingMethod, ...]] = (MCLACHLAN_4, BLANES_MOAN_4, BLANES_MOAN_6)
