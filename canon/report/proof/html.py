"""Proofs as a web page that stands by itself: MathML, no script, no network; for phones too, light and dark."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Final

from canon.report.proof.blocks import Block, Display, Grid, Items, Paragraph, Section, Words
from canon.typeset.in_mathml import MATHML
from canon.typeset.notation import written
from canon.typeset.trees import Tree

STYLE: Final = """\
:root { color-scheme: light dark; --ink: #1b1b1f; --paper: #fcfcfa; --dim: #5c5c66; --line: #d8d8d2; --box: #f3f3ee;
  --proved: #1a7f37; --refuted: #b3261e; --supported: #8a6100; --undecided: #7a3e9d; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e6ea; --paper: #16171a; --dim: #a3a3ad; --line: #3a3b40;
  --box: #202126; --proved: #5fd07f; --refuted: #ff8a80; --supported: #e3b341; --undecided: #cf9cf0; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 46rem; padding: 1rem; font: 1.05rem/1.55 Georgia, "Times New Roman", serif;
  color: var(--ink); background: var(--paper); overflow-wrap: break-word; }
h1 { font-size: 1.5rem; line-height: 1.25; } h2 { font-size: 1.2rem; line-height: 1.3; margin: 0 0 .2rem; }
section { border-top: 1px solid var(--line); padding: 1.4rem 0 .6rem; }
.place { color: var(--dim); font-size: .88rem; margin: 0 0 .8rem; }
.status { font-weight: bold; } .proved { color: var(--proved); } .refuted { color: var(--refuted); }
.supported { color: var(--supported); } .undecided { color: var(--undecided); }
.claim { background: var(--box); border-left: .25rem solid currentColor; padding: .4rem .9rem; margin: .8rem 0; }
.claim > * { color: var(--ink); } p { margin: .5rem 0; } ul { padding-left: 1.3rem; margin: .4rem 0; }
.math { overflow-x: auto; overflow-y: hidden; margin: .5rem 0; padding: .3rem 0; max-width: 100%; }
li, p { max-width: 100%; overflow-x: auto; overflow-y: hidden; }
math { font-size: 1.06em;
  font-family: "Latin Modern Math", "STIX Two Math", "Cambria Math", "DejaVu Math TeX Gyre", math; }
.end { color: var(--dim); font-size: .92rem; }
table.matrix { border-collapse: collapse; }
.matrix th { font-weight: normal; color: var(--dim); } .matrix tbody th { border-right: 1px solid var(--line); }
nav ol { padding-left: 1.6rem; } a { color: inherit; }
@media print { body { max-width: none; } .math { overflow: visible; } }
"""


def document(title: str, sections: Sequence[str], entries: Sequence[tuple[str, str]], summary: str) -> str:
    """The page of some sections; `entries` are the (title, status) of each, for a table of contents."""
    contents = ""
    if len(entries) > 1:
        items = "".join(
            f'<li><a href="#claim-{k}">{escape(name)}</a>: <span class="{word}">{word}</span></li>'
            for k, (name, word) in enumerate(entries, 1)
        )
        contents = f"<nav><ol>{items}</ol></nav>\n"
    body = "\n".join(text.replace("<section>", f'<section id="claim-{k}">', 1) for k, text in enumerate(sections, 1))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n<p>{escape(summary)}</p>\n{contents}{body}\n</body>\n</html>\n"
    )


def section(s: Section) -> tuple[str, str, str]:
    """One claim with its proof: its heading, its setting, and the rest."""
    source = f" ({escape(s.source)})" if s.source else ""
    word = {"proved": "Proof.", "refuted": "Refutation."}.get(s.status, "What is known.")
    end = " ∎" if s.status == "proved" else ""
    heading = [
        f"<section>\n<h2>{escape(s.title)}</h2>",
        f'<p class="place"><span class="status {s.status}">{s.status}</span> · {escape(s.place)}{source}</p>',
    ]
    rest = [
        f'<div class="claim {s.status}"><p><b>Claim.</b></p>',
        *map(_block, s.statement),
        f"</div>\n<p><b>{word}</b></p>",
        *map(_block, s.proof),
        f'<p class="end">{_words(s.close)}{end}</p>\n</section>',
    ]
    return "\n".join(heading), "\n".join(map(_block, s.setting)), "\n".join(rest)


def _block(block: Block) -> str:
    if isinstance(block, Paragraph):
        lead = f"<b>{escape(block.lead)}</b> " if block.lead else ""
        return f"<p>{lead}{_words(block.words)}</p>"
    if isinstance(block, Display):
        return "\n".join(
            f'<div class="math"><math display="block">{written(line, MATHML)}</math></div>' for line in block.lines
        )
    if isinstance(block, Items):
        return "<ul>" + "".join(f"<li>{_words(item)}</li>" for item in block.items) + "</ul>"
    return _grid(block)


CELL: Final = ' style="text-align:center;padding:.15rem .6rem"'
"""Said of each cell: a notebook has its own idea of tables."""


def _grid(grid: Grid) -> str:
    head = "".join(f"<th{CELL}>{_math(Tree('name', name))}</th>" for name in grid.columns)
    rows = "".join(
        f"<tr><th{CELL}>{_math(Tree('name', name))}</th>"
        + "".join(f"<td{CELL}>{_math(entry)}</td>" for entry in row)
        + "</tr>"
        for name, row in zip(grid.rows, grid.entries, strict=True)
    )
    return (
        f'<div class="math"><table class="matrix"><thead><tr><th{CELL}>{_math(grid.name)}</th>{head}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div>"
    )


def _words(words: Words) -> str:
    return "".join(escape(piece) if isinstance(piece, str) else _math(piece) for piece in words)


def _math(tree: Tree) -> str:
    return f"<math>{written(tree, MATHML)}</math>"
