"""Formulas in MathML, as browsers read it without help."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Final

from canon.typeset.letters import GREEK, split_name
from canon.typeset.notation import Notation


def _mathml_name(name: str) -> str:
    head, index = split_name(name) if not name.startswith("∂_") else ("∂", name[2:])
    letter = f"<mi>{escape(GREEK.get(head, head))}</mi>"
    kind = "mn" if index.isdigit() else "mi"
    return f"<msub>{letter}<{kind}>{escape(GREEK.get(index, index))}</{kind}></msub>" if index else letter


def _mrow(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>"


_TALL: Final = ("<mfrac", "<msqrt", "<mroot")
"""What makes a row taller than parentheses are by themselves."""


def _fenced(left: str, inner: str, right: str) -> str:
    """Fences round a formula; where it is one line high they don't grow, or else an index makes them twice as tall."""
    size = "" if any(part in inner for part in _TALL) else " stretchy='false'"
    return (
        f"<mrow><mo fence='true'{size} form='prefix' lspace='0' rspace='0'>{left}</mo>{inner}"
        f"<mo fence='true'{size} form='postfix' lspace='0' rspace='0'>{right}</mo></mrow>"
    )


MATHML: Final = Notation(
    number=lambda text: f"<mn>{escape(text)}</mn>",
    name=_mathml_name,
    word=lambda text: (
        f"<mi mathvariant='normal'>{escape(text)}</mi>" if " " not in text else f"<mtext>{escape(text)}</mtext>"
    ),
    sign=lambda text: f"<mo>{escape(text)}</mo>",
    row=_mrow,
    fenced=_fenced,
    fraction=lambda over, under: f"<mfrac>{over}{under}</mfrac>",
    power=lambda base, up: f"<msup>{base}{up}</msup>",
    root=lambda inner, degree: (
        f"<msqrt>{inner}</msqrt>" if degree == "2" else f"<mroot>{inner}<mn>{escape(degree)}</mn></mroot>"
    ),
    times="<mspace width='0.17em'/>",
    apply="<mo>&#x2061;</mo>",
)
