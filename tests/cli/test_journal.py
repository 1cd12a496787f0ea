"""`canon verify --resume`: a campaign that is interrupted anywhere and gone on with has the verdicts of a whole one."""

from __future__ import annotations

import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import canon.claims.run as runs
from canon.claims.journal import answered, journal, write
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.claims.worker import Entry, Settings
from canon.cli.main import main
from canon.errors import InputError

CLAIM = '[[claim]]\nkind = "bracket"\nf = "q**{k}"\ng = "p"\nequals = "{value}"\nexpect = "{expect}"\n'
HEAD = '[phase_space]\nq = ["q"]\np = ["p"]\n'


def claims(count: int) -> str:
    """Brackets {q^k, p} = k q^(k-1), every third one with a factor."""
    text = HEAD
    for k in range(1, count + 1):
        value = f"{k}*q**{k - 1}" + "*1001/1000" * (k % 3 == 0)
        text += CLAIM.format(k=k, value=value, expect="fails" if k % 3 == 0 else "holds")
    return text


class Stopped(KeyboardInterrupt):
    """Somebody presses Ctrl-C."""


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The claims that were verified, in this process, by their numbers; before the one of number -asked[0] it stops."""
    numbers: list[int] = []

    def here(entries, settings, recorder, **_options):
        for position, entry in enumerate(entries):
            if numbers and numbers[0] < 0:
                numbers[0] += 1
                if not numbers[0]:
                    del numbers[0]
                    raise Stopped
            verdict = verify(entry.claim, budget=settings.budget, seed=settings.seed, method=settings.method)
            numbers.append(entry.index)
            yield position, {"claim": recorder(entry, entry.claim, verdict), "retire": False}

    monkeypatch.setattr(runs, "run", here)
    return numbers


def verdicts(capsys: pytest.CaptureFixture[str], *arguments: object, status: int = 0) -> list[tuple]:
    assert main(["verify", "--json", *map(str, arguments)]) == status
    record = json.loads(capsys.readouterr().out)
    keys = ("file", "index", "kind", "verdict", "expected", "method", "witness", "detail")
    return [tuple(claim[key] for key in keys) for claim in record["claims"]]


def test_interrupted_at_random_and_resumed(tmp_path: Path, asked: list[int], capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(claims(40))
    whole = verdicts(capsys, file)
    asked.clear()
    rng, begun = random.Random(1), 0
    while True:
        asked[:0] = [-rng.randint(1, 12)]
        done = main(["verify", "--json", str(file), "--resume", str(kept)])
        part = json.loads(capsys.readouterr().out)
        if done == 0:
            break
        assert done == 130
        assert len(part["claims"]) == len([k for k in asked if k >= 0])
        begun += 1
    asked[:] = [k for k in asked if k >= 0]
    assert begun > 3
    assert sorted(asked) == list(range(40))  # each of them once
    assert verdicts(capsys, file, "--resume", kept) == whole
    assert len(asked) == 40


def test_what_the_answer_depends_on_is_asked_again(tmp_path: Path, asked: list[int], capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(claims(3))
    verdicts(capsys, file, "--resume", kept)
    for options in ([], ["--seed", "1"], ["--budget", "3"], ["--method", "all"]):
        asked.clear()
        verdicts(capsys, file, "--resume", kept, *options)
        assert len(asked) == (3 if options else 0), options
    asked.clear()
    file.write_text(claims(3).replace("1001", "1002"))
    verdicts(capsys, file, "--resume", kept)
    assert len(asked) == 3


def test_answers_of_another_version_or_other_options_are_counted(
    tmp_path: Path, asked: list[int], capsys, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(claims(3))
    words = "of its answers are of another version of canon or other options, and not used"
    for options, others in ([], 0), ([], 0), (["--seed", "1"], 3), ([], 3):
        assert main(["verify", "--json", str(file), "--resume", str(kept), *options]) == 0
        said = capsys.readouterr().err
        assert said == (f"canon verify: --resume {kept}: {others} {words}\n" if others else "")
    asked.clear()
    monkeypatch.setattr("canon.claims.journal.fingerprint", lambda: "another")
    assert main(["verify", "--json", str(file), "--resume", str(kept)]) == 0
    assert f"6 {words}" in capsys.readouterr().err
    assert len(asked) == 3


def test_lines_that_are_damaged_are_none(tmp_path: Path, asked: list[int], capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(claims(6))
    whole = verdicts(capsys, file, "--resume", kept)
    lines = kept.read_bytes().splitlines(keepends=True)
    lines[0] = lines[0].replace(b'"method": "', b'"method": "some other ')  # the checksum no longer fits
    lines[1] = lines[1][:50] + b"\xff" + lines[1][51:]
    lines[2] = b"[" * 100_000 + b"\n"
    lines[5] = lines[5][:-40]  # cut short
    kept.write_bytes(b"".join(lines))
    asked.clear()
    assert verdicts(capsys, file, "--resume", kept) == whole
    assert sorted(asked) == [0, 1, 2, 5]
    asked.clear()
    assert verdicts(capsys, file, "--resume", kept) == whole
    assert asked == []


@pytest.mark.parametrize(
    "changed",
    [
        {"verdict": "certain"}, {"index": 1}, {"kind": "volume"}, {"expected": None}, {"detail": []}, {"seconds": "x"},
        {"witness": 3}, {"method": None}, {"verdict": "refuted", "expected": True}, {"certificate": 1},
        {"matters": [["q"]]}, {"matters": "q"}, {"detail": {"certificate_error": ["q"]}},
    ],
)  # fmt: skip
def test_answers_that_fit_no_claim_are_none(tmp_path: Path, changed: dict) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(claims(1))
    (claim,) = read_text(claims(1)).claims
    entry = Entry("claims.toml", 0, claim, str(file))
    record = {
        "file": "other", "index": 0, "kind": "bracket", "title": None, "verdict": "proved", "expected": True,
        "method": "", "seconds": 0.1, "numeric": None, "witness": None, "certificate": None, "detail": {},
    }  # fmt: skip
    kept = journal(tmp_path / "journal", Settings())
    write(kept, entry, {"claim": {**record, **changed}})
    assert answered(kept, [entry]) == {}
    write(kept, entry, {"claim": record})
    assert answered(kept, [entry]) == {0: {"claim": {**record, "file": "claims.toml"}}}


def test_what_is_no_journal_is_left_alone(tmp_path: Path, asked: list[int], capsys) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(claims(1))
    os.mkfifo(tmp_path / "pipe")
    before = file.read_bytes()
    for name in (file, tmp_path / "pipe", tmp_path, tmp_path / "none/journal"):
        assert main(["verify", str(file), "--resume", str(name)]) == 3
        assert f"canon verify: --resume {name}: " in capsys.readouterr().err
    assert file.read_bytes() == before
    assert asked == []


def test_a_full_disk_costs_the_journal_alone(tmp_path: Path, asked: list[int], capsys) -> None:
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(claims(8))
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1500, hard))  # Python ignores the signal that goes with it
    try:
        assert main(["verify", "--json", str(file), "--resume", str(kept)]) == 74
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    out, err = capsys.readouterr()
    assert len(json.loads(out)["claims"]) == 8
    assert "the answers since then are not in it" in err
    asked.clear()
    assert len(verdicts(capsys, file, "--resume", kept)) == 8
    assert 0 < len(asked) < 8


STAND_IN = Path(__file__).with_name("stand_in.py")


def test_killed_outright_and_resumed_by_two_at_once(tmp_path: Path) -> None:
    """SIGKILL leaves nobody the time to write anything; then two runs go on with one journal."""
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text("fine " * 30 + "gate " * 16 + "!false " * 10)
    command = [sys.executable, str(STAND_IN), "verify", "--json", str(file), "--resume", str(kept), "--jobs", "2"]
    command += ["--budget", "300"]
    gated = {**os.environ, "GATE": str(tmp_path / "open")}
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL, env=gated)
    deadline = time.monotonic() + 60
    while not (kept.exists() and kept.read_bytes().count(b"\n") == 30) and time.monotonic() < deadline:
        time.sleep(0.01)
    first.send_signal(signal.SIGKILL)
    first.wait()
    assert kept.read_bytes().count(b"\n") == 30
    (tmp_path / "open").touch()
    both = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=gated) for _ in range(2)]
    records = [json.loads(process.communicate(timeout=60)[0]) for process in both]
    for record in records:
        assert [claim["index"] for claim in record["claims"]] == list(range(56))
        assert record["summary"] == {"proved": 46, "refuted": 10, "supported": 0, "undecided": 0, "errors": 0}
    lines = kept.read_bytes().splitlines()
    assert all(json.loads(line) for line in lines)
    assert len(lines) >= 56


def test_a_journal_is_not_where_a_certificate_goes(tmp_path: Path, capsys) -> None:
    file, folder = tmp_path / "claims.toml", tmp_path / "certificates"
    file.write_text(claims(2))
    for name in ("claims.1.json", "below/x.json"):
        options = ["--certificate", str(folder), "--resume", str(folder / name)]
        assert main(["verify", str(file), *options]) == 3
        assert "might be written over the journal" in capsys.readouterr().err
    assert not folder.exists() or not any(folder.iterdir())


def test_errors_are_answers_too(tmp_path: Path) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(HEAD + '[domain]\nwhere = ["q > 1", "q < 0"]\n' + CLAIM.format(k=1, value="1", expect="holds"))
    (claim,) = read_text(file.read_text()).claims
    entry = Entry("claims.toml", 0, claim, str(file))
    kept = journal(tmp_path / "journal", Settings())
    error = {"file": "claims.toml", "where": "claim 1", "message": "the domain seems empty"}
    write(kept, entry, {"error": error})
    assert answered(kept, [entry]) == {0: {"error": error}}


@pytest.mark.parametrize("line", [b"\n", b"{}\n", b"9" * 40 + b"\n"])
def test_what_is_damaged_all_over_is_not_read_to_its_end(line: bytes, tmp_path: Path) -> None:
    """A journal of 100 MB of empty lines would take minutes."""
    (claim,) = read_text(claims(1)).claims
    entry = Entry("claims.toml", 0, claim, str(tmp_path / "claims.toml"))
    kept = journal(tmp_path / "journal", Settings())
    write(kept, entry, {"error": {"file": "claims.toml", "where": "", "message": "first"}})
    with kept.path.open("ab") as file:
        file.write(line * 9_000)
    assert answered(kept, [entry])
    with kept.path.open("ab") as file:
        file.write(line * 2_000)
    with pytest.raises(InputError, match="more than 10000 lines of this journal are damaged"):
        answered(kept, [entry])


def test_a_certificate_that_is_missing_is_made_again(tmp_path: Path, asked: list[int], capsys) -> None:
    """Its folder was removed, or the disk was full; and of two files that say the same each has its own."""
    first, second, kept, folder = (tmp_path / name for name in ("a.toml", "b.toml", "journal", "certificates"))
    for file in (first, second):
        file.write_text(claims(3))
    command = ["verify", "--json", str(first), str(second), "--resume", str(kept), "--certificate", str(folder)]

    def again() -> int:
        asked.clear()
        assert main(command) == 0
        found = [claim["certificate"] for claim in json.loads(capsys.readouterr().out)["claims"]]
        assert sorted(found) == sorted(map(str, folder.iterdir()))
        assert len(set(found)) == 6
        return len(asked)

    folder.mkdir()
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10, hard))  # neither the journal nor a certificate fits
    try:
        assert main(command) == 74
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    capsys.readouterr()
    assert [again(), again()] == [6, 0]
    sorted(folder.iterdir())[1].unlink()
    assert [again(), again()] == [1, 0]
    for file in folder.iterdir():
        file.unlink()
    folder.rmdir()
    folder.write_text("")  # in the place of the folder, while the run goes on
    monkey = pytest.MonkeyPatch()
    monkey.setattr("canon.cli.verify.not_a_folder", lambda *_: "")
    assert main(command) == 74
    monkey.undo()
    capsys.readouterr()
    folder.unlink()
    assert [again(), again()] == [6, 0]
