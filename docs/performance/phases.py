"""Where the time of a verdict goes: clocks on the doors between canon's parts, each counting its own time only."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import wraps
from importlib import import_module
from types import TracebackType
from typing import Any

DOORS = (
    ("conditions", "canon.domain", "conditions_of"),
    ("conditions", "canon.mechanics.formulas", "conditions_of"),
    ("conditions", "measure", "conditions_of"),
    ("load", "canon.decide.tape", "Tape.load"),
    ("load", "canon.decide.region", "Region.of"),
    ("derivatives", "canon.claims.chart", "derivative"),
    ("derivatives", "canon.claims.scale", "poisson_bracket"),
    ("derivatives", "canon.claims.shears", "derivative"),
    ("structure", "canon.claims.transformation", "by_shears"),
    ("balls", "canon.decide.ladder", "samples"),
    ("balls", "canon.decide.ladder", "evaluate_again"),
    ("balls", "canon.decide.continuity", "samples"),
    ("tower", "canon.decide.ladder", "Tower"),
    ("tower", "canon.decide.continuity", "Tower"),
    ("normal form", "canon.decide.ladder", "reduce_to_zero"),
    ("normal form", "canon.decide.continuity", "reduce_to_zero"),
    ("modular", "canon.decide.modular", "vanishing"),
    ("lesson", "canon.claims.transformation", "taught"),
)
"""(phase, module, name): the functions as their callers look them up."""

NAMES = (*dict.fromkeys(phase for phase, _, _ in DOORS), "other")


class Phases:
    """Puts the clocks on while it is entered.

    Whatever runs behind one door and in front of the next is counted for the first; `other` is the rest.
    """

    def __init__(self) -> None:
        self._own: dict[str, float] = dict.fromkeys(NAMES, 0.0)
        self._open: list[str] = []
        self._last = 0.0
        self._undo: list[Callable[[], None]] = []

    def __enter__(self) -> Phases:
        for phase, module, name in DOORS:
            self._wrap(phase, import_module("__main__") if module == "measure" else import_module(module), name)
        self._open, self._last = ["other"], time.process_time()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._tick()
        for undo in reversed(self._undo):
            undo()

    def spent(self) -> dict[str, float]:
        """CPU seconds by phase."""
        return dict(self._own)

    def _tick(self) -> None:
        now = time.process_time()
        self._own[self._open[-1]] += now - self._last
        self._last = now

    def _wrap(self, phase: str, holder: Any, name: str) -> None:
        *path, last = name.split(".")
        for part in path:
            holder = getattr(holder, part)
        if last not in vars(holder):
            return
        before = vars(holder)[last]
        function = before.__func__ if isinstance(before, staticmethod) else before

        def enter() -> None:
            self._tick()
            self._open.append(phase)

        def leave() -> None:
            self._tick()
            self._open.pop()

        @wraps(function, updated=())
        def timed(*arguments: Any, **keywords: Any) -> Any:
            enter()
            try:
                result = function(*arguments, **keywords)
            finally:
                leave()
            return _stepwise(result, enter, leave) if hasattr(result, "__next__") else result

        setattr(holder, last, staticmethod(timed) if isinstance(before, staticmethod) else timed)
        self._undo.append(lambda: setattr(holder, last, before))


def _stepwise(steps: Any, enter: Callable[[], None], leave: Callable[[], None]) -> Any:
    """A generator whose every step is timed."""
    while True:
        enter()
        try:
            item = next(steps)
        except StopIteration:
            return
        finally:
            leave()
        yield item
