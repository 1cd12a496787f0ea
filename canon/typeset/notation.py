"""Trees of formulas in a notation: precedence, fences, and what functions and derivatives look like."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

from canon.typeset.letters import GREEK
from canon.typeset.trees import Tree

UPRIGHT: Final = frozenset(
    ["sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "coth", "log", "exp", "det"]
)  # fmt: skip
RELATIONS: Final = {"=": "=", "!=": "≠", "<=": "≤", ">=": "≥", "<": "<", ">": ">"}
SUM, PRODUCT, SIGN, POWER, ATOM = 1, 2, 3, 4, 5


class Notation(NamedTuple):
    """How the pieces of a formula are written: each makes text of texts."""

    number: Callable[[str], str]
    name: Callable[[str], str]
    word: Callable[[str], str]
    sign: Callable[[str], str]
    row: Callable[[Sequence[str]], str]
    fenced: Callable[[str, str, str], str]
    fraction: Callable[[str, str], str]
    power: Callable[[str, str], str]
    root: Callable[[str, str], str]
    times: str
    apply: str


def written(tree: Tree, notation: Notation) -> str:
    """The formula in a notation."""
    return _show(tree, notation)[0]


def _show(tree: Tree, to: Notation) -> tuple[str, int]:
    """The text, and how tightly its outermost operation binds."""
    kind, parts = tree.kind, tree.parts
    if kind == "number":
        return to.number(tree.text), ATOM
    if kind == "name":
        return to.name(tree.text), ATOM
    if kind in ("verbatim", "more"):
        return (to.word(tree.text), ATOM) if kind == "verbatim" else (to.row([to.sign("⋯"), _count(tree, to)]), ATOM)
    if kind == "relation":
        pieces = [_show(parts[0], to)[0]]
        for sign, part in zip(tree.signs, parts[1:], strict=True):
            pieces += [to.sign(RELATIONS[sign]), _show(part, to)[0]]
        return to.row(pieces), 0
    if kind == "sum":
        pieces = []
        for k, (sign, part) in enumerate(zip(tree.signs, parts, strict=True)):
            if k or sign == "-":
                pieces.append(to.sign("−" if sign == "-" else "+"))
            pieces.append(_bound(part, PRODUCT, to))
        return to.row(pieces), SUM
    if kind == "product":
        return to.row(_factors(parts, to)), PRODUCT
    if kind == "fraction":
        return to.fraction(_show(parts[0], to)[0], _show(parts[1], to)[0]), PRODUCT
    if kind == "root":
        return to.root(_show(parts[0], to)[0], tree.text), ATOM
    if kind == "power":
        return _power(parts[0], parts[1], to)
    return _call(tree, to), ATOM


def _count(tree: Tree, to: Notation) -> str:
    return to.fenced("(", to.word(tree.text), ")")


def _bound(tree: Tree, level: int, to: Notation) -> str:
    text, own = _show(tree, to)
    return text if own >= level else to.fenced("(", text, ")")


def _factors(parts: Sequence[Tree], to: Notation) -> list[str]:
    found: list[str] = []
    for k, part in enumerate(parts):
        if k:
            number = part.kind == "number" or (part.kind == "power" and part.parts[0].kind == "number")
            found.append(to.sign("·") if number else to.times)
        found.append(_bound(part, PRODUCT if part.kind == "fraction" else SIGN, to))
    return [piece for piece in found if piece]


def _power(base: Tree, exponent: Tree, to: Notation) -> tuple[str, int]:
    up = _show(exponent, to)[0]
    if base.kind == "call" and base.text in UPRIGHT and exponent.kind == "number":
        head = to.power(to.word(base.text), up)
        return to.row([head, to.apply, _arguments(base.parts, to)]), ATOM
    return to.power(_bound(base, ATOM, to), up), POWER


def _arguments(parts: Sequence[Tree], to: Notation) -> str:
    pieces: list[str] = []
    for k, part in enumerate(parts):
        pieces += ([to.sign(",")] if k else []) + [_show(part, to)[0]]
    return to.fenced("(", to.row(pieces), ")")


def _call(tree: Tree, to: Notation) -> str:
    parts, name = tree.parts, tree.text
    if name == "abs":
        return to.fenced("|", _show(parts[0], to)[0], "|")
    if name == "bracket" and len(parts) == 2:
        inner = to.row([_show(parts[0], to)[0], to.sign(","), _show(parts[1], to)[0]])
        return to.fenced("{", inner, "}")
    if name == "commutator" and len(parts) == 2:
        inner = to.row([_show(parts[0], to)[0], to.sign(","), _show(parts[1], to)[0]])
        return to.fenced("[", inner, "]")
    if name == "transpose":
        return to.power(_bound(parts[0], ATOM, to), to.word("T"))
    if name == "dot":
        return to.fraction(to.row([to.word("d"), _show(parts[0], to)[0]]), to.row([to.word("d"), to.name("t")]))
    if name == "D" and len(parts) >= 2:
        return _slope(parts, to)
    if tree.kind == "derivative":
        return _derivative(tree, to)
    head = to.word(name) if name in UPRIGHT or (len(name) > 2 and name not in GREEK) else to.name(name)
    return to.row([head, to.apply, _arguments(parts, to)])


def _slope(parts: Sequence[Tree], to: Notation) -> str:
    """∂f/∂x, ∂ⁿf/∂xⁿ, or the mixed ∂ⁿf/∂x∂y: each variable with its order behind it, where that isn't 1."""
    while parts[0].kind == "call" and parts[0].text == "D" and len(parts[0].parts) >= 2:  # ∂(∂f/∂x)/∂y
        parts = (*parts[0].parts, *parts[1:])
    below: list[tuple[str, int]] = []
    for part in parts[1:]:
        if part.kind == "number" and part.text.isdecimal() and below:
            below[-1] = (below[-1][0], int(part.text))
        else:
            below.append((_bound(part, ATOM, to), 1))
    d, total = to.sign("∂"), sum(order for _, order in below)
    head = d if total == 1 else to.power(d, to.number(str(total)))
    under = [piece for x, n in below for piece in (d, x if n == 1 else to.power(x, to.number(str(n))))]
    return to.fraction(to.row([head, _bound(parts[0], SIGN, to)]), to.row(under))


def _derivative(tree: Tree, to: Notation) -> str:
    """A derivative of a declared function: V′(x), or ∂₁∂₂V(x, y)."""
    name, _, orders = tree.text.partition(" ")
    counts = [int(order) for order in orders.split("_")]
    if len(counts) == 1:
        head = to.row([to.name(name), *[to.sign("′")] * counts[0]])
    else:
        head = to.row([*(to.name(f"∂_{k}") for k, n in enumerate(counts, 1) for _ in range(n)), to.name(name)])
    return to.row([head, to.apply, _arguments(tree.parts, to)])
