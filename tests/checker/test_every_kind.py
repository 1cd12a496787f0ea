"""A certificate of each kind of claim in the catalogue: whatever is changed in it, it isn't confirmed any more."""

import random
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from canon.catalogue import files
from canon.checker.check import check
from canon.checker.kinds import KINDS
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.keys import KEYS
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from tests.checker.certified import places
from tests.checker.test_check import changed
from tests.checker.test_misstated import resealed_status


@cache
def shortest() -> dict[str, tuple[Path, int]]:
    """Of each kind the claim with the shortest file and text."""
    found: dict[str, tuple[int, Path, int]] = {}
    for path in map(Path, map(str, files())):
        tables = document.load(path)
        size = path.stat().st_size
        for k, claim in enumerate(tables["claim"]):
            here = size + 10 * len(str(claim)), path, k
            found[claim["kind"]] = min(found.get(claim["kind"], here), here)
    return {kind: (path, k) for kind, (_, path, k) in found.items()}


def made(kind: str) -> Any:
    path, k = shortest()[kind]
    tables = document.load(path)
    claim = read_tables(tables).claims[k]
    return certificate(claim, verify(claim), statement_tables(tables, k))


def test_the_catalogue_has_every_kind() -> None:
    assert {*shortest()} == {*KEYS}


def test_the_checker_has_rules_for_every_kind() -> None:
    assert {*KEYS} == {*KINDS}


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(KEYS))
def test_no_field_can_be_changed(kind: str) -> None:
    """With the old checksum it is rejected; with a new one, what is shown is no proof."""
    data = made(kind)
    routes = [route for route in places(data) if route != ("certificate",)]
    assert len(routes) > 15
    for route in routes:
        new = changed(data, route)
        assert check(new).status == "rejected", route
    shown = [r for r in routes if r[0] == "cases" and r[-1] in ("numerator", "cofactors", "residuals", "stands for")]
    for route in random.Random(1).sample(shown, min(4, len(shown))):
        new = changed(data, route)
        assert new == data or resealed_status(new) != "confirmed", route
