"""Formulas as trees of what is to be set: fractions, roots and powers as a physicist writes them, nothing computed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from canon.errors import InputError
from canon.syntax import Call, Name, Node, Number, Power, Product, Sum, parse

RELATION: Final = re.compile(r" (=|!=|<=|>=|<|>) ")
_DERIVED: Final = re.compile(r"([^\W\d]\w*)\[([\d, ]+)\]\(")
_MARKED: Final = re.compile(r"(.+)__by_([\d_]+)")
HALF: Final = ("1", "2")
ONE_OVER: Final = {"sqrt": "2", "cbrt": "3"}


@dataclass(frozen=True, slots=True)
class Tree:
    """A formula as it is set.

    `kind` says what it is made of: "number" and "name" (`text`), "verbatim" (`text` as it stands), "sum" (parts with
    their `signs`), "product", "fraction", "power", "root" (of degree `text`), "call" (of the name `text`), "derivative"
    (of a declared function, its orders in `text`), "relation" (parts with `signs` between them), and "more" (`text`
    says what was left out).
    """

    kind: str
    text: str = ""
    parts: tuple[Tree, ...] = ()
    signs: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """How many signs it has to be written with, about."""
        return 1 + sum(part.size for part in self.parts)

    def below(self) -> Iterator[Tree]:
        """The tree and all its parts."""
        yield self
        for part in self.parts:
            yield from part.below()


EXPONENTIAL: Final = Tree("name", "e")


def tree_of(text: str) -> Tree:
    """The tree of a formula, or of relations between formulas; what is neither is set as it stands."""
    sides = RELATION.split(_DERIVED.sub(_mark, text))
    try:
        trees = tuple(_tree(parse(side)) for side in sides[::2])
    except (InputError, RecursionError):
        return Tree("verbatim", text)
    return trees[0] if len(trees) == 1 else Tree("relation", parts=trees, signs=tuple(sides[1::2]))


def _mark(match: re.Match[str]) -> str:
    """A derivative of a declared function, V[1, 0](x, y), as a call of a name that says so."""
    orders = "_".join(match[2].replace(" ", "").split(","))
    return f"{match[1]}__by_{orders}("


def _tree(node: Node) -> Tree:
    if isinstance(node, Number):
        return _number(node)
    if isinstance(node, Name):
        return Tree("name", node.name)
    if isinstance(node, Call):
        return _call(node.name, [_tree(part) for part in node.arguments])
    if isinstance(node, Sum):
        return _sum(node)
    if isinstance(node, Power):
        return _power(_tree(node.base), _tree(node.exponent))
    return _product(node)


def _number(node: Number) -> Tree:
    value = node.value
    number = Tree("number", str(value) if value.denominator == 1 else _decimal(value))
    if not node.imaginary:
        return number
    return Tree("name", "i") if value == 1 else Tree("product", parts=(number, Tree("name", "i")))


def _decimal(value: Fraction) -> str:
    """A number that was written with a point, as it was written."""
    places = next(k for k in range(1, 10_000) if (value * 10**k).denominator == 1)
    digits = str(int(value * 10**places)).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def _sum(node: Sum) -> Tree:
    parts: list[Tree] = []
    signs: list[str] = []
    for part, added in zip(node.terms, node.added, strict=True):
        tree = _tree(part)
        sign = "+" if added else "-"
        if tree.kind == "sum" and len(tree.parts) == 1:  # a sign in front of a sign
            sign, tree = ("+" if sign == tree.signs[0] else "-"), tree.parts[0]
        if tree.kind == "sum" and sign == "+":
            parts += tree.parts
            signs += tree.signs
        else:
            parts.append(tree)
            signs.append(sign)
    if len(parts) == 1 and signs == ["+"]:
        return parts[0]
    return Tree("sum", parts=tuple(parts), signs=tuple(signs))


def _product(node: Product) -> Tree:
    over: list[Tree] = []
    under: list[Tree] = []
    negative = False
    for part, multiplied in zip(node.factors, node.multiplied, strict=True):
        tree = _tree(part)
        if tree.kind == "sum" and len(tree.parts) == 1:
            negative, tree = negative ^ (tree.signs[0] == "-"), tree.parts[0]
        if tree.kind == "power" and _is_negative(tree.parts[1]) and tree.parts[0] != EXPONENTIAL:
            tree, multiplied = _power(tree.parts[0], tree.parts[1].parts[0]), not multiplied
        if tree.kind == "product":
            (over if multiplied else under).extend(tree.parts)
        elif tree.kind == "fraction":
            (over if multiplied else under).append(tree.parts[0])
            (under if multiplied else over).append(tree.parts[1])
        else:
            (over if multiplied else under).append(tree)
    found = times(over)
    if under:
        found = Tree("fraction", parts=(found, times(under)))
    return Tree("sum", parts=(found,), signs=("-",)) if negative else found


def times(factors: Sequence[Tree]) -> Tree:
    """A product: whole numbers in one, in front; a factor that stands there more than once as a power."""
    flat = [part for factor in factors for part in (factor.parts if factor.kind == "product" else (factor,))]
    whole = math.prod(int(factor.text) for factor in flat if _is_whole(factor))
    counts: dict[Tree, int] = {}
    for factor in (factor for factor in flat if not _is_whole(factor)):
        plain = factor.kind == "power" and factor.parts[1].kind == "number"
        base, count = (factor.parts[0], int(factor.parts[1].text)) if plain else (factor, 1)
        counts[base] = counts.get(base, 0) + count
    found = [b if n == 1 else Tree("power", parts=(b, Tree("number", str(n)))) for b, n in counts.items()]
    if whole != 1 or not found:
        found.insert(0, Tree("number", str(whole)))
    return found[0] if len(found) == 1 else Tree("product", parts=tuple(found))


def _is_whole(tree: Tree) -> bool:
    return tree.kind == "number" and tree.text.isdecimal()


def _is_negative(tree: Tree) -> bool:
    return tree.kind == "sum" and len(tree.parts) == 1 and tree.signs == ("-",)


def _power(base: Tree, exponent: Tree) -> Tree:
    if exponent.kind == "number" and exponent.text == "1":
        return base
    if _is_negative(exponent):
        return (
            Tree("fraction", parts=(Tree("number", "1"), _power(base, exponent.parts[0])))
            if base.kind != "number" or exponent.parts[0].kind == "number"
            else Tree("power", parts=(base, exponent))
        )
    if exponent.kind == "fraction" and all(part.kind == "number" for part in exponent.parts):
        over, under = (part.text for part in exponent.parts)
        if (over, under) == HALF or over == "1":
            return Tree("root", under, (base,))
    return Tree("power", parts=(base, exponent))


def _call(name: str, arguments: list[Tree]) -> Tree:
    name = {"Abs": "abs", "Derivative": "D", "conjugate": "conj"}.get(name, name)
    if name in ONE_OVER:
        return Tree("root", ONE_OVER[name], tuple(arguments))
    if name == "exp":
        return Tree("power", parts=(EXPONENTIAL, arguments[0]))
    if marked := _MARKED.fullmatch(name):
        return Tree("derivative", f"{marked[1]} {marked[2]}", tuple(arguments))
    return Tree("call", name, tuple(arguments))
