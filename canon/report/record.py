"""The JSON record of a run: claims, errors and a summary, in format 1 of the claim files' contract."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from canon.claim import Claim
from canon.claims.worker import Entry
from canon.report.words import MATTERS, PRICE
from canon.verdict import STATUSES, Evidence, Verdict

FORMAT: Final = 1
Record = dict[str, Any]


def claim_record(entry: Entry, claim: Claim, verdict: Verdict) -> Record:
    """Return a verdict as data: where the claim stands, what was found, and whether that was expected."""
    made = {
        "file": entry.file,
        "index": entry.index,
        "kind": claim.kind,
        "title": claim.title,
        "verdict": verdict.status,
        "expected": claim.is_met_by(verdict.status) and "alarm" not in verdict.detail,
        "method": verdict.method,
        "seconds": round(verdict.seconds, 6),
        "numeric": None if verdict.numeric is None else _evidence(verdict.numeric),
        "witness": None if verdict.witness is None else {str(k): number(v) for k, v in verdict.witness.items()},
        "certificate": None,
        "detail": {str(key): plain(value) for key, value in verdict.detail.items()} | _price(verdict),
    }
    return made if verdict.matters is None else {**made, MATTERS: list(verdict.matters)}


def _price(verdict: Verdict) -> Record:
    """What one digit more would cost, where that is known; a contract names the keys beside `detail`."""
    return {} if verdict.one_digit_more is None else {PRICE: verdict.one_digit_more}


def error_record(file: str, where: str, message: str) -> Record:
    """Return an input error as data."""
    return {"file": file, "where": where, "message": message}


def run_record(claims: Sequence[Record], errors: Sequence[Record]) -> Record:
    """Return the whole of a run as the one object that `--json` prints."""
    return {"format": FORMAT, "claims": list(claims), "errors": list(errors), "summary": summary(claims, errors)}


def summary(claims: Sequence[Record], errors: Sequence[Record]) -> dict[str, int]:
    """Return how many claims have each verdict, and how many input errors there are."""
    counts = {status: sum(claim["verdict"] == status for claim in claims) for status in STATUSES}
    return {**counts, "errors": len(errors)}


def exit_status(claims: Sequence[Record], errors: Sequence[Record]) -> int:
    """Return 3 for input errors; else 1 for a verdict against its expectation; else 2 for an undecided one; else 0."""
    if errors:
        return 3
    against = {claim["verdict"] for claim in claims if not claim["expected"]}
    if against - {"undecided"}:
        return 1
    return 2 if against else 0


def number(value: object) -> object:
    """Return a witness's value as exact text: "3/2", a decimal, {"re": …, "im": …}, or a formula as it is written.

    A pair is a complex number. Text, and what already is such a table, stays as it is.
    """
    if isinstance(value, Mapping):
        return {str(key): number(item) for key, item in value.items()}
    if isinstance(value, complex):
        return {"re": repr(value.real), "im": repr(value.imag)}
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return {"re": number(value[0]), "im": number(value[1])}
    if isinstance(value, float):
        return repr(value)
    return str(value)


def plain(value: object) -> object:
    """Return data that JSON can hold: numbers and text as they are, fractions and formulas as text."""
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if isinstance(value, Fraction):
        return str(value)
    if isinstance(value, complex):
        return number(value)
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, set, frozenset)):
        items = sorted(value, key=str) if isinstance(value, (set, frozenset)) else value
        return [plain(item) for item in items]
    return str(value)


def _evidence(numeric: Evidence) -> Record:
    return {
        "points": numeric.points,
        "max_residual": plain(float(numeric.max_residual)),
        "bound": plain(float(numeric.bound)),
        "bits": numeric.bits,
    }
