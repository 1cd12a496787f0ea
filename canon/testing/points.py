"""Strategies of phase points, with scales that break programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from hypothesis import strategies as st

from canon.expected import numbers, whole_number

Array = np.ndarray

SCALES: Final = (1.0, 1e-3, 1e3, 1e-8, 1e8)

UNITS: Final[Mapping[str, tuple[float, float]]] = {
    "natural": (1.0, 1.0),
    "electron in SI": (5.3e-11, 2.0e-24),
    "planet in SI": (1.5e11, 1.8e29),
    "planet in au, solar masses and years": (1.0, 1.9e-5),
}
"""Typical coordinates and momenta in some units: a Bohr radius and an electron's momentum there, the Earth's orbit."""


@st.composite
def phase_points(
    draw: st.DrawFn,
    degrees: int,
    *,
    scales: Sequence[float] = SCALES,
    units: tuple[float, float] = UNITS["natural"],
    twins: bool = True,
) -> Array:
    """Phase points (q₁…q_n, p₁…p_n) of shape (2n,): whole numbers up to 9 times a scale, times the units of q and p.

    Entries may be 0, of very different scales, and (`twins`) equal to another entry up to a part in 10¹², so that
    differences cancel. They shrink to 0 and to 1 in the first scale.
    """
    degrees = whole_number(degrees, "degrees", 1)
    scales, sizes = numbers(scales, "scales"), numbers(units, "units")
    values = [draw(st.integers(-9, 9)) * draw(st.sampled_from(scales)) for _ in range(2 * degrees)]
    if twins and draw(st.booleans()):
        k = draw(st.integers(0, 2 * degrees - 1))
        values[k] = values[k - 1] * (1 + draw(st.sampled_from((0.0, 1e-12, -1e-12))))
    return np.array(values) * np.repeat(sizes, degrees)
