"""Formulas on a page: what can't be broken across lines and is too wide for one gets a name, and a line of its own.

A sum can be broken at its signs, in parentheses too; a fraction, a root and a product can't.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count
from typing import Final

from canon.report.proof.blocks import Block, Display, Grid, Items, Paragraph, Section, Words, equation, paragraph
from canon.typeset.in_room import room
from canon.typeset.trees import Tree

LINE: Final = 38.0
"""Ems of a line in a proof."""
BETWEEN: Final = 1.5
"""Ems between two columns of a matrix."""

Named = list[tuple[Tree, Tree]]


def fitted(section: Section) -> Section:
    """The section with names for the wide parts of fractions, roots and products; new ones, u1, u2 and so on."""
    blocks = [*section.setting, *section.statement, *section.proof]
    taken = {part.text for tree in _trees(blocks) for part in tree.below() if part.kind in ("name", "call")}
    names = (Tree("name", name) for k in count(1) if (name := f"u{k}") not in taken)
    setting, statement, proof = (
        tuple(found for block in part for found in _blocks(block, names))
        for part in (section.setting, section.statement, section.proof)
    )
    return replace(section, setting=setting, statement=statement, proof=proof)


def _trees(blocks: Sequence[Block]) -> Iterator[Tree]:
    for block in blocks:
        if isinstance(block, Display):
            yield from block.lines
        elif isinstance(block, Grid):
            yield from (entry for row in block.entries for entry in row)
        else:
            rows = [block.words] if isinstance(block, Paragraph) else block.items
            yield from (piece for row in rows for piece in row if isinstance(piece, Tree))


def _blocks(block: Block, names: Iterator[Tree]) -> list[Block]:
    if isinstance(block, Display):
        return [Display(tuple(line for tree in block.lines for line in _lines(tree, names)))]
    if isinstance(block, Paragraph):
        return [replace(block, words=_words(block.words, names))]
    if isinstance(block, Items):
        return [Items(tuple(_words(item, names) for item in block.items))]
    return _grid(block, names)


def _grid(grid: Grid, names: Iterator[Tree]) -> list[Block]:
    """The matrix with names for its widest entries, until it fits, and what they mean."""
    entries = [list(row) for row in grid.entries]
    named: Named = []
    while sum(max(map(room, column)) + BETWEEN for column in zip(*entries, strict=True)) > LINE:
        i, j = max(
            ((i, j) for i in range(len(entries)) for j in range(len(entries[i]))), key=lambda k: _size(entries, k)
        )
        if entries[i][j].kind == "name":
            break
        entries[i][j] = _short(entries[i][j], 0, names, named)
    shown: list[Block] = [replace(grid, entries=tuple(map(tuple, entries)))]
    lines = tuple(line for name, part in named for line in _lines(equation(name, part), names))
    return [*shown, paragraph("where"), Display(lines)] if lines else shown


def _size(entries: Sequence[Sequence[Tree]], place: tuple[int, int]) -> float:
    return room(entries[place[0]][place[1]])


def _words(words: Words, names: Iterator[Tree]) -> Words:
    """Words, and behind them what their new names mean."""
    found: list[str | Tree] = []
    named: list[Tree] = []
    for piece in words:
        first, *rest = _lines(piece, names) if isinstance(piece, Tree) else (piece,)
        found.append(first)
        named += [line for line in rest if isinstance(line, Tree)]
    for k, line in enumerate(named):
        found += [", " if k else "; here ", line]
    return tuple(found)


def _lines(tree: Tree, names: Iterator[Tree]) -> list[Tree]:
    """The formula, and a line for each name that it uses now."""
    named: Named = []
    found = [_fit(tree, names, named)]
    while named:
        name, part = named.pop(0)
        found.append(equation(name, _fit(part, names, named)))
    return found


def _fit(tree: Tree, names: Iterator[Tree], named: Named) -> Tree:
    """The formula with names for the wide parts of what is never broken."""
    if room(tree) <= LINE or not tree.parts:
        return tree
    if tree.kind in ("fraction", "root"):
        return replace(tree, parts=tuple(_short(part, LINE, names, named) for part in tree.parts))
    if tree.kind == "power":
        base, exponent = tree.parts
        return replace(tree, parts=(_fit(base, names, named), _short(exponent, LINE / 3, names, named)))
    if tree.kind == "product":
        return replace(tree, parts=tuple(_factors(tree.parts, names, named)))
    return replace(tree, parts=tuple(_fit(part, names, named) for part in tree.parts))


def _short(part: Tree, most: float, names: Iterator[Tree], named: Named) -> Tree:
    """The part, or a name for it where it is wider than `most` ems."""
    if room(part) <= most:
        return part
    name = next(names)
    named.append((name, part))
    return name


def _factors(parts: Sequence[Tree], names: Iterator[Tree], named: Named) -> list[Tree]:
    """Factors that fit on a line together, names for the widest; but a sum among them can be broken by itself."""
    found = [_fit(part, names, named) for part in parts]
    while sum(room(part) for part in found if part.kind != "sum") > LINE:
        widest = max((k for k, part in enumerate(found) if part.kind != "sum"), key=lambda k: room(found[k]))
        if found[widest].kind == "name":
            break
        found[widest] = _short(found[widest], 0, names, named)
    return found
