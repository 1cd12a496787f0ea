"""Symplectic Runge–Kutta–Nyström methods: splittings of H = T(p) + V(q, t) with T quadratic, where [V,[V,[V,T]]] = 0
frees coefficients. On other problems they lose their order, so they refuse these.
"""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, mirrored, palindrome
from canon.numeric.integrators.traits import Traits

_PAPER: Final = "Blanes and Moan (2002), J. Comput. Appl. Math. 142, 313, table 3"


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


NYSTROM_4: Final = SplittingMethod(
    "nystrom4",
    _traits(4),
    palindrome((0.0829844064174052, 0.396309801498368, -0.0390563049223486)),
    mirrored((0.245298957184271, 0.604872665711080)),
    f"{_PAPER}, SRKN b, 6 stages",
    needs="nystrom",
    outer="last",
)
NYSTROM_6: Final = SplittingMethod(
    "nystrom6",
    _traits(6),
    mirrored((0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807, -0.0115113874206879)),
    palindrome((0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075, 0.357208872795928)),
    f"{_PAPER}, SRKN b, 11 stages",
    needs="nystrom",
    outer="last",
)
NYSTROM_6A: Final = SplittingMethod(
    "nystrom6a",
    _traits(6),
    palindrome(
        (
            0.0378593198406116,
            0.102635633102435,
            -0.0258678882665587,
            0.314241403071447,
            -0.130144459517415,
            0.106417700369543,
            -0.00879424312851058,
        )
    ),
    mirrored(
        (
            0.09171915262446165,
            0.183983170005006,
            -0.05653436583288827,
            0.004914688774712854,
            0.143761127168358,
            0.328567693746804,
        )
    ),
    f"{_PAPER}, SRKN a, 14 stages",
    needs="nystrom",
)
METHODS: Final[tuple[SplittingMethod, ...]] = (NYSTROM_4, NYSTROM_6, NYSTROM_6A)
