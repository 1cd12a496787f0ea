"""The command with a reader and a verifier of its own: each claim does what its kind says (hang, die, …).

A claim file is here a list of kinds, one word each. Run as a program it is `canon`; it shows what the worker
processes make of claims that no honest verifier would survive.
"""

import os
import signal
import sys
import time
import types
from fractions import Fraction
from pathlib import Path
from typing import Any

from canon.claim import Claim
from canon.errors import InputError
from canon.verdict import Verdict


def verify(claim: Claim, *, budget: float, seed: int, method: str, accuracy: float | None) -> Verdict:
    """Do what the claim's kind says."""
    kind = claim.kind
    if kind == "hang":
        while True:
            pass
    if kind == "die":
        os.abort()
    if kind == "victim" and not _asked_before():
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == "late":
        first = not _asked_before()
        while not Path(os.environ["GATE"]).exists():
            time.sleep(0.02)
        if first:
            return Verdict("undecided", kind, detail={"note": "the budget is spent"})
    if kind == "devour":
        raise MemoryError
    if kind == "ill":
        raise InputError("the domain seems empty", "claim 4")
    if kind == "flaw":
        raise ZeroDivisionError("division by zero")
    if kind == "nap":
        time.sleep(0.3)
    if kind == "gate":
        while not Path(os.environ["GATE"]).exists():
            time.sleep(0.02)
    if kind == "sleep":
        if mark := os.environ.get("ASLEEP"):
            Path(mark).touch()
        time.sleep(3600)
    if kind == "chatter":
        print("noise on standard output")
        print("noise on standard error", file=sys.stderr)
    if kind == "settings":
        return Verdict(
            "proved", kind, detail={"budget": budget, "seed": seed, "method": method, "process": os.getpid()}
        )
    if kind == "contradict":
        return Verdict(
            "undecided", kind, detail={"alarm": "a proof and a certified counterexample contradict each other"}
        )
    if kind == "false":
        return Verdict("refuted", kind, claim.title, "ball", witness={"q": Fraction(3, 2)}, detail={"value": "2"})
    return Verdict("proved", kind, claim.title, "normal form", 0.0123)


def _asked_before() -> bool:
    mark = Path(os.environ["MARK"])
    known = mark.exists()
    mark.touch()
    return known


def read_text(text: str) -> tuple[list[Claim], list[Any]]:
    """Read a list of kinds; `!kind` is expected to fail, `kind@2` has a budget of its own."""
    claims = []
    for index, word in enumerate(text.split()):
        kind, _, budget = word.removeprefix("!").partition("@")
        expect = "fails" if word.startswith("!") else "holds"
        claims.append(
            Claim(kind, None, expect=expect, budget=float(budget) if budget else None, index=index)
        )  # fmt: skip
    return claims, []


reader = types.ModuleType("canon.claims.reader")
verifier = types.ModuleType("canon.claims.verify")
reader.read_text = read_text  # type: ignore[attr-defined]
verifier.verify = verify  # type: ignore[attr-defined]
verifier.Method = str  # type: ignore[attr-defined]
verifier.check_settings = lambda settings: None  # type: ignore[attr-defined]
sys.modules["canon.claims.reader"] = reader
sys.modules["canon.claims.verify"] = verifier

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs begin with it ignored
    from canon.cli.main import entry

    entry()
