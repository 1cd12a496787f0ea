"""Faults of the machine: a full disk, a closed pipe, no home, another alphabet, a clock that jumps, killed workers."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import count
from pathlib import Path

import pytest

import canon.claims.remembered as remembered
import canon.claims.run as runs
from canon.budget import Budget
from canon.claims.document import digest
from canon.claims.reader import read_text
from canon.claims.remembered import Memory, recall, remember
from canon.claims.worker import Entry, Settings
from canon.cli.main import main
from canon.report.record import claim_record
from tests.short_scenes import PENDULUM

CLAIMS = """
[phase_space]
q = ["q"]
p = ["p"]
[[claim]]
kind = "bracket"
title = "Poisson’s bracket of ϑ"
f = "q"
g = "p"
equals = "1"
[[claim]]
kind = "bracket"
f = "q"
g = "p"
equals = "2"
expect = "fails"
"""
CANON = [sys.executable, "-m", "canon"]


@contextmanager
def full_disk(left: int) -> Iterator[None]:
    """No file may grow beyond so many bytes (Python ignores the signal that goes with it)."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (left, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.fixture
def forked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers are forked, though other tests may have loaded what keeps canon from it."""
    monkeypatch.setattr(runs, "_start_method", lambda: "fork")


@pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no device that is full here")
def test_output_to_a_full_disk_is_an_error_of_its_own(tmp_path: Path) -> None:
    """Not status 1, which says that a claim is refuted."""
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    with open("/dev/full", "w") as full:
        command = [*CANON, "verify", str(tmp_path / "claims.toml")]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == 74
    assert done.stderr == "canon: the output could not be written: No space left on device\n"


def test_a_reader_that_hangs_up_ends_the_run(tmp_path: Path) -> None:
    """As `| head` does. What was answered until then is in the journal, and no worker goes on."""
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(CLAIMS, encoding="utf-8")
    read, write = os.pipe()
    os.close(read)
    command = [*CANON, "verify", str(file), "--jobs", "1", "--resume", str(kept)]
    done = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True, timeout=60)
    os.close(write)
    assert (done.returncode, done.stderr) == (141, "")
    assert kept.read_bytes().count(b"\n") >= 1


def test_a_full_disk_costs_the_files_and_not_the_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, states = tmp_path / "scene.toml", tmp_path / "states.npz"
    scene.write_text(PENDULUM)
    states.write_bytes(b"what was here before")
    with full_disk(200):
        assert main(["simulate", str(scene), "--out", str(states)]) == 74
    out, err = capsys.readouterr()
    assert "states      5, from t = 0 to 2" in out
    assert err == f"canon simulate: --out {states} can't be written: File too large\n"
    assert states.read_bytes() == b"what was here before"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scene.toml", "states.npz"]


def test_a_certificate_that_is_missing_is_missed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], forked: None
) -> None:
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    with full_disk(100):
        assert main(["verify", "claims.toml", "--certificate", "kept"]) == 74
    out, err = capsys.readouterr()
    assert "1 proved, 1 refuted (as expected)" in out
    assert err.startswith("canon verify: 2 certificates are missing: kept/claims.1.json can't be written")
    assert list((tmp_path / "kept").iterdir()) == []


def test_no_device_is_replaced_by_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Who may write into /dev could otherwise lose it: a file is written beside its place and put there."""
    (tmp_path / "scene.toml").write_text(PENDULUM)
    os.mkfifo(tmp_path / "pipe")
    for name in ("/dev/null", str(tmp_path / "pipe"), str(tmp_path)):
        assert main(["simulate", str(tmp_path / "scene.toml"), "--out", name]) == 3
        assert "is no regular file" in capsys.readouterr().err
    assert Path("/dev/null").is_char_device()


def test_a_bare_environment_is_enough(tmp_path: Path) -> None:
    """No home, no terminal, another alphabet."""
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    bare = {
        "PATH": os.environ["PATH"],
        "PYTHONPATH": os.pathsep.join(sys.path),
        "LC_ALL": "C",
        "PYTHONUTF8": "0",
        "PYTHONIOENCODING": "ascii",
    }
    command = [*CANON, "verify", str(tmp_path / "claims.toml")]
    done = subprocess.run(command, capture_output=True, timeout=60, env=bare, stdin=subprocess.DEVNULL)
    assert done.returncode == 0
    assert done.stderr == b""
    assert b"1 proved, 1 refuted (as expected)" in done.stdout


def test_without_a_home_nothing_is_remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", lambda: (_ for _ in ()).throw(RuntimeError("no home")))
    assert remembered.memory(Settings()) is None


def test_a_folder_that_cant_be_written_to_is_no_error(tmp_path: Path) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(CLAIMS, encoding="utf-8")
    claims = read_text(CLAIMS).claims
    records = [{"verdict": "proved"}, {"verdict": "refuted"}]
    for folder in (Path("/proc/none"), file / "below"):
        remember(Memory(folder, "settings"), digest(CLAIMS), claims, records)
        assert recall(Memory(folder, "settings"), file, "name") is None
    kept = Memory(tmp_path / "kept", "settings")
    with full_disk(100):
        remember(kept, digest(CLAIMS), claims, records)
    assert recall(kept, file, "name") is None
    assert list(kept.folder.iterdir()) == []


def test_two_runs_that_remember_at_once_spoil_nothing(tmp_path: Path) -> None:
    """Each writes beside the place and puts it there whole: a reader sees one or the other."""
    file = tmp_path / "claims.toml"
    file.write_text(CLAIMS, encoding="utf-8")
    claims, kept = read_text(CLAIMS).claims, Memory(tmp_path / "kept", "settings")
    whole = {"expected": False, "method": "", "detail": {}, "seconds": 0.0, "numeric": None, "witness": None}
    told = [{"kind": c.kind, "title": c.title, "index": c.index, "certificate": None, **whole} for c in claims]
    records = [[{**of, "verdict": word, "long": word * 50_000} for of in told] for word in ("proved", "refuted")]
    remember(kept, digest(CLAIMS), claims, records[0])
    child = os.fork()
    if child == 0:
        until = time.monotonic() + 0.5
        while time.monotonic() < until:
            remember(kept, digest(CLAIMS), claims, records[1])
        os._exit(0)
    seen = set()
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        remember(kept, digest(CLAIMS), claims, records[0])
        found = recall(kept, file, "name")
        assert found is not None
        seen.add(found[1][0]["verdict"])
    assert seen <= {"proved", "refuted"}
    assert len(list(kept.folder.iterdir())) == 1


def test_a_memory_with_anything_in_it_is_none(tmp_path: Path) -> None:
    """Also under a checksum that is right."""
    file = tmp_path / "claims.toml"
    file.write_text(CLAIMS, encoding="utf-8")
    claims, kept = read_text(CLAIMS).claims, Memory(tmp_path / "kept", "settings")
    whole = {"expected": False, "method": "", "detail": {}, "seconds": 0.0, "numeric": None, "witness": None}
    told = [
        {"kind": c.kind, "title": c.title, "index": c.index, "certificate": None, "verdict": "proved", **whole}
        for c in claims
    ]
    remember(kept, digest(CLAIMS), claims, told)
    assert recall(kept, file, "name") is not None
    evidence = {"points": 3, "max_residual": 1e-9, "bound": 1e-8, "bits": 53}
    remember(kept, digest(CLAIMS), claims, [{**told[0], "numeric": evidence}, told[1]])
    assert recall(kept, file, "name") is not None
    deep: dict = {}
    for _ in range(400):
        deep = {"a": deep}
    strange = [("verdict", "certain"), ("detail", None), ("expected", 1), ("kind", "volume"), ("witness", [])]
    strange += [("numeric", {}), ("numeric", {**evidence, "points": {}}), ("numeric", {**evidence, "bound": []})]
    strange += [("detail", {"value": deep}), ("seconds", 10**400)]
    for key, value in strange:
        remember(kept, digest(CLAIMS), claims, [{**told[0], key: value}, told[1]])
        assert recall(kept, file, "name") is None
    for key in told[1]:
        remember(
            kept, digest(CLAIMS), claims, [told[0], {k: v for k, v in told[1].items() if k != key or k == "verdict"}]
        )
        assert (recall(kept, file, "name") is None) == (key != "verdict"), key


@pytest.mark.parametrize("step", [3600.0, -3600.0])
def test_a_clock_that_jumps_changes_no_verdict(step: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Budgets are measured by a clock that doesn't; the one that does is asked by nobody."""

    hours = count(10.0**9, step)
    monkeypatch.setattr(time, "time", lambda: next(hours))
    assert not any(Budget(60.0).spent() for _ in range(8))
    entries = [Entry("claims.toml", claim.index, claim) for claim in read_text(CLAIMS).claims]
    answers = dict(runs.run(entries, Settings(budget=5.0), claim_record, jobs=1, start_method="fork"))
    assert [answers[k]["claim"]["verdict"] for k in (0, 1)] == ["proved", "refuted"]


def test_the_number_of_workers_changes_nothing(forked: None, capsys: pytest.CaptureFixture[str]) -> None:
    """Nor does the order in which the claims are asked."""
    from canon.catalogue import files

    chosen = [str(path) for path in sorted(map(str, files())) if "/brackets/" in path][:5]
    found = []
    for jobs, names in (("1", chosen), ("3", chosen), ("2", chosen[::-1])):
        assert main(["verify", "--json", "--jobs", jobs, *names]) == 0
        claims = json.loads(capsys.readouterr().out)["claims"]
        timed = ("seconds",)
        shown = [{key: value for key, value in claim.items() if key not in timed} for claim in claims]
        found.append(sorted(shown, key=lambda claim: (claim["file"], claim["index"])))
    assert len(found[0]) > 4
    assert found[0] == found[1] == found[2]


def test_a_product_that_holds_the_interpreter_is_killed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A multiplication of polynomials in C looks at no clock: its worker is killed, and the next claim is answered."""
    import canon.claims.verify as deciders

    real = deciders.verify

    def runaway(claim, **options):
        if claim.index == 0:
            import flint

            n = flint.fmpz(3) ** 400_000_000  # minutes, in one call
            return n
        return real(claim, **options)

    monkeypatch.setattr(deciders, "verify", runaway)
    first, *others = read_text(CLAIMS).claims
    entries = [Entry("claims.toml", claim.index, claim) for claim in (replace(first, budget=0.3), *others)]
    start = time.monotonic()
    answers = dict(runs.run(entries, Settings(budget=60.0), claim_record, jobs=1, start_method="fork"))
    assert time.monotonic() - start < 60
    assert answers[0]["claim"]["verdict"] == "undecided"
    assert answers[0]["claim"]["detail"]["note"] == "stopped: still busy well past its budget of 0.3 s"
    assert answers[1]["claim"]["verdict"] == "refuted"


@pytest.mark.parametrize(
    ("how", "note"),
    [("kill", "ended by SIGKILL (out of memory, most likely)"), ("devour", "stopped: out of memory")],
)
def test_a_worker_that_the_system_ends_costs_one_answer(monkeypatch: pytest.MonkeyPatch, how: str, note: str) -> None:
    import signal

    import canon.claims.verify as deciders

    real = deciders.verify

    def ended(claim, **options):
        if claim.index == 0 and how == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        if claim.index == 0:
            return [bytearray(1 << 27) for _ in range(64)]  # 8 GiB, in pieces
        return real(claim, **options)

    monkeypatch.setattr(deciders, "verify", ended)
    entries = [Entry("claims.toml", claim.index, claim) for claim in read_text(CLAIMS).claims]
    settings = Settings(budget=20.0, memory=2 << 30)
    answers = dict(runs.run(entries, settings, claim_record, jobs=1, start_method="fork"))
    assert answers[0]["claim"]["verdict"] == "undecided"
    assert answers[0]["claim"]["detail"]["note"].endswith(note)
    assert answers[1]["claim"]["verdict"] == "refuted"
