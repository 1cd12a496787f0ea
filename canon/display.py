"""What notebooks show of values: HTML without style sheets, readable on light and dark pages. Needs no notebook."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any, Final

COLOURS: Final = {"proved": "#2da44e", "refuted": "#d1453b", "supported": "#b58105", "undecided": "#9a6ac2"}
"""One colour for each verdict, that can be read on white and on black."""


def status_in_html(status: str, text: str) -> str:
    """A verdict's word in its colour, and what it is about."""
    return f'<b style="color:{COLOURS.get(status, "inherit")}">{escape(status)}</b>: {escape(text)}'


def list_in_html(items: Iterable[str]) -> str:
    """Lines of text as a list; nothing for none."""
    return items_in_html(map(escape, items))


def items_in_html(items: Iterable[str]) -> str:
    """A list of what is HTML already; nothing for none."""
    lines = "".join(f"<li>{item}</li>" for item in items)
    return f'<ul style="margin:0.2em 0">{lines}</ul>' if lines else ""


def table_in_html(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of text."""
    cell = 'style="text-align:left;padding:0.1em 0.8em"'
    head = "".join(f"<th {cell}>{escape(word)}</th>" for word in heads)
    body = "".join("<tr>" + "".join(f"<td {cell}>{escape(word)}</td>" for word in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def text_in_html(value: object) -> str:
    """A value as it prints itself, its lines kept: the `_repr_html_` of what is best read so."""
    return f'<pre style="white-space:pre-wrap">{escape(str(value))}</pre>'


_MOMENTUM: Final = re.compile(r"([pP])([A-Za-hj-z]|alpha|beta|eta|theta|phi|psi|rho|xi)")


def latex(value: Any) -> str:
    """Sympy's LaTeX, but a momentum such as px as p with an index: px y written as pxy would be read as p x y."""
    import sympy as sp

    named = {s: match for s in value.free_symbols if (match := _MOMENTUM.fullmatch(s.name))}
    names = {s: f"{m[1]}_{{{m[2] if len(m[2]) == 1 else chr(92) + m[2]}}}" for s, m in named.items()}
    return sp.latex(value, symbol_names=names)
