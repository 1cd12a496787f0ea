"""Proofs as Markdown for MyST: theorems and proofs are directives, formulas are LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from canon.report.proof.blocks import Block, Display, Grid, Items, Paragraph, Section, Words
from canon.typeset.in_latex import LATEX
from canon.typeset.notation import written
from canon.typeset.trees import Tree


def document(title: str, sections: Sequence[str], summary: str) -> str:
    """The document of some sections."""
    return f"# {markdown_words(title)}\n\n{markdown_words(summary)}\n\n" + "\n".join(sections)


def section(s: Section) -> tuple[str, str, str]:
    """One claim with its proof: its heading, its setting, and the rest."""
    source = f" ({markdown_words(s.source)})" if s.source else ""
    statement, proof = ("\n".join(map(_block, blocks)) for blocks in (s.statement, s.proof))
    kind = "theorem" if s.status == "proved" else "conjecture"
    word = {"proved": "", "refuted": "**Refutation.**\n\n"}.get(s.status, "**What is known.**\n\n")
    argument = f"{word}{proof}\n{_words(s.close)}\n"
    if s.status == "proved":
        argument = f":::{{prf:proof}}\n{argument}:::\n"
    heading = f"## {markdown_words(s.title)}\n\n**{s.status}**: {markdown_words(s.place)}{source}\n"
    return heading, "\n".join(map(_block, s.setting)), f":::{{prf:{kind}}}\n{statement}:::\n\n{argument}"


def markdown_words(text: str) -> str:
    """Words for Markdown, the signs that mean something escaped."""
    return "".join(f"\\{c}" if c in "\\*_`$[]<>#{}|&~" else c for c in text)


def _block(block: Block) -> str:
    if isinstance(block, Paragraph):
        lead = f"**{markdown_words(block.lead)}** " if block.lead else ""
        return f"{lead}{_words(block.words)}\n"
    if isinstance(block, Display):
        return "".join(f"$$\n{written(line, LATEX)}\n$$\n\n" for line in block.lines)
    if isinstance(block, Items):
        return "".join(f"- {_words(item)}\n" for item in block.items)
    return _grid(block)


def _grid(grid: Grid) -> str:
    heads = [written(grid.name, LATEX), *(written(Tree("name", name), LATEX) for name in grid.columns)]
    rows = [
        [written(Tree("name", name), LATEX), *(written(entry, LATEX) for entry in row)]
        for name, row in zip(grid.rows, grid.entries, strict=True)
    ]
    body = " \\\\\n".join(" & ".join(row) for row in (heads, *rows))
    return f"$$\n\\begin{{array}}{{c|{'c' * len(grid.columns)}}}\n{body}\n\\end{{array}}\n$$\n"


def _words(words: Words) -> str:
    return "".join(
        markdown_words(piece) if isinstance(piece, str) else f"${written(piece, LATEX).strip()}$" for piece in words
    )
