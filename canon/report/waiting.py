"""A progress bar for Python code that waits: on a terminal, in a notebook, and nothing where nobody looks."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from html import escape
from typing import Any, Final, Protocol

PATIENCE: Final = 1.0
"""Seconds before a bar appears in a notebook."""
SELDOM: Final = 0.2
"""Seconds between two drawings of it."""


class _Bar(Protocol):
    def update(self, part: float) -> None: ...

    def close(self) -> None: ...


@contextmanager
def progress(label: str = "simulating") -> Iterator[Callable[[float], None]]:
    """A bar while a block runs, and the function that is to be told which part (0 to 1) is done.

    As `with progress() as watch: simulate(scene, watch=watch)`. It appears when the wait has become long: drawn by rich
    on a terminal, as an HTML element in a notebook (which needs no extension), and not at all elsewhere.
    """
    bar = _bar(label)
    try:
        yield bar.update if bar is not None else _ignored
    finally:
        if bar is not None:
            bar.close()


def _ignored(part: float) -> None:
    """Where nobody looks."""


def _bar(label: str) -> _Bar | None:
    display = _notebook_display()
    if display is not None:
        return NotebookBar(label, display)
    if not sys.stderr.isatty():
        return None
    from canon.report.console import part_bar

    return part_bar(label)


def _notebook_display() -> Any:
    """The display function of the notebook that this runs in; None elsewhere. IPython is never imported by us."""
    module = sys.modules.get("IPython")
    shell = module.get_ipython() if module is not None else None
    if shell is None or not hasattr(shell, "kernel"):
        return None
    return sys.modules["IPython.display"].display if "IPython.display" in sys.modules else None


class NotebookBar:
    """A bar in a notebook's output, drawn anew in place.

    **Arguments:** its label; `display`, as IPython's: called with the bundle of an output, `raw=True` and a
    `display_id`, of which it returns the handle when it is called with `display_id=True`.
    """

    def __init__(self, label: str, display: Callable[..., Any]) -> None:
        self.label, self.display = label, display
        self.start = time.monotonic()
        self.drawn = 0.0
        self.handle: Any = None

    def update(self, part: float) -> None:
        """Draw the bar anew: this part is done."""
        now = time.monotonic()
        if now - self.start < PATIENCE or now - self.drawn < SELDOM:
            return
        self.drawn = now
        self._show(self._bundle(part, now - self.start))

    def close(self) -> None:
        """Take the bar away, if there is one."""
        if self.handle is not None:
            self._show({"text/html": "", "text/plain": ""})

    def _show(self, bundle: dict[str, str]) -> None:
        if self.handle is None:
            self.handle = self.display(bundle, raw=True, display_id=True)
        else:
            self.handle.update(bundle, raw=True)

    def _bundle(self, part: float, seconds: float) -> dict[str, str]:
        percent = round(100 * min(max(part, 0.0), 1.0))
        text = f"{self.label}: {percent} % in {seconds:.0f} s"
        bar = f'<progress max="100" value="{percent}" style="width:min(20em,60%)"></progress>'
        return {"text/html": f"{bar} {escape(text)}", "text/plain": text}
