"""Proofs as plain text."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from canon.report.proof.blocks import Block, Display, Grid, Items, Paragraph, Section, Words
from canon.typeset.in_text import PLAIN
from canon.typeset.notation import written

WIDTH = 100


def document(title: str, sections: Sequence[str], summary: str) -> str:
    """The text of some sections."""
    return "\n".join([title, "=" * len(title), "", summary, "", *sections])


def section(s: Section) -> tuple[str, str, str]:
    """One claim with its proof: its heading, its setting, and the rest."""
    word = {"proved": "Proof.", "refuted": "Refutation."}.get(s.status, "What is known.")
    source = f" ({s.source})" if s.source else ""
    end = " ∎" if s.status == "proved" else ""
    heading = "\n".join([s.title, "-" * len(s.title), _filled(f"{s.status}: {s.place}{source}")])
    rest = ["Claim.", *map(_block, s.statement), word, *map(_block, s.proof), _filled(_words(s.close) + end), ""]
    return heading, "\n".join(map(_block, s.setting)), "\n".join(rest)


def _filled(text: str, indent: str = "") -> str:
    return textwrap.fill(text, WIDTH, initial_indent=indent, subsequent_indent="  " if indent else "")


def _block(block: Block) -> str:
    if isinstance(block, Paragraph):
        return _filled(f"{block.lead} {_words(block.words)}".strip())
    if isinstance(block, Display):
        return "\n".join(f"    {written(line, PLAIN)}" for line in block.lines)
    if isinstance(block, Items):
        return "\n".join(_filled(_words(item), "- ") for item in block.items)
    return _grid(block)


def _grid(grid: Grid) -> str:
    rows = [[written(entry, PLAIN) for entry in row] for row in grid.entries]
    table = [[written(grid.name, PLAIN), *grid.columns], *([n, *row] for n, row in zip(grid.rows, rows, strict=True))]
    widths = [max(len(row[k]) for row in table) for k in range(len(table[0]))]
    return "\n".join("    " + "  ".join(x.ljust(w) for x, w in zip(row, widths, strict=True)).rstrip() for row in table)


def _words(words: Words) -> str:
    return "".join(piece if isinstance(piece, str) else written(piece, PLAIN) for piece in words)
