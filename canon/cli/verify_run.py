"""Running the claims of `canon verify`: in silence, with a bar, or line by line; what is remembered isn't run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from canon.claims.worker import Entry, Settings

Record = dict[str, Any]
Answers = dict[int, Record]
Watcher = Callable[[int, Sequence[int]], None]
Told = Callable[[int, Record], None]
Ask = Callable[..., Iterator[tuple[int, Record]]]


def run_claims(
    entries: list[Entry],
    settings: Settings,
    results: Answers,
    *,
    jobs: int | None = None,
    cluster: str | None = None,
    terminal: bool,
    quiet: bool,
    told: Told | None = None,
) -> None:
    """Verify the claims that `results` has no answer to, and put theirs in by position.

    **Arguments:** `jobs`, the number of worker processes, or `cluster`, the address of a cluster; `terminal`, whether
    to draw a bar; `quiet`, whether to print nothing; else a line for each answer; `told`, what is
    told of each answer as it comes, with its position.

    **Raises:** `InputError` where there is no such cluster.
    """
    ask = partial(_answers, entries, settings, jobs, cluster, dict(results), told)
    if terminal:
        _with_bar(entries, ask, results)
    elif quiet:
        _collect(ask, results)
    else:
        _with_lines(entries, ask, results)


def _answers(
    entries: list[Entry],
    settings: Settings,
    jobs: int | None,
    cluster: str | None,
    known: Answers,
    told: Told | None,
    watch: Watcher | None = None,
) -> Iterator[tuple[int, Record]]:
    """(position, answer) of the entries that aren't known."""
    from canon.claims.run import run
    from canon.report.proof_file import recorder

    open_ones = [position for position in range(len(entries)) if position not in known]
    asked = [entries[position] for position in open_ones]

    def seen(done: int, running: Sequence[int]) -> None:
        assert watch is not None
        watch(done + len(entries) - len(asked), [open_ones[k] for k in running])

    watcher = None if watch is None else seen
    if cluster is not None and asked:
        from canon.cli.cluster import answers_of

        answers = answers_of(cluster, asked, settings)
    else:
        answers = run(asked, settings, recorder(settings), jobs=jobs, watch=watcher)
    for position, answer in answers:
        if told is not None:
            told(open_ones[position], answer)
        yield open_ones[position], answer


def _collect(ask: Ask, results: Answers, watch: Watcher | None = None) -> None:
    for position, answer in ask(watch):
        results[position] = answer


def _with_bar(entries: list[Entry], ask: Ask, results: Answers) -> None:
    from canon.report.console import progress
    from canon.report.console import terminal as here

    console = here(stderr=True)
    if not (console.is_terminal and entries):
        _collect(ask, results)
        return
    with progress(len(entries), console) as bar:
        _collect(ask, results, lambda done, running: bar.update(done, entries[running[0]].file if running else ""))


def _with_lines(entries: list[Entry], ask: Ask, results: Answers) -> None:
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
    for position, answer in ask():
        results[position] = answer
        catch_up()
