"""Sums of many terms: decided in time that grows with their number, and named, not printed."""

import sympy as sp

from canon import PhaseSpace, bracket, verify

SPACE = PhaseSpace("q", "p")
q, p = SPACE.symbols("q p")
SIDE = 40
F = sp.Add(*[(a + b + 1) * q**a * p**b for a in range(SIDE) for b in range(SIDE)])
SLOPE = sp.Add(*[(a + b + 1) * b * q**a * p ** (b - 1) for a in range(SIDE) for b in range(1, SIDE)])


def test_a_bracket_of_many_terms_is_proved_and_named() -> None:
    found = verify(bracket(SPACE, q, F, SLOPE), budget=60)
    assert found.status == "proved"
    claim = bracket(SPACE, q, F, SLOPE).keys["g"]
    assert claim.label == f"a sum of {SIDE**2} terms"


def test_a_thousandth_in_one_of_many_terms_is_refuted() -> None:
    found = verify(bracket(SPACE, q, F, SLOPE + q**20 * p**20 / 1000))
    assert found.status == "refuted"
    assert found.method == "ball at 64 bits"


def test_short_formulas_are_printed() -> None:
    assert bracket(SPACE, q, q * p, q).keys["g"].label == "p*q"
