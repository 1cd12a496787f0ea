"""Symmetric compositions of a symmetric map of order 2, with coefficients of small size: orders 4, 6, 8 and 10.

They apply to any such map, implicit ones and those on constraint surfaces included: see `composed`. The coefficients
follow Hairer, Lubich and Wanner, Geometric Numerical Integration (2006), V.3.2.
"""

from __future__ import annotations

from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod, from_composition, palindrome
from canon.numeric.integrators.traits import Traits

_FIFTH: Final = 1 / (4 - 4.0 ** (1 / 3))
SUZUKI_4_GAMMA: Final = palindrome((_FIFTH, _FIFTH))
KAHAN_LI_6_GAMMA: Final = palindrome(
    (0.39216144400731413928, 0.33259913678935943860, -0.70624617255763935981, 0.082213596293550800230)
)
SUZUKI_UMENO_8_GAMMA: Final = palindrome(
    (
        0.74167036435061295345,
        -0.40910082580003159400,
        0.19075471029623837995,
        -0.57386247111608226666,
        0.29906418130365592384,
        0.33462491824529818378,
        0.31529309239676659663,
    )
)
KAHAN_LI_8_GAMMA: Final = palindrome(
    (
        0.13020248308889008087881763,
        0.56116298177510838456196441,
        -0.38947496264484728640807860,
        0.15884190655515560089621075,
        -0.39590389413323757733623154,
        0.18453964097831570709183254,
        0.25837438768632204729397911,
        0.29501172360931029887096624,
    )
)
SOFRONIOU_SPALETTA_10_GAMMA: Final = palindrome(
    (
        0.078795722521686419263907679337684,
        0.31309610341510852776481247192647,
        0.027918383235078066109520273275299,
        -0.22959284159390709415121339679655,
        0.13096206107716486317465685927961,
        -0.26973340565451071434460973222411,
        0.074973343155891435666137105641410,
        0.11199342399981020488957508073640,
        0.36613344954622675119314812353150,
        -0.39910563013603589787862981058340,
        0.10308739852747107731580277001372,
        0.41143087395589023782070411897608,
        -0.0048663605831352617621956593099771,
        -0.39203335370863990644808193642610,
        0.051942502962449647037182904015976,
        0.050665090759924496335874344156866,
        0.049674370639729879054568800279461,
    )
)


def _traits(order: int) -> Traits:
    return Traits(order=order, symplectic=True, symmetric=True, volume_preserving=True)


SUZUKI_4: Final = from_composition(
    "suzuki4", _traits(4), SUZUKI_4_GAMMA, "Suzuki (1990), Phys. Lett. A 146, 319; McLachlan (1995), eq. 4.2"
)
KAHAN_LI_6: Final = from_composition(
    "kahan_li6", _traits(6), KAHAN_LI_6_GAMMA, "Kahan and Li (1997), Math. Comput. 66, 1089, s9odr6a"
)
SUZUKI_UMENO_8: Final = from_composition(
    "suzuki_umeno8",
    _traits(8),
    SUZUKI_UMENO_8_GAMMA,
    "Suzuki and Umeno (1993); McLachlan (1995), SIAM J. Sci. Comput. 16, 151",
)
KAHAN_LI_8: Final = from_composition(
    "kahan_li8", _traits(8), KAHAN_LI_8_GAMMA, "Kahan and Li (1997), Math. Comput. 66, 1089, s17odr8a"
)
SOFRONIOU_SPALETTA_10: Final = from_composition(
    "sofroniou_spaletta10",
    _traits(10),
    SOFRONIOU_SPALETTA_10_GAMMA,
    "Sofroniou and Spaletta (2005), Optim. Methods Softw. 20, 597, 35 stages",
)
METHODS: Final[tuple[SplittingMethod, ...]] = (SUZUKI_4, KAHAN_LI_6, SUZUKI_UMENO_8, KAHAN_LI_8, SOFRONIOU_SPALETTA_10)
