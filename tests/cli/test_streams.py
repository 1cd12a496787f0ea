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
    (tmp_path / "true.toml").write_text(CLAIM.format(1))
    (tmp_path / "false.toml").write_text(CLAIM.format(2))
    kept = tmp_path / "journal"
    for name, status in (("true", 0), ("false", 1), ("none", 3)):
        command = [*CANON, "verify", str(tmp_path / f"{name}.toml"), "--resume", str(kept), "--jobs", "1"]
        done = subprocess.run(command, preexec_fn=closed(0, 1, 2), timeout=60)
        assert done.returncode == status
    assert [line.startswith(b'{"check"') for line in kept.read_bytes().splitlines()] == [True, True]
    command = [*CANON, "verify", str(tmp_path / "true.toml"), "--json"]
    done = subprocess.run(command, preexec_fn=closed(1), stderr=subprocess.PIPE, timeout=60)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no device that is full here")
def test_help_that_cant_be_written_is_an_error() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run([*CANON, "--help"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == 74
    assert "could not be written" in done.stderr
