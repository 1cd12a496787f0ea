"""The work-precision diagram: error over seconds, both logarithmic, one labelled curve a method; matplotlib loads here.

Colours are those of Okabe and Ito (2008), which people who are colour-blind can tell apart; markers differ too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from canon.cost.study import Point, Study, measured_order, pareto
from canon.report.figure_style import plain, words
from canon.report.whole_file import figure_written

COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8A7B00")
MARKERS: Final = "osD^vP*X"
SPACING: Final = 0.035
"""Of two labels, in heights of the panel."""
LEAST: Final = 1e-32
"""An error of 0 is drawn here, or at the lowest other one."""


@plain()
def plot_studies(studies: Sequence[Study], path: str | Path) -> None:
    """One panel a study, at most six, into a file whose ending says in which format."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    shown = list(studies)[:6]
    columns = min(len(shown), 2)
    rows = math.ceil(len(shown) / columns)
    figure = Figure(figsize=(7.2 * columns, 5.0 * rows), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, study in zip(panels, shown, strict=False):
        _panel(axes, study)
    for axes in panels[len(shown) :]:
        axes.set_visible(False)
    figure_written(path, figure)


def _panel(axes: Any, study: Study) -> None:
    known = [point for point in study.points if point.error is not None and math.isfinite(point.error)]
    positive = [point.error for point in known if point.error]
    lowest = max(min(positive, default=LEAST), 1e-300)
    labels: list[tuple[float, float, str, str]] = []
    for k, method in enumerate(study.methods):
        curve = [point for point in study.of(method) if point in known]
        if not curve:
            continue
        colour, marker = COLOURS[k % len(COLOURS)], MARKERS[k % len(MARKERS)]
        x = [point.seconds for point in curve]
        y = [max(point.error or 0.0, lowest) for point in curve]
        style = "-" if k < len(COLOURS) else "--"
        axes.plot(x, y, marker=marker, ms=4, lw=1.2, ls=style, color=colour)
        order = measured_order(study, method)
        label = method if order is None or method not in study.orders else f"{method} (slope {order:.1f})"
        labels.append((y[-1], x[-1], label, colour))
        _slope(axes, study, method, curve, colour)
    front = sorted((study.points[k] for k in pareto(study.points)), key=lambda point: point.seconds)
    axes.plot(
        [p.seconds for p in front], [max(p.error or 0.0, lowest) for p in front], color="0.6", lw=4, alpha=0.4, zorder=0
    )
    if study.floor > lowest / 1e3:
        axes.axhline(study.floor, color="0.4", lw=0.8, ls=":")
        axes.annotate(
            "rounding", (0.01, study.floor), xycoords=("axes fraction", "data"), fontsize=8, color="0.4", va="bottom"
        )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="seconds (median, warm)",
        ylabel=f"error ({study.error})",
        title=words(study.title),
    )
    axes.title.set_fontsize(10)
    _label(axes, labels)
    axes.grid(True, which="major", lw=0.3)


def _label(axes: Any, labels: Sequence[tuple[float, float, str, str]]) -> None:
    """Each curve's name in the right margin, at the height of its end or, where that is taken, above."""
    low, high = (math.log10(value) for value in axes.get_ylim())
    taken = -1.0
    for y, x, text, colour in sorted(labels):
        place = max((math.log10(y) - low) / (high - low), taken + SPACING)
        taken = place
        axes.annotate(
            text, (x, y), xytext=(1.02, place), textcoords="axes fraction", color=colour, fontsize=8, va="center",
            arrowprops={"arrowstyle": "-", "color": colour, "lw": 0.4, "relpos": (0, 0.5)},
        )  # fmt: skip


def _slope(axes: Any, study: Study, method: str, curve: Sequence[Point], colour: str) -> None:
    """The line of the measured order, through the middle of the curve: where time is proportional to work."""
    order = measured_order(study, method)
    falling = [point for point in curve if point.error and point.error < 0.1 and point.error > 100 * study.floor]
    if order is None or method not in study.orders or len(falling) < 2:
        return
    middle = falling[len(falling) // 2]
    x = [middle.seconds / 2, middle.seconds * 2]
    y = [(middle.error or 1.0) * (value / middle.seconds) ** -order for value in x]
    axes.plot(x, y, color=colour, lw=0.7, ls="--")
