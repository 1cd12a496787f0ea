"""Long formulas by their structure: parts that are repeated or large get names, long sums are cut with a count."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count
from typing import Final

from canon.typeset.trees import Tree

LONG: Final = 45
"""A formula of more signs is shown by its structure."""
SMALLEST: Final = 7
"""Parts of fewer signs aren't worth a name."""
MOST_NAMES: Final = 6
MOST_TERMS: Final = 6


def structured(tree: Tree, taken: set[str]) -> tuple[Tree, list[tuple[str, Tree]]]:
    """The formula in terms of names for parts of it, and these parts in the order in which they were named.

    `taken` are names that have a meaning already; the new ones are added to it.
    """
    named: list[tuple[str, Tree]] = []
    names = _new_names(taken)
    while tree.size > LONG and len(named) < MOST_NAMES:
        part = _worth_a_name(tree)
        if part is None:
            break
        name = next(names)
        taken.add(name)
        tree = _replaced(tree, part, Tree("name", name))
        named.append((name, part))
    return cut(tree), [(name, cut(part)) for name, part in named]


def _new_names(taken: set[str]) -> Iterator[str]:
    yield from (name for k in count(1) if (name := f"u{k}") not in taken)


def _worth_a_name(tree: Tree) -> Tree | None:
    """The part whose name saves most; a part that stands there once has to be large, and no whole term of the top."""
    found = Counter(part for part in tree.below() if part.size >= SMALLEST and part.kind != "relation")
    worth = {
        part: (times - 1) * (part.size - 1) or (part.size / 4 if part.size <= LONG else 0)
        for part, times in found.items()
        if part != tree and part.size <= LONG
    }
    best = max(worth, key=lambda part: worth[part], default=None)
    return best if best is not None and worth[best] > 2 else None


def _replaced(tree: Tree, part: Tree, name: Tree) -> Tree:
    if tree == part:
        return name
    if not tree.parts:
        return tree
    return replace(tree, parts=tuple(_replaced(p, part, name) for p in tree.parts))


def cut(tree: Tree, most: int = MOST_TERMS) -> Tree:
    """The formula with the rest of each long sum left out, and counted."""
    parts = tuple(cut(part, most) for part in tree.parts)
    if tree.kind != "sum" or len(parts) <= most + 1:
        return replace(tree, parts=parts)
    more = Tree("more", f"{len(parts) - most + 1} terms")
    return replace(tree, parts=(*parts[: most - 1], more), signs=(*tree.signs[: most - 1], "+"))


def polynomial(table: dict[str, str]) -> Tree:
    """The tree of a certificate's polynomial, {"g4^2": "1", "x": "-1"}; signs and constants as they are written."""
    terms, signs = [], []
    for monomial, coefficient in table.items():
        factors = [_power(factor) for factor in monomial.split()]
        number = coefficient.lstrip("-")
        over, _, under = number.partition("/")
        if number != "1" or not factors:
            head = Tree("number", over)
            factors.insert(0, Tree("fraction", parts=(head, Tree("number", under))) if under else head)
        terms.append(factors[0] if len(factors) == 1 else Tree("product", parts=tuple(factors)))
        signs.append("-" if coefficient.startswith("-") else "+")
    return _total(terms, signs)


def _total(terms: Sequence[Tree], signs: Sequence[str]) -> Tree:
    if not terms:
        return Tree("number", "0")
    if len(terms) == 1 and signs[0] == "+":
        return terms[0]
    return Tree("sum", parts=tuple(terms), signs=tuple(signs))


def _power(factor: str) -> Tree:
    name, _, exponent = factor.partition("^")
    base = Tree("name", name)
    return Tree("power", parts=(base, Tree("number", exponent))) if exponent else base
