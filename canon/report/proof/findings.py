"""What refutes a claim (a witness), what is known of an open one, and the details that its kind found besides."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, Final

from canon.report.proof.blocks import Block, Items, Piece, display, paragraph
from canon.report.proof.structure import cut
from canon.report.proof.trees import Tree, tree_of
from canon.report.words import PRICE, value

Data = Mapping[str, Any]
Blocks = list[Block]


def refutation(tables: Data, certificate: Data, record: Data) -> Blocks:
    """The point at which it fails, by how much, and how surely."""
    detail, witness = record["detail"], record["witness"]
    if witness is None:
        note = detail.get("note") or detail.get("fails") or record["method"] or "a theorem"
        return [
            paragraph(f"It fails by an exact argument, wherever the formulas are defined: {note}."),
            *details(record),
        ]
    numbers = {n: v for n, v in witness.items() if not _is_formula(v)}
    functions = {n: v for n, v in witness.items() if _is_formula(v)}
    found: Blocks = [
        paragraph("At the point", lead="Witness."),
        display(*(f"{n} = {_number(v)}" for n, v in numbers.items())),
    ]
    if functions:
        chosen = [f"`{n}` that of `{value(v)}`" for n, v in functions.items()]
        found.append(paragraph(f"with, for arbitrary functions, {', '.join(chosen)}"))
    fails, size = detail.get("fails"), detail.get("residual")
    if fails:
        tail = [" is off by ", _decimal(size)] if size is not None else [" fails"]
        found.append(paragraph(_label(str(fails)), *tail, _enclosure(record), "."))
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


def _label(text: str) -> Piece:
    """A residual's name: {Q, P} as a bracket, other words as they are."""
    if text.startswith("{") and text.endswith("}") and text.count(",") == 1 and text.count("{") == 1:
        left, _, right = text[1:-1].partition(",")
        return Tree("call", "bracket", (tree_of(left.strip()), tree_of(right.strip())))
    tree = tree_of(text)
    return text if tree.kind == "verbatim" else tree


def _enclosure(record: Data) -> str:
    numeric = record["numeric"]
    if not numeric or "ball" not in record["method"]:
        return ""
    size, bound = numeric["max_residual"], numeric["bound"]
    ball = f"enclosed in a ball of {numeric['bits']} bits that doesn't contain 0"
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
                f"{numeric['max_residual']:.3g}, against a rounding bound of {numeric['bound']:.3g}."
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
        text = value(datum)
        tree = tree_of(text) if isinstance(datum, str) and key != "note" else None
        shown: Piece = text if tree is None or tree.kind == "verbatim" else cut(tree)
        items.append((f"{key.replace('_', ' ')}: ", shown))
    return [paragraph("Found besides:"), Items(tuple(items))] if items else []


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
    found: list[Piece] = []
    for piece in WORDS.split(text):
        tree = tree_of(piece)
        found.append(piece if WORDS.fullmatch(piece) or tree.kind == "verbatim" else tree)
    return [piece for piece in found if piece]
