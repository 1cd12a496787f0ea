"""The command `canon`: finds out which command is meant and hands over to its module.

Nothing heavy is imported here, so that `canon --help` and `canon --version` answer at once.
"""

from __future__ import annotations

import argparse
import contextlib
import errno
import io
import os
import sys
import traceback
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final

import canon
from canon.__main__ import CUT_SHORT, HEEDED, starts_threads
from canon.cli import actions, algebra, certificate, cost, hard, scenes, simulate, verify
from canon.cli.parser import FLAW, NO_RESOURCES, NOT_WRITTEN, Parser
from canon.cli.spoken import shown
from canon.interruption import Left, heeding, left_behind, raising

COMMANDS: Final = {
    "verify": verify,
    "certificate": certificate,
    "simulate": simulate,
    "cost": cost,
    "actions": actions,
    "algebra": algebra,
    "scenes": scenes,
    "hard": hard,
}
EPILOG: Final = """\
examples:
  canon verify                      check the built-in catalogue
  canon verify oscillator.toml      check the claims of one file
  canon verify claims/ --json       check every *.toml below a folder, print one JSON object
  canon verify FILE --certificate DIR   and write a certificate of each proof and refutation
  canon certificate check DIR       check them with a small checker of its own
  canon scenes pendulum             print a scene file of a system; without a name, list them all
  canon simulate pendulum.toml      run a scene; --plot, --out, --explain, --json
  canon cost simulate pendulum      what accuracy costs in time: of runs, of verdicts, actions, loops, normal forms
  canon algebra kepler.toml         the Lie algebras of its claims: brackets, Killing form, name; --latex, --json
  canon actions pendulum.toml       actions, frequencies and angles of its orbit, with their bounds
  canon hard kepler                 digits kept in the hard cases of a family; without a name, in all of them

exit status of verify:
  0  every claim is as expected (proved or supported, unless the claim says otherwise)
  1  some claim is refuted, or otherwise against its expectation
  2  some claim is undecided
  3  some input could not be read or is ill-posed (the rest is checked all the same)
"""


HEARING: Final = ("verify", "algebra", "certificate")
"""The commands that hear Ctrl-C in the first thread: their work is done in other processes, or in short steps; and
certificates are checked under a timer, which the first thread alone has."""
COMPILING: Final = ("simulate", "cost", "hard")
"""The commands that load jax, whose XLA aborts where the system refuses it a thread; it has some `THREADS` a core."""
THREADS: Final = 8
NO_THREADS: Final = "can't start new thread"
"""What Python says of that."""
REFUSED: Final = {
    **dict.fromkeys((errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.EAGAIN), "the system gave no more"),
    errno.ENOENT: "the working folder is gone",
}
"""Errors of the system that aren't about output, in words."""
HUNG_UP = 141  # as the shell reports a program ended by SIGPIPE; 1 would say "refuted"


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    top = Parser(
        prog="canon",
        description="Decides whether transformations of classical mechanics are canonical: "
        "with a proof, or with a point at which they fail.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="store_true", help="print the version and exit")
    commands = top.add_subparsers(title="commands", dest="command", metavar="COMMAND", parser_class=Parser)
    for name, module in COMMANDS.items():
        module.declare(commands.add_parser(name, help=module.HELP, description=module.DESCRIPTION))
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line (default: this process's arguments) and return the exit status."""
    return _work(argv)()


def _work(argv: Sequence[str] | None) -> Callable[[], int]:
    """What the arguments ask for, as a function that does it and returns the exit status."""
    top = parser()
    arguments = top.parse_args(argv)
    if arguments.version:
        return partial(_say, f"canon {canon.__version__}\n")
    if arguments.command is None:
        return partial(_say, top.format_help())
    execute = partial(COMMANDS[arguments.command].execute, arguments)
    if argv is not None:
        return execute
    if arguments.command in COMPILING and not starts_threads(THREADS * (os.cpu_count() or 1)):
        raise RuntimeError(NO_THREADS)
    return partial(raising, execute) if arguments.command in HEARING else partial(heeding, execute)


def _say(text: str) -> int:
    sys.stdout.write(text)
    return 0


def _open_what_is_closed() -> None:
    """Give the system's nowhere to standard streams that are closed.

    Else the next file that is opened, as a journal, would be one of them, and get what a library in C prints.
    """
    for number, name, mode in ((0, "stdin", "r"), (1, "stdout", "w"), (2, "stderr", "w")):
        try:
            os.fstat(number)
        except OSError:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:
                os.dup2(nowhere, number)
                os.close(nowhere)
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115


def _flaw(error: Exception) -> str:
    """What is said of an error that nobody has foreseen: on one line, with the place in canon that it came from, and
    the variables that libraries heed; where `CANON_TRACEBACK` is set, as Python says it."""
    if os.environ.get("CANON_TRACEBACK"):
        return "".join(traceback.format_exception(error)).rstrip()
    home = os.path.dirname(os.path.abspath(canon.__file__))
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if frame.filename.startswith(home)] or list(frames)
    place = f" ({os.path.relpath(ours[-1].filename, home)}, line {ours[-1].lineno})" if ours else ""
    heeded = ", ".join(f"{name}={value}" for name, value in os.environ.items() if name.startswith(HEEDED))
    cause = shown(f"It may be for {heeded}")[:300] if heeded else "It is a flaw of canon's, or of a library's"
    words = shown(f"{type(error).__name__}: {error}")[:500]
    return f"canon: stopped by an internal error, {words}{place}. {cause}: CANON_TRACEBACK=1 says more"


def entry() -> None:
    """Run as a program: the exit status goes to the shell; Ctrl-C, and a reader that hangs up, are no errors."""
    _open_what_is_closed()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        try:
            status = main()
        except SystemExit as done:  # --help and argument errors: what they printed may still be in the buffer
            status = done.code
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = HUNG_UP
    except OSError as error:
        refused = error.errno in REFUSED
        what = REFUSED.get(error.errno or 0, "the output could not be written")
        with contextlib.suppress(OSError):
            print(f"canon: {what}: {error.strerror or error}", file=sys.stderr, flush=True)
        os._exit(NO_RESOURCES if refused else NOT_WRITTEN)  # what is left in the buffers can't be written, either
    except EOFError as error:
        if "marshal" not in str(error):
            raise
        with contextlib.suppress(OSError):
            print(f"canon: {error}{CUT_SHORT}", file=sys.stderr, flush=True)
        os._exit(NO_RESOURCES)
    except (MemoryError, RuntimeError, ImportError) as error:
        words = " ".join(str(error).split())[:300]
        refused = not isinstance(error, RuntimeError) or words.startswith((NO_THREADS, "RESOURCE_EXHAUSTED"))
        said = f"canon: the system gave no more: {words or 'out of memory'}" if refused else _flaw(error)
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        with contextlib.suppress(OSError):
            print(said, file=sys.stderr, flush=True)
        os._exit(NO_RESOURCES if refused else FLAW)
    except (KeyboardInterrupt, Left):
        with contextlib.suppress(OSError):
            print("canon: interrupted", file=sys.stderr, flush=True)
        os._exit(verify.INTERRUPTED)  # an orderly end of large libraries takes half a second
    except Exception as error:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        with contextlib.suppress(OSError):
            print(_flaw(error), file=sys.stderr, flush=True)
        os._exit(FLAW)  # Python's own status is that of a refuted claim
    # compiled code that nobody waits for would be in the way of an orderly end; and Python has a status of its own
    # where an interruption met a text that is executed, as for a namedtuple
    if left_behind() or status == verify.INTERRUPTED:
        with contextlib.suppress(OSError):
            sys.stderr.flush()
        os._exit(status if isinstance(status, int) else 1)
    sys.exit(status)
