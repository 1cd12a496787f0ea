"""What is assumed of a symbol, read at once, is what sympy finds by searching."""

from itertools import combinations

import pytest
import sympy as sp

from canon.sign import declared

WORDS = (
    "real", "positive", "negative", "nonnegative", "nonpositive", "nonzero", "zero",
    "integer", "rational", "even", "odd",
)  # fmt: skip
GIVEN = ({"real": True}, {"complex": True}, {"zero": False}, *({word: True} for word in WORDS[1:]), {})


@pytest.mark.parametrize("first", range(len(GIVEN)))
def test_declared_facts_are_those_of_sympy(first: int) -> None:
    for a, b in combinations(GIVEN[first:], 2) if first else ((given, {}) for given in GIVEN):
        try:
            symbol = sp.Symbol("x", **{**a, **b})
        except ValueError:
            continue
        facts = declared(symbol)
        assert {word: facts.get(word) for word in WORDS} == {word: getattr(symbol, f"is_{word}") for word in WORDS}
