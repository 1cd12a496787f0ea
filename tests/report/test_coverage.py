"""The table of the course's statements with the claims that check them."""

from __future__ import annotations

from canon.catalogue.ledger import Statement
from canon.claim import Claim
from canon.claims.worker import Entry
from canon.report.coverage import as_markdown, as_records, as_text, coverage, tally


def _answered(*claims: tuple[str, str, bool]) -> tuple[list[Entry], list[dict]]:
    entries, records = [], []
    for index, (source, verdict, expected) in enumerate(claims):
        entries.append(Entry("course/some.toml", index, Claim("identity", None, source=source)))
        answer = {"verdict": verdict, "expected": expected, "method": "normal form", "seconds": 0.01}
        records.append({"file": "course/some.toml", "index": index, **answer})
    return entries, records


def test_a_statement_has_the_weakest_answer_of_its_claims() -> None:
    rows = coverage(
        *_answered(
            ("course 13.35", "proved", True),
            ("course 13.35, erratum E47", "refuted", True),
            ("course 13.36", "proved", True),
            ("course 13.36", "supported", True),
            ("course 13.37", "refuted", False),
        )
    )
    found = {row.id: row for row in rows}
    assert found["13.35"].status == found["E47"].status == "proved"
    assert found["13.36"].status == "supported"
    assert found["13.37"].status == "undecided"
    assert found["13.38"].status == "open"
    assert tally(rows)["proved"] == 2
    assert len([row for row in rows if isinstance(row.item, Statement)]) == 363


def test_the_table_as_text_page_and_data() -> None:
    rows = coverage(*_answered(("course 13.35", "proved", True)))
    (line,) = [line for line in as_text(rows) if line.startswith("13.35 ")]
    assert line.split()[1:4] == ["proved", "course/some:", "1"]
    assert "| 13.35 | " in as_markdown(rows)
    (record,) = [record for record in as_records(rows) if record["id"] == "13.35"]
    assert record["claims"] == [{"file": "course/some.toml", "index": 0, "verdict": "proved"}]
