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
    said = (
        "canon verify: 1 of 1 claims not asked: the system starts no process: " if words else "canon: the system gave"
    )
    assert done.stderr.startswith(f"{said}{words}")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("number", "status", "said"), [("EMFILE", 71, "the system gave no more"), ("EIO", 74, "the output")]
)
def test_an_error_of_the_system_is_told_from_one_of_output(number: str, status: int, said: str) -> None:
    """Wherever it comes from: which call is refused first depends on the machine."""
    program = (
        "import errno, canon.cli.main as start\n"
        "def refused(*_): raise OSError(errno.NUMBER, 'as it happens')\n"
        "start.main = refused; start.entry()"
    ).replace("NUMBER", number)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert done.returncode == status
    assert done.stderr.startswith(f"canon: {said}")
    assert done.stderr.count("\n") == 1


def test_a_loaded_file_that_is_cut_short_is_said() -> None:
    """CPython 3.11 keeps what it has compiled on a full disk, however much of it; each later start fails over it."""
    program = (
        "import sys, types; import canon.__main__ as start\n"
        "class Cut:\n"
        "    def find_spec(name, *_):\n"
        "        if name == sys.argv[1]: raise EOFError('marshal data too short')\n"
        "word = sys.argv[1]; sys.argv[1:] = sys.argv[2:]; sys.meta_path.insert(0, Cut)\n"
    ).replace("sys.argv[1]: raise", "word: raise")
    for module in ("canon.cli.main", "canon.claims.reader"):
        command = [sys.executable, "-c", f"{program}start.entry()", module, "verify", "--coverage"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        assert done.returncode == 71, done.stderr
        assert "marshal data too short: a file that Python has compiled is cut short" in done.stderr
        assert done.stderr.count("\n") == 1


@pytest.mark.skipif(sys.platform == "win32", reason="no such limits here")
def test_where_files_may_be_cut_short_nothing_compiled_is_kept() -> None:
    import resource

    program = "import sys; import canon.cli.main as loaded; loaded.entry = lambda: print(sys.dont_write_bytecode)\n"
    command = [sys.executable, "-c", f"{program}from canon.__main__ import entry; entry()"]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    for most, said in ((1 << 30, "True\n"), (resource.RLIM_INFINITY, "False\n")):
        done = subprocess.run(
            command,
            preexec_fn=lambda most=most: resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY)),
            env=environment,
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert done.stdout == said


def test_a_working_folder_is_no_place_to_import_from(tmp_path: Path) -> None:
    """Of what lies beside claims nothing is run, though `python -m` would; its own `importlib` comes before."""
    for name in ("sympy", "argparse", "typing", "signal", "canon_extra"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('run from the working folder')\n")
    (tmp_path / "true.toml").write_text(CLAIM.format(1))
    home = str(Path(__file__).resolve().parents[2])
    environment = {**os.environ, "PYTHONPATH": home}
    done = subprocess.run(
        [*CANON, "verify", "true.toml"], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stderr) == (0, "")
