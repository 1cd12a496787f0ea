"""Many claims at once, from Python: either way of starting workers, and what the caller is told meanwhile."""

from pathlib import Path

import pytest

from canon.claims.reader import read_file
from canon.claims.run import GIB, available_cores, memory_limit, run
from canon.claims.worker import Entry, Settings
from canon.report.record import claim_record

FILE = """
[phase_space]
q = ["q"]
p = ["p"]

[[claim]]
kind = "bracket"
f = "q"
g = "p"
equals = "1"

[[claim]]
kind = "bracket"
f = "q**2"
g = "p"
equals = "q"
"""


@pytest.fixture
def entries(tmp_path: Path) -> list[Entry]:
    path = tmp_path / "brackets.toml"
    path.write_text(FILE, encoding="utf-8")
    claims, problems = read_file(path)
    assert not problems
    return [Entry("brackets.toml", claim.index, claim, str(path)) for claim in claims]


def test_spawned_workers_read_the_files_again(entries: list[Entry]) -> None:
    answers = dict(run(entries, Settings(), claim_record, jobs=1, start_method="spawn"))
    assert [answers[position]["claim"]["verdict"] for position in (0, 1)] == ["proved", "refuted"]
    assert answers[1]["claim"]["index"] == 1


def test_the_watcher_is_told_how_many_are_done(entries: list[Entry]) -> None:
    seen: list[int] = []
    answers = list(run(entries, Settings(), claim_record, jobs=1, watch=lambda done, running: seen.append(done)))
    assert len(answers) == 2
    assert seen[-1] == 2
    assert seen == sorted(seen)


def test_leaving_early_is_fine(entries: list[Entry]) -> None:
    answers = run(entries, Settings(), claim_record, jobs=2)
    next(iter(answers))
    answers.close()  # type: ignore[attr-defined]


def test_no_claims_no_workers() -> None:
    assert list(run([], Settings(), claim_record)) == []


def test_limits() -> None:
    assert available_cores() >= 1
    assert (memory_limit(1000) or 2 * GIB) == 2 * GIB


def test_grace_is_bounded() -> None:
    entry = Entry("f", 0, None)
    assert Settings(budget=0.1).grace(entry) == 1
    assert Settings(budget=1000).grace(entry) == 5
