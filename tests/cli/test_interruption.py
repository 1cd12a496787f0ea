"""Ctrl-C: compiled code is left at once, what is done is reported, and nothing is raised where it could be lost."""

from __future__ import annotations

import os
import signal
import threading
import time
from functools import partial
from pathlib import Path

import pytest

from canon import interruption
from canon.cli import main as command
from canon.cli.main import main
from canon.interruption import ABANDONED, Late, Left, heeding, interruptible, left_behind
from canon.scenes import monitors
from tests.short_scenes import PENDULUM

LONG = 60.0
SOON = 10.0
"""Seconds in which what takes `LONG` must have been left, on a machine that is busy with other things."""


@pytest.fixture(autouse=True)
def terminal():
    """Ctrl-C as in a terminal: a shell's background jobs begin with it ignored, and then `heeding` leaves it so."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def release(terminal: None):
    """An event for which "compiled" code waits; what was left behind ends with the test."""
    event = threading.Event()
    yield event
    event.set()
    deadline = time.monotonic() + SOON
    while left_behind() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not left_behind()


def press() -> None:
    os.kill(os.getpid(), signal.SIGINT)


def test_what_is_done_is_reported(release: threading.Event) -> None:
    def work() -> list[str]:
        done = [interruptible(lambda: "first")]
        try:
            interruptible(lambda: (press(), release.wait(LONG)))
        except KeyboardInterrupt:
            done.append("interrupted")
        return done

    start = time.monotonic()
    assert heeding(work) == ["first", "interrupted"]
    assert time.monotonic() - start < SOON
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_what_begins_with_ctrl_c_ignored_goes_on() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert heeding(lambda: press() or "done") == "done"
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_work_that_does_not_listen_is_left(release: threading.Event) -> None:
    start = time.monotonic()
    with pytest.raises(Left):
        heeding(lambda: (press(), release.wait(LONG)))
    assert time.monotonic() - start < SOON
    assert any(thread.name == ABANDONED for thread in threading.enumerate())


def test_a_second_time_is_meant(release: threading.Event, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruption, "PATIENCE", (LONG, LONG))

    def deaf() -> None:
        interruptible(lambda: None)  # there is something to report, for which more time is given
        press()
        time.sleep(0.3)
        press()
        release.wait(LONG)

    start = time.monotonic()
    with pytest.raises(Left):
        heeding(deaf)
    assert time.monotonic() - start < SOON


def test_errors_and_answers_pass(release: threading.Event) -> None:
    def fail() -> None:
        raise ZeroDivisionError("as it was")

    for way in (heeding, interruptible):
        with pytest.raises(ZeroDivisionError, match="as it was"):
            way(fail)
        assert way(lambda: 7) == 7
    with pytest.raises(Late):
        interruptible(lambda: release.wait(LONG), until=time.monotonic() + 0.1)


SCENE = PENDULUM + 'monitor = ["energy", "loop", "cartan"]\n'


def test_a_monitor_is_left_and_the_run_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], release: threading.Event
) -> None:
    scene, states = tmp_path / "scene.toml", tmp_path / "states.npz"
    scene.write_text(SCENE)

    def compiled(*_: object) -> None:
        press()
        release.wait(LONG)

    monkeypatch.setitem(monitors.AVAILABLE, "loop", compiled)
    start = time.monotonic()
    assert heeding(partial(main, ["simulate", str(scene), "--out", str(states)])) == 1
    assert time.monotonic() - start < LONG / 2
    shown = capsys.readouterr().out
    assert "states      5, from t = 0 to 2" in shown
    assert "energy" in shown
    assert "interrupted before these monitors were read: loop, cartan" in shown
    assert states.exists()


def test_an_unforeseen_error_ends_the_process_by_itself(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An orderly end would take the interpreter from compiled code that still runs, and abort with status 134."""

    def fails() -> int:
        raise ZeroDivisionError("as it was")

    def ended(status: int) -> None:
        raise SystemExit(status)

    monkeypatch.setattr(command, "main", fails)
    monkeypatch.setattr(os, "_exit", ended)
    for left in (False, True):
        monkeypatch.setattr(command, "left_behind", lambda left=left: left)
        with pytest.raises(SystemExit) as end:
            command.entry()
        assert end.value.code == 70
        assert "ZeroDivisionError: as it was" in capsys.readouterr().err


@pytest.mark.usefixtures("hangups_heard")
def test_a_closed_terminal_is_heard_as_ctrl_c(release: threading.Event) -> None:
    def work() -> str:
        try:
            interruptible(lambda: (os.kill(os.getpid(), signal.SIGHUP), release.wait(LONG)))
        except KeyboardInterrupt:
            return "interrupted"
        return "not heard"

    assert heeding(work) == "interrupted"
