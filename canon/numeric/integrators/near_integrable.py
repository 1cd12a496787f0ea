"""Splittings of H = A + εB with a small ε, such as Kepler's motion and a perturbation of it.

An error ε h^p_1 + ε² h^p_2 + … has a small leading term, so few stages with positive coefficients go far. Their names
give the orders: ABA(8,6,4).
"""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, mirrored, palindrome
from canon.numeric.integrators.traits import Traits

_LASKAR: Final = "McLachlan (1995), BIT 35, 258; Laskar and Robutel (2001), Celest. Mech. Dyn. Astron. 80, 39"
_BLANES: Final = "Blanes, Casas, Farrés, Laskar, Makazaga and Murua (2013), Appl. Numer. Math. 68, 58, table 3"


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


ABA_82: Final = SplittingMethod(
    "aba82",
    _traits(2),
    palindrome((0.06943184420297371238802675555359525, 0.2605776340045981552106403648947824), 1.0),
    mirrored((0.17392742256872692868653197461099970,)),
    f"{_LASKAR}, SABA4",
    near_integrable=(8, 2),
)
ABA_104: Final = SplittingMethod(
    "aba104",
    _traits(4),
    mirrored(
        (
            0.04706710064597250612947887637243678556564,
            0.1847569354170881069247376193702560968574,
            0.2827060056798362053243616565541452479160,
        )
    ),
    palindrome(
        (
            0.1188819173681970199453503950853885936957,
            0.2410504605515015657441667865901651105675,
            -0.2732866667053238060543113981664559460630,
        )
    ),
    f"{_BLANES}, (10,4)",
    near_integrable=(10, 4),
)
ABA_864: Final = SplittingMethod(
    "aba864",
    _traits(4),
    mirrored(
        (
            0.0711334264982231177779387300061549964174,
            0.241153427956640098736487795326289649618,
            0.521411761772814789212136078067994229991,
        )
    ),
    palindrome(
        (
            0.183083687472197221961703757166430291072,
            0.310782859898574869507522291054262796375,
            -0.0265646185119588006972121379164987592663,
        )
    ),
    f"{_BLANES}, (8,6,4)",
    near_integrable=(8, 6, 4),
)
ABA_1064: Final = SplittingMethod(
    "aba1064",
    _traits(4),
    palindrome(
        (
            0.03809449742241219545697532230863756534060,
            0.1452987161169137492940200726606637497442,
            0.2076276957255412507162056113249882065158,
            0.4359097036515261592231548624010651844006,
        )
    ),
    mirrored(
        (
            0.09585888083707521061077150377145884776921,
            0.2044461531429987806805077839164344779763,
            0.2170703479789911017143385924306336714532,
        )
    ),
    f"{_BLANES}, (10,6,4)",
    near_integrable=(10, 6, 4),
)
METHODS: Final[tuple[SplittingMethod, ...]] = (ABA_82, ABA_104, ABA_864, ABA_1064)
