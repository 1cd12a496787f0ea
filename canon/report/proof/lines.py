"""Formulas by name, one below the other; long ones by their structure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from canon.report.proof.blocks import Display
from canon.report.proof.structure import LONG, structured
from canon.typeset.trees import Tree, tree_of

Tables = Mapping[str, Any]


def formulas(pairs: Sequence[tuple[str, str]], tables: Tables) -> Display:
    """name = formula, long ones by their structure."""
    taken = names_of(tables)
    lines: list[Tree] = []
    for name, text in pairs:
        lines += by_structure(tree_of(name), tree_of(str(text)), taken)
    return Display(tuple(lines))


def by_structure(left: Tree, right: Tree, taken: set[str]) -> list[Tree]:
    """left = right on a line; where that is long, with names for parts, each on a further line."""
    if right.size <= LONG:
        return [Tree("relation", parts=(left, right), signs=("=",))]
    short, parts = structured(right, taken)
    rows = [(left, short), *((Tree("name", name), part) for name, part in reversed(parts))]
    return [Tree("relation", parts=row, signs=("=",)) for row in rows]


def names_of(tables: Tables) -> set[str]:
    """The names that have a meaning in the file."""
    space = tables["phase_space"]
    return {
        *(name for side in "qpQP" for name in space.get(side, [])),
        *tables.get("symbols", {}),
        *tables.get("definitions", {}),
    }
