"""How much room a formula takes on a page: a notation in which it is as long as it will be wide."""

from __future__ import annotations

from typing import Final

from canon.typeset.letters import GREEK, split_name
from canon.typeset.notation import Notation, written
from canon.typeset.trees import Tree

MARK: Final = "."
"""A tenth of an em."""
WIDE: Final = {"+": 12, "−": 12, "=": 13, "≠": 13, "≤": 13, "≥": 13, "<": 13, ">": 13, "⋯": 12, ",": 5, "′": 3, "·": 7}
"""Signs with the space about them; others are as wide as a letter."""
LETTER: Final = 6
SMALLER: Final = 0.75
"""An index or an exponent beside what stands on the line."""


def room(tree: Tree) -> float:
    """The width of a formula as pdflatex sets it with a fraction as high as can be, in ems, about."""
    return len(written(tree, _ROOM)) / 10


def _marks(count: float) -> str:
    return MARK * round(count)


def _name(name: str) -> str:
    letter, index = split_name(name)
    return _marks(_letters(letter) + SMALLER * _letters(index))


def _letters(word: str) -> int:
    return LETTER * (1 if word in GREEK else len(word))


_ROOM: Final = Notation(
    number=lambda text: _marks(5 * len(text)),
    name=_name,
    word=lambda text: _marks(5 * len(text)),
    sign=lambda text: _marks(WIDE.get(text, LETTER)),
    row="".join,
    fenced=lambda left, inner, right: inner + _marks(11),
    fraction=lambda over, under: max(over, under, key=len) + _marks(3),
    power=lambda base, up: base + _marks(SMALLER * len(up)),
    root=lambda inner, degree: inner + _marks(11),
    times=_marks(2),
    apply="",
)
