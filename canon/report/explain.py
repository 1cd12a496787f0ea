"""What stands below the table: refutations that teach, what was tried in vain, and errors of input."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from canon.report.words import Record, duration, name, value, visible

FEW: Final = 12
"""Up to so many claims, refutations that were expected are explained too."""


def explained(claims: list[Record]) -> list[Record]:
    """Return the claims that deserve an explanation: those against their expectation; all that fail, if few."""
    few = len(claims) <= FEW
    return [claim for claim in claims if not claim["expected"] or (few and claim["verdict"] != "proved")]


def explanation(claim: Record) -> Iterator[str]:
    """Yield the lines that explain a verdict: a heading, what was found, where, and the numerical evidence."""
    title = name(claim)
    kind = claim["kind"].replace("_", " ")
    what = title if title == kind else f"{kind}, {title}"
    yield f"{visible(claim['file'])} #{claim['index'] + 1} ({what}) is {claim['verdict']}{_how(claim)}"
    for key, datum in claim["detail"].items():
        if datum is None or datum in ("", [], {}):
            continue
        text = value(datum)
        yield f"  {text}" if key == "note" else f"  {visible(key.replace('_', ' '))}: {text}"
    if claim["witness"]:
        places = ", ".join(f"{visible(key)} = {value(datum)}" for key, datum in claim["witness"].items())
        yield f"  at {places}"
    elif claim["verdict"] == "refuted":
        yield "  by an exact argument, wherever the formulas are defined"
    if claim["numeric"]:
        numeric = claim["numeric"]
        yield (
            f"  {numeric['points']} sample points: largest residual {numeric['max_residual']}, "
            f"rounding bound {numeric['bound']}"
        )
    if claim["verdict"] == "undecided":
        hint = "; a larger --budget may help" if "budget" in str(claim["detail"]) else ""
        yield f"  undecided after {duration(claim['seconds'])}{hint}"


def error_line(error: Record) -> str:
    """Return an error of input in one line: the file, the place, and what is wrong."""
    place = f", {visible(error['where'])}" if error["where"] else ""
    return f"{visible(error['file'])}{place}: {visible(error['message'])}"


def _how(claim: Record) -> str:
    return f" ({visible(claim['method'])})" if claim["method"] else ""
