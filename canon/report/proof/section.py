"""A verdict's section of a document of proofs, from its record, its claim file's tables and its certificate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from canon.report.proof.argument import argument
from canon.report.proof.blocks import Section, words
from canon.report.proof.findings import side_conditions
from canon.report.proof.fitted import fitted
from canon.report.proof.statement import setting, statement
from canon.report.words import duration, visible
from canon.typeset.mixed import in_text

Data = Mapping[str, Any]
NONE: Final[Data] = {"tables": {}, "known": {}, "cases": [], "domain": [], "witness": None}


def _spoken(text: str) -> str:
    return visible(in_text(text))


def section(record: Data, tables: Data, certificate: Data | None) -> Section:
    """The section of one claim.

    **Arguments:** `record`, the verdict as in the JSON record; `tables`, the claim file's tables with the claim under
    "claim"; `certificate`, where there is one.
    """
    data = certificate or {**NONE, "tables": tables}
    method = record["method"] or "no argument"
    close = f"By {method}, in {duration(record['seconds'])}."
    if record.get("certificate"):
        close += f" Certificate: {visible(str(record['certificate']))}."
    kind = record["kind"].replace("_", " ")
    made = Section(
        title=_spoken(record["title"] or f"{kind[0].upper()}{kind[1:]}"),
        place=f"{visible(record['file'])} #{record['index'] + 1}, {kind}" if record["file"] else kind,
        status=record["verdict"],
        source=_spoken(str(tables["claim"].get("source") or tables.get("source") or "")),
        setting=tuple(setting(tables)),
        statement=tuple(statement(tables)),
        proof=(*argument(tables, data, record), *side_conditions(data)),
        close=words(close.replace("`", "'")),
    )
    return fitted(made)
