"""Certificates about real Lie algebras and groups whose constants, or compositions of parameters, aren't real."""

import pytest

from tests.checker.test_forged_files import group
from tests.checker.test_forged_places import of, status

LAWS = {"u + w + 1j*u*w": {"u": "real"}, "u + w + z*u*w": {"u": "real", "z": "complex"}}


@pytest.mark.parametrize("law", LAWS)
def test_a_law_that_is_not_real_is_not_confirmed(law: str) -> None:
    assert status(group("u + w + u*w", symbols=LAWS[law])) == "confirmed"
    assert status(group(law, symbols=LAWS[law])) == "unreadable"


def test_structure_constants_that_are_not_seen_to_be_real_are_not_confirmed() -> None:
    claim = {"kind": "algebra", "basis": {"v": "z*q", "u": "p", "w": "1"}, "structure": {"v,u": "z*w"}}
    assert status(of(claim, symbols={"z": ["complex", "nonzero"]})) == "not confirmed"
