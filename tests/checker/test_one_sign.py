"""Forged refutations by a function without a zero that has values of both signs."""

import pytest

from tests.checker.test_forged_files import against
from tests.checker.test_forged_places import status

POSITIVE = {"kind": "inequality", "lhs": "X(q)*X(p)", "relation": ">", "rhs": "0"}
ALIKE = {"kind": "identity", "lhs": "abs(X(q))/X(q)", "rhs": "abs(X(p))/X(p)"}


@pytest.mark.parametrize("claim", [POSITIVE, ALIKE])
def test_no_function_without_a_zero_has_both_signs(claim):
    point, words = {"q": "1", "p": "-1", "X": "a"}, ["function", "nonzero"]
    assert status(against(claim, point, symbols={"X": words})) != "confirmed"
    assert status(against(claim, point, symbols={"X": "function"})) == "confirmed"


def test_with_one_sign_it_refutes():
    claim, words = {"kind": "identity", "lhs": "X(q)", "rhs": "X(p)"}, ["function", "nonzero"]
    assert status(against(claim, {"q": "1", "p": "2", "X": "a"}, symbols={"X": words})) == "confirmed"
