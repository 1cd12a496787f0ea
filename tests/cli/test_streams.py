"""Standard streams that are closed, or full: the status is the command's, and no file takes a stream's place."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CANON = [sys.executable, "-m", "canon"]
CLAIM = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "{}"\n'


def closed(*streams: int):
    """A program's beginning, that closes streams."""

    def close() -> None:
        for stream in streams:
            os.close(stream)

    return close


@pytest.mark.skipif(sys.platform == "win32", reason="no streams that are inherited closed")
def test_streams_that_are_closed_are_nowhere(tmp_path: Path) -> None:
    file, kept = tmp_path / "false.toml", tmp_path / "journal"
    file.write_text(CLAIM.format(2))
    command = [*CANON, "verify", str(file), "--resume", str(kept), "--jobs", "1"]
    done = subprocess.run(command, preexec_fn=closed(0, 1, 2), timeout=60)
    assert done.returncode == 1
    assert [line.startswith(b'{"check"') for line in kept.read_bytes().splitlines()] == [True]
    done = subprocess.run([*command, "--json"], preexec_fn=closed(1), stderr=subprocess.PIPE, timeout=60)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no device that is full here")
def test_help_that_cant_be_written_is_an_error() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run([*CANON, "--help"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == 74
    assert "could not be written" in done.stderr


@pytest.mark.parametrize(
    ("limit", "most", "words"),
    [("RLIMIT_NOFILE", 8, "Too many open files"), pytest.param("RLIMIT_AS", 300 << 20, "", marks=pytest.mark.slow)],
)
@pytest.mark.skipif(sys.platform == "win32", reason="no such limits here")
def test_a_system_that_gives_no_more_is_no_flaw(limit: str, most: int, words: str, tmp_path: Path) -> None:
    import resource

    (tmp_path / "true.toml").write_text(CLAIM.format(1))
    command = ["verify", str(tmp_path / "true.toml"), "--jobs", "2"] if words else ["simulate", "pendulum"]
    number = getattr(resource, limit)
    done = subprocess.run(
        [*CANON, *command],
        preexec_fn=lambda: resource.setrlimit(number, (most, most)),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 71
    assert done.stderr.startswith(f"canon: the system gave no more: {words}")
    assert done.stderr.count("\n") == 1
