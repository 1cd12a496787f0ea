"""Coverage-guided fuzzing of what reads foreign data: `python -m properties.fuzz_reader formulas -max_total_time=300`.

The first argument is what is fuzzed; the others are libFuzzer's (`-max_total_time`, `-runs`, `-max_len`, a folder of
inputs). Whatever the input, there is an answer or an error that is meant (`InputError`, `Unreadable`), within five
seconds and in 2 GB. Needs `pip install canon-mechanics[fuzz]`.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Final

import atheris

with atheris.instrument_imports(include=["canon"]):
    from canon.checker.check import check, checksum
    from canon.checker.files import load
    from canon.checker.functions import Unreadable
    from canon.claims.document import parse
    from canon.claims.journal import Journal, answered
    from canon.claims.reader import read_text
    from canon.claims.worker import Entry
    from canon.cli.main import main as command
    from canon.errors import InputError
    from canon.expression import Vocabulary, read, read_relation
    from canon.mechanics.phase_space import PhaseSpace
    from canon.report.states_file import read_arrays
    from canon.scenes.reader import read_scene_text

SPACE: Final = PhaseSpace("q x", "p y", new=("Q X", "P Y"), positive="m", symbols={"n": "integer", "z": "complex"})
VOCABULARY: Final = Vocabulary(
    symbols=SPACE.vocabulary, functions=frozenset({"V"}), pairs=tuple(zip(SPACE.q, SPACE.p, strict=True))
)
PATH: Final = os.path.join(tempfile.mkdtemp(prefix="fuzz-"), "input")
CLAIM: Final = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"\n'
SCENE: Final = (
    '[[body]]\nmass = 1\nposition = [1, 0]\n[[effect]]\nkind = "potential"\nV = "x**2"\n[run]\nduration = 1\n'
)
CLAIMS: Final = read_text(CLAIM).claims
CERTIFICATE: Final = {"certificate": 1, "verdict": "proved", "known": {}, "witness": None, "points": [], "cases": []}


def formulas(data: bytes) -> None:
    """A formula, and an inequality."""
    text = data.decode("utf-8", "surrogateescape")
    for reading in (read, read_relation):
        with suppress(InputError):
            reading(text, VOCABULARY)


def claims(data: bytes) -> None:
    """A claim file: the end of one, or all of it."""
    text = data.decode("utf-8", "replace")
    for whole in (text, CLAIM + text):
        assert all(problem["message"] for problem in read_text(whole).problems)


def scenes(data: bytes) -> None:
    """A scene: the beginning of one, or all of it."""
    text = data.decode("utf-8", "replace")
    for whole in (text, text + SCENE):
        with suppress(InputError):
            read_scene_text(whole)


def certificates(data: bytes) -> None:
    """A certificate: its bytes; its tables, with a checksum that is right; a claim's formula in it."""
    _written(data)
    with suppress(Unreadable):
        check(load(PATH))
    text = data.decode("utf-8", "replace")
    try:
        tables = json.loads(json.dumps(parse(text), default=str))
    except (InputError, ValueError, RecursionError):
        tables = {
            "phase_space": {"q": ["q"], "p": ["p"]},
            "claim": {"kind": "identity", "lhs": text, "rhs": "sin(q)**2 + cos(q)**2"},
        }
    whole = {**CERTIFICATE, "tables": tables}
    try:
        whole["checksum"] = checksum(whole)
        answer = check(whole)
    except (Unreadable, UnicodeEncodeError):
        return
    assert answer.status != "confirmed" or tables.get("claim"), text


def journals(data: bytes) -> None:
    """A journal of verdicts, and an archive of states."""
    _written(data)
    with suppress(InputError):
        answered(Journal(Path(PATH), "these settings"), [Entry("claims.toml", 0, CLAIMS[0], PATH)])
    with suppress(InputError):
        read_arrays(PATH)


def arguments(data: bytes) -> None:
    """The command line, without what writes files: a status, and never a traceback."""
    words = data.decode("utf-8", "replace").split("\x00")[:6]
    if any(word.startswith(("--c", "--p", "--o", "--r")) or os.path.exists(word) for word in words if "\0" not in word):
        return
    for word in ("verify", "simulate", "algebra", "actions", "scenes"):
        try:
            status = command([word, os.path.join(PATH, "none.toml"), *words])
        except SystemExit as done:
            status = done.code
        assert status in (0, 3), status


def _written(data: bytes) -> None:
    with open(PATH, "wb") as file:
        file.write(data)


TARGETS: Final[dict[str, Callable[[bytes], None]]] = {
    function.__name__: function for function in (formulas, claims, scenes, certificates, journals, arguments)
}


def main() -> None:
    """Fuzz what the first argument says."""
    if len(sys.argv) < 2 or sys.argv[1] not in TARGETS:
        sys.exit(f"{__doc__}\nwhat to fuzz: {', '.join(TARGETS)}")
    target = TARGETS[sys.argv.pop(1)]
    if target is arguments:
        sys.stdout = sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    atheris.Setup([*sys.argv, "-timeout=20", "-rss_limit_mb=2048"], target)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
