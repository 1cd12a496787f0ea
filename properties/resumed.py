"""A campaign that is interrupted at random and resumed, beside one that isn't: `python -m properties.resumed`.

Claims are written into files at random (brackets, canonical maps, constants of the motion, with mutants of them), and
verified by the command as a user would. The second time the command is stopped after a random time, by one signal after
another (to the command, to its whole group, to a worker), and started again with `--resume`, as often as is asked, and
then until it comes to its end. It is stopped when the journal has grown by a random part of what is left to do, so that
each stop costs something.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Final

HEAD = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
m = "positive"
k = "positive"
[hamiltonian]
H = "p**2/(2*m) + k*q**2/2"
"""
PER_FILE = 50
STOPS: Final = (
    ("command", signal.SIGINT), ("command", signal.SIGKILL), ("group", signal.SIGTERM), ("worker", signal.SIGKILL),
    ("group", signal.SIGSTOP), ("command", signal.SIGHUP), ("worker", signal.SIGTERM), ("group", signal.SIGKILL),
    ("command", signal.SIGSTOP), ("group", signal.SIGINT), ("command", signal.SIGQUIT), ("command", signal.SIGTERM),
)  # fmt: skip
"""Who is sent what, in turn."""


def file_text(rng: random.Random) -> str:
    """A claim file whose transformation is a shear, true or spoiled, and claims about it and about brackets."""
    degree, factor, spoil = rng.randint(2, 7), rng.randint(1, 99), rng.choice(("", "", "*1001/1000"))
    text = HEAD + f'[transformation]\nQ = ["q{spoil}"]\nP = ["p + {factor}*q**{degree}/k"]\n'
    for _ in range(PER_FILE):
        n, c = rng.randint(2, 9), rng.choice(("", "", "*(1 + 1/10**9)"))
        kind = rng.randrange(4)
        if kind == 0:
            text += '[[claim]]\nkind = "canonical"\n'
        elif kind == 1:
            text += (
                f'[[claim]]\nkind = "bracket"\nf = "q**{n}*p"\ng = "sin(p)"\nequals = "{n}*q**{n - 1}*p*cos(p){c}"\n'
            )
        elif kind == 2:
            text += f'[[claim]]\nkind = "conserved"\nf = "exp(H_**{n % 3 + 1}{c and "*q"})"\n'.replace(
                "H_", "(p**2/(2*m) + k*q**2/2)"
            )
        else:
            text += f'[[claim]]\nkind = "identity"\nlhs = "cos({n}*q)**2 + sin({n}*q)**2{c}"\nrhs = "1"\n'
    return text


def command(folder: Path, jobs: int, *more: str) -> list[str]:
    """The command that verifies all files of a folder."""
    return [sys.executable, "-m", "canon", "verify", str(folder), "--json", "--jobs", str(jobs), *more]


def verdicts(output: str) -> list[dict[str, Any]]:
    """What a run found, but for the time that it took."""
    return [{**claim, "seconds": 0} for claim in json.loads(output)["claims"]]


def heard() -> None:
    """A background job begins with Ctrl-C ignored; this one is to hear it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.setsid()


def workers_of(process: int) -> list[int]:
    """The processes that a process has started; none where the system doesn't tell."""
    try:
        return [int(word) for word in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    except OSError:
        return []


def send(process: int, whom: str, number: int) -> None:
    """Send a signal; after it, where the command goes on, continue it, and send it Ctrl-C a moment later."""
    with contextlib.suppress(ProcessLookupError):
        if whom == "worker":
            for worker in workers_of(process)[:1]:
                os.kill(worker, number)
        elif whom == "group":
            os.killpg(process, number)
        else:
            os.kill(process, number)
        if whom == "worker" or number == signal.SIGSTOP:
            time.sleep(2.0 if number == signal.SIGSTOP else 0.2)
            os.killpg(process, signal.SIGCONT)
            time.sleep(0.2)
            os.kill(process, signal.SIGINT)


def lines_of(journal: Path) -> int:
    """How many answers were written down."""
    return journal.read_bytes().count(b"\n") if journal.exists() else 0


def stopped(line: list[str], journal: Path, lines: int, whom: str, number: int) -> None:
    """Run a command until its journal has so many lines, and send a signal then; if it ends before, it has ended."""
    process = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=heard)
    while process.poll() is None and lines_of(journal) < lines:
        time.sleep(0.02)
    send(process.pid, whom, number)
    process.wait()


def main() -> int:
    """Run both, compare, print the figures; exit status 1 where they differ."""
    parser = argparse.ArgumentParser(prog="python -m properties.resumed", description=__doc__)
    parser.add_argument("--claims", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--stops", type=int, default=0, metavar="N", help="stop it so often (default: 2 to 5 times)")
    options = parser.parse_args()
    rng = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as name:
        folder, kept = Path(name) / "claims", Path(name) / "journal"
        folder.mkdir()
        for k in range(-(-options.claims // PER_FILE)):
            (folder / f"{k:05d}.toml").write_text(file_text(rng), encoding="utf-8")
        start = time.monotonic()
        whole = verdicts(subprocess.run(command(folder, options.jobs), capture_output=True, text=True).stdout)
        seconds = time.monotonic() - start
        stops, at = options.stops or rng.randint(2, 5), list[int]()
        resumed = command(folder, options.jobs, "--resume", str(kept))
        for stop in range(stops):
            wanted = lines_of(kept) + int((len(whole) - lines_of(kept)) * rng.uniform(0.02, 0.6)) + rng.randint(0, 3)
            stopped(resumed, kept, wanted, *STOPS[(stop + options.seed) % len(STOPS)])
            at.append(lines_of(kept))
        again = verdicts(subprocess.run(resumed, capture_output=True, text=True).stdout)
        lines = lines_of(kept)
    words = ("proved", "refuted", "supported", "undecided")
    counts = {word: sum(claim["verdict"] == word for claim in whole) for word in words}
    found = {"claims": len(whole), **counts, "interruptions": len(at), "answered_by_then": at}
    print(json.dumps({**found, "lines_of_journal": lines, "same": again == whole, "seconds": round(seconds, 1)}))
    return 0 if again == whole else 1


if __name__ == "__main__":
    sys.exit(main())
