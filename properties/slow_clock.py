"""A machine that is slower than this one, for the tests: budgets run out so many times as fast.

`SLOWNESS=8 python -m pytest -p properties.slow_clock …` shows which verdicts of tests depend on how long they take. The
deciders' deadlines alone are moved; what tests wait for themselves is left as it is.
"""

from __future__ import annotations

import os
import time
from types import SimpleNamespace
from typing import Final

import canon.budget

SLOWNESS: Final = float(os.environ.get("SLOWNESS", "8"))


def seen() -> float:
    """The monotonic clock, as a slower machine would see it."""
    return SLOWNESS * time.monotonic()


canon.budget.time = SimpleNamespace(monotonic=seen)  # pyright: ignore[reportAttributeAccessIssue]
