"""Measures one case in a process of its own: canon's verdicts, then `sympy.simplify` under a cap.

    python docs/performance/measure.py NAME [--cap 60] [--runs 7] [--skip-simplify]

One JSON object a line goes to standard output, so that what was measured survives if the process is killed.
"""

from __future__ import annotations

import argparse
import gc
import json
import resource
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import sympy as sp
from cases_all import all_cases
from cases_common import Case
from phases import Phases
from sympy.core.cache import clear_cache

from canon import Domain, PhaseSpace, Transformation, verify
from canon.budget import Budget
from canon.decide.ladder import vanish
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.domain import conditions_of

BUDGET = 60.0
ENOUGH = 4.0
"""CPU seconds of runs after which no further one is started (three are always made)."""


def verdict(case: Case) -> tuple[str, str]:
    """canon's status and method: of the claim `canonical` for a map, else of the residuals together.

    All the work from sympy's expressions to the verdict is in here: the formulas' conditions, the tape, the deciders.
    """
    if case.map is not None and not case.more:
        given = case.map
        names = ([f"new_{x}" for x in given.q], [f"new_{x}" for x in given.p])
        space = PhaseSpace(given.q, given.p, new=names)
        answer = verify(Transformation(space, Q=given.Q, P=given.P).canonical(), budget=BUDGET)
        return answer.status, answer.method
    tape = Tape()
    domain = Domain(conditions_of(*case.residuals))
    region = Region.of(tape, domain)
    answers = vanish(tape, [tape.load(residual) for residual in case.residuals], region, budget=Budget(BUDGET))
    states = {answer.status for answer in answers}
    worst = next(s for s in ("refuted", "undecided", "supported", "proved") if s in states)
    return worst, ", ".join(dict.fromkeys(a.method for a in answers if a.status == worst))


def fresh(build: Callable[[], Case]) -> Case:
    """The case, with its expressions built anew: sympy's cache is cleared, so no earlier run has warmed anything.

    What is there already is frozen, so that garbage collection looks at nothing but what the run itself makes.
    """
    gc.unfreeze()
    clear_cache()
    case = build()
    if case.map is None or case.more:
        _ = case.residuals
    gc.collect()
    gc.freeze()
    return case


def canon_times(build: Callable[[], Case], runs: int) -> dict[str, Any]:
    """CPU seconds of each run from expressions to verdict, on a new tape and with sympy's cache cleared."""
    times: list[float] = []
    answer = ("", "")
    while len(times) < runs and (len(times) < 3 or sum(times) < ENOUGH):
        case = fresh(build)
        start = time.process_time()
        answer = verdict(case)
        times.append(time.process_time() - start)
    return {"verdict": answer[0], "method": answer[1], "seconds": statistics.median(times), "runs": times}


def canon_phases(build: Callable[[], Case]) -> dict[str, float]:
    """Where the CPU time of one more run goes; the clocks themselves cost a little."""
    case = fresh(build)
    with Phases() as phases:
        verdict(case)
    return phases.spent()


def simplify_time(build: Callable[[], Case]) -> dict[str, Any]:
    """CPU seconds that `sympy.simplify` takes for all residuals, how many of them are not 0 as given, and after it."""
    case = fresh(build)
    residuals = case.residuals
    gc.collect()
    gc.freeze()
    start = time.process_time()
    left = sum(1 for residual in residuals if sp.simplify(residual) != 0)
    seconds = time.process_time() - start
    given = sum(1 for residual in residuals if residual != 0)
    return {"seconds": seconds, "residuals": len(residuals), "given": given, "left": left}


def _tell(key: str, value: Any) -> None:
    print(json.dumps({key: value}), flush=True)


def main(arguments: list[str]) -> None:
    """Measure the case named."""
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("--cap", type=float, default=60.0)
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--skip-simplify", action="store_true")
    parser.add_argument("--skip-canon", action="store_true")
    options = parser.parse_args(arguments)
    build = all_cases()[options.name]
    case = build()
    _tell("case", {"holds": case.holds, "map": case.map is not None and not case.more})
    if not options.skip_canon:
        verdict(all_cases()["c01_poincare_polar"]())
        _tell("canon", canon_times(build, options.runs))
        _tell("phases", canon_phases(build))
    if not options.skip_simplify:
        _ = case.residuals
        used = resource.getrusage(resource.RUSAGE_SELF)
        cap = int(used.ru_utime + used.ru_stime + options.cap) + 1
        building = time.process_time()
        _ = build().residuals
        cap += int(time.process_time() - building) + 1
        _tell("started", {"cap": options.cap})
        resource.setrlimit(resource.RLIMIT_CPU, (cap, cap))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
        _tell("simplify", simplify_time(build))


if __name__ == "__main__":
    main(sys.argv[1:])
