"""What the benchmark's record comes to: counts, medians, percentiles, ratios."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from typing import Any

Record = dict[str, Any]


def identities(report: Record) -> dict[str, Record]:
    """The cases that hold."""
    return {name: case for name, case in report["cases"].items() if case["case"]["holds"]}


def misses(report: Record) -> dict[str, Record]:
    """The near misses."""
    return {name: case for name, case in report["cases"].items() if not case["case"]["holds"]}


def right(case: Record) -> bool:
    """True where canon decided the case, as it is."""
    return case["canon"]["verdict"] == ("proved" if case["case"]["holds"] else "refuted")


def simplify_decides(case: Record) -> bool:
    """True where simplify brought every residual of an identity to 0 within its cap."""
    found = case.get("simplify", {})
    return case["case"]["holds"] and "seconds" in found and not found["left"]


def simplify_works(case: Record) -> bool:
    """True where it decided, and the residuals were not all the number 0 before it began."""
    return simplify_decides(case) and bool(case["simplify"]["given"])


def ratio(case: Record) -> float | None:
    """Simplify's CPU time over canon's; where simplify was stopped, its cap over canon's: a lower bound."""
    found = case.get("simplify")
    if not found or "canon" not in case:
        return None
    return found.get("seconds", found.get("cap")) / case["canon"]["seconds"]


def percentile(values: Sequence[float], percent: float) -> float:
    """The smallest of the values that at least that many per cent of them don't exceed."""
    ordered = sorted(values)
    return ordered[max(0, -(-len(ordered) * percent // 100).__int__() - 1)]


def spread(cases: dict[str, Record]) -> tuple[float, float, float, str]:
    """(median, 90th percentile, worst, its name) of canon's CPU seconds."""
    times = {name: case["canon"]["seconds"] for name, case in cases.items()}
    worst = max(times, key=lambda name: times[name])
    values = list(times.values())
    return statistics.median(values), percentile(values, 90), times[worst], worst


def phase_shares(cases: dict[str, Record]) -> dict[str, tuple[float, float]]:
    """For each phase: its share of all CPU time, and the mean of its shares case by case."""
    spent = [case["phases"] for case in cases.values() if "phases" in case]
    names = [name for name in spent[0] if any(s.get(name) for s in spent)]
    totals = [sum(s.values()) for s in spent]
    return {
        name: (
            sum(s.get(name, 0.0) for s in spent) / sum(totals),
            statistics.mean(s.get(name, 0.0) / t for s, t in zip(spent, totals, strict=True)),
        )
        for name in names
    }
