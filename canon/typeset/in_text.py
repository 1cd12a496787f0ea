"""Formulas in plain text."""

from __future__ import annotations

import re
from typing import Final

from canon.typeset.notation import Notation


def _plain_group(text: str) -> str:
    return text if re.fullmatch(r"[\w.]+", text) else f"({text})"


PLAIN: Final = Notation(
    number=lambda text: text,
    name=lambda name: name,
    word=lambda text: text,
    sign=lambda text: {",": ", ", "·": " ", "−": " − ", "∂": "∂", "′": "′"}.get(text, f" {text} "),
    row=lambda parts: re.sub(r" {2,}", " ", "".join(parts)).strip(),
    fenced=lambda left, inner, right: f"{left}{inner}{right}",
    fraction=lambda over, under: f"{_plain_group(over)}/{_plain_group(under)}",
    power=lambda base, up: f"{base}^{_plain_group(up)}",
    root=lambda inner, degree: f"√{_plain_group(inner)}" if degree == "2" else f"({inner})^(1/{degree})",
    times=" ",
    apply="",
)
