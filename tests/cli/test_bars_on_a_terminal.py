"""What long commands draw while they run: on a terminal alone, and nothing of it is left at the end."""

import io
import os
import sys
import threading
from pathlib import Path

import pytest

pty = pytest.importorskip("pty", reason="there are no pseudo-terminals")

from canon.cli.main import main  # noqa: E402
from canon.report import console  # noqa: E402

SCENE = """
[system]
name = "harmonic_oscillator"
parameters = { m = 1.0, omega = 1.0 }
q = [1.0]
p = [0.0]

[run]
duration = 10
"""
CLAIMS = """
[phase_space]
q = ["q"]
p = ["p"]
[[claim]]
kind = "bracket"
f = "q"
g = "p"
equals = "1"
"""
COMMANDS = {
    "simulate": ("simulating", "\x1b[2K"),
    "verify": ("1/1", "\x1b[2K"),
    "hard": ("hard cases", "\x1b[2K"),
    "cost": ("measuring", "\x1b[K"),
}
"""What is drawn, and what takes it away."""
SLOW = ("simulate", "verify")


@pytest.fixture
def commands(tmp_path: Path) -> dict[str, list[str]]:
    scene, claims = tmp_path / "scene.toml", tmp_path / "claims.toml"
    scene.write_text(SCENE)
    claims.write_text(CLAIMS)
    return {
        "simulate": ["simulate", str(scene)],
        "verify": ["verify", str(claims), "--jobs", "1"],
        "hard": ["hard", "that all but vanishes"],
        "cost": ["cost", "action", "pendulum", "--cap", "0.001"],
    }


class Terminal:
    """A pseudo-terminal, and what was written to it."""

    def __init__(self) -> None:
        self.master, slave = pty.openpty()
        self.file = os.fdopen(slave, "w", encoding="utf-8")
        self.seen = b""
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self) -> None:
        while True:
            try:
                piece = os.read(self.master, 65536)
            except OSError:
                return
            if not piece:
                return
            self.seen += piece

    def closed(self) -> str:
        """All that was written, once nothing more comes."""
        self.file.close()
        self.reader.join(10)
        os.close(self.master)
        return self.seen.decode()


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] if name in SLOW else []) for name in COMMANDS]
)
def test_on_a_terminal_it_is_drawn_and_taken_away_and_elsewhere_there_is_none(
    name: str, commands: dict[str, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setattr(console, "PATIENCE", -1.0)
    terminal, (drawn, away) = Terminal(), COMMANDS[name]
    with monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", terminal.file)
        patched.setattr(sys, "stderr", terminal.file)
        assert main(commands[name]) == 0
    seen = terminal.closed()
    assert drawn in seen
    assert away in seen[seen.rindex(drawn) :]
    assert seen.count("\x1b[?25l") == seen.count("\x1b[?25h")  # the cursor is there again

    out, err = io.StringIO(), io.StringIO()
    with monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", out)
        patched.setattr(sys, "stderr", err)
        assert main(commands[name]) == 0
    assert err.getvalue() == ""
    assert out.getvalue()
    assert "\x1b" not in out.getvalue()
