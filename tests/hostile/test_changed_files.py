"""Files that change while they are worked on, and a cache in which anything may lie: no answer is kept of what a file
didn't say."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

import canon.claims.reader as reader
import canon.claims.remembered as remembered
import canon.claims.run as runs
import canon.cli.verify as verify
from canon.claims.document import digest
from canon.claims.reader import read_text
from canon.claims.remembered import KEPT, Memory, forget_the_oldest, recall, remember
from canon.claims.worker import Entry, Settings, _answer
from canon.cli.files import ClaimFile
from canon.cli.main import main
from canon.report.record import claim_record
from tests.hostile.test_faults import CLAIMS

TRUE = CLAIMS.split('[[claim]]\nkind = "bracket"\nf')[0]
FALSE = TRUE.replace('equals = "1"', 'equals = "3"')
Change = Callable[[Path, str], None]


@pytest.fixture
def changing(monkeypatch: pytest.MonkeyPatch) -> Change:
    """Says what a file is to say, or that it is gone, as soon as it has been read; once. Claims are decided here."""

    def run(entries, settings, recorder, **_options):
        for position, entry in enumerate(entries):
            yield position, _answer(entry, settings, recorder)

    def change(path: Path, text: str) -> None:
        def read_and_changed(said: str) -> reader.Reading:
            found = read_text(said)
            if text:
                path.write_text(text, encoding="utf-8")
            else:
                path.unlink()
            monkeypatch.setattr(reader, "read_text", read_text)
            return found

        monkeypatch.setattr(reader, "read_text", read_and_changed)

    monkeypatch.setattr(runs, "run", run)
    return change


def told(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return [claim["verdict"] for claim in json.loads(capsys.readouterr().out)["claims"]]


def test_a_journal_answers_for_what_was_read(tmp_path: Path, changing: Change, capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(TRUE, encoding="utf-8")
    changing(file, FALSE)
    command = ["verify", str(file), "--json", "--resume", str(kept)]
    assert main(command) == 0
    assert told(capsys) == ["proved"]
    assert main(command) == 1
    assert told(capsys) == ["refuted"]
    assert len(kept.read_text().splitlines()) == 2


def test_so_does_what_is_remembered(tmp_path: Path, changing: Change, capsys, monkeypatch) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(TRUE, encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(verify, "_catalogue", lambda: [ClaimFile("one.toml", file)])
    monkeypatch.setattr(remembered, "fingerprint", lambda: "0" * 32)
    changing(file, FALSE)
    assert main(["verify", "--json"]) == 0
    assert told(capsys) == ["proved"]
    assert main(["verify", "--json"]) == 1
    assert told(capsys) == ["refuted"]


@pytest.mark.parametrize("text", [FALSE, ""])
def test_no_certificate_quotes_another_file(tmp_path: Path, text: str, changing: Change, capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "kept"
    file.write_text(TRUE, encoding="utf-8")
    changing(file, text)
    proofs = ["--proof", str(tmp_path / "proofs.md")]
    assert main(["verify", str(file), "--certificate", str(kept), *proofs]) == 74
    out, err = capsys.readouterr()
    assert "1 proved" in out
    assert "1 certificates are missing" in err
    assert ("has changed since it was read" if text else "there is no such file") in err
    assert list(kept.iterdir()) == []


def test_a_worker_that_reads_again_reads_the_same(tmp_path: Path) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(FALSE, encoding="utf-8")
    entry = Entry("claims.toml", 0, None, str(file), digest=digest(TRUE))
    assert _answer(entry, Settings(), claim_record)["error"]["message"] == "has changed since it was read"
    same = Entry("claims.toml", 0, None, str(file), digest=digest(FALSE))
    assert _answer(same, Settings(), claim_record)["claim"]["verdict"] == "refuted"


# -- a cache in which anything lies ------------------------------------------------------------------------


def memory(folder: Path) -> Memory:
    return Memory(folder / "0123456789abcdef0123456789abcdef", "settings")


@pytest.mark.parametrize("what", ["pipe", "device", "folder", "loop", "large"])
def test_an_entry_that_is_no_file_is_no_memory(what: str, tmp_path: Path) -> None:
    """Reading it would wait for ever, or never come to its end."""
    file, kept = tmp_path / "claims.toml", memory(tmp_path)
    file.write_text(TRUE, encoding="utf-8")
    place = kept.entry(digest(TRUE))
    place.parent.mkdir()
    if what == "pipe":
        os.mkfifo(place)
    elif what == "large":
        place.write_bytes(b" " * (remembered.LARGEST + 1))
    elif what == "folder":
        place.mkdir()
    else:
        place.symlink_to("/dev/zero" if what == "device" else place.name)
    assert recall(kept, file, "name") is None
    claims = read_text(TRUE).claims
    remember(kept, digest(TRUE), claims, [{"verdict": "proved"}] * len(claims))
    assert recall(kept, file, "name") is None


def test_only_what_is_ours_is_forgotten(tmp_path: Path) -> None:
    """A folder that is linked to, or isn't named as a state is, is somebody's work."""
    work = tmp_path / "work"
    kept = memory(tmp_path / "verdicts")
    for folder in (work, kept.folder, *(tmp_path / "verdicts" / name for name in ("mine", f"{1:032x}", f"{2:032x}"))):
        folder.mkdir(parents=True)
        (folder / "results.json").write_text("{}")
    (tmp_path / "verdicts" / f"{2:032x}" / "thesis.tex").write_text("for years")
    (tmp_path / "verdicts" / f"{3:032x}").symlink_to(work)
    for k in range(10, 10 + KEPT):
        (tmp_path / "verdicts" / f"{k:032x}").mkdir()
    for k in (1, 2):
        os.utime(tmp_path / "verdicts" / f"{k:032x}", (k, k))
    os.utime(work, (0, 0))
    forget_the_oldest(kept)
    assert (work / "results.json").exists()
    assert (tmp_path / "verdicts" / "mine" / "results.json").exists()
    assert (tmp_path / "verdicts" / f"{2:032x}" / "thesis.tex").exists()
    assert not (tmp_path / "verdicts" / f"{1:032x}").exists()
    assert (kept.folder / "results.json").exists()
