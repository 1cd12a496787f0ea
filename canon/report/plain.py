"""Verdicts as plain aligned lines, for pipes and logs: each is printed as soon as those before it are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TextIO

from canon.report.explain import error_line, explained, explanation
from canon.report.words import Record, closing, duration, name, verdict, visible

WIDEST_FILE = 60
WIDEST_NAME = 60


@dataclass(frozen=True)
class Columns:
    """Widths of the columns, known before the first verdict is."""

    file: int
    name: int

    @classmethod
    def of(cls, places: Sequence[tuple[str, int]], names: Sequence[str]) -> Columns:
        """Return the widths for claims at these places (file, index) with these names."""
        file = max((len(_place(*place)) for place in places), default=0)
        return cls(min(file, WIDEST_FILE), min(max(map(len, names), default=0), WIDEST_NAME))

    def line(self, claim: Record) -> str:
        """Return one claim's line: verdict, place, name, time, method."""
        cells = (
            f"{verdict(claim):<22}",
            f"{_place(claim['file'], claim['index']):<{self.file}}",
            f"{_cut(name(claim), self.name):<{self.name}}",
            f"{duration(claim['seconds']):>7}",
            visible(claim["method"]),
        )
        return "  ".join(cells).rstrip()


def print_rest(record: Record, out: TextIO, *, seconds: float, interrupted: int = 0) -> None:
    """Print what follows the lines: explanations, errors, and the summary."""
    for claim in explained(record["claims"]):
        print("", *explanation(claim), sep="\n", file=out)
    if record["errors"]:
        print("", "input errors:", sep="\n", file=out)
    for error in record["errors"]:
        print(f"  ! {error_line(error)}", file=out)
    print("", closing(record, seconds=seconds, interrupted=interrupted), sep="\n", file=out)


def _place(file: str, index: int) -> str:
    return f"{visible(file)} #{index + 1}"


def _cut(text: str, width: int) -> str:
    return text if len(text) <= width else text[: width - 1] + "…"
