"""What stands below the table: refutations that teach, what was tried in vain, and errors of input."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from canon.report.words import PRICE, Record, duration, name, shown_witness, value, visible
from canon.typeset.mixed import tidied
from canon.verdict import GLANCES, NUMBERS

FEW: Final = 12
"""Up to so many claims, refutations that were expected are explained too."""


def explained(claims: list[Record]) -> list[Record]:
    """Return the claims that deserve an explanation: not as expected, or with a warning; all that fail, if few."""
    few = len(claims) <= FEW
    return [
        claim
        for claim in claims
        if not claim["expected"] or "warning" in claim["detail"] or (few and claim["verdict"] != "proved")
    ]


def explanation(claim: Record) -> Iterator[str]:
    """Yield the lines that explain a verdict: a heading, what fails and where, what else was found, the evidence."""
    title = name(claim)
    kind = claim["kind"].replace("_", " ")
    what = title if title == kind else f"{kind}, {title}"
    yield f"{visible(claim['file'])} #{claim['index'] + 1} ({what}) is {claim['verdict']}{_how(claim)}"
    if claim["verdict"] == "refuted":
        yield f"  {_failure(claim)}"
    for key, datum in claim["detail"].items():
        if key in {"fails", "residual", PRICE} or datum is None or datum in ("", [], {}):
            continue
        text = value(datum)
        yield f"  {text}" if key == "note" else f"  {visible(key.replace('_', ' '))}: {text}"
    numeric = claim["numeric"]
    if numeric and (claim["verdict"] in ("supported", "undecided") or numeric["points"] > GLANCES):
        counted = f"{numeric['points']} sample point{'s' * (numeric['points'] != 1)}"
        number = NUMBERS.get(claim["kind"], "largest residual")
        yield f"  {counted}: {number} {numeric['max_residual']}, rounding bound {numeric['bound']}"
    if claim["verdict"] == "undecided":
        hint = "; a larger --budget may help" if "budget" in str(claim["detail"]) else ""
        yield f"  undecided after {duration(claim['seconds'])}{hint}"


def _failure(claim: Record) -> str:
    """Return what fails, by how much, and where."""
    fails, residual = claim["detail"].get("fails"), claim["detail"].get("residual")
    parts = ["it fails" if not fails else f"{value(fails)} fails"]
    if residual:
        parts.append(f"by {_rounded(residual)}")
    if witness := shown_witness(claim):
        places = ", ".join(f"{visible(key)} = {_coordinate(datum)}" for key, datum in witness.items())
        parts.append(f"at {places}")
    elif claim["witness"]:
        parts.append("wherever the formulas are defined")
    else:
        parts.append("by an exact argument, wherever the formulas are defined")
    return " ".join(parts)


def _coordinate(datum: object) -> str:
    """Return a coordinate's value, or of an arbitrary function the one that was chosen."""
    return value(tidied(datum) if isinstance(datum, str) else datum)


def _rounded(residual: object) -> str:
    """Return a decimal without the zeros at its end."""
    text = value(residual)
    digits, mark, exponent = text.partition("e")
    if "." in digits and digits.lstrip("-").replace(".", "").isdigit():
        digits = digits.rstrip("0").rstrip(".")
    return digits + mark + exponent


def error_line(error: Record) -> str:
    """Return an error of input in one line: the file, the place, and what is wrong."""
    place = f", {visible(error['where'])}" if error["where"] else ""
    return f"{visible(error['file'])}{place}: {visible(error['message'])}"


def _how(claim: Record) -> str:
    return f" ({visible(claim['method'])})" if claim["method"] else ""
