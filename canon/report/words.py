"""How verdicts, times and values are put into words, for terminals and plain text alike."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping, Sequence
from typing import Any, Final

from canon.typeset.mixed import in_text

Record = Mapping[str, Any]
PRICE: Final = "one_digit_more"
"""The key of a verdict\'s detail that reports in words leave out."""
MATTERS: Final = "matters"
"""The key under which a record has the witness's names that are worth showing; it is for words, and not in the JSON."""

SYMBOLS: Final[Mapping[str, str]] = {"proved": "✓", "refuted": "✗", "supported": "≈", "undecided": "?"}
LONGEST: Final = 400


def visible(text: str) -> str:
    """Return text in which nothing can move the cursor, set a colour or end the line."""
    return "".join(
        "\N{REPLACEMENT CHARACTER}" if unicodedata.category(character)[0] == "C" else character
        for character in " ".join(text.split())
    )


def name(claim: Record) -> str:
    """Return what a claim is called: its title, or else its kind."""
    return visible(claim["title"] or claim["kind"].replace("_", " "))


def verdict(claim: Record) -> str:
    """Return the verdict with its symbol, and whether it was expected where that is not plain."""
    status = claim["verdict"]
    words = f"{SYMBOLS[status]} {status}"
    if claim["expected"]:
        return words if status in {"proved", "supported"} else f"{words}, as expected"
    return f"{words}, not as expected" if status in {"proved", "supported"} else words


def duration(seconds: float) -> str:
    """Return a time in milliseconds or seconds, three figures at most."""
    if seconds < 0.0995:
        return f"{1000 * seconds:.2g} ms"
    if seconds < 0.9995:
        return f"{1000 * seconds:.3g} ms"
    return f"{seconds:.3g} s" if seconds < 1000 else f"{seconds:.0f} s"


def shown_witness(claim: Record) -> Mapping[str, Any]:
    """Return the witness without what the refutation doesn't depend on; empty where there is none."""
    witness, names = claim["witness"] or {}, claim.get(MATTERS)
    return {name: witness[name] for name in names if name in witness} if isinstance(names, list) else witness


def value(datum: object) -> str:
    """Return data as a physicist writes it: complex numbers as sums, powers as q^2, long formulas cut."""
    text = _written(datum)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} … ({len(text)} characters)"


def _written(datum: object) -> str:
    if isinstance(datum, Mapping):
        if set(datum) == {"re", "im"}:
            return f"{datum['re']} + {datum['im']} i".replace("+ -", "- ")
        return ", ".join(f"{visible(str(key))} = {_written(item)}" for key, item in datum.items())
    if isinstance(datum, Sequence) and not isinstance(datum, str):
        return "; ".join(_written(item) for item in datum)
    if isinstance(datum, bool):
        return "yes" if datum else "no"
    return visible(in_text(str(datum)))


def closing(record: Record, *, seconds: float, interrupted: int = 0) -> str:
    """Return the summary of a run in one line."""
    claims, errors = record["claims"], record["errors"]
    files = len({claim["file"] for claim in claims})
    parts = []
    for status in SYMBOLS:
        of_it = [claim for claim in claims if claim["verdict"] == status]
        if not of_it:
            continue
        odd = sum(not claim["expected"] for claim in of_it)
        remark = ""
        if status == "refuted":
            remark = " (as expected)" if not odd else f" ({odd} not expected)" if odd < len(of_it) else ""
        elif status == "proved" and odd:
            remark = f" ({odd} not expected)"
        parts.append(f"{len(of_it)} {status}{remark}")
    if errors:
        parts.append(f"{len(errors)} input error{'s' * (len(errors) != 1)}")
    if interrupted:
        parts.append(f"{interrupted} not checked (interrupted)")
    counted = f"{len(claims)} claim{'s' * (len(claims) != 1)} in {files} file{'s' * (files != 1)}"
    return f"{counted}: {', '.join(parts) or 'nothing to check'} in {duration(seconds)}"
