"""Errors that nobody has foreseen: said in one line, with a status of their own, and never that of a refuted claim; and
what makes libraries raise them: their variables, folders in folders, files whose disk is full while they are drawn."""

from __future__ import annotations

import inspect
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import canon.__main__ as start
import canon.report.certificate_file as certificate_file
from canon.claims.certificate_path import LONGEST, certificate_path
from canon.claims.folders import make_folder
from canon.claims.worker import Entry
from canon.cli.files import claim_files, files_below
from canon.cli.main import main
from canon.report.whole_file import figure_written
from tests.hostile.test_faults import CLAIMS, full_disk

CANON = [sys.executable, "-m", "canon"]
ROOM = 40
"""Calls that a walk through folders may nest."""


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        ("KeyError('as it was')", 70, "internal error, KeyError: 'as it was' ("),
        ("RecursionError('too deep')", 70, "internal error, RecursionError: too deep"),
        ("RuntimeError('RESOURCE_EXHAUSTED: no memory')", 71, "the system gave no more: RESOURCE_EXHAUSTED: no memory"),
        ("zlib.error('-2')", 70, "internal error, error: -2"),
    ],
)
def test_an_error_that_nobody_has_foreseen_has_a_status_of_its_own(error: str, status: int, said: str) -> None:
    """Python's own, 1, says that a claim is refuted, or that something drifted."""
    program = (
        "import zlib, canon.cli.main as start\n"
        f"def stopped(*_):\n print('what was known')\n raise {error}\n"
        "start.main = stopped; start.entry()"
    )
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, env=environment)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (status, "what was known\n", 1)
    assert said in done.stderr
    environment["CANON_TRACEBACK"] = "1"
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, env=environment)
    assert ("Traceback" in told.stderr) == (status == 70)
    assert told.returncode == status


def test_variables_of_libraries_are_not_heeded(tmp_path: Path) -> None:
    """Each of these ended every command in a traceback, with status 1."""
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    names = ("SYMPY_USE_CACHE", "SYMPY_CACHE_SIZE", "SYMPY_DEBUG", "JAX_ENABLE_X64", "XLA_FLAGS", "MPLBACKEND")
    environment = {**os.environ, **dict.fromkeys(names, "x"), "XDG_CACHE_HOME": str(tmp_path)}
    environment["PYTHONPATH"] = str(Path(__file__).resolve().parents[2])
    command = [*CANON, "verify", "claims.toml"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")


def test_numbers_have_a_bound_whatever_python_is_told(tmp_path: Path) -> None:
    """Without one a number of a megabyte is read for seconds, in a file, a certificate or a journal."""
    (tmp_path / "long.toml").write_text(f"a = {'9' * 100_000}\n")
    (tmp_path / "long.json").write_text(f'{{"certificate": 1, "checksum": {"9" * 100_000}}}\n')
    environment = {**os.environ, "PYTHONINTMAXSTRDIGITS": "0", "PYTHONPATH": str(Path(__file__).resolve().parents[2])}
    for words in (["verify", "long.toml"], ["certificate", "check", "long.json"]):
        command = [*CANON, *words]
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60)
        assert done.returncode == 3
        assert "4300 digits" in done.stdout or "unreadable" in done.stdout


def test_where_jax_computes_is_heeded(monkeypatch: pytest.MonkeyPatch) -> None:
    import canon.cli.main as loaded

    for name in ("JAX_PLATFORMS", "JAX_COMPILATION_CACHE_DIR", "JAX_DEBUG_NANS", "SYMPY_DEBUG"):
        monkeypatch.setenv(name, "x")
    monkeypatch.setattr(loaded, "entry", lambda: None)
    monkeypatch.setattr("signal.signal", lambda *_: None)
    start.entry()
    assert {name for name in os.environ if name.startswith(start.UNHEEDED) and os.environ[name] == "x"} == {
        "JAX_PLATFORMS",
        "JAX_COMPILATION_CACHE_DIR",
    }


def test_compiled_files_are_kept_where_python_is_told_to(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The disk that has to have room is that of `PYTHONPYCACHEPREFIX`, whose folders may not be there yet."""
    asked = []

    def room(path: str) -> SimpleNamespace:
        asked.append(path)
        return SimpleNamespace(f_bavail=0 if path == str(tmp_path) else 1 << 30, f_frsize=4096)

    monkeypatch.setattr(os, "statvfs", room)
    assert not start._is_short_of_room()
    monkeypatch.setattr(sys, "pycache_prefix", str(tmp_path / "a" / "b"))
    assert start._is_short_of_room()
    assert asked == [os.path.dirname(os.path.abspath(start.__file__)), str(tmp_path)]


def test_a_folder_is_made_as_deep_as_it_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A thousand of them ended in a `RecursionError`, though a message about names that are too long was there."""
    deep = tmp_path.joinpath(*["d"] * 2 * ROOM)
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + ROOM)
    try:
        make_folder(deep)
        make_folder(deep)
    finally:
        sys.setrecursionlimit(limit)
    assert deep.is_dir()
    (tmp_path / "file").touch()
    for place in ("file", "file/below", "e/" * 3000, "e" * 300):
        with pytest.raises(OSError):  # noqa: PT011 - which one is the system's
            make_folder(tmp_path / place)
    for place in ("", "/proc/none", "/proc/none/below"):  # made again and again for ever, once
        with pytest.raises(FileNotFoundError):
            make_folder(place)
    assert not (tmp_path / "e").exists()
    claims = tmp_path / "claims.toml"
    claims.write_text(CLAIMS, encoding="utf-8")
    assert main(["verify", str(claims), "--certificate", "d/" * 3000]) == 3
    assert "can't be made one" in capsys.readouterr().err


def test_folders_lie_in_folders_as_deep_as_they_like(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    """A thousand of them ended in a `RecursionError`, with the exit status of a refuted claim."""
    place = tmp_path
    for _ in range(2 * ROOM):
        place = place / "d"
        place.mkdir()
    for name in ("b.toml", "a.toml", "c.json"):
        (place / name).write_text(CLAIMS, encoding="utf-8")
    (tmp_path / "d" / "z.toml").write_text(CLAIMS, encoding="utf-8")
    (place / "back").symlink_to(tmp_path)
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + ROOM)
    try:
        found, missing = claim_files([str(tmp_path)])
        certificates = list(files_below(str(tmp_path), ".json", lambda error: None))
    finally:
        sys.setrecursionlimit(limit)
    assert [str(file.path) for file in found] == [
        str(tmp_path / "d/z.toml"), str(place / "a.toml"), str(place / "b.toml"),
    ]  # fmt: skip
    assert not missing
    assert certificates == [str(place / "c.json")]
    assert main(["certificate", "check", str(tmp_path)]) == 3
    assert capsys.readouterr().out.startswith("unreadable")


def test_a_folder_of_certificates_that_cant_be_read_is_said(tmp_path: Path, monkeypatch, capsys) -> None:
    """Those in it aren't confirmed by not being looked at."""
    (tmp_path / "sealed").mkdir()
    real = os.scandir

    def scandir(path):
        if str(path).endswith("sealed"):
            raise PermissionError(13, "Permission denied")
        return real(path)

    monkeypatch.setattr(os, "scandir", scandir)
    assert main(["certificate", "check", str(tmp_path)]) == 3
    assert capsys.readouterr().out.startswith(f"unreadable         {tmp_path / 'sealed'}")


def test_a_verdict_stands_whatever_happens_to_its_certificate(tmp_path: Path, monkeypatch, capsys) -> None:
    """The worker died of it, twice, and the claim was undecided."""
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)

    def fails(path, data):
        raise RecursionError("too deep")

    monkeypatch.setattr(certificate_file, "write_certificate", fails)
    monkeypatch.setattr("canon.claims.run._start_method", lambda: "fork")
    assert main(["verify", "claims.toml", "--json", "--certificate", "kept", "--jobs", "1"]) == 74
    out, err = capsys.readouterr()
    claims = json.loads(out)["claims"]
    assert [claim["verdict"] for claim in claims] == ["proved", "refuted"]
    assert all(claim["certificate"] is None for claim in claims)
    assert "2 certificates are missing: claims.toml: stopped by an internal error, RecursionError: too deep" in err


def test_certificates_of_files_with_any_name_have_a_name() -> None:
    """Names that are no text in UTF-8, and the paths of deep folders, which can't be made again below another one."""
    odd = certificate_path("kept", Entry("\udcff.toml", 0, None))
    deep = certificate_path("kept", Entry("d/" * LONGEST + "x.toml", 1, None))
    other = certificate_path("kept", Entry("e/" * LONGEST + "x.toml", 1, None))
    assert odd.parent == deep.parent == Path("kept")
    assert deep.name.startswith("x-")
    assert deep.name.endswith(".2.json")
    assert deep != other
    assert certificate_path("kept", Entry("a/b.toml", 0, None)) == Path("kept/a/b.1.json")


@pytest.mark.parametrize("left", [0, 10, 5000])
def test_a_figure_is_drawn_before_its_file_is_begun(left: int, tmp_path: Path) -> None:
    """Where the disk is full in the middle of a PDF its compressor has another error than the file: -2, of zlib."""

    class Figure:
        def savefig(self, file, **_: object) -> None:
            assert not list(tmp_path.iterdir())
            file.write(b"x" * 10_000)

    with full_disk(left), pytest.raises(OSError, match="File too large"):
        figure_written(tmp_path / "a.pdf", Figure())
    assert not list(tmp_path.iterdir())
    figure_written(tmp_path / "a.pdf", Figure())
    assert (tmp_path / "a.pdf").stat().st_size == 10_000


def test_a_protected_file_is_not_replaced_by_another(tmp_path: Path, monkeypatch, capsys) -> None:
    """Its folder may be written to, so that it could be; nobody was asked whether it may."""
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    real = os.access
    monkeypatch.setattr(os, "access", lambda path, mode: "kept" not in str(path) and real(path, mode))
    for command in (["verify", "claims.toml", "--proof"], ["cost", "normal-form", "--order", "3", "--csv"]):
        Path("kept.txt").write_text("work")
        assert main([*command, "kept.txt"]) == 3
        assert "is there, and is protected against being written over" in capsys.readouterr().err
        assert Path("kept.txt").read_text() == "work"


def test_threads_are_counted_before_libraries_need_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenBLAS interrupts the program that has too few, and crashes at its end; XLA aborts it."""
    import _thread

    real, started = _thread.start_new_thread, []

    def refuses(run, arguments):
        if len(started) == 3:
            raise RuntimeError("can't start new thread")
        started.append(real(run, arguments))

    before = _thread._count()
    assert start.starts_threads(5)
    assert _thread._count() == before
    monkeypatch.setattr(_thread, "start_new_thread", refuses)
    assert not start.starts_threads(4)
    assert _thread._count() == before


def test_a_program_without_threads_says_so(tmp_path: Path) -> None:
    program = "import canon.__main__ as start; start.starts_threads = lambda count: False; start.entry()"
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    for words, status in ((["simulate", "none.toml"], 71), (["hard", "--list"], 71), (["scenes"], 0)):
        command = [sys.executable, "-c", f"{program}", *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment, cwd=tmp_path)
        assert done.returncode == status
        assert done.stderr == ("canon: the system gave no more: can't start new thread\n" if status else "")


@pytest.mark.parametrize("name", start.HEARD)
def test_no_signal_changes_a_status_that_is_known(name: str) -> None:
    """While Python ends, its own handlers are gone: the process was ended by the signal, its report printed."""
    program = (
        "import atexit, os, signal, sys, canon.__main__ as start, canon.cli.main as loaded\n"
        f"atexit.register(lambda: os.kill(os.getpid(), signal.{name}))\n"
        "loaded.entry = lambda: sys.exit(3)\n"
        "start.entry()"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (3, "")
