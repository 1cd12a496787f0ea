"""The benchmark's table in Markdown."""

from __future__ import annotations

import statistics
from pathlib import Path
from typing import Any

from summary import identities, misses, phase_shares, ratio, right, simplify_decides, simplify_works, spread

Record = dict[str, Any]


def milliseconds(seconds: float) -> str:
    """A time for people."""
    return f"{1000 * seconds:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"


def simplified(case: Record) -> str:
    """Simplify's cell."""
    found = case.get("simplify")
    if not found:
        return "not run"
    if "stopped" in found:
        return f"stopped after {found['cap']:g} s" if found["stopped"] == "cap" else "out of memory (4 GiB)"
    if not found["given"]:
        return "nothing to do: the residuals are 0 as given"
    left = f", {found['left']} of {found['residuals']} left" if found["left"] else ""
    return milliseconds(found["seconds"]) + left


def times(case: Record) -> str:
    """The ratio's cell."""
    value = ratio(case)
    if value is None or not case["simplify"].get("given", 1):
        return ""
    shown = f"{value:.0f}" if value < 1000 else f"{value:,.0f}"
    return f"> {shown}×" if "stopped" in case["simplify"] else f"{shown}×"


def _rows(cases: dict[str, Record]) -> list[str]:
    lines = ["| case | canon | CPU time | sympy.simplify | ratio |", "|---|---|--:|--:|--:|"]
    for name, case in cases.items():
        found = case["canon"]
        verdict = found["verdict"] if right(case) else f"**{found['verdict']}**"
        cells = (f"`{name}`", f"{verdict} ({found['method']})", milliseconds(found["seconds"]))
        lines.append("| " + " | ".join((*cells, simplified(case), times(case))) + " |")
    return lines


def headline(report: Record) -> list[str]:
    """Counts, medians and percentiles."""
    lines = ["| | cases | decided | median | 90th percentile | worst |", "|---|--:|--:|--:|--:|--:|"]
    for title, cases in (("identities", identities(report)), ("near misses", misses(report))):
        median, ninety, worst, name = spread(cases)
        decided = sum(right(case) for case in cases.values())
        shown = " | ".join(map(milliseconds, (median, ninety, worst)))
        lines.append(f"| {title} | {len(cases)} | {decided} | {shown} (`{name}`) |")
    decided = sum(simplify_decides(case) for case in identities(report).values())
    both = {name: case for name, case in identities(report).items() if simplify_works(case)}
    if both:
        ratios = {name: ratio(case) or 0.0 for name, case in both.items()}
        least = min(ratios, key=lambda name: ratios[name])
        lines += [
            "",
            f"`sympy.simplify` brings {decided} of the identities to 0 within {report['cap']:g} s of CPU time, "
            f"{decided - len(both)} of which are 0 as soon as sympy has built the residuals. On the other {len(both)} "
            f"canon is {statistics.median(ratios.values()):.0f} times as fast in the median, and "
            f"{ratios[least]:.0f} times where it gains least (`{least}`).",
        ]
    return lines


def write_table(report: Record, path: Path) -> None:
    """Write the whole table."""
    made = report["machine"]
    lines = [
        "# Verdicts beside sympy.simplify",
        "",
        "Made by `python docs/performance/verify_benchmark.py`; what is measured and how is said in `README.md`.",
        f"Python {made['python']}, sympy {made['sympy']}, python-flint {made['python-flint']}, {made['processor']}.",
        "",
        *headline(report),
        "",
        "## Identities",
        "",
        *_rows(identities(report)),
        "",
        "## Near misses",
        "",
        *_rows(misses(report)),
        "",
        "## Where the time goes",
        "",
        "| phase | identities: share of all time | mean share | near misses: share of all time | mean share |",
        "|---|--:|--:|--:|--:|",
    ]
    proofs, refutations = phase_shares(identities(report)), phase_shares(misses(report))
    for name in dict.fromkeys((*proofs, *refutations)):
        cells = [f"{100 * share:.0f} %" for found in (proofs, refutations) for share in found.get(name, (0.0, 0.0))]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    path.write_text("\n".join(lines) + "\n")
