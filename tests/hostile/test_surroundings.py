"""What lies around a run: a system that starts no more processes, terminals of any width, settings of the folder."""

from __future__ import annotations

import errno
import json
import os
import signal
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import canon.claims.run as runs
from canon import interruption
from canon.claims.worker import serve
from canon.cli.main import main
from canon.report.console import NARROWEST, WIDEST, terminal
from tests.hostile.test_faults import CLAIMS

TRUE = CLAIMS.split('[[claim]]\nkind = "bracket"\nf')[0]
CLAIM = TRUE.removeprefix(TRUE.split("[[claim]]")[0])


@pytest.mark.parametrize("starts", [0, 1, 2])
def test_fewer_processes_do_the_rest(starts: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    """Where the system starts none at all, the claims aren't asked; with one the whole run goes on."""
    real, started = runs._Team._started, []

    def refuse(team, mine, its):
        if len(started) == starts:
            raise BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable")
        started.append(1)
        return real(team, mine, its)

    monkeypatch.setattr(runs, "_start_method", lambda: "fork")
    monkeypatch.setattr(runs._Team, "_started", refuse)
    file = tmp_path / "claims.toml"
    file.write_text(TRUE + CLAIM * 5, encoding="utf-8")
    assert main(["verify", str(file), "--json", "--jobs", "4"]) == (0 if starts else 71)
    out, err = capsys.readouterr()
    assert len(json.loads(out)["claims"]) == (6 if starts else 0)
    no = "canon verify: 6 of 6 claims not asked: the system starts no process: Resource temporarily unavailable\n"
    assert err == ("" if starts else no)


def test_what_was_answered_before_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    """The only worker dies, and the system starts no other."""
    import canon.claims.verify as deciders

    real, started, decide = runs._Team._started, [], deciders.verify

    def once(team, mine, its):
        if started:
            raise OSError(errno.ENOMEM, "Cannot allocate memory")
        started.append(1)
        return real(team, mine, its)

    def dying(claim, **options):
        if claim.index == 2:
            os.kill(os.getpid(), signal.SIGKILL)
        return decide(claim, **options)

    monkeypatch.setattr(runs, "_start_method", lambda: "fork")
    monkeypatch.setattr(runs._Team, "_started", once)
    monkeypatch.setattr(deciders, "verify", dying)
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text(TRUE + CLAIM * 5, encoding="utf-8")
    assert main(["verify", str(file), "--json", "--jobs", "1", "--resume", str(kept)]) == 71
    out, err = capsys.readouterr()
    assert [claim["verdict"] for claim in json.loads(out)["claims"]] == ["proved", "proved"]
    assert "4 of 6 claims not asked: the system starts no process: Cannot allocate memory" in err
    assert len(kept.read_text().splitlines()) == 2


@pytest.mark.parametrize("columns", ["0", "1", "-5", "x", "", "\u00b2", "99999999", "9" * 30, "80"])
def test_a_terminal_of_any_width(columns: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With none rich printed nothing, with 10^8 columns for ever; 10^30 were an OverflowError, and "²" a ValueError."""
    with monkeypatch.context() as patch:  # no longer than it has to be: pytest's own lines are as wide
        patch.setenv("COLUMNS", columns)
        patch.setenv("LINES", columns)
        console = terminal()
        assert NARROWEST <= console.width <= WIDEST
        with console.capture() as shown:
            console.print("proved")
    assert "proved" in shown.get()


def test_an_interruption_that_a_library_has_lost_is_raised_again() -> None:
    before = signal.getsignal(signal.SIGTERM)

    class Callback:
        def __del__(self) -> None:
            os.kill(os.getpid(), signal.SIGTERM)
            for _ in range(1000):
                pass

    def work() -> str:
        hook, sys.unraisablehook = sys.unraisablehook, lambda _: None
        try:
            Callback()
        finally:
            sys.unraisablehook = hook
        try:
            interruption.raise_again()
        except KeyboardInterrupt:
            interruption.raise_again()
            return "heard, once"
        return "lost"

    assert interruption.raising(work) == "heard, once"
    assert signal.getsignal(signal.SIGTERM) is before
    interruption.raise_again()


def test_a_worker_begins_with_signals_held_and_lets_them_go(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that arrives just after the fork would else raise what is meant for its parent."""
    with interruption.held():
        assert signal.pthread_sigmask(signal.SIG_BLOCK, ()) >= {*interruption.HEARD}
        child = os.fork()
        if child == 0:
            os.kill(os.getpid(), signal.SIGINT)
            ended = SimpleNamespace(close=lambda: None, recv_bytes=lambda: (_ for _ in ()).throw(EOFError))
            serve(ended, [], runs.Settings(), lambda *_: {})  # type: ignore[arg-type]
            os._exit(7 if signal.pthread_sigmask(signal.SIG_BLOCK, ()) & {*interruption.HEARD} else 0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert not signal.pthread_sigmask(signal.SIG_BLOCK, ()) & {*interruption.HEARD}


RC = "text.usetex: True\nbackend: module://none\nfont.size: 90\n"


@pytest.mark.parametrize("found", [RC, "pipe"])
def test_figures_take_nothing_from_the_folder(found: str, tmp_path: Path, monkeypatch, capsys) -> None:
    """A title with a dollar is no formula, and TeX isn't started, whatever lies beside the scene."""
    import matplotlib

    from canon.report import figure_style as figures

    monkeypatch.chdir(tmp_path)
    if found == "pipe":
        os.mkfifo("matplotlibrc")
        with pytest.raises(OSError, match="no regular file"), figures.plain():
            pass
        return
    Path("matplotlibrc").write_text(found)
    with matplotlib.rc_context({"text.usetex": True, "font.size": 90}):
        with figures.plain():
            assert not matplotlib.rcParams["text.usetex"]
            assert matplotlib.rcParams["font.size"] == matplotlib.rcParamsDefault["font.size"]
        assert matplotlib.rcParams["text.usetex"]


def test_a_title_is_drawn_as_it_is(tmp_path: Path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from canon.report.figure_style import words

    for title in ("$\\frac{$", "a $x^2$ b", "\\$1$", "\x1b[31m$"):
        figure = Figure()
        FigureCanvasAgg(figure)
        drawn = figure.suptitle(words(title))
        figure.draw_without_rendering()
        text, math = drawn._preprocess_math(drawn.get_text())
        assert math is False
        assert text.replace("�", "\x1b") == title
