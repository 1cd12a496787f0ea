"""The matrix M of a map for a proof: the derivatives of the new variables by the old ones, where it can be read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from canon.report.proof.blocks import Block, Grid, paragraph
from canon.report.proof.structure import LONG
from canon.typeset.trees import Tree, tree_of

LARGEST: Final = 6
WIDEST: Final = 100
"""Signs of a row, in all its entries."""


def jacobian(tables: Mapping[str, Any]) -> list[Block]:
    """M of an explicit map, as a list that is empty where it is too large to be read."""
    from canon.claims.reader import read_tables
    from canon.claims.show import FAILURES, neat

    given = tables.get("transformation")
    claims = read_tables({**tables, "claim": [tables["claim"]]}).claims
    if not given or not claims or claims[0].subject.transformation is None:
        return []
    map_ = claims[0].subject.transformation
    rows, columns = map_.targets, map_.arguments
    if max(len(rows), len(columns)) > LARGEST:
        return []
    try:
        entries = [[neat(f.diff(x)) for x in columns] for f in map_.expressions]
        trees = [[tree_of(str(entry)) for entry in row] for row in entries]
    except FAILURES:
        return []
    wide = any(sum(tree.size for tree in row) > WIDEST for row in trees)
    if wide or any(tree.kind == "verbatim" or tree.size > LONG for row in trees for tree in row):
        return []
    name = Tree("name", "M" if "Q" in given else "N")
    grid = Grid(name, tuple(map(str, rows)), tuple(map(str, columns)), tuple(map(tuple, trees)))
    inverse = paragraph("The inverse of `M` is `N`, the derivatives of the old variables by the new ones:")
    return [grid] if "Q" in given else [inverse, grid]
