"""How many certificates of the catalogue Coq accepts: each is exported, and `coqc` is run on it.

    canon verify --fresh --certificate proofs
    python docs/performance/coq_catalogue.py proofs [--seconds 60] [--jobs 2] [--only WORD]

A line for each certificate that Coq refuses, or for which it takes longer than the limit; then the counts, and the
reasons for which certificates can't be exported. Needs `coqc` (Debian's package `coq`).
"""

import argparse
import subprocess
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from canon.checker.files import load
from canon.errors import InputError
from canon.report.coq import coq_of


def answer(path: Path, seconds: float) -> tuple[str, float, str]:
    """(answer, seconds of coqc, its message or the reason of a refusal) for one certificate."""
    data = load(str(path))
    polynomial = all(not case["kernels"] for case in data["cases"]) if data["verdict"] == "proved" else False
    kind = "polynomial" if polynomial else data["verdict"]
    try:
        text = coq_of(data)
    except InputError as reason:
        return f"{kind}, not exported", 0.0, str(reason).removeprefix("this certificate can't be put in Coq: ")
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "claim.v").write_text(text, encoding="utf-8")
        start = time.monotonic()
        try:
            done = subprocess.run(
                ["coqc", "-q", "claim.v"], cwd=folder, capture_output=True, text=True, timeout=seconds, check=False
            )
        except subprocess.TimeoutExpired:
            return f"{kind}, not within {seconds:g} s", seconds, ""
    taken = time.monotonic() - start
    message = " ".join(done.stderr.split()[-12:])
    return f"{kind}, {'accepted' if done.returncode == 0 else 'refused'}", taken, message


def main() -> None:
    """Go through a folder of certificates."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    paths = [path for path in sorted(Path(arguments.folder).rglob("*.json")) if arguments.only in str(path)]
    counts, reasons, total = Counter[str](), Counter[str](), 0.0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for path, (word, taken, message) in zip(
            paths, pool.map(lambda path: answer(path, arguments.seconds), paths), strict=True
        ):
            counts[word] += 1
            total += taken
            if "not exported" in word:
                reasons[message.split(": ")[-1][:60]] += 1
            elif "accepted" not in word:
                print(f"{word:<34} {path}: {message}", flush=True)
    for word, count in sorted(counts.items()):
        print(f"{count:5d}  {word}")
    print(f"coqc took {total:.0f} s in all\nnot exported:")
    for reason, count in reasons.most_common():
        print(f"{count:5d}  {reason}")


if __name__ == "__main__":
    main()
