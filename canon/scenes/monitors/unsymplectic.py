"""What a method that is not symplectic does to areas in phase space: how far it may go before that is an alarm.

Such steps keep no invariant but by being small: what they make of one is bounded by their estimated error, and a coarse
step has a large one. A bound that would pass a change of areas by one part in a thousand is none.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading

DAMNING: Final = 1e-3
"""The part of an area, or of phase volume, by which steps may change it at most, whatever their error."""


def area_change(kept: np.ndarray, expected: np.ndarray) -> float:
    """The largest change of a bracket that is expected to be large, as a part of it: a number without a unit, as that
    of {q, p} = 1 is.
    """
    sizes = np.abs(expected)
    large = sizes >= sizes.max() / 2
    return float((np.abs(kept - expected)[large] / sizes[large]).max())


def condemned(reading: Reading, flow: Flow, part: float, rounding: float) -> Reading:
    """The reading, with an alarm where the steps are not symplectic and have changed an area by a `part` of it that no
    `rounding` explains, and that their error alone would excuse.
    """
    if flow.method.traits.symplectic is True or reading.bound is None:
        return reading
    if reading.alarm or not part > DAMNING + rounding:
        known = "not symplectic" if flow.method.traits.symplectic is False else "not known to be symplectic"
        note = f"{flow.method.name} is {known}: the bound is what its steps' estimated error allows"
        return replace(reading, extra={"note": note, **reading.extra})
    alarm = (
        f"drifted by {part:.2g} of itself ({reading.expected}): the steps of {flow.method.name} are too long, and not "
        f"symplectic. A symplectic method keeps this with any step"
    )
    return replace(reading, alarm=alarm, bound=min(reading.bound, DAMNING + rounding))
