"""Claims about actions and their mutants, of which it is known whether they are true: is one of them decided wrongly?

    python -m properties.action_attacks [--budget SECONDS]

`action_attacks.toml` holds them, made by hand: a sign, a factor, a thousandth; energies at and beyond separatrices;
several wells, barriers, branches; variables of one sign, domains that cut the orbit, kinks, masses that change their
sign; angles of several turns. An ill-posed claim has no orbit, or several: it may be refused or left open.
"""

import argparse
import tomllib
from collections import Counter
from pathlib import Path

from canon import verify
from canon.claims.reader import read_text
from canon.errors import InputError

WRONG = {("true", "refuted"), ("false", "proved"), ("ill-posed", "proved"), ("ill-posed", "refuted")}


def main() -> int:
    """Prints how many of each truth have each verdict; 1 if one is wrong."""
    parser = argparse.ArgumentParser(description="Decides claims about actions whose truth is known.")
    parser.add_argument("--budget", type=float, default=20, metavar="SECONDS")
    budget = parser.parse_args().budget
    tally, wrong = Counter[tuple[str, str]](), list[str]()
    with (Path(__file__).parent / "action_attacks.toml").open("rb") as stream:
        files = tomllib.load(stream)["file"]
    for file in files:
        reading = read_text(file["text"])
        for truth, claim in zip(file["truths"], reading.claims, strict=True):
            try:
                verdict = verify(claim, budget=budget).status
            except InputError:
                verdict = "input error"
            tally[truth, verdict] += 1
            if (truth, verdict) in WRONG:
                wrong.append(f"{verdict}, though {truth}: {claim.kind} of\n{file['text']}")
    for (truth, verdict), count in sorted(tally.items()):
        print(f"{truth:10} {verdict:12} {count:4}")
    print(*wrong, f"{len(wrong)} wrong of {sum(tally.values())}", sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
