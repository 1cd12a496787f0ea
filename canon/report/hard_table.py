"""The table of hard cases: on a terminal, as a record for JSON, and as rows for CSV."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from rich.table import Table
from rich.text import Text

from canon.hard.run import Digits, Row

COLOURS: Final = {"kept": "green", "open": "yellow", "lost": "bold red"}
FIELDS: Final = (
    "family", "case", "point", "condition", "allowed", "naive", "ours", "peers", "verdict", "bound_holds", "seconds",
)  # fmt: skip


def hard_table(rows: Sequence[Row]) -> Table:
    """One line a case, at the point at which the naive formula falls shortest."""
    table = Table(box=None, pad_edge=False, header_style="dim")
    table.add_column("case", overflow="fold")
    for heading in ("condition", "allowed", "naive", "ours"):
        table.add_column(heading, justify="right")
    table.add_column("peers", overflow="fold")
    table.add_column("verdict")
    table.add_column("s", justify="right")
    family = None
    for row in rows:
        if row.case.family != family:
            family = row.case.family
            table.add_row(Text(family, "bold"))
        shown = row.shown
        table.add_row(
            f"  {row.case.name}",
            f"{shown.condition:.0e}",
            f"{shown.allowed:.1f}",
            Text(f"{shown.naive.digits:.1f}", "red" if row.naive_fails else ""),
            f"{shown.ours.digits:.1f}",
            peers_text(shown),
            Text(row.verdict, COLOURS[row.verdict]),
            f"{row.seconds:.2f}",
        )
    return table


def peers_text(digits: Digits) -> str:
    """The peers' digits; those that are not installed are said to be absent."""
    return ", ".join(
        f"{name} {'absent' if kept is None else f'{kept.digits:.1f}'}" for name, kept in digits.peers.items()
    )


def closing_lines(rows: Sequence[Row]) -> list[str]:
    """What the table amounts to, what is open and why, and what was lost."""
    lines = [f"{row.case.family}, {row.case.name} is open: {row.case.open}" for row in rows if row.verdict == "open"]
    for row in rows:
        if row.verdict == "lost":
            worst = row.worst
            point = ", ".join(f"{name} = {x!r}" for name, x in zip(row.case.inputs, worst.point, strict=True))
            why = "its bound does not hold" if row.bound_holds is False else f"{worst.ours.digits:.1f} digits"
            lines.append(f"{row.case.family}, {row.case.name} is lost: {why} at {point}")
    counts = {word: sum(row.verdict == word for row in rows) for word in COLOURS}
    naive = sum(row.naive_fails for row in rows)
    failing = sum(bool(row.failing) for row in rows)
    verdicts = ", ".join(f"{count} {word}" for word, count in counts.items() if count)
    count = "1 case" if len(rows) == 1 else f"{len(rows)} cases"
    lines.append(
        f"{count}: {verdicts}; the naive formula loses digits in {naive}, a peer in {failing}; "
        f"{sum(row.seconds for row in rows):.1f} s for ours"
    )
    return lines


def hard_record(rows: Sequence[Row]) -> dict[str, Any]:
    """The whole run, every point of every case."""
    return {"format": 1, "cases": [_record(row) for row in rows]}


def _record(row: Row) -> dict[str, Any]:
    return {
        "family": row.case.family,
        "name": row.case.name,
        "states": row.case.states,
        "inputs": list(row.case.inputs),
        "verdict": row.verdict,
        "open": row.case.open or None,
        "bound_holds": row.bound_holds,
        "naive_fails": row.naive_fails,
        "peers_failing": list(row.failing),
        "seconds": row.seconds,
        "points": [
            {
                "point": list(each.point),
                "condition": each.condition,
                "allowed": each.allowed,
                "naive": each.naive.digits,
                "ours": each.ours.digits,
                "shortfall": each.ours.shortfall,
                "peers": {name: None if kept is None else kept.digits for name, kept in each.peers.items()},
            }
            for each in row.digits
        ],
    }


def hard_csv(rows: Sequence[Row]) -> list[list[str]]:
    """A heading, and one line for each point of each case."""
    lines: list[list[str]] = [[*FIELDS]]
    for row in rows:
        for each in row.digits:
            point = " ".join(f"{name}={x!r}" for name, x in zip(row.case.inputs, each.point, strict=True))
            held = "" if row.bound_holds is None else str(row.bound_holds).lower()
            numbers = [
                f"{each.condition:.3g}",
                *(f"{x:.2f}" for x in (each.allowed, each.naive.digits, each.ours.digits)),
            ]
            lines.append(
                [
                    *(row.case.family, row.case.name, point, *numbers),
                    *(peers_text(each), row.verdict, held, f"{row.seconds:.3f}"),
                ]
            )
    return lines
