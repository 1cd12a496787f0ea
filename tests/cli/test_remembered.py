"""The catalogue's verdicts are remembered by content, and never trusted when they are damaged."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import canon.claims.remembered as remembered
import canon.claims.run as runs
import canon.cli.verify as verify
from canon.claims.verify import verify as decided
from canon.cli.files import ClaimFile
from canon.cli.main import main

CLAIMS = """
[phase_space]
q = ["q"]
p = ["p"]
[[claim]]
kind = "bracket"
title = "true"
f = "q"
g = "p"
equals = "1"
[[claim]]
kind = "bracket"
title = "false"
f = "q"
g = "p"
equals = "2"
expect = "fails"
"""


@pytest.fixture
def catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A catalogue of one file, and a folder for what is remembered."""
    file = tmp_path / "one.toml"
    file.write_text(CLAIMS)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(verify, "_catalogue", lambda: [ClaimFile("course/one.toml", file)])
    monkeypatch.setattr(remembered, "fingerprint", lambda: "this state")
    return file


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many claims were run, one number for each run; they are verified in this process."""
    counts: list[int] = []

    def counted(entries, settings, recorder, **_options):
        counts.append(len(entries))
        for position, entry in enumerate(entries):
            verdict = decided(entry.claim, budget=settings.budget, seed=settings.seed, method=settings.method)
            yield position, {"claim": recorder(entry, entry.claim, verdict)}

    monkeypatch.setattr(runs, "run", counted)
    return counts


def _answers(capsys: pytest.CaptureFixture[str], *options: str) -> list[tuple]:
    assert main(["verify", "--json", *options]) == 0
    record = json.loads(capsys.readouterr().out)
    return [(c["file"], c["index"], c["title"], c["verdict"], c["witness"]) for c in record["claims"]]


def test_the_second_run_asks_nothing(catalogue, asked, capsys) -> None:
    first = _answers(capsys)
    assert _answers(capsys) == first
    assert asked == [2, 0]
    assert main(["verify"]) == 0
    assert "2 claims in 1 file: 1 proved, 1 refuted (as expected)" in capsys.readouterr().out
    assert _answers(capsys, "--catalogue") == first
    assert main(["verify", "--catalogue", "--coverage"]) == 0


@pytest.mark.parametrize("option", ["--coverage", "--catalogue"])
def test_the_catalogue_is_no_file(option, capsys) -> None:
    assert main(["verify", "claims.toml", option]) == 3
    assert f"{option} speaks of the built-in catalogue" in capsys.readouterr().err


@pytest.mark.parametrize("options", [["--fresh"], ["--seed", "1"], ["--budget", "3"], ["--method", "all"]])
def test_other_settings_and_fresh_ask_again(catalogue, asked, capsys, options) -> None:
    _answers(capsys)
    _answers(capsys, *options)
    assert asked == [2, 2]


def test_a_changed_file_or_decider_is_asked_again(catalogue, asked, capsys, monkeypatch) -> None:
    _answers(capsys)
    catalogue.write_text(CLAIMS.replace('equals = "2"', 'equals = "3"'))
    _answers(capsys)
    monkeypatch.setattr(remembered, "fingerprint", lambda: "another state")
    _answers(capsys)
    assert asked == [2, 2, 2]


@pytest.mark.parametrize("damage", [b"", b"{", b"[]", b"{}", b"\xff", b'{"checksum": "0", "body": {"format": 1}}'])
def test_damaged_entries_are_ignored(catalogue, asked, capsys, tmp_path, damage) -> None:
    first = _answers(capsys)
    (entry,) = (tmp_path / "cache/canon/verdicts/this state").iterdir()
    entry.write_bytes(damage)
    assert _answers(capsys) == first
    assert asked == [2, 2]


@pytest.mark.parametrize(("one", "other"), [('"refuted"', '"proved"'), ('"title": "true"', '"title": "false"')])
def test_a_tampered_verdict_is_ignored(catalogue, asked, capsys, tmp_path, one, other) -> None:
    """Also where it would fit: the title of a claim and of its record are changed together."""
    first = _answers(capsys)
    (entry,) = (tmp_path / "cache/canon/verdicts/this state").iterdir()
    text = entry.read_text()
    entry.write_text(text.replace(one, other))
    assert entry.read_text() != text
    assert _answers(capsys) == first
    assert asked == [2, 2]


def test_an_entry_in_the_place_of_another_is_none(catalogue, asked, capsys, tmp_path, monkeypatch) -> None:
    """It is whole, and has the right checksum, but is about another file, or of another state of the deciders."""
    first = _answers(capsys)
    (old,) = (tmp_path / "cache/canon/verdicts/this state").iterdir()
    kept = old.read_text()
    catalogue.write_text(CLAIMS.replace('"false"', '"wrong"'))
    second = _answers(capsys)
    (new,) = set(old.parent.iterdir()) - {old}
    new.write_text(kept)
    assert _answers(capsys) == second != first
    monkeypatch.setattr(remembered, "fingerprint", lambda: "another state")
    catalogue.write_text(CLAIMS)
    there = tmp_path / "cache/canon/verdicts/another state"
    there.mkdir()
    (there / old.name).write_text(kept)
    assert _answers(capsys) == first
    assert asked == [2, 2, 2, 2]


def test_without_a_folder_nothing_is_lost(catalogue, asked, capsys, tmp_path) -> None:
    (tmp_path / "cache").write_text("no folder")
    first = _answers(capsys)
    assert _answers(capsys) == first
    assert asked == [2, 2]


def test_the_fingerprint_is_that_of_the_sources() -> None:
    assert remembered.fingerprint() == remembered.fingerprint()
    assert len(remembered.fingerprint()) == 32
