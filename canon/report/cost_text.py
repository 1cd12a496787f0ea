"""A study of cost as a table for terminals, as rows for spreadsheets, and what it says of accuracies to be bought."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from typing import Final

from canon.cost.study import Point, Study, cheapest, measured_order, next_digit, pareto
from canon.report.words import duration, visible

ASKED: Final = (1e-3, 1e-6, 1e-9, 1e-12)
FRONT: Final = "*"
_HEADINGS: Final = {"energy": "energy", "symplecticity": "M J Mᵀ − J", "loop": "∮ p dq"}


def study_lines(study: Study, *, accuracy: float | None = None, budget: float | None = None) -> Iterator[str]:
    """The table: every configuration, those marked that nothing else beats in error and in time at once."""
    front = pareto(study.points)
    yield visible(study.title)
    yield f"  error: {study.error}; measured against {study.reference}"
    measures = [name for name in _HEADINGS if any(name in point.measures for point in study.points)]
    width = max(map(len, study.methods), default=6)
    heading = f"    {'method':<{width}}  {study.unit:>9}  {'error':>8}"
    yield heading + "".join(f"  {_HEADINGS[name]:>10}" for name in measures) + f"  {'time':>10}"
    for k, point in enumerate(study.points):
        yield f"  {FRONT if k in front else ' '} {_row(point, width, measures)}"
    yield f"  {FRONT} nothing is as exact in less time" + (f"; floor {study.floor:.0e}" if study.floor else "")
    for method in study.methods:
        order, digit = measured_order(study, method), next_digit(study, method)
        claimed = study.orders.get(method)
        if order is not None and claimed is not None and digit is not None:
            more = f"one digit more takes {digit:.2g} times as long"
            yield f"    {method:<{width}}  order {claimed}, measured {order:.1f}: {more}"
    yield from _choices(study, accuracy, budget)
    for message in study.messages:
        yield f"  ! {message}"


def _row(point: Point, width: int, measures: Sequence[str]) -> str:
    work = "" if point.work is None else f"{point.work:g}"
    cells = [f"{point.method:<{width}}", f"{work:>9}", f"{_number(point.error):>8}"]
    cells += [f"{_number(point.measures.get(name)):>10}" for name in measures]
    cells.append(f"{duration(point.seconds):>10}")
    return "  ".join([*cells, *([point.note] if point.note else [])])


def _number(value: float | None) -> str:
    return "–" if value is None else "0" if value == 0 else f"{value:.1e}"


def _choices(study: Study, accuracy: float | None, budget: float | None) -> Iterator[str]:
    """The cheapest configuration for an accuracy, and the most exact one within a time."""
    if budget is not None:
        within = [point for point in study.points if point.seconds <= budget and point.error is not None]
        best = min(within, key=lambda point: point.error or 0.0, default=None)
        found = "nothing that was tried" if best is None else f"{_named(best, study)}, error {_number(best.error)}"
        yield f"  within {duration(budget)}: {found}"
    if study.kind in ("verify", "loop", "normal-form", "action") and accuracy is None:
        return
    for asked in (accuracy,) if accuracy is not None else ASKED:
        best = cheapest(study, asked)
        if best is not None:
            yield f"  for {asked:.0e}: {_named(best, study)}, {duration(best.seconds)}"
        elif accuracy is not None:
            yield f"  for {asked:.0e}: nothing that was tried; the best is {_number(_best(study))}"


def _named(point: Point, study: Study) -> str:
    return point.method if point.work is None else f"{point.method} with {point.work:g} {study.unit}"


def _best(study: Study) -> float | None:
    return min((point.error for point in study.points if point.error is not None), default=None)


def as_csv(studies: Sequence[Study]) -> str:
    """All points of all studies, one a row."""
    measures = list(dict.fromkeys(name for study in studies for point in study.points for name in point.measures))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        [
            "kind",
            "title",
            "method",
            study_unit(studies),
            "error",
            *measures,
            "seconds",
            "least",
            "first",
            "runs",
            "pareto",
            "note",
        ]
    )
    for study in studies:
        front = pareto(study.points)
        for k, point in enumerate(study.points):
            writer.writerow(
                [study.kind, _cell(study.title), point.method, point.work, point.error]
                + [point.measures.get(name) for name in measures]
                + [point.seconds, point.least, point.first, point.runs, int(k in front), _cell(point.note)]
            )
    return text.getvalue()


def _cell(text: str) -> str:
    """A text of which neither a terminal nor a spreadsheet makes a command: what begins with = is a formula there."""
    shown = visible(text)
    return f"'{shown}" if shown.startswith(("=", "+", "-", "@")) else shown


def study_unit(studies: Sequence[Study]) -> str:
    """The unit of work, which all studies of a command share."""
    return studies[0].unit if studies else "work"
