"""Formulas and polynomials as terms of Coq over the reals, and names that Coq can read."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any, Final

from canon.checker.formulas import Formulas

RESERVED: Final = frozenset((
    "R", "Q", "Z", "N", "I", "O", "S", "C", "D", "E", "INR", "IZR", "as", "at", "cofix", "else", "end", "exists",
    "fix", "for", "forall", "fun", "if", "in", "let", "match", "mod", "return", "then", "using", "where", "with",
    "Prop", "Set", "Type", "SProp", "sqrt", "sin", "cos", "tan", "exp", "ln", "atan", "PI", "Rabs", "sinh", "cosh",
    "tanh", "Rinv", "Rmult", "Rplus", "pow", "nonzero", "other_form", "nonzero_factor", "T", "V",
    "list", "nil", "cons", "tt", "positive", "not_negative", "square_positive", "with_differences",
))  # fmt: skip
"""Words of Coq, and names of its library that a variable must not hide."""


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """A name in Coq for each of these, itself where that can be."""
    found: dict[str, str] = {}
    for name in names:
        word = name if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) else "x" + "_".join(f"{ord(c):x}" for c in name)
        while word in RESERVED or word in found.values():
            word += "_"
        found[name] = word
    return found


def number(value: Fraction) -> str:
    """A rational number."""
    text = str(abs(value.numerator)) if value.denominator == 1 else f"({abs(value.numerator)} / {value.denominator})"
    return f"(- {text})" if value < 0 else text


def polynomial(terms: Mapping[str, str], words: Mapping[str, str]) -> str:
    """The polynomial of a table monomial = coefficient, as in certificates."""
    text = ""
    for monomial, coefficient in terms.items():
        size = abs(Fraction(coefficient))
        factors = [] if size == 1 and monomial else [number(size)]
        for factor in monomial.split():
            name, _, exponent = factor.partition("^")
            factors.append(f"{words[name]} ^ {int(exponent)}" if exponent else words[name])
        sign = " - " if coefficient.startswith("-") else " + "
        text += (sign if text else sign.strip(" +").replace("-", "- ")) + " * ".join(factors)
    return text or "0"


def term(f: Formulas, target: int, leaves: Mapping[int, str]) -> str:
    """A formula as a term, with differences and quotients; `leaves` are the texts of its names and functions."""
    texts: dict[int, tuple[str, int]] = {a: (text, 3 if text.isidentifier() else 0) for a, text in leaves.items()}
    negatives: dict[int, str] = {}
    for a in f.rational([target])[0]:
        if a in texts:
            continue
        op, inner = f.ops[a], f.parts(a)
        parts = [texts[b] for b in inner]
        if op[0] == "*" and (negative := _negative(f.ops[inner[0]], parts)) is not None:
            negatives[a] = negative
            texts[a] = f"- {negative}", 0
        elif op[0] == "+" and f.ops[inner[1]][0] == "n" and f.ops[inner[1]][1] < 0:
            texts[a] = f"{parts[0][0]} - {number(-f.ops[inner[1]][1])}", 0
        elif op[0] == "+" and inner[1] in negatives:
            texts[a] = f"{parts[0][0]} - {negatives[inner[1]]}", 0
        elif op[0] == "*" and parts[1][0].startswith("/ ") and parts[1][1] == 2:  # an inverse, not a text for it
            texts[a] = f"{_bound(parts[0], 1)} {parts[1][0]}", 1
        else:
            texts[a] = operation(op, parts)
    return texts[target][0]


def _negative(first: tuple[Any, ...], parts: list[tuple[str, int]]) -> str | None:
    """Minus a product, where its first factor is a negative number."""
    if first[0] != "n" or first[1] >= 0:
        return None
    return _bound(parts[1], 1) if first[1] == -1 else f"{number(-first[1])} * {_bound(parts[1], 2)}"


def _bound(part: tuple[str, int], level: int) -> str:
    text, own = part
    return text if own >= level else f"({text})"


def wrapped(text: str, width: int = 110) -> str:
    """The text with long lines broken at spaces: Coq reads any space alike."""
    lines: list[str] = []
    for line in text.split("\n"):
        indent = " " * (len(line) - len(line.lstrip()) + 4)
        while len(line) > width and (at := line.rfind(" ", len(indent) + 1, width)) > 0:
            lines.append(line[:at])
            line = indent + line[at + 1 :]
        lines.append(line)
    return "\n".join(lines)


def operation(op: tuple[Any, ...], parts: list[tuple[str, int]]) -> tuple[str, int]:
    """The text of an operation, and how tightly it binds: a sum 0, a product 1, an inverse 2, a name or a number 3."""

    def bound(k: int, level: int) -> str:
        return _bound(parts[k], level)

    if op[0] == "n":
        return number(op[1]), 3
    if op[0] == "+":
        return f"{bound(0, 0)} + {bound(1, 1)}", 0
    if op[0] == "*":
        return f"{bound(0, 1)} * {bound(1, 2)}", 1
    power = bound(0, 3) if abs(op[2]) == 1 else f"{bound(0, 3)} ^ {abs(op[2])}"
    return (f"{power}", 2) if op[2] > 0 else (f"/ {power}" if op[2] == -1 else f"/ ({power})", 2)
