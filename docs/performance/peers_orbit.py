"""Hénon–Heiles: five orbits, one by one, to t = 10 000, beside heyoka."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from peers_common import Row
from peers_orbits import FEW, LONG, TARGETS, by_canon, by_heyoka, row


def rows() -> Iterator[Row]:
    settings = {"canon": [*by_canon(LONG, FEW)], "heyoka": [*by_heyoka(LONG, FEW)]}
    for target, goal in zip(TARGETS, (2.5, 1, 0.7), strict=True):
        yield row("five orbits one by one, t = 10 000, median error", settings, np.median, target, goal, LONG, FEW)
