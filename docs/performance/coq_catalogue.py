"""How many certificates of the catalogue Coq accepts: each is exported, and `coqc` is run on it.

    canon verify --fresh --certificate proofs
    python docs/performance/coq_catalogue.py proofs [--seconds 60] [--jobs 1] [--only WORD] [--journal FILE]
        [--together N]

A line for each certificate that Coq refuses, or for which it takes longer than the limit; then the counts, and the
reasons for which certificates can't be exported. The limit and the times are in seconds of `coqc`'s CPU, so that they
are the same on a busy machine; small certificates come first. With a journal, every answer is kept (a line of JSON
each), and a run that was broken off goes on where it stopped; what was exported in another form since, what was
refused, and what didn't end within a lesser limit are tried again. With `--together N`, N short files are first made
modules of one, since loading Coq's library takes longer than most of them; where that isn't accepted, each is
tried alone. A file's time is then its share. Needs `coqc` (Debian's package `coq`).
"""

from __future__ import annotations

import argparse
import hashlib
import json
import math
import resource
import subprocess
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from canon.checker.files import load
from canon.errors import InputError
from canon.report.coq import coq_of

Answer = dict[str, Any]
SHORT = 20_000
"""Bytes of a certificate that is tried together with others."""


def answers(names: Sequence[str], folder: Path, seconds: float, kept: Mapping[str, Answer]) -> list[Answer]:
    """What became of some certificates, tried as one file, and where that isn't accepted, one by one."""
    found = [answer(name, folder / name, seconds, kept.get(name), try_it=False) for name in names]
    open_ = [entry for entry in found if entry["answer"] == "not tried"]
    if len(open_) > 1:
        modules = [f"Module M{k}.\n{entry['text']}\nEnd M{k}.\n" for k, entry in enumerate(open_)]
        said = coqc("\n".join(modules), seconds)
        if said["answer"] == "accepted":
            for entry in open_:
                entry |= {**said, "seconds": round(said["seconds"] / len(open_), 2)}
    for entry in open_:
        text = entry.pop("text")
        if entry["answer"] == "not tried":
            entry |= coqc(text, seconds)
    return found


def groups(names: Sequence[str], folder: Path, most: int) -> Iterator[list[str]]:
    """The names, short certificates in groups of as many as are tried together."""
    short = [name for name in names if (folder / name).stat().st_size < SHORT]
    for k in range(0, len(short), most):
        yield short[k : k + most]
    yield from ([name] for name in names[len(short) :])


def answer(name: str, path: Path, seconds: float, kept: Mapping[str, Any] | None, *, try_it: bool = True) -> Answer:
    """What became of one certificate: its `answer`, `coqc`'s CPU time in `seconds`, a `message` or a reason.

    Where it isn't to be tried yet, the file's `text` is among them.
    """
    data = load(str(path))
    polynomial = data["verdict"] == "proved" and all(not case["kernels"] for case in data["cases"])
    found: Answer = {"name": name, "kind": "polynomial" if polynomial else data["verdict"], "limit": seconds}
    try:
        text = coq_of(data)
    except InputError as reason:
        message = str(reason).removeprefix("this certificate can't be put in Coq: ")
        return found | {"answer": "not exported", "seconds": 0.0, "message": message, "file": ""}
    found["file"] = hashlib.sha256(text.encode()).hexdigest()
    if kept and kept["file"] == found["file"] and (kept["answer"] == "accepted" or _hopeless(kept, seconds)):
        return dict(kept)
    return found | (coqc(text, seconds) if try_it else {"answer": "not tried", "text": text})


def _hopeless(kept: Mapping[str, Any], seconds: float) -> bool:
    """Whether this didn't end within such a limit."""
    return kept["answer"] == "not in time" and kept["limit"] >= seconds


def coqc(text: str, seconds: float) -> Answer:
    """What `coqc` says of a file, within seconds of CPU time."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 1))

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "claim.v").write_text(text, encoding="utf-8")
        timed = ["bash", "-c", "TIMEFORMAT='%U %S'; time coqc -q claim.v 2>message"]
        done = subprocess.run(timed, cwd=folder, capture_output=True, text=True, check=False, preexec_fn=limited)  # noqa: PLW1509
        message = (Path(folder) / "message").read_text(encoding="utf-8", errors="replace")
    taken = sum(float(word) for word in done.stderr.split()[-2:])
    killed = done.returncode != 0 and not message.strip()  # it ends without a word at the limit alone
    word = "accepted" if done.returncode == 0 else "not in time" if killed else "refused"
    return {"answer": word, "seconds": round(taken, 2), "message": " ".join(message.split()[-12:])}


def main() -> None:
    """Go through a folder of certificates."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--together", type=int, default=1)
    parser.add_argument("--journal", type=Path)
    arguments = parser.parse_args()
    folder = Path(arguments.folder)
    names = [str(path.relative_to(folder)) for path in folder.rglob("*.json")]
    names = sorted((n for n in names if arguments.only in n), key=lambda n: ((folder / n).stat().st_size, n))
    lines = arguments.journal.read_text().splitlines() if arguments.journal and arguments.journal.exists() else []
    kept = {entry["name"]: entry for entry in map(json.loads, lines)}
    counts, reasons, total = Counter[str](), Counter[str](), 0.0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        parts = groups(names, folder, arguments.together)
        jobs = [pool.submit(answers, part, folder, arguments.seconds, kept) for part in parts]
        for found in (each for job in jobs for each in job.result()):
            if arguments.journal and found != kept.get(found["name"]):
                with arguments.journal.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(found) + "\n")
            word = found["answer"] if found["answer"] != "not in time" else f"not within {found['limit']:g} s"
            counts[f"{found['kind']}, {word}"] += 1
            total += found["seconds"]
            if word == "not exported":
                reasons[found["message"].split(": ")[-1][:60]] += 1
            elif word != "accepted":
                print(f"{found['kind']}, {word:<20} {found['name']}: {found['message']}", flush=True)
    for word, count in sorted(counts.items()):
        print(f"{count:5d}  {word}")
    print(f"coqc took {total:.0f} s of CPU time in all\nnot exported:")
    for reason, count in reasons.most_common():
        print(f"{count:5d}  {reason}")


if __name__ == "__main__":
    main()
