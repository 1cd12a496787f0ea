"""Claims made by hand, of which it is known whether they are true: is one of them decided wrongly?

    python -m properties.action_attacks [FILE] [--budget SECONDS] [--jobs N] [--method METHOD]

`meaning_attacks.toml` holds claims about what a claim means, of all kinds, `class_attacks.toml` those of classes that
it hardly has, `analysis_attacks.toml` those about what the theorems of analysis take for granted,
`map_attacks.toml` those about maps, brackets, algebras and surfaces, `round11_maps.toml` and `round15_maps.toml` more,
`round12.toml` those that combine what is seldom combined, `round13_maps.toml` and `round13_branches.toml` those written
from the reference alone, with near misses of them,
`round11_analysis.toml` those about which orbit or motion a claim speaks of, `round13_analysis.toml` and
`round14_analysis.toml` those of limits, integrals, orbits and variations at special values of what the symbols allow,
`round15_motion.toml` those of motion: wrong wells, separatrices, orbits that are cut, retrograde, or end,
`round15_algebra.toml` those of Lie algebras, groups and matrices at each sign of their parameters, and of branches,
`round16.toml` those of every kind with optional keys that are false, and of functions that vanish nowhere,
`round17.toml` those of all kinds about what a decider may take for granted,
`round18_maps.toml` those of maps and brackets with terms that are nearly 0, and with holes, branches and slivers,
`round18_motion.toml` those that fail at one value of a parameter, and of states that constraints allow,
`round19_motion.toml` those of orbits that words, walls, maps and other wells cut, and of germs and signs,
`round20.toml` those that combine sections and words that lists of one kind pass over,
`round21_hidden.toml` those with terms that vanish and aren't defined everywhere, beside kinks that are harmless,
`round22_words.toml` those in which a name shows nowhere, by what its own word says,
`round22_places.toml` those about single places, as the identity of a group, and about numbers that are nearly 0.
`action_attacks.toml`, where no file is named, those about actions and their mutants: a sign, a factor, a thousandth;
energies at and beyond separatrices; several wells, barriers, branches; variables of one sign, domains that cut the
orbit, kinks, masses that change their sign; angles of several turns. An ill-posed claim has no orbit, or several: it
may be refused or left open. They are decided as `canon verify` decides, by workers that stay and are killed where a
claim overstays.
"""

import argparse
import json
import sys
import time
import tomllib
from collections import Counter
from pathlib import Path

from canon.claims.reader import read_text
from canon.claims.run import run
from canon.claims.verify import METHODS
from canon.claims.worker import Entry, Settings
from canon.report.record import claim_record

WRONG = {("true", "refuted"), ("false", "proved"), ("ill-posed", "proved"), ("ill-posed", "refuted")}


def entries(path: Path) -> tuple[list[Entry], list[str], list[str]]:
    """The claims, of each its truth, and the file that it is in."""
    with path.open("rb") as stream:
        files = tomllib.load(stream)["file"]
    claims, truths, texts = list[Entry](), list[str](), list[str]()
    for number, file in enumerate(files):
        read = read_text(file["text"]).claims
        claims += [Entry(f"file {number + 1}", claim.index, claim) for claim in read]
        truths += [truth for truth, _ in zip(file["truths"], read, strict=True)]
        texts += [file["text"]] * len(read)
    return claims, truths, texts


def main() -> int:
    """Prints how many of each truth have each verdict, and what they took; 1 if one is wrong."""
    parser = argparse.ArgumentParser(description="Decides claims whose truth is known.")
    parser.add_argument("file", type=Path, nargs="?", default=Path(__file__).parent / "action_attacks.toml")
    parser.add_argument("--method", choices=METHODS, default="symbolic")
    parser.add_argument("--budget", type=float, default=20, metavar="SECONDS")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="worker processes (default: 1)")
    asked = parser.parse_args()
    claims, truths, texts = entries(asked.file)
    tally, wrong, start = Counter[tuple[str, str]](), list[str](), time.monotonic()
    slow = list[tuple[float, str, int, str]]()
    done = run(claims, Settings(budget=asked.budget, method=asked.method), claim_record, jobs=asked.jobs)
    for position, answer in done:
        entry, truth = claims[position], truths[position]
        verdict = answer["claim"]["verdict"] if "claim" in answer else "input error"
        tally[truth, verdict] += 1
        if "claim" in answer:
            note = json.dumps(answer["claim"]["detail"].get("note", ""))[:90]
            slow.append((answer["claim"]["seconds"], entry.file, entry.index + 1, f"{verdict} {note}"))
        if (truth, verdict) in WRONG:
            assert entry.claim is not None
            wrong.append(
                f"{verdict}, though {truth}: {entry.claim.kind}, claim {entry.index + 1} of\n{texts[position]}"
            )
        if sys.stderr.isatty():
            print(f"\r{sum(tally.values())} of {len(claims)}", end="", file=sys.stderr, flush=True)
    for (truth, verdict), count in sorted(tally.items()):
        print(f"{truth:10} {verdict:12} {count:4}")
    slow.sort(reverse=True)
    print(
        f"{time.monotonic() - start:.0f} s, {sum(seconds for seconds, *_ in slow):.0f} s in the workers; the slowest:"
    )
    print(
        *(f"  {seconds:6.1f} s  {file}, claim {index}: {words}" for seconds, file, index, words in slow[:8]), sep="\n"
    )
    print(*wrong, f"{len(wrong)} wrong of {sum(tally.values())}", sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
