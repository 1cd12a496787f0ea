"""An orbit of Kuzmin and Kutuzov's potential −1/(√λ + √ν) in spheroidal coordinates, in 40 digits; de Zeeuw (1985)."""

from collections.abc import Callable
from typing import Any, NamedTuple

from mpmath import mp


class SpheroidalOrbit(NamedTuple):
    """Where it is (`l`, `n`, `p_l`), its third integral, `depth` of which it is the value at each turning point, and
    these: l lies between `low` and `high`, and n below `top`.
    """

    m: Any
    D2: Any
    l: Any
    n: Any
    p_l: Any
    depth: Callable[[Any], Any]
    I3: Any
    low: Any
    high: Any
    top: Any


def spheroidal_orbit(R: Any, z: Any, p_R: Any, p_z: Any, L: Any, *, c: Any, delta: Any, m: Any) -> SpheroidalOrbit:
    """The orbit through a state; to be called, and its numbers used, in the digits that are wanted."""
    R, z, p_R, p_z, L, c, m, delta = map(mp.mpf, (R, z, p_R, p_z, L, c, m, delta))
    D2 = delta**2
    S = R * R + z * z + D2
    l = (S + mp.sqrt(S * S - 4 * z * z * D2)) / 2
    n = z * z * D2 / l
    E = (p_R**2 + p_z**2 + L**2 / R**2) / (2 * m) - 1 / (mp.sqrt(l + c * c) + mp.sqrt(n + c * c))
    I2, p_l = L * L / (2 * m), p_R * R / (2 * (l - D2)) + p_z * z / (2 * l)

    def depth(t: Any) -> Any:
        return t * (1 / (c + mp.sqrt(t + c * c)) + E - I2 / (t - D2))

    I3 = depth(l) - 2 * (l - D2) * l * p_l**2 / m

    def zero(a: Any, b: Any) -> Any:
        for _ in range(150):
            half = (a + b) / 2
            a, b = (half, b) if (depth(half) - I3) * (depth(a) - I3) > 0 else (a, half)
        return a

    low = high = l
    while depth(low) >= I3:
        low = D2 + (low - D2) / 2
    while depth(high) >= I3:
        high = D2 + (high - D2) * 2
    low, high = zero(l, low), zero(l, high)
    top = zero(n if depth(n) < I3 else n / 2, D2 * (1 - mp.mpf(10) ** -30))
    return SpheroidalOrbit(m, D2, l, n, p_l, depth, I3, low, high, top)
