"""canon's verdicts on the branch and constant traps, beside `expression.equals(0)` of sympy.

    python docs/performance/branch_traps.py

Prints a table; the exit status is 1 if a verdict is wrong.
"""

from __future__ import annotations

import signal
import statistics
import sys
import time
from types import FrameType

import sympy as sp
from cases_traps import TRAPS, p, q, theta, x, y, z

from canon import InputError, PhaseSpace, identity, verify

SPACE = PhaseSpace([x], [y], real=[z, theta], positive=[p, q])
PATIENCE = 20.0
RIGHT = {"zero": ("proved",), "not": ("refuted",)}


def answer(expression: sp.Expr) -> str:
    """canon's verdict of `expression = 0`, or that it is no claim."""
    try:
        return verify(identity(SPACE, expression, 0), budget=20.0).status
    except InputError:
        return "input error"


def judged(truth: str, status: str) -> str:
    """`right`, `wrong`, or `withheld`."""
    if truth == "open":
        return "wrong" if status == "proved" else "withheld"
    if status in RIGHT[truth]:
        return "right"
    return "wrong" if status in ("proved", "refuted", "input error") else "withheld"


def of_sympy(expression: sp.Expr) -> str:
    """What `expression.equals(0)` says within a few seconds of CPU time."""
    signal.setitimer(signal.ITIMER_PROF, PATIENCE)
    try:
        return {True: "proved", False: "refuted"}.get(expression.equals(0), "undecided")
    except (TypeError, ValueError, AttributeError, RecursionError, TimeoutError):
        return "undecided"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def _stop(number: int, frame: FrameType | None) -> None:
    raise TimeoutError


def main() -> int:
    """Print the table."""
    signal.signal(signal.SIGPROF, _stop)
    counts: dict[str, dict[str, int]] = {"canon": {}, "equals": {}}
    times = []
    print("| expression | truth | canon | CPU time | `.equals(0)` |", "|---|---|---|--:|---|", sep="\n")
    for expression, truth in TRAPS:
        start = time.process_time()
        mine = answer(expression)
        times.append(time.process_time() - start)
        theirs = of_sympy(expression)
        for name, status in (("canon", mine), ("equals", theirs)):
            outcome = judged(truth, status)
            counts[name][outcome] = counts[name].get(outcome, 0) + 1
        shown = str(expression).replace("|", "\\|")
        marked = f"{theirs} ({judged(truth, theirs)})" if judged(truth, theirs) != "right" else theirs
        print(f"| `{shown}` | {truth} | {mine} ({judged(truth, mine)}) | {1000 * times[-1]:.1f} ms | {marked} |")
    for name, found in counts.items():
        print(f"\n{name}: " + ", ".join(f"{number} {word}" for word, number in sorted(found.items())))
    print(f"\ncanon: median {1000 * statistics.median(times):.1f} ms, worst {1000 * max(times):.0f} ms")
    return 1 if counts["canon"].get("wrong") else 0


if __name__ == "__main__":
    sys.exit(main())
