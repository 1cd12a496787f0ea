"""What rules ask of a file, and how they change it: its parameters, its nodes, names that formulas replace."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from typing import Any, Final

from canon.syntax import Call, Name, Node, Power, parse
from properties.metamorphic.tables import (
    Tables,
    in_nodes,
    mapped,
    open_parts,
    own_names,
    replaced,
    shown,
    walk,
    with_children,
)

Rule = Callable[[random.Random, Tables], Tables | None]
"""A change of a file with one claim, by chance; None where it has no place."""
CANONICAL: Final = (
    "canonical", "canonical_when", "fundamental_brackets", "volume", "integral_invariant", "bracket", "jacobi",
    "conserved", "involution", "independent", "bracket_invariance", "new_hamiltonian", "cartan_invariant",
    "lie_series", "identity", "inequality",
)  # fmt: skip
"""Kinds that say the same in any canonical coordinates."""
MAPS: Final = ("canonical", "canonical_when", "fundamental_brackets", "volume", "integral_invariant")
"""Kinds about a map alone."""
COMPLEX: Final = ("complex", "1j", "j)")


def substituted(tables: Tables, values: Mapping[str, str]) -> Tables | None:
    """The file with formulas in the place of names; None where one of them is more than a value."""
    if own_names(tables["claim"][0]) & {*values}:
        return None
    trees = {name: parse(text) for name, text in values.items()}
    held = False

    def told(node: Node) -> Node:
        nonlocal held
        if isinstance(node, Call) and node.name == "D":
            held = held or any(isinstance(a, Name) and a.name in trees for a in node.arguments[1:])
        return trees.get(node.name, node) if isinstance(node, Name) else node

    found = mapped(tables, lambda text: in_nodes(text, lambda node: replaced(node, told)))
    return None if held else found


def variables(tables: Tables) -> set[str]:
    return {name for word in "qpQP" for name in tables.get("phase_space", {}).get(word, [])}


def words_of(tables: Tables, name: str) -> list[str]:
    given = tables.get("symbols", {}).get(name, "real")
    return [given] if isinstance(given, str) else list(given)


def parameters(tables: Tables, *words: str) -> list[str]:
    """The parameters, no functions, that have one of the words and stand in formulas alone."""
    others = variables(tables) | own_names(tables["claim"][0])
    names = [name for name in tables.get("symbols", {}) if name not in others]
    return [name for name in names if tuple(words_of(tables, name)) in [(word,) for word in words]]


def is_complex(tables: Tables) -> bool:
    text = repr(tables)
    return any(word in text for word in COMPLEX)


def with_symbol(tables: Tables, name: str, word: Any) -> Tables:
    return {**tables, "symbols": {**tables.get("symbols", {}), name: word}}


def with_claim(tables: Tables, **keys: Any) -> Tables:
    return {**tables, "claim": [{**tables["claim"][0], **keys}]}


def nodes(tables: Tables, wanted: Callable[[Node], bool]) -> list[str]:
    found = list[str]()

    def seen(node: Node) -> Node:
        found.extend(shown(part) for part in walk(node) if wanted(part))
        return node

    mapped(tables, lambda text: in_nodes(text, seen))
    return found


def outside_exponents(node: Node, told: Callable[[Node], Node]) -> Node:
    """As `replaced`, but an exponent that is a number stays, and so does what an unknown's derivative is taken by."""
    if isinstance(node, Power):
        new = Power(node.span, outside_exponents(node.base, told), node.exponent)
        return told(node if new.base is node.base else new)
    parts = open_parts(node)
    news = tuple(outside_exponents(part, told) for part in parts)
    if any(new is not part for new, part in zip(news, parts, strict=True)):
        same = iter(news)
        node = with_open_parts(node, same)
    return told(node)


def with_open_parts(node: Node, parts: Any) -> Node:
    """The node with its replaceable parts replaced, the others kept."""
    kept = node.arguments[1:] if isinstance(node, Call) and node.name == "D" else ()
    return with_children(node, (*parts, *kept))


def is_canonical(tables: Tables) -> bool:
    return not {"tensor", "structure", "coordinates"} & {*tables["claim"][0]}


def with_claim_of(tables: Tables, **keys: Any) -> Tables:
    return {**tables, "claim": [keys]}


def names_in(text: str) -> set[str]:
    """The names in a formula that aren't called."""
    return {node.name for node in walk(parse(text)) if isinstance(node, Name)}


def differentiated(tables: Tables) -> set[str]:
    """The names by which a derivative is taken."""
    held = set[str]()

    def seen(node: Node) -> Node:
        if isinstance(node, Call) and node.name == "D":
            held.update(part.name for part in node.arguments[1:] if isinstance(part, Name))
        return node

    mapped(tables, lambda text: in_nodes(text, lambda node: replaced(node, seen)))
    return held


def named(tables: Tables, text: str, name: str) -> Tables:
    """The file with a name wherever a part stood that is written so."""

    def told(node: Node) -> Node:
        return Name(node.span, name) if shown(node) == text else node

    return mapped(tables, lambda formula: in_nodes(formula, lambda node: replaced(node, told)))


def called_in(text: str) -> set[str]:
    """The names in a formula that are called."""
    return {node.name for node in walk(parse(text)) if isinstance(node, Call)}
