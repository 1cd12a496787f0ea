"""The command line's own words: help, version, and errors that say what to do instead."""

import os
import subprocess
import sys
from importlib.metadata import version

import pytest

from canon.cli.main import main


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """Return what is said on standard error of arguments that are refused with exit status 3."""
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    out, err = capsys.readouterr()
    assert stop.value.code == 3
    assert out == ""
    return err.splitlines()


@pytest.mark.parametrize(
    ("arguments", "lines"),
    [
        (["verfy"], ["Did you mean verify? See `canon --help`."]),
        (["verify", "--jbos", "2"], ["canon verify: error: unrecognized arguments: --jbos", "Did you mean --jobs?"]),
        (["verify", "--jobs", "0"], ["argument --jobs: '0' is no count: give a whole number from 1 on"]),
        (["verify", "--budget", "nan"], ["'nan' is no number of seconds: give one above 0, as 2.5"]),
        (["verify", "--budget", "-1"], ["'-1' is no number of seconds: give one above 0, as 2.5"]),
        (["verify", "--seed", "x"], ["'x' is no whole number from 0 on", "See `canon verify --help`."]),
        (["verify", "--method", "numerical"], ["Did you mean numeric? See `canon verify --help`."]),
        (["verify", "--met", "all"], ["unrecognized arguments: --met", "Did you mean --method?"]),
        (["verify", "x", "--explain"], ["\n--explain is an option of `canon simulate`, not of `canon verify`. See"]),
        (
            ["certificate", "check", "x", "--coq=y"],
            ["of `canon certificate export`, not of `canon certificate check`."],
        ),
        (["hard", "--version"], ["--version is an option of `canon`, not of `canon hard`."]),
        (["simulate", "--duration", "x"], ["arguments: --duration\nSee `canon simulate --help`."]),
    ],
)
def test_refused_arguments(capsys: pytest.CaptureFixture[str], arguments: list[str], lines: list[str]) -> None:
    said = "\n".join(refusal(capsys, *arguments))
    for line in lines:
        assert line in said


def test_help_shows_the_commands_and_the_exit_status(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["--help"])
    out = capsys.readouterr().out
    assert stop.value.code == 0
    for word in ("verify", "examples:", "exit status of verify:", "--version"):
        assert word in out


def test_no_command_is_a_call_for_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    assert capsys.readouterr().out.startswith("usage: canon [-h] [--version] COMMAND")


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"canon {version('canon-mechanics')}\n"


def test_the_module_is_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "canon", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"canon {version('canon-mechanics')}\n"
    assert done.stderr == ""


def test_a_reader_that_hangs_up_is_no_error() -> None:
    read, write = os.pipe()
    os.close(read)
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    command = [sys.executable, "-m", "canon", "--help"]
    done = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True, env=buffered)
    os.close(write)
    assert done.stderr == ""
    assert done.returncode == 141
