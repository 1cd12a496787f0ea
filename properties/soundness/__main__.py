"""The command `python -m properties.soundness`."""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
import time
from collections.abc import Container
from dataclasses import asdict
from pathlib import Path

from properties.soundness.campaign import Record, limit_memory, run, summary
from properties.soundness.cases import case
from properties.soundness.known import known_case


def main() -> int:
    """Run a campaign; exit status 1 if a verdict was wrong or something crashed."""
    parser = argparse.ArgumentParser(prog="python -m properties.soundness", description=__doc__)
    parser.add_argument("--maps", type=int, default=1000, help="how many random claims")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--known", action="store_true", help="cheap cases whose truth is known by construction, without an oracle"
    )
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="one JSON object on standard output")
    parser.add_argument(
        "--journal", type=Path, help="a file of every case; those that are in it already aren't repeated"
    )
    parser.add_argument("--keep", type=Path, help="a file for what wasn't decided, one JSON record a line")
    options = parser.parse_args()
    limit_memory()
    seeds = range(options.seed * 1_000_000, options.seed * 1_000_000 + options.maps)
    start, records = time.monotonic(), journalled(options.journal, seeds)
    known = {record.seed for record in records}
    left = [seed for seed in seeds if seed not in known]
    for record in run(left, options.jobs, known_case if options.known else case):
        records.append(record)
        if options.journal:
            with options.journal.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(record)) + "\n")
        if record.wrong or record.outcome == "crash":
            print(f"\n{record.wrong or 'crash'}: seed {record.seed}: {record.cause}\n{record.text}", file=sys.stderr)
        if len(records) % 100 == 0:
            print(f"\r{len(records)} of {options.maps}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    figures = summary(records) | {"seed": options.seed, "wall_seconds": round(time.monotonic() - start, 1)}
    if options.keep:
        kept = [json.dumps(asdict(r)) for r in records if r.outcome not in ("proved", "refuted", "no claim") or r.wrong]
        options.keep.write_text("\n".join(kept) + "\n")
    if options.json:
        print(json.dumps(figures, indent=2))
    else:
        for name, value in figures.items():
            print(f"{name}: {value}")
    return 1 if figures["wrong_proved"] or figures["wrong_refuted"] or figures["crashes"] else 0


def journalled(path: Path | None, seeds: Container[int]) -> list[Record]:
    """The records of these seeds in a journal; a line that was cut short is none."""
    found = dict[int, Record]()
    for line in path.read_text(encoding="utf-8").splitlines() if path and path.exists() else ():
        with contextlib.suppress(ValueError, TypeError):
            record = Record(**json.loads(line))
            if record.seed in seeds:
                found[record.seed] = record
    return list(found.values())


if __name__ == "__main__":
    sys.exit(main())
