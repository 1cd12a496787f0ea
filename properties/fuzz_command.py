"""Random command lines, and damaged memories: `python -m properties.fuzz_command --inputs 20000 --seed 1`.

Every command is called with its own options, with files that are sound, broken, missing, folders or no files at all,
and with values that are odd. Whatever they are, the exit status is one that the reference names, nothing ends in a
traceback, and with `--json` what is printed is JSON or nothing. What is remembered of verdicts is spoiled too: byte by
byte, and with anything in it under a checksum that is right.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import random
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path
from typing import Any, Final

import canon.cli.verify as verify_command
from canon.claims.remembered import _checksum
from canon.cli.files import ClaimFile
from canon.cli.main import main as command
from canon.cli.main import parser

CLAIMS: Final = (
    '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"\n'
    '[[claim]]\nkind = "identity"\nlhs = "sqrt(q**2)"\nrhs = "q"\nexpect = "fails"\n'
)
STATUSES: Final = (0, 1, 2, 3, 74)
SLOWEST: Final = 20.0
"""Seconds of a processor after which a command line is called a hang."""
ODD: Final = (
    "", " ", "-", "--", "0", "-1", "1", "2.5", "1e999", "nan", "inf", "-inf", "1/0", "q=1", "q==1", "=", "E=1/2",
    "\x00", "\udc80", "ß", "\u202eabc", "9" * 400, "a" * 10_000, "%s%n", "{0}", "$(id)", "`id`",
    "/dev/null", "/dev/zero", "/proc/self/mem", "~", "*", "\n", "\t", "all", "numeric", "none.toml", "claims.toml",
    "broken.toml", "folder", "certificate.json", "pipe", "link.toml", "tcp://127.0.0.1:1", "x.png", "x.csv",
    "x.v", "x.lean", "__import__('os')", "q.__class__", "1e-3", "1_0", "٣", "0x10", "pendulum", "kepler", "rotation",
)  # fmt: skip
LONG: Final = ("hard", "cost", "simulate")
"""Commands that would run for long on what is sound: they are given no file that is."""


def folder(place: Path) -> None:
    """The files that command lines name."""
    (place / "claims.toml").write_text(CLAIMS)
    (place / "broken.toml").write_text(CLAIMS[:70])
    (place / "folder").mkdir()
    (place / "certificate.json").write_text('{"certificate": 1}')
    (place / "link.toml").symlink_to("link.toml")
    os.mkfifo(place / "pipe")


def options() -> dict[str, list[str]]:
    """The options of each command."""
    subparsers = next(a for a in parser()._actions if isinstance(a, argparse._SubParsersAction))
    found = {}
    for name, sub in subparsers.choices.items():
        found[name] = [option for action in sub._actions for option in action.option_strings]
        for deeper in (a for a in sub._actions if isinstance(a, argparse._SubParsersAction)):
            for word, inner in deeper.choices.items():
                found[name] += [word, *(option for action in inner._actions for option in action.option_strings)]
    return found


def line(rng: random.Random, known: dict[str, list[str]]) -> list[str]:
    """A command line."""
    name = rng.choice([*known, "verify", "verify", "algebra", "actions", "certificate"])
    words = [] if rng.random() < 0.2 else ["claims.toml" if name not in LONG else "none.toml"]
    for _ in range(rng.randrange(6)):
        kind = rng.randrange(8)
        if kind < 4 and known[name]:
            words.append(rng.choice(known[name]))
        elif kind < 7:
            words.append(rng.choice(ODD))
        else:
            words.append("".join(chr(rng.choice((rng.randrange(32, 127), rng.randrange(0x3000)))) for _ in range(6)))
        if rng.random() < 0.1 and len(words) > 1:
            words[-2:] = ["=".join(words[-2:])]
    if name in LONG:
        words = [word for word in words if word not in ("pendulum", "kepler", "claims.toml", "--slow")]
        words.append("none.toml" if name != "hard" else "--list")
    if name == "verify" and not any(word.endswith(".toml") for word in words):
        words.append("none.toml")  # without a file the whole catalogue would be decided
    return [name, *words] if rng.random() < 0.97 else words


def answered(words: list[str]) -> tuple[Any, str, str]:
    """(exit status, standard output, what is wrong) of a command line."""
    out, err = io.StringIO(), io.StringIO()
    start = time.process_time()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                status = command(words)
            except SystemExit as done:
                status = done.code
    except BaseException:  # a crash is what is looked for
        return None, out.getvalue(), traceback.format_exc()
    wrong = ""
    if status not in STATUSES:
        wrong = f"status {status}"
    elif "Traceback" in err.getvalue() or "Traceback" in out.getvalue():
        wrong = err.getvalue()
    elif time.process_time() - start > SLOWEST:
        wrong = "slow"
    elif "--json" in (asked := words[: words.index("--")] if "--" in words else words) and (
        out.getvalue() and not {"--help", "-h", "--list"} & {*asked}
    ):
        try:
            json.loads(out.getvalue())
        except ValueError:
            wrong = f"no JSON: {out.getvalue()[:200]!r}"
    return status, out.getvalue(), wrong


# -- what is remembered ------------------------------------------------------------------------------------

ANYTHING: Final = (
    None,
    True,
    0,
    -1,
    1e308,
    "",
    "proved",
    "refuted",
    [],
    {},
    [[]],
    {"a": 1},
    "9" * 1000,
    ["x"],
    {"verdict": 1},
)


def spoiled(rng: random.Random, value: Any) -> Any:
    """JSON with one of its places changed to anything, or left out, or doubled."""
    if isinstance(value, dict) and value and rng.random() < 0.9:
        key = rng.choice(list(value))
        if rng.random() < 0.15:
            return {k: v for k, v in value.items() if k != key}
        return {**value, key: spoiled(rng, value[key])}
    if isinstance(value, list) and value and rng.random() < 0.9:
        k = rng.randrange(len(value))
        if rng.random() < 0.15:
            return [*value, value[k]]
        return [*value[:k], spoiled(rng, value[k]), *value[k + 1 :]]
    return rng.choice(ANYTHING)


def memories(rng: random.Random, kept: Path) -> str:
    """What is wrong when a memory that is spoiled is read; the empty text if nothing is."""
    sound = kept.read_bytes()
    if rng.random() < 0.5:
        data = bytearray(sound)
        for _ in range(rng.randrange(1, 4)):
            data[rng.randrange(len(data))] = rng.randrange(256)
        kept.write_bytes(bytes(data[: rng.choice((len(data), rng.randrange(len(data))))]))
    else:
        body = spoiled(rng, json.loads(sound)["body"])
        kept.write_text(json.dumps({"checksum": _checksum(body), "body": body}))
    words = ["verify", *rng.choice(([], ["--json"], ["--coverage"]))]
    _, _, wrong = answered(words)
    kept.write_bytes(sound)
    return wrong


def main() -> int:
    """Try command lines and memories, and print one JSON object; exit status 1 if anything was wrong."""
    parsed = argparse.ArgumentParser(prog="python -m properties.fuzz_command", description=__doc__)
    parsed.add_argument("--inputs", type=int, default=2000)
    parsed.add_argument("--memories", type=int, default=200)
    parsed.add_argument("--seed", type=int, default=1)
    asked = parsed.parse_args()
    rng, known = random.Random(asked.seed), options()
    statuses, wrong = Counter[str](), []
    with tempfile.TemporaryDirectory(prefix="fuzz-") as name, contextlib.chdir(name):
        place = Path(name)
        folder(place)
        os.environ["XDG_CACHE_HOME"] = str(place / "cache")
        for _ in range(asked.inputs):
            words = line(rng, known)
            status, _, fault = answered(words)
            statuses[str(status)] += 1
            if fault:
                wrong.append({"words": [word[:80] for word in words], "wrong": fault[-1500:]})
                print(f"{words}: {fault}", file=sys.stderr)
        folder_again = place / "catalogue.toml"
        folder_again.write_text(CLAIMS)
        verify_command._catalogue = lambda: [ClaimFile("catalogue.toml", folder_again)]  # type: ignore[assignment]
        shutil.rmtree(place / "cache", ignore_errors=True)
        answered(["verify"])
        (kept,) = (place / "cache").rglob("*.json")
        for _ in range(asked.memories):
            fault = memories(rng, kept)
            if fault:
                wrong.append({"words": ["a memory"], "wrong": fault[-1500:]})
                print(fault, file=sys.stderr)
    figures = {"inputs": asked.inputs, "memories": asked.memories, "statuses": dict(statuses), "wrong": wrong[:20]}
    print(json.dumps(figures, indent=1))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
