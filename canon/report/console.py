"""Verdicts on a terminal: a table in colour, what there is to learn below it, and a bar while a run takes long."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from rich import box
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from canon.report.explain import error_line, explained, explanation
from canon.report.words import Record, closing, duration, name, verdict, visible

PATIENCE: Final = 1.0
"""Seconds before a progress bar appears."""

_COLOURS: Final = {"proved": "green", "refuted": "red", "supported": "yellow", "undecided": "magenta"}


def colour(claim: Record) -> str:
    """Return the colour of a verdict; bold where it is not what was expected."""
    if claim["expected"]:
        return "green" if claim["verdict"] == "refuted" else _COLOURS[claim["verdict"]]
    return "bold red" if claim["verdict"] == "proved" else f"bold {_COLOURS[claim['verdict']]}"


def print_record(record: Record, console: Console, *, seconds: float, interrupted: int = 0) -> None:
    """Print a whole run: the table, explanations, errors, and the summary."""
    if record["claims"]:
        console.print(_table(record["claims"]))
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


def _table(claims: list[Record]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    table.add_column("claim", overflow="fold")
    table.add_column("verdict", no_wrap=True)
    table.add_column("method", overflow="fold")
    table.add_column("time", justify="right", no_wrap=True)
    before = None
    for claim in claims:
        if claim["file"] != before:
            before = claim["file"]
            table.add_row(Text(visible(before), style="bold"))
        table.add_row(
            Text("  " + name(claim)),
            Text(verdict(claim), style=colour(claim)),
            Text(visible(claim["method"])),
            Text(duration(claim["seconds"]), style="dim"),
        )
    return table
