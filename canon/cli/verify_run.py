"""Running the claims of `canon verify`: in silence, with a bar, or line by line; what is remembered isn't run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from canon.claims.worker import Entry, Settings

Record = dict[str, Any]
Answers = dict[int, Record]
Watcher = Callable[[int, Sequence[int]], None]


def run_claims(
    entries: list[Entry], settings: Settings, jobs: int | None, results: Answers, *, terminal: bool, quiet: bool
) -> None:
    """Verify the claims that `results` has no answer to, and put theirs in by position.

    **Arguments:** `terminal`, whether to draw a bar; `quiet`, whether to print nothing; else a line for each answer.
    """
    if terminal:
        _with_bar(entries, settings, jobs, results)
    elif quiet:
        _collect(entries, settings, jobs, results)
    else:
        _with_lines(entries, settings, jobs, results)


def _answers(
    entries: list[Entry], settings: Settings, jobs: int | None, known: Answers, watch: Watcher | None = None
) -> Iterator[tuple[int, Record]]:
    """(position, answer) of the entries that aren't known."""
    from canon.claims.run import run
    from canon.report.proof_file import recorder

    open_ones = [position for position in range(len(entries)) if position not in known]
    asked = [entries[position] for position in open_ones]

    def told(done: int, running: Sequence[int]) -> None:
        assert watch is not None
        watch(done + len(entries) - len(asked), [open_ones[k] for k in running])

    watcher = None if watch is None else told
    for position, answer in run(asked, settings, recorder(settings), jobs=jobs, watch=watcher):
        yield open_ones[position], answer


def _collect(
    entries: list[Entry], settings: Settings, jobs: int | None, results: Answers, watch: Watcher | None = None
) -> None:
    for position, answer in _answers(entries, settings, jobs, dict(results), watch):
        results[position] = answer


def _with_bar(entries: list[Entry], settings: Settings, jobs: int | None, results: Answers) -> None:
    from rich.console import Console

    from canon.report.console import progress

    console = Console(stderr=True)
    if not (console.is_terminal and entries):
        _collect(entries, settings, jobs, results)
        return
    with progress(len(entries), console) as bar:
        _collect(
            entries,
            settings,
            jobs,
            results,
            lambda done, running: bar.update(done, entries[running[0]].file if running else ""),
        )


def _with_lines(entries: list[Entry], settings: Settings, jobs: int | None, results: Answers) -> None:
    from canon.report.plain import Columns
    from canon.report.words import name

    heads = [{"title": entry.claim.title, "kind": entry.claim.kind} for entry in entries if entry.claim is not None]
    columns = Columns.of([(entry.file, entry.index) for entry in entries], [name(head) for head in heads])
    printed = 0

    def catch_up() -> None:
        nonlocal printed
        while printed in results:
            if "claim" in results[printed]:
                print(columns.line(results[printed]["claim"]), flush=True)
            printed += 1

    catch_up()
    for position, answer in _answers(entries, settings, jobs, dict(results)):
        results[position] = answer
        catch_up()
