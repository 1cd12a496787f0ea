"""What a proof is made of before it is set: words with formulas in them, displays, a matrix, lists."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from canon.typeset.trees import Tree, tree_of

Piece = str | Tree
Words = tuple[Piece, ...]


@dataclass(frozen=True)
class Paragraph:
    """Words in a row; `lead` stands out at its beginning."""

    words: Words
    lead: str = ""


@dataclass(frozen=True)
class Display:
    """Formulas that stand by themselves, one below the other."""

    lines: tuple[Tree, ...]


@dataclass(frozen=True)
class Items:
    """A list."""

    items: tuple[Words, ...]


@dataclass(frozen=True)
class Grid:
    """A matrix with its name and the names of its rows and columns."""

    name: Tree
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    entries: tuple[tuple[Tree, ...], ...]


Block = Paragraph | Display | Items | Grid


@dataclass(frozen=True)
class Section:
    """A claim with its proof: `status` is the verdict, `statement` what is claimed, `proof` why it is so (or isn't)."""

    title: str
    place: str
    status: str
    source: str
    setting: tuple[Block, ...]
    statement: tuple[Block, ...]
    proof: tuple[Block, ...]
    close: Words


def words(*pieces: Piece) -> Words:
    """Words in which what stands between backquotes is a formula."""
    found: list[Piece] = []
    for piece in pieces:
        if isinstance(piece, Tree):
            found.append(piece)
            continue
        for k, part in enumerate(piece.split("`")):
            if part:
                found.append(tree_of(part) if k % 2 else part)
    return tuple(found)


def paragraph(*pieces: Piece, lead: str = "") -> Paragraph:
    """A paragraph, formulas between backquotes."""
    return Paragraph(words(*pieces), lead)


def display(*lines: str | Tree) -> Display:
    """Formulas, each on a line."""
    return Display(tuple(line if isinstance(line, Tree) else tree_of(line) for line in lines))


def equation(left: Tree, *right: Tree) -> Tree:
    """left = right = …"""
    return Tree("relation", parts=(left, *right), signs=("=",) * len(right))


def listed(pieces: Sequence[str]) -> str:
    """Formulas in backquotes with commas and an "and"."""
    quoted = [f"`{piece}`" for piece in pieces]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} and {quoted[-1]}"
