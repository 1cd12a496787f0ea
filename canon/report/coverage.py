"""Which statements of the course are checked, by what, and with what answer."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from canon.catalogue.ledger import Erratum, Statement, cited, elsewhere, errata, statements
from canon.claims.worker import Entry

Record = dict[str, Any]
ORDER: Final[tuple[str, ...]] = ("proved", "supported", "test", "undecided", "open")


@dataclass(frozen=True)
class Row:
    """One id of the ledger with the records of the claims that cite it, or the test that stands for it."""

    id: str
    title: str
    item: Statement | Erratum
    claims: tuple[Record, ...] = field(default=())
    test: str = ""
    reason: str = ""

    @property
    def status(self) -> str:
        """The weakest answer of the claims that are to hold: "proved", "supported", "undecided"; "test"; "open".

        A printed error counts by its refutation: "proved" where each `expect = "fails"` is refuted.
        """
        if not self.claims:
            return "test" if self.test else "open"
        if not all(claim["expected"] for claim in self.claims):
            return "undecided"
        held = {claim["verdict"] for claim in self.claims} - {"refuted"}
        return max(held or {"proved"}, key=ORDER.index)

    @property
    def seconds(self) -> float:
        """What the claims took together."""
        return sum(claim["seconds"] for claim in self.claims)


def coverage(entries: Iterable[Entry], records: Iterable[Record]) -> list[Row]:
    """A row for every statement, and then for every erratum, of the ledger.

    **Arguments:** `entries`, the claims that were asked about, and `records`, their answers (in any order).
    """
    answers = {(record["file"], record["index"]): record for record in records}
    by_id: dict[str, list[Record]] = {}
    for entry in entries:
        record = answers.get((entry.file, entry.index))
        if entry.claim is not None and record is not None:
            for name in cited(entry.claim.source):
                by_id.setdefault(name, []).append(record)
    known = elsewhere()
    rows = []
    for item in (*statements(), *errata()):
        title = item.title if isinstance(item, Statement) else item.where
        claims = tuple(by_id.get(item.id, ()))
        rows.append(Row(item.id, title, item, claims, known.tests.get(item.id, ""), known.open.get(item.id, "")))
    return rows


def tally(rows: Iterable[Row]) -> Mapping[str, int]:
    """How many rows have each status."""
    counts: dict[str, int] = dict.fromkeys(ORDER, 0)
    for row in rows:
        counts[row.status] += 1
    return {status: number for status, number in counts.items() if number}


def as_text(rows: list[Row]) -> list[str]:
    """The table as lines: id, status, claims, milliseconds, title; and a summary by priority and scope."""
    width = max(len(row.id) for row in rows)
    lines = [
        f"{row.id:<{width}}  {row.status:<9}  {_checks(row):<44}  {1000 * row.seconds:7.0f} ms  {row.title}"
        for row in rows
    ]
    return [*lines, "", *summary(rows)]


def summary(rows: list[Row]) -> list[str]:
    """The counts, of the statements by priority, of the core ones, and of the errata."""
    stated = [row for row in rows if isinstance(row.item, Statement)]
    groups = [(f"priority {n}", [r for r in stated if r.item.priority == n]) for n in (1, 2, 3)]  # type: ignore[union-attr]
    groups.append(("core", [row for row in stated if row.item.scope == "core"]))  # type: ignore[union-attr]
    groups.append(("errata", [row for row in rows if isinstance(row.item, Erratum)]))
    return [
        f"{name}: {len(members)}, of them " + ", ".join(f"{count} {status}" for status, count in tally(members).items())
        for name, members in groups
    ]


def as_markdown(rows: list[Row]) -> str:
    """The page of the documentation."""
    lines = [*(f"- {line}" for line in summary(rows)), ""]
    for heading, kind in (("Statements", Statement), ("Errata", Erratum)):
        lines += [f"## {heading}", "", "| id | statement | check | answer | method | ms |", "|---|---|---|---|---|---|"]
        for row in rows:
            if isinstance(row.item, kind):
                methods = dict.fromkeys(m for c in row.claims for m in c["method"].split(", ") if m)
                check = _checks(row, limit=6).replace("|", "\\|") or row.reason
                limit = elsewhere().limits.get(row.id, "")
                title = (row.title + (f" (limit: {limit})" if limit else "")).replace("|", "\\|")
                time = f"{1000 * row.seconds:.0f}" if row.claims else ""
                lines.append(f"| {row.id} | {title} | {check} | {row.status} | {', '.join(methods)} | {time} |")
        lines.append("")
    return "\n".join(lines)


def errata_page(rows: list[Row]) -> str:
    """The course's errata: each line as printed and corrected, with the claims that refute and prove them."""
    lines: list[str] = []
    for row in rows:
        erratum = row.item
        if not isinstance(erratum, Erratum):
            continue
        lines += [f"## {erratum.id}: {erratum.where}", "", f"*{erratum.type}*, at {', '.join(erratum.entries)}", ""]
        lines += [f"- **Printed:** {_plain(erratum.printed)}", f"- **Corrected:** {_plain(erratum.corrected)}"]
        for claim in row.claims:
            title, place = claim["title"] or claim["kind"], f"{claim['file']}, claim {claim['index'] + 1}"
            point = ", ".join(f"{name} = {value}" for name, value in (claim["witness"] or {}).items())
            at = f", as at {point}" if point and len(point) < 160 else ""
            lines.append(f"- {claim['verdict']}: {_plain(title)} (`{place}`{_plain(at)})")
        if not row.claims:
            lines.append(f"- no claim: {_plain(row.reason)}")
        lines.append("")
    return "\n".join(lines)


def _plain(text: str) -> str:
    """Text without accidental Markdown."""
    for sign in "\\*_[]<>{}$`":
        text = text.replace(sign, "\\" + sign)
    return text


def as_records(rows: list[Row]) -> list[Record]:
    """The rows as data."""
    return [
        {
            "id": row.id,
            "title": row.title,
            "status": row.status,
            "claims": [{"file": c["file"], "index": c["index"], "verdict": c["verdict"]} for c in row.claims],
            "test": row.test or None,
            "reason": row.reason or None,
        }
        for row in rows
    ]


def _checks(row: Row, limit: int = 2) -> str:
    places: dict[str, list[str]] = {}
    for claim in row.claims:
        places.setdefault(claim["file"].removesuffix(".toml"), []).append(str(claim["index"] + 1))
    shown = [f"{file}: {', '.join(numbers)}" for file, numbers in places.items()]
    if len(shown) > limit:
        shown = [*shown[:limit], f"and {len(shown) - limit} more"]
    return "; ".join(shown) or row.test
