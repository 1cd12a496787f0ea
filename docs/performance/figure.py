"""The benchmark's figure: canon's and simplify's CPU times case by case, on a logarithmic axis."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from summary import identities, misses

Record = dict[str, Any]
CANON, SIMPLIFY, JOIN = "#0072B2", "#D55E00", "#BBBBBB"
"""Blue and vermilion of Okabe and Ito's palette, told apart in every common kind of colour vision."""


def draw(report: Record, path: Path) -> None:
    """Draw all cases, fastest proof first, and write a PNG."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    groups = [("identities", identities(report)), ("near misses", misses(report))]
    heights = [len(cases) for _, cases in groups]
    figure, axes = plt.subplots(
        2, 1, figsize=(9, 15), sharex=True, height_ratios=heights, layout="constrained", squeeze=True
    )
    for axis, (title, cases) in zip(axes, groups, strict=True):
        _panel(axis, title, cases, report["cap"])
    axes[-1].set_xlabel("CPU time in seconds, from sympy expressions to the answer")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _panel(axis: Any, title: str, cases: dict[str, Record], cap: float) -> None:
    ordered = sorted(cases, key=lambda name: cases[name]["canon"]["seconds"], reverse=True)
    for row, name in enumerate(ordered):
        case = cases[name]
        mine, other = case["canon"]["seconds"], case.get("simplify")
        if other and other.get("given", 1):
            theirs = other.get("seconds", other.get("cap"))
            axis.plot([mine, theirs], [row, row], color=JOIN, linewidth=0.8, zorder=1)
            stopped = "stopped" in other
            done = not stopped and not other["left"]
            face = SIMPLIFY if done else "white"
            axis.plot(theirs, row, marker=">" if stopped else "s", color=SIMPLIFY, markerfacecolor=face, markersize=5)
        axis.plot(mine, row, marker="o", color=CANON, markersize=5, zorder=2)
    axis.set_yticks(range(len(ordered)), ordered, fontsize=7)
    axis.set_xscale("log")
    axis.set_ylim(-0.8, len(ordered) + 0.8)
    axis.grid(axis="x", color="#E5E5E5", linewidth=0.6)
    axis.set_axisbelow(True)
    axis.axvline(cap, color=JOIN, linestyle=":", linewidth=0.9)
    axis.spines[["top", "right"]].set_visible(False)
    axis.set_title(f"{title}, of simplify: ▷ stopped at its cap, □ nonzero residues left", loc="left", fontsize=9)
    place = {"xytext": (0, 7), "textcoords": "offset points", "ha": "center", "fontsize": 8}
    axis.annotate("canon", (cases[ordered[-1]]["canon"]["seconds"], len(ordered) - 1), color=CANON, **place)
    timed = [row for row, name in enumerate(ordered) if cases[name].get("simplify", {}).get("seconds", 0) > 0.01]
    if timed:
        where = cases[ordered[timed[-1]]]["simplify"]["seconds"]
        axis.annotate("sympy.simplify", (where, timed[-1]), color=SIMPLIFY, **place)
