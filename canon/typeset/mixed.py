"""Words with formulas among them, as verdicts tell what they found: which runs of a text are formulas, and how to set
them.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from html import escape
from typing import Final

from canon.typeset.in_latex import LATEX, latex_words
from canon.typeset.in_mathml import MATHML
from canon.typeset.notation import written
from canon.typeset.trees import Tree, tree_of

OPERATION: Final = re.compile(
    r"[\w)\]] ?(\*\*?|/) ?[\w(-]|[\w)] [+-] [\w(]|\w\(|\{[^{}]+,[^{}]+\}|^\w+ = -?\d+\b|[ :]\w+ = -?\d+\b"
)
"""What makes a run of words worth reading as a formula."""
LONGEST: Final = 600
"""A longer text stays as it is."""
OPEN, CLOSED, ENDS = "([{", ")]}", ".,;:"


def pieces(text: str) -> list[str | Tree]:
    """The text in pieces: words as they are, and formulas as trees; together they say what the text says."""
    if (whole := _formula(text)) is not None:
        return [whole]
    if len(text) > LONGEST or not OPERATION.search(text):
        return [text]
    words = re.split(r"( +)", text)
    found: list[str | Tree] = []
    k = depth = 0
    while k < len(words):
        runs = range(len(words), k, -2) if k % 2 == 0 and depth == 0 else ()
        run = next(((n, part) for n in runs if (part := _run("".join(words[k:n]))) is not None), None)
        if run is None:
            depth += _opened(words[k])
            found.append(words[k])
            k += 1
        else:
            k, part = run
            found += part
    return _joined(found)


def _opened(text: str) -> int:
    """How many parentheses are left open."""
    return sum(c in OPEN for c in text) - sum(c in CLOSED for c in text)


def _run(text: str) -> list[str | Tree] | None:
    """A run of words as a formula and the comma or stop behind it; None where it is none."""
    core = text.rstrip(ENDS)
    tree = _formula(core)
    return None if tree is None else [tree, text[len(core) :]]


def _formula(text: str) -> Tree | None:
    """The tree of a text with an operation in it, or a Poisson bracket, perhaps with what it equals."""
    if not OPERATION.search(text) or _opened(text):
        return None
    tree = tree_of(f"{_called(text)}")
    return None if tree.kind == "verbatim" else tree


def _called(text: str) -> str:
    """Poisson brackets {f, g} as calls, bracket(f, g), which formulas have; indices in them as of names: {Q1,P2}."""
    return re.sub(r"\{([^{}]*,[^{}]*)\}", r"bracket(\1)", text)


def _joined(found: list[str | Tree]) -> list[str | Tree]:
    """The same, words in a row as one."""
    joined: list[str | Tree] = []
    for piece in found:
        if isinstance(piece, str) and joined and isinstance(joined[-1], str):
            joined[-1] += piece
        elif piece != "":
            joined.append(piece)
    return joined


def in_html(text: str) -> str:
    """A text as HTML, its formulas as MathML."""
    return _set(text, escape, lambda tree: f"<math>{written(tree, MATHML)}</math>")


def in_latex(text: str) -> str:
    r"""A text as LaTeX for within a formula: words as \text, formulas set."""
    return _set(text, lambda words: rf"\text{{{latex_words(words)}}}", lambda tree: written(tree, LATEX))


def in_markdown(text: str, words: Callable[[str], str]) -> str:
    """A text as Markdown: its formulas in LaTeX between dollars, `words` escaping the rest."""
    return _set(text, words, lambda tree: f"${written(tree, LATEX).strip()}$")


def _set(text: str, words: Callable[[str], str], formula: Callable[[Tree], str]) -> str:
    return "".join(words(piece) if isinstance(piece, str) else formula(piece) for piece in pieces(text))


def in_text(text: str) -> str:
    """A text for a terminal, powers with a caret as people write them."""
    return text.replace("**", "^")


def tidied(text: str) -> str:
    """A chosen function as it is read: no terms + 0, no factors 1, no powers ** 1."""
    for pattern, better in TIDY:
        text = re.sub(pattern, better, text)
    return text


TIDY: Final = (
    (r"\*\*1(?![\d.])", ""),
    (r" \+ 0(?=\))", ""),
    (r"(?<![\w.)])\(1\)\*", ""),
    (r"(?<![\w./])1\*", ""),
    (r"\+ -", "- "),
    (r"\+ \(-([\d/]+)\)\*", r"- (\1)*"),
    (r"\((\d+)\)\*", r"\1*"),
)
