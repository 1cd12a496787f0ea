"""Verdicts on a terminal: a table in colour, what there is to learn below it, and a bar while a run takes long."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import groupby
from shutil import get_terminal_size
from typing import Final

from rich.console import Console, RenderableType
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from canon.report.explain import error_line, explained, explanation
from canon.report.words import Record, closing, duration, name, verdict, visible

NARROWEST: Final = 20
WIDEST: Final = 500
"""Columns of a terminal that a table is fitted to."""
PATIENCE: Final = 1.0
"""Seconds before a progress bar appears."""

_COLOURS: Final = {"proved": "green", "refuted": "red", "supported": "yellow", "undecided": "magenta"}


def terminal(*, stderr: bool = False) -> Console:
    """The terminal, as wide as it says, within reason: rich would print nothing on one of no width."""
    columns, lines = get_terminal_size()
    width, height = min(max(columns, NARROWEST), WIDEST), min(max(lines, 5), 500)
    return Console(stderr=stderr, highlight=False, width=width, height=height)


def colour(claim: Record) -> str:
    """Return the colour of a verdict; bold where it is not what was expected."""
    if claim["expected"]:
        return "green" if claim["verdict"] == "refuted" else _COLOURS[claim["verdict"]]
    return "bold red" if claim["verdict"] == "proved" else f"bold {_COLOURS[claim['verdict']]}"


def print_record(record: Record, console: Console, *, seconds: float, interrupted: int = 0) -> None:
    """Print a whole run: the table, explanations, errors, and the summary."""
    if record["claims"]:
        console.print(*_tables(record["claims"], console.width), sep="\n")
        console.print()
    for claim in explained(record["claims"]):
        first, *rest = explanation(claim)
        console.print(Text(first, style=colour(claim)))
        for line in rest:
            console.print(Text(line))
        console.print()
    for error in record["errors"]:
        console.print(Text("! ", style="bold red").append(error_line(error), style="not bold default"))
    if record["errors"]:
        console.print()
    fine = not record["errors"] and not interrupted and all(claim["expected"] for claim in record["claims"])
    console.print(Text(closing(record, seconds=seconds, interrupted=interrupted), "bold green" if fine else "bold"))


@contextmanager
def progress(total: int, console: Console) -> Iterator[_Bar]:
    """Show a bar from `PATIENCE` on; it is drawn by whoever calls it, never by a thread (workers are forked)."""
    bar = _Bar(total, console)
    try:
        yield bar
    finally:
        bar.close()


class _Bar:
    """A progress bar that appears when the wait has become long."""

    def __init__(self, total: int, console: Console) -> None:
        self.start = time.monotonic()
        self.progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=console,
            auto_refresh=False,
            transient=True,
        )
        self.task = self.progress.add_task("checking", total=total)
        self.shown = False

    def update(self, done: int, current: str) -> None:
        """Draw the bar anew, with the number of claims done and the name of one that is in work."""
        if time.monotonic() - self.start < PATIENCE:
            return
        if not self.shown:
            self.progress.start()
            self.shown = True
        self.progress.update(self.task, completed=done, description=visible(current)[:40])
        self.progress.refresh()

    def close(self) -> None:
        """Take the bar away."""
        if self.shown:
            self.progress.stop()


class part_bar:  # noqa: N801 - it is called as a function, and kept while a run goes on
    """A progress bar of one run, which appears when the wait has become long."""

    def __init__(self, label: str = "simulating") -> None:
        self.bar, self.label = _Bar(100, terminal(stderr=True)), label

    def update(self, part: float) -> None:
        """Draw the bar anew: this part of the run is done."""
        self.bar.update(round(100 * part), self.label)

    def close(self) -> None:
        """Take the bar away."""
        self.bar.close()


def _tables(claims: list[Record], width: int) -> Iterator[RenderableType]:
    """Yield the table piece by piece: a heading, and for each file its name and its claims, in columns that agree."""
    method = min(max(len("method"), *(len(visible(claim["method"])) for claim in claims)), max(16, width // 4))
    widths = (22, max(16, width - 22 - method - 7 - 8), method, 7)
    heading = _grid(widths)
    heading.add_row(*(Text(word, style="dim") for word in ("verdict", "claim", "method", "time")))
    yield heading
    for file, group in groupby(claims, key=lambda claim: claim["file"]):
        yield Text(visible(file), style="bold")
        table = _grid(widths)
        for claim in group:
            table.add_row(
                Text(verdict(claim), style=colour(claim)),
                Text(name(claim)),
                Text(visible(claim["method"])),
                Text(duration(claim["seconds"]), style="dim"),
            )
        yield table


def _grid(widths: tuple[int, ...]) -> Table:
    """Return an empty table without lines, indented, with columns of these widths; the last one is for numbers."""
    grid = Table(box=None, show_header=False, padding=(0, 0, 0, 2))
    for width in widths[:-1]:
        grid.add_column(width=width, overflow="fold")
    grid.add_column(width=widths[-1], justify="right", no_wrap=True)
    return grid
