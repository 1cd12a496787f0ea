"""Who outlasts a budget, in a process that nobody kills: `python -m properties.overstay --claims 3500 --seed 2`.

Claims of the catalogue, with something odd put into one or two of their formulas (roots of roots, high powers,
exponents of long fractions), are verified as a Python program does it, under a small budget, each file in a fork with
a limit of memory. Listed are the claims that take more seconds of the processor than twice their budget and half a
second, and what ends in anything but a verdict or an input error.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import resource
import signal
import sys
import time
from pathlib import Path
from typing import Any, Final

from canon import verify
from canon.catalogue import files
from canon.claim import Claim
from canon.claims.reader import read_text
from canon.errors import InputError

ODD: Final = (
    "sqrt(1+({0})**3)", "exp({0})", "(({0})**5+({0})+1)", "tanh(1001*({0})/1000)", "log(1+({0})**2)", "atan({0})",
    "({0})*1000003/999983", "(({0})+1/3)**7", "exp(1001/1000*({0}))", "sinh({0})", "(({0})**(2/3))", "asin({0}/7)",
    "sqrt({0}+sqrt(2+{0}))", "(1/(({0})**4+{0}+1))",
)  # fmt: skip
"""What a name or number in a formula is put into."""
NAME: Final = re.compile(r"(?<![\w.])([A-Za-z]\w*|\d+)(?![\w(.])")
MEMORY: Final = 4 << 30


def spoiled(rng: random.Random, text: str) -> str:
    """A claim file with something odd in it; it may be none any more."""
    quoted = [m[1] for m in re.finditer(r'"([^"\n]+)"', text) if re.search(r"[-+*/(]", m[1])]
    formulas = [formula for formula in quoted if not re.search(r"[=<>]", formula)]
    for formula in rng.sample(formulas, min(len(formulas), rng.choice((1, 1, 2)))):
        names = list(NAME.finditer(formula))
        if names:
            at = rng.choice(names)
            odd = f"{formula[: at.start()]}({rng.choice(ODD).format(at[0])}){formula[at.end() :]}"
            text = text.replace(f'"{formula}"', f'"{odd}"', rng.choice((1, -1)))
    return text


def faults(claims: list[Claim], budget: float, pipe: int) -> None:
    """Verify the claims, and write a line of JSON about each that isn't as it should be."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, -1))
    for claim in claims:
        start, said = time.process_time(), ""
        try:
            verify(claim, budget=budget)
        except InputError:
            pass
        except Exception as error:
            said = repr(error)[:200]
        seconds = time.process_time() - start
        if said or seconds > 2 * budget + 0.5:
            found = {"index": claim.index, "kind": claim.kind, "seconds": round(seconds, 2), "error": said}
            os.write(pipe, (json.dumps(found) + "\n").encode())


def in_a_fork(claims: list[Claim], budget: float) -> list[dict[str, Any]]:
    """What is wrong with the claims of a file; the fork is ended after twenty budgets and ten seconds for each."""
    mine, its = os.pipe()
    child = os.fork()
    if child == 0:
        signal.setitimer(signal.ITIMER_PROF, len(claims) * (20 * budget + 10))  # ends it: nobody handles it
        faults(claims, budget, its)
        os._exit(0)
    os.close(its)
    with os.fdopen(mine) as pipe:
        found = [json.loads(line) for line in pipe]
    status = os.waitpid(child, 0)[1]
    return [*found, *([{"error": f"ended with {status}"}] if status else [])]


def main() -> int:
    """Try so many claims, and print what was found; exit status 1 if anything was."""
    parser = argparse.ArgumentParser(prog="python -m properties.overstay", description=__doc__)
    parser.add_argument("--claims", type=int, default=300)
    parser.add_argument("--budget", type=float, default=0.3)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    rng, paths = random.Random(asked.seed), sorted(Path(str(file)) for file in files())
    tried, found = 0, []
    while tried < asked.claims:
        path = rng.choice(paths)
        text = spoiled(rng, path.read_text(encoding="utf-8"))
        claims = list(read_text(text).claims)
        tried += len(claims)
        for fault in in_a_fork(claims, asked.budget) if claims else []:
            found.append({"file": path.name, **fault})
            print(json.dumps(found[-1]), file=sys.stderr, flush=True)
    print(json.dumps({"claims": tried, "budget": asked.budget, "wrong": found}, indent=1))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
