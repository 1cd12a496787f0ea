"""Formulas and words in LaTeX."""

from __future__ import annotations

import re
from typing import Final

from canon.typeset.letters import GREEK, split_name
from canon.typeset.notation import UPRIGHT, Notation

LATEX_GREEK: Final = {word: "\\" + {"lam": "lambda"}.get(word, word).replace("amda", "ambda") for word in GREEK}
_SIGNS: Final = {
    "−": "-", "·": r"\cdot ", "≠": r"\ne ", "≤": r"\le ", "≥": r"\ge ", "⋯": r"\cdots ", "∂": r"\partial ",
    "′": "'", ",": ",\\, ", "+": " + ", "=": " = ", "<": " < ", ">": " > ",
}  # fmt: skip
_SPECIAL: Final = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "_": r"\_", "^": r"\^{}", "#": r"\#", "$": r"\$", "%": r"\%",
    "&": r"\&", "~": r"\~{}", "<": r"\ensuremath{<}", ">": r"\ensuremath{>}", "|": r"\ensuremath{|}", '"': "''",
}  # fmt: skip


def latex_words(text: str) -> str:
    """Words for LaTeX, its special signs escaped; letters that pdflatex doesn't know stay away."""
    known = {
        **_SPECIAL,
        **{letter: f"\\ensuremath{{{LATEX_GREEK[w]}}}" for w, letter in GREEK.items() if w in LATEX_GREEK},
    }
    known |= {"′": "'", "“": "``", "”": "''", "–": "--", "—": "---", "·": r"\ensuremath{\cdot}", "−": r"\ensuremath{-}"}
    known |= {"∂": r"\ensuremath{\partial}", "²": r"\ensuremath{{}^2}", "≠": r"\ensuremath{\ne}", "…": r"\ldots{}"}
    return "".join(known.get(c, c if ord(c) < 0x250 and c.isprintable() else "?") for c in text)


def _latex_name(name: str) -> str:
    if name.startswith("∂_"):
        return rf"\partial_{{{name[2:]}}} "
    head, index = split_name(name)
    letter = LATEX_GREEK.get(head) or (
        head if len(head) == 1 and head.isascii() else rf"\mathit{{{latex_words(head)}}}"
    )
    if not index:
        return f"{letter} "
    below = LATEX_GREEK.get(index) or (
        index if index.isdigit() or len(index) == 1 else rf"\mathit{{{latex_words(index)}}}"
    )
    return f"{letter}_{{{below}}}"


def _latex_word(text: str) -> str:
    if text in UPRIGHT:
        return rf"\{text}"
    return (
        rf"\operatorname{{{text}}}"
        if text.isalpha() and text.isascii() and len(text) > 1
        else rf"\text{{{latex_words(text)}}}"
    )


WIDE: Final = 160
"""Signs of LaTeX from which on parentheses let what is between them be broken across lines."""


def _latex_fence(left: str, inner: str, right: str) -> str:
    fences = {"{": r"\{", "}": r"\}", "(": "(", ")": ")", "|": "|", "[": "[", "]": "]"}
    if len(inner) < WIDE:
        return rf"\left{fences[left]} {inner} \right{fences[right]}"
    size = "bigg" if r"\frac" in inner else "big"
    return rf"\{size}l{fences[left]} {inner} \{size}r{fences[right]}"


def _latex_power(base: str, up: str) -> str:
    """Braces hold a base together on its line; what is wide may be broken."""
    return rf"{base}^{{{up}}}" if re.search(r"\\bigg?r\S+$", base) else rf"{{{base}}}^{{{up}}}"


LATEX: Final = Notation(
    number=lambda text: text,
    name=_latex_name,
    word=_latex_word,
    sign=lambda text: _SIGNS.get(text, text),
    row="".join,
    fenced=_latex_fence,
    fraction=lambda over, under: rf"\frac{{{over}}}{{{under}}}",
    power=_latex_power,
    root=lambda inner, degree: rf"\sqrt{'' if degree == '2' else f'[{degree}]'}{{{inner}}}",
    times=r"\,",
    apply=r"\!",
)
