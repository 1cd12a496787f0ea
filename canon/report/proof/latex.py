"""Proofs as a document for LaTeX: pdflatex reads it with the packages of every distribution."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from canon.report.proof.blocks import Block, Display, Grid, Items, Paragraph, Section, Words
from canon.typeset.in_latex import LATEX, latex_words
from canon.typeset.notation import written
from canon.typeset.trees import Tree

HEAD: Final = r"""\documentclass[11pt]{article}
\usepackage[utf8]{inputenc}
\usepackage{amsmath,amssymb,amsthm}
\usepackage[margin=2.3cm]{geometry}
\newtheorem*{claim}{Claim}
\allowdisplaybreaks
\setlength{\parindent}{0pt}\setlength{\parskip}{0.5ex}\setlength{\emergencystretch}{20em}
\newenvironment{formulas}{\begin{list}{}{\leftmargin2em\raggedright}\item[]}{\end{list}}
"""


def document(title: str, sections: Sequence[str], summary: str) -> str:
    """The document of some sections."""
    return (
        f"{HEAD}\\title{{{latex_words(title)}}}\n\\date{{}}\n\\begin{{document}}\n\\maketitle\n"
        f"{latex_words(summary)}\n\n" + "\n".join(sections) + "\n\\end{document}\n"
    )


def section(s: Section) -> tuple[str, str, str]:
    """One claim with its proof: its heading, its setting, and the rest."""
    word = {"proved": "Proof", "refuted": "Refutation"}.get(s.status, "What is known")
    source = f" ({latex_words(s.source)})" if s.source else ""
    end = r" \qed" if s.status == "proved" else ""
    heading = (
        f"\\section*{{\\raggedright {latex_words(s.title)}}}\n\\textbf{{{s.status}}}: {latex_words(s.place)}{source}\n"
    )
    rest = [
        "\\begin{claim}",
        *map(_block, s.statement),
        f"\\end{{claim}}\n\\textit{{{word}.}}",
        *map(_block, s.proof),
        f"{_words(s.close)}{end}\n",
    ]
    return heading, "\n".join(map(_block, s.setting)), "\n".join(rest)


def _block(block: Block) -> str:
    if isinstance(block, Paragraph):
        lead = f"\\textbf{{{latex_words(block.lead)}}} " if block.lead else ""
        return f"{lead}{_words(block.words)}\n"
    if isinstance(block, Display):
        lines = "\\\\[0.6ex]\n".join(f"$\\displaystyle {written(line, LATEX)}$" for line in block.lines)
        return f"\\begin{{formulas}}\n{lines}\n\\end{{formulas}}\n"
    if isinstance(block, Items):
        return "\\begin{itemize}\n" + "\n".join(f"\\item {_words(item)}" for item in block.items) + "\n\\end{itemize}\n"
    return _grid(block)


def _grid(grid: Grid) -> str:
    head = " & ".join([written(grid.name, LATEX), *(written(Tree("name", name), LATEX) for name in grid.columns)])
    rows = [
        " & ".join([written(Tree("name", name), LATEX), *(written(entry, LATEX) for entry in row)])
        for name, row in zip(grid.rows, grid.entries, strict=True)
    ]
    body = " \\\\\n".join([f"{head} \\\\ \\hline\n{rows[0]}", *rows[1:]])
    return f"\\[ \\begin{{array}}{{c|{'c' * len(grid.columns)}}}\n{body}\n\\end{{array}} \\]\n"


def _words(words: Words) -> str:
    return "".join(latex_words(piece) if isinstance(piece, str) else f"${written(piece, LATEX)}$" for piece in words)
