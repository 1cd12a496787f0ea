"""The command, attacked from outside: `python -m properties.command_attacks --seed 1`.

Each attack is a command line in surroundings that are odd: variables, limits, streams, signals, terminals, files that
are none, places that can't be written to, options with values that are none, schedulers that never answer. Whatever
they are, the command ends in time, with an exit status that the reference names, without a traceback, and nothing that
it prints moves a terminal's cursor; with `--json` it prints JSON or nothing. In this process, besides: a value of every
odd kind in any place of claim files, scenes and certificates, and a journal that is damaged at each of its bytes.
"""

from __future__ import annotations

import argparse
import fcntl
import json
import os
import pty
import random
import resource
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import chdir, suppress
from itertools import islice
from pathlib import Path
from typing import Final, NamedTuple

from properties.odd_values import CLAIMS, COLOUR, journals, odd_values

STATUSES: Final = (0, 1, 2, 3, 71, 74, 130, 141)
LONGEST: Final = 120.0
MOVING: Final = {chr(k) for k in (*range(9), *range(11, 32), *range(127, 160))} | {"\u202e", "\u2028", "\u2066"}
VERIFY: Final = ("verify", "claims.toml", "--jobs", "2")


class Attack(NamedTuple):
    """A command line, and its surroundings: variables (None: taken away), what is done before it starts, a signal and
    when it is sent, the size of its terminal; and the exit statuses that are right."""

    words: tuple[str, ...]
    variables: dict[str, str | None] = {}  # noqa: RUF012 - nobody changes it
    before: Callable[[], object] | None = None
    signal: tuple[int, float] | None = None
    size: tuple[int, int] | None = None
    right: tuple[int, ...] = STATUSES


# -- the attacks -------------------------------------------------------------------------------------------

VARIABLES: Final[tuple[dict[str, str | None], ...]] = (
    {"LANG": "C", "LC_ALL": "C"}, {"PYTHONIOENCODING": "ascii"}, {"PYTHONIOENCODING": "utf-16"}, {"TERM": "dumb"},
    {"PYTHONIOENCODING": "cp037"}, {"COLUMNS": "0"}, {"COLUMNS": "-5"}, {"COLUMNS": "9" * 30}, {"LINES": "²"},
    {"PYTHONOPTIMIZE": "2"}, {"PYTHONWARNINGS": "error"}, {"PYTHONDEVMODE": "1"}, {"PYTHONUTF8": "0", "LC_ALL": "C"},
    {"TMPDIR": "/nonexistent"}, {"XDG_CACHE_HOME": "/proc/self"}, {"XDG_CACHE_HOME": "/dev/null"}, {"HOME": ""},
    {"XDG_CACHE_HOME": "a\nb"}, {"HOME": None}, {"PATH": None}, {"HOME": None, "XDG_CACHE_HOME": None, "USER": None},
    {"PYTHONINTMAXSTRDIGITS": "640"}, {"PYTHONINTMAXSTRDIGITS": "0"}, {"TZ": "none"}, {"OMP_NUM_THREADS": "0"},
    {"JAX_PLATFORMS": "none"}, {"SYMPY_USE_CACHE": "no"}, {"SYMPY_GROUND_TYPES": "python"}, {"MPMATH_NOGMPY": "1"},
    {"PYTHONMALLOC": "debug"}, {"PYTHONHASHSEED": "7"}, {"PYTHONNODEBUGRANGES": "1"}, {"FORCE_COLOR": "1"},
    {"LD_BIND_NOW": "1"}, {"PYTHONFAULTHANDLER": "1"}, {"PYTHONCASEOK": "1"}, {"SOURCE_DATE_EPOCH": "x"},
)  # fmt: skip
LIMITS: Final = (
    *(("NOFILE", n) for n in (6, 7, 9, 11, 14, 18)), *(("FSIZE", n) for n in (0, 1, 100, 3000)),
    *(("AS", n << 20) for n in (200, 400, 800, 2000)), *(("STACK", n << 10) for n in (256, 512, 4096)),
    ("CORE", 0), ("CPU", 60), ("MEMLOCK", 0), ("DATA", 1 << 30),
)  # fmt: skip
SIZES: Final = ((0, 0), (1, 1), (3, 5), (65535, 65535), (24, 80))
FILES: Final = (
    "pipe", "loop", "folder", "none.toml", "/dev/zero", "/dev/full", "/dev/stdin", "/proc/self/mem", "/proc/kmsg", "",
    "-", "claims.toml/", "a" * 300, "a/" * 3000, "\udcff.toml", f"{COLOUR}.toml", "two\nlines.toml", "~",
    "bytes.toml", "broken.toml", "deep.toml", "cut.json", "cert.json", "run.npz", "journal",
)  # fmt: skip
READ: Final = (
    ("verify",), ("verify", "--json"), ("simulate",), ("actions", "--json"), ("algebra",), ("certificate", "check"),
    ("certificate", "export", "--coq", "x.v"), ("cost", "verify", "--json"), ("verify", "claims.toml", "--resume"),
    ("simulate", "--step", "0.1", "none", "--resume"),
)  # fmt: skip
TARGETS: Final = (
    "/dev/full", "/proc/x", "loop", "claims.toml/x", "folder", "", "a" * 300, "/dev/null", "pipe", "sealed/x", "full/x",
    f"{COLOUR}", "claims.toml",
)  # fmt: skip
WRITE: Final = (
    (*VERIFY, "--certificate"), (*VERIFY, "--resume"), (*VERIFY, "--proof"),
    ("cost", "normal-form", "--order", "3", "--cap", "0.1", "--csv"),
)  # fmt: skip
NUMBERS: Final = (
    "0", "-1", "1000000000", "9" * 400, "nan", "inf", "-inf", "1e-9", "1e999", "5e-324", "1e308", "", "x", "1/0",
    "0x10", "1_0", "٣", "--", "\x1b[31m", "1e400", "q", "²",
)  # fmt: skip
OPTIONS: Final = tuple(("verify", "claims.toml", option) for option in ("--jobs", "--budget", "--accuracy", "--seed"))
ADDRESSES: Final = ("x", "tcp://256.0.0.1:1", "tcp://127.0.0.1:1", "ssh://x", "", "\x1b[31m:1", "MUTE")
SIGNALS: Final = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGKILL", "SIGSTOP", "SIGPIPE", "SIGUSR1")


def attacks(rng: random.Random, mute: str) -> Iterator[Attack]:
    """All of them; `rng` chooses the moments of signals, `mute` is the address of a scheduler that never answers."""
    yield from (Attack(VERIFY, variables, right=(0,)) for variables in VARIABLES)
    for name, most in LIMITS:
        number = getattr(resource, f"RLIMIT_{name}")
        yield Attack(VERIFY, before=lambda number=number, most=most: resource.setrlimit(number, (most, most)))
    for streams in ((0,), (1,), (2,), (0, 1), (1, 2), (0, 2), (0, 1, 2)):
        for words in (VERIFY, ("scenes",), ("--help",), ("verify", "none.toml")):
            yield Attack(words, before=lambda streams=streams: [os.close(stream) for stream in streams])
    for ignored in (signal.SIGCHLD, signal.SIGPIPE, signal.SIGALRM, signal.SIGINT):
        yield Attack(VERIFY, before=lambda ignored=ignored: signal.signal(ignored, signal.SIG_IGN), right=(0,))
        yield Attack(VERIFY, before=lambda s=ignored: signal.pthread_sigmask(signal.SIG_BLOCK, {s}), right=(0,))
    yield Attack(VERIFY, before=lambda: os.umask(0o777), right=(0,))
    yield Attack(VERIFY, before=lambda: (os.mkdir("gone"), os.chdir("gone"), os.rmdir("../gone")), right=(3,))
    for name in SIGNALS:
        for words in ((*VERIFY, "--json"), ("verify", "--fresh", "--jobs", "2", "many.toml", "--resume", "kept")):
            for _ in range(3):
                number = int(getattr(signal, name))
                yield Attack(words, signal=(number, rng.uniform(0.08, 1.5)), right=(*STATUSES, -number))
    for size in SIZES:
        yield from (Attack(words, size=size) for words in (VERIFY, ("--help",), ("hard", "--list"), ("scenes",)))
    yield from (Attack(VERIFY, {"COLUMNS": wide}, size=(24, 80), right=(0,)) for wide in ("0", "1", "9" * 9, "²"))
    yield from (Attack((*words, name)) for words in READ for name in FILES)
    yield from (Attack((*words, name + end)) for words in WRITE for name in TARGETS for end in ("", ".md"))
    yield from (Attack((*words, number)) for words in OPTIONS for number in NUMBERS)
    for address in ADDRESSES:
        yield Attack(("verify", "claims.toml", "--cluster", mute if address == "MUTE" else address), right=(3,))


def surroundings() -> None:
    """The files that attacks name, in the working folder."""
    Path("claims.toml").write_text(CLAIMS)
    Path("many.toml").write_text(CLAIMS + "".join(CLAIMS[CLAIMS.index("[[claim]]") :] for _ in range(60)))
    Path("broken.toml").write_text(CLAIMS[:70])
    Path("bytes.toml").write_bytes(random.Random(1).randbytes(5000))
    Path("deep.toml").write_text("a = " + "[" * 50_000)
    Path("cut.json").write_text('{"certificate": 1')
    Path("cert.json").write_text('{"certificate": 1, "checksum": "0"}')
    Path("run.npz").write_bytes(b"PK\x03\x04" + bytes(100))
    Path("journal").write_bytes(b'{"check": "0"}\n' * 3)
    for name in (f"{COLOUR}.toml", "two\nlines.toml", "\udcff.toml"):
        shutil.copy("claims.toml", name)
    Path("loop").symlink_to("loop")
    Path("folder").mkdir()
    Path("sealed").mkdir(0o500)
    Path("full").mkdir()
    with suppress(OSError):  # where this may be done, a disk of 64 kB that is full
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", "full"], capture_output=True, check=False)
        if os.path.ismount("full"):
            with open("full/all", "wb") as file:
                file.write(bytes(1 << 20))
    os.mkfifo("pipe")


def fault(attack: Attack) -> str:
    """What is wrong with how the command took an attack; the empty text if nothing is."""
    environment: dict[str, str] = {**os.environ, "XDG_CACHE_HOME": os.path.abspath("cache")}
    for name, value in attack.variables.items():
        environment.pop(name, None) if value is None else environment.update({name: value})
    command = [sys.executable, "-m", "canon", *attack.words]
    if any("\0" in word for word in command):
        return ""
    master, slave = pty.openpty() if attack.size else (-1, subprocess.PIPE)
    if attack.size:
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", *attack.size, 0, 0))
    process = subprocess.Popen(
        command, env=environment, stdin=subprocess.DEVNULL, stdout=slave, stderr=subprocess.PIPE,
        preexec_fn=attack.before or (lambda: signal.signal(signal.SIGINT, signal.default_int_handler)),
    )  # fmt: skip
    if attack.size:
        os.close(slave)
        with open(master, "rb", buffering=0) as shown, suppress(OSError):  # which says so where nobody writes any more
            while shown.read(1 << 16):
                pass
    if attack.signal:
        time.sleep(attack.signal[1])
        process.send_signal(attack.signal[0])
        if attack.signal[0] == signal.SIGSTOP:
            time.sleep(0.5)
            process.send_signal(signal.SIGCONT)
    try:
        out, err = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return "hang"
    said, told = (data.decode("utf-8", "surrogateescape") for data in (out or b"", err))
    if process.returncode not in attack.right:
        return f"status {process.returncode}: {told[-300:]}"
    if "Traceback" in told or "Exception ignored" in told:
        return told[-600:]
    if "PYTHONIOENCODING" not in attack.variables and MOVING & {*said, *told}:
        return f"moves the cursor: {said[:100]!r} {told[:100]!r}"
    if "--json" in attack.words and said:
        try:
            json.loads(said)
        except ValueError:
            return f"no JSON: {said[:200]!r}"
    return ""


def main() -> int:
    """Try all, and print what was wrong, as JSON; exit status 1 if anything was."""
    parsed = argparse.ArgumentParser(prog="python -m properties.command_attacks", description=__doc__)
    parsed.add_argument("--seed", type=int, default=1)
    parsed.add_argument("--values", type=int, default=3000, help="files with an odd value in one of their places")
    parsed.add_argument("--only", default="", help="a word of the command lines that are tried")
    parsed.add_argument("--after", type=int, default=0, metavar="N", help="leave out the first N command lines")
    parsed.add_argument("--most", type=int, default=None, metavar="N", help="command lines, and no odd values")
    asked = parsed.parse_args()
    rng, tried, wrong = random.Random(asked.seed), Counter[str](), []
    whole = not asked.only and asked.most is None

    def note(what: str, found: str) -> None:
        tried[what.split()[0] if what else "canon"] += 1
        if found:
            wrong.append({"attack": what[:200], "wrong": found})
            print(f"{what[:200]}: {found}", file=sys.stderr)

    asked_for = os.environ.get("PYTHONPATH")  # an empty part of it would be the working folder, as one that is gone
    home = str(Path(__file__).resolve().parents[1])
    os.environ["PYTHONPATH"] = os.pathsep.join([home, asked_for]) if asked_for else home
    with (
        tempfile.TemporaryDirectory(prefix="attacks-") as place,
        chdir(place),
        socket.create_server(("127.0.0.1", 0)) as s,
    ):
        surroundings()
        try:
            listed = attacks(rng, f"tcp://127.0.0.1:{s.getsockname()[1]}")
            end = None if asked.most is None else asked.after + asked.most
            for attack in islice(listed, asked.after, end):
                line = " ".join(attack.words)
                if asked.only in line:
                    about = f"{attack.variables or ''} {attack.signal or ''} {attack.size or ''}"
                    note(f"{line!a} {about}", fault(attack))
            for what, found in (*odd_values(rng, asked.values), *journals()) if whole else ():
                note(what, found)
        finally:
            if os.path.ismount("full"):
                subprocess.run(["umount", "full"], capture_output=True, check=False)
    print(json.dumps({"tried": sum(tried.values()), "by kind": dict(tried), "wrong": wrong}, indent=1))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
