"""Forged certificates for the small checkers: is one shown of a claim that is false, or a refutation of a true one?

    python -m properties.forged [FILE …] [--refuted] [--share 0.1] [--seconds 8] [--seed 1] [--jobs 2]

The claims are those of the lists in this folder (all of them, where no file is named), whose truth is known. Of each
false or ill-posed one a certificate says that it is proved, and of each of its residuals that it is 0; with `--refuted`
of each true or ill-posed one that it is refuted, by three witnesses of small numbers, and by none. A line for each that
is shown; then the counts. The status is 1 if one was shown of a claim that is false (with `--refuted`: true): of an
ill-posed one it may be, as these files ask neither whether a domain has a point nor whether a file could state it.
"""

import argparse
import json
import random
import signal
import tomllib
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from typing import Any, NamedTuple

from canon.checker import alone, alone_together, alone_wider, refutations
from canon.checker.check import checksum
from canon.claims import document
from canon.claims.certificate_data import statement_tables
from canon.errors import CanonError

FOLDER, NUMBERS = Path(__file__).parent, ("3/4", "11/3", "-3/4", "2/5", "5", "1", "-2", "1/7")
COUNTS = (1, 2, 3, 4, 6, 0)
"""So many residuals are tried, where the number isn't known."""


class Late(BaseException):
    """A check that takes longer than it may."""


class Forgery(NamedTuple):
    """A claim beside the rest of its file, and whether it is true."""

    place: str
    truth: str
    tables: Any


def forgeries(path: Path, truths: set[str]) -> Iterator[Forgery]:
    """The claims of a list that have one of these truths."""
    for number, file in enumerate(tomllib.loads(path.read_text(encoding="utf-8"))["file"], 1):
        if not isinstance(file.get("text"), str):
            continue
        with suppress(CanonError):
            tables = document.parse(file["text"])
            for index, (truth, _) in enumerate(zip(file.get("truths", ()), tables["claim"], strict=False)):
                if truth in truths:
                    place = f"{path.name}, file {number}, claim {index + 1}"
                    yield Forgery(place, truth, statement_tables(tables, index))


def sealed(tables: Any, verdict: str, residuals: int, witness: Any = None) -> Any:
    """A certificate that says nothing but this verdict, with the right checksum."""
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    cases = [{"kernels": [], "atoms": {}, "residuals": [entry] * residuals}]
    data = {"certificate": 1, "tables": tables, "verdict": verdict, "method": "", "known": {}, "domain": [],
            "points": [], "witness": witness, "cases": cases}  # fmt: skip
    return {**data, "checksum": checksum(data)}


def proof(tables: Any) -> str:
    """The answer about a forged proof, with as many residuals as are asked for, or as may be."""
    counts = list[int]()
    for asked in (alone_wider.Wider, alone.Claim):
        with suppress(Exception):  # whatever is no such claim
            counts.append(len(asked(tables).zeros))
    answer = "not shown"
    for count in dict.fromkeys((*counts, *COUNTS)):
        answer, reason = alone_together.checked(sealed(tables, "proved", count))
        if answer == "shown" or (counts and "zip()" not in reason):
            break
    return answer


def refutation(tables: Any, seed: str) -> str:
    """The answer about a forged refutation, at some witnesses."""
    rng, space = random.Random(seed), tables.get("phase_space", {})
    names = [name for side in "qpQP" for name in space.get(side, [])]
    names += [name for name, words in tables.get("symbols", {}).items() if "function" not in str(words)]
    answers = [refutations.checked(sealed(tables, "refuted", 0))[0]]
    for _ in range(3):
        witness = {name: rng.choice(NUMBERS) for name in (*names, space.get("time", "t"))}
        answers.append(refutations.checked(sealed(tables, "refuted", 0, witness))[0])
    return "shown" if "shown" in answers else "not shown"


def _rung(*_: Any) -> None:
    raise Late


def asked(forgery: Forgery, refuted: bool, seconds: float) -> tuple[Forgery, str]:
    """The answer about one forgery: shown, not shown, wrong or late."""
    signal.signal(signal.SIGALRM, _rung)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        return forgery, refutation(forgery.tables, forgery.place) if refuted else proof(forgery.tables)
    except Late:
        return forgery, "late"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def main() -> int:
    """Prints what is shown and how many of each truth have each answer; 1 if one is wrong."""
    parser = argparse.ArgumentParser(description="Asks small checkers about forged certificates.")
    parser.add_argument("file", type=Path, nargs="*", default=sorted(FOLDER.glob("*.toml")))
    parser.add_argument("--refuted", action="store_true", help="refutations of true claims")
    parser.add_argument("--share", type=float, default=1, metavar="P", help="of the claims (default: 1, all)")
    parser.add_argument("--seconds", type=float, default=8, metavar="S", help="for each (default: 8)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="worker processes (default: 1)")
    given = parser.parse_args()
    lie = "true" if given.refuted else "false"
    every = (one for path in given.file for one in forgeries(path, {lie, "ill-posed"}))
    chosen = [one for one in every if random.Random(f"{given.seed} {one.place}").random() < given.share]
    tally, wrong = Counter[tuple[str, str]](), 0
    with Pool(given.jobs) as pool:
        for one, answer in pool.imap_unordered(partial(asked, refuted=given.refuted, seconds=given.seconds), chosen, 8):
            tally[one.truth, answer] += 1
            wrong += answer == "shown" and one.truth == lie
            if answer == "shown":
                print(f"shown, though {one.truth}: {one.place}: {json.dumps(one.tables['claim'])[:200]}", flush=True)
    for (truth, answer), count in sorted(tally.items()):
        print(f"{truth:10} {answer:10} {count:5}")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
