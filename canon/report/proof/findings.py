"""What refutes a claim (a witness), what is known of an open one, and the details that its kind found besides."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, Final

from canon.report.proof.blocks import Block, Items, Piece, display, paragraph
from canon.report.proof.structure import cut
from canon.report.words import PRICE, shown_witness, value
from canon.typeset.mixed import pieces, tidied
from canon.typeset.trees import tree_of
from canon.verdict import STATUSES

Data = Mapping[str, Any]
Blocks = list[Block]


def refutation(tables: Data, certificate: Data, record: Data) -> Blocks:
    """The point at which it fails, by how much, and how surely."""
    detail, witness = record["detail"], record["witness"]
    if witness is None:
        note = detail.get("note") or detail.get("fails") or record["method"] or "a theorem"
        return [
            paragraph("It fails by an exact argument, wherever the formulas are defined: ", *_said(str(note)), "."),
            *details(record),
        ]
    shown = shown_witness(record)
    numbers = {n: v for n, v in shown.items() if not _is_formula(v)}
    functions = {n: v for n, v in shown.items() if _is_formula(v)}
    found: Blocks = [paragraph("At the point" if shown else "Wherever the formulas are defined", lead="Witness.")]
    if numbers:
        found.append(display(*(f"{n} = {_number(v)}" for n, v in numbers.items())))
    if functions:
        chosen = [f"`{n}` that of `{tidied(str(v))}`" for n, v in functions.items()]
        found.append(paragraph(f"with, for arbitrary functions, {', '.join(chosen)}"))
    fails, size = detail.get("fails"), detail.get("residual")
    if fails:
        tail = [" is off by ", _decimal(size)] if size is not None else [" fails"]
        found.append(paragraph(*_said(str(fails)), *tail, _enclosure(record), "."))
    else:
        found.append(paragraph("the claim fails", _enclosure(record), "."))
    return [*found, *details(record)]


def _is_formula(text: Any) -> bool:
    return isinstance(text, str) and any(c.isalpha() and c != "e" for c in text)


def _number(text: Any) -> str:
    if isinstance(text, Mapping):
        return f"{text['re']} + ({text['im']})*1j"
    return str(text)


def _decimal(size: Any) -> Piece:
    return tree_of(value(size)) if not isinstance(size, Mapping) else value(size)


def _said(text: str) -> list[Piece]:
    """Words with formulas among them, a residual's name {Q, P} for example: each set as what it is."""
    return [_plain(piece) if isinstance(piece, str) else cut(piece) for piece in pieces(text)]


def _plain(words: str) -> str:
    return f"{' ' * words.startswith(' ')}{value(words)}{' ' * (words.endswith(' ') and bool(words.strip()))}"


def _enclosure(record: Data) -> str:
    numeric = record["numeric"]
    if not numeric or "ball" not in record["method"]:
        return ""
    size, bound = numeric["max_residual"], numeric["bound"]
    ball = f"enclosed in a ball of {numeric['bits']} bits that doesn't contain 0"
    if isinstance(size, str) or isinstance(bound, str):  # of the record: beyond the range of doubles
        return f": it is {ball}"
    return f": its modulus is {size:.6g} with an error of at most {bound:.2g}, {ball}"


def open_question(record: Data) -> Blocks:
    """What is known of a claim that is neither proved nor refuted."""
    numeric = record["numeric"]
    found: Blocks = [
        paragraph(
            "This is no proof. "
            + ("Sampling agrees with the claim." if record["verdict"] == "supported" else "The claim is left open.")
        )
    ]
    if numeric:
        found.append(
            paragraph(
                f"At {numeric['points']} points in {numeric['bits']} bits the largest residual is "
                f"{float(numeric['max_residual']):.3g}, against a rounding bound of {float(numeric['bound']):.3g}."
            )
        )
    return [*found, *details(record)]


WORDS: Final = re.compile(r"(^not \(| and | or | is analytic| \(pulled back\)$|(?<=\d)\)$)")
"""What stands in a condition beside its formulas."""
SILENT: Final = ("fails", "residual", "certificate_error", PRICE)


def details(record: Data) -> Blocks:
    """What else the kind of claim found: a scale, the true value, a repair."""
    items = []
    for key, datum in record["detail"].items():
        if (key, datum) == ("scale", "1") or key in SILENT or datum is None or datum in ("", [], {}):
            continue
        items.append((f"{key.replace('_', ' ')}: ", *_told(datum)))
    return [paragraph("Found besides:"), Items(tuple(items))] if items else []


def _told(datum: Any) -> list[Piece]:
    """What was found, its formulas set, long ones cut."""
    if isinstance(datum, Mapping) and set(datum) != {"re", "im"}:
        rows = [[*_told(str(key)), " = ", *_told(item)] for key, item in datum.items()]
        return [piece for k, row in enumerate(rows) for piece in ([", "] if k else []) + row]
    if isinstance(datum, list | tuple):
        return [piece for k, item in enumerate(datum) for piece in (["; "] if k else []) + _told(item)]
    if not isinstance(datum, str):
        return [value(datum)]
    if datum not in STATUSES and (tree := tree_of(datum)).kind != "verbatim":
        return [cut(tree)]
    return _said(datum)


def side_conditions(certificate: Data) -> Blocks:
    """What was used of the domain."""
    conditions = list(dict.fromkeys(certificate["domain"])) if certificate else []
    shown = [text for text in conditions if len(text) < 200]
    if not shown:
        return []
    said: list[Piece] = []
    for text in shown[:12]:
        said += [", ", *_condition(text)]
    more = f", and {len(conditions) - 12} more" if len(conditions) > 12 else ""
    return [paragraph(*said[1:], f"{more}.", lead="Where it holds.")]


def _condition(text: str) -> list[Piece]:
    """A condition: its formulas set as such, the words about and between them left words."""
    if (whole := tree_of(text)).kind != "verbatim":
        return [whole]
    found: list[Piece] = []
    for piece in WORDS.split(text):
        tree = tree_of(piece)
        found.append(piece if WORDS.fullmatch(piece) or tree.kind == "verbatim" else tree)
    return [piece for piece in found if piece]
