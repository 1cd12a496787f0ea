"""A claim's time: a deadline that is handed down and never moves."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from canon.errors import NO_NUMBER, BudgetExceeded


class Budget:
    """A deadline, `seconds` from now (`math.inf` for none). Immutable.

    Work that may take long asks `check()` now and then; work that may fail asks for a `share`
    and leaves the rest to what is tried next. `look`, if there is one, is called wherever the clock is looked at, by
    shares of the budget too; it stays in the process.
    """

    __slots__ = ("_deadline", "_look", "seconds")

    seconds: float
    _deadline: float
    _look: Callable[[], None] | None

    def __init__(self, seconds: float = math.inf, look: Callable[[], None] | None = None) -> None:
        object.__setattr__(self, "_look", look)
        if math.isnan(seconds) or seconds < 0:
            raise ValueError(f"a budget is a number of seconds from 0 on, not {seconds!r}")
        object.__setattr__(self, "seconds", float(seconds))
        object.__setattr__(self, "_deadline", time.monotonic() + seconds)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Budget is immutable: {name!r} can't be set")

    def __repr__(self) -> str:
        return f"Budget({self.seconds:g} s, {self.left():.3g} s left)"

    def __reduce__(self) -> tuple[type[Budget], tuple[float]]:
        return (Budget, (self.left(),))

    def left(self) -> float:
        """The seconds that are left, never negative."""
        return max(0.0, self._deadline - time.monotonic())

    def spent(self) -> bool:
        """Whether nothing is left."""
        if self._look is not None:
            self._look()
        return time.monotonic() >= self._deadline

    def check(self) -> None:
        """Go on, or raise `BudgetExceeded` if the deadline has passed."""
        if self.spent():
            raise BudgetExceeded(f"the budget of {self.seconds:g} s is spent")

    def share(self, fraction: float) -> Budget:
        """A budget of `fraction` (0 to 1) of what is left: it can't outlive this one."""
        if not 0 <= fraction <= 1:
            raise ValueError(f"a share is between 0 and 1, not {fraction!r}")
        return Budget(self.left() * fraction if fraction else 0.0, self._look)


def is_budget(seconds: object) -> bool:
    """Whether a `Budget` of so many seconds can be made."""
    try:
        Budget(seconds)  # pyright: ignore[reportArgumentType] - that is asked here
    except NO_NUMBER:
        return False
    return True
