"""Winding numbers certified by balls."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.decide.tape import Tape
from canon.decide.winding import winding_number

W = sp.Symbol("w", real=True)
TWO_PI = 2 * sp.pi


@pytest.mark.parametrize(
    ("x", "y", "expected"),
    [
        (sp.cos(W), sp.sin(W), 1),
        (sp.sin(W), sp.cos(W), -1),
        (sp.cos(2 * W), sp.sin(2 * W), 2),
        (7 + sp.cos(W) / 100, sp.sin(W), 1),
        (sp.cos(W) + sp.cos(2 * W), sp.sin(W) + sp.sin(2 * W), 2),  # with a small loop inside
        (sp.cos(W / 2), sp.sin(W / 2), None),  # open
        (sp.log(sp.cos(W)), sp.sin(W), None),  # undefined on the way
    ],
)
def test_curves(x, y, expected):
    tape = Tape()
    plane = [tape.load(x), tape.load(y)]
    found = winding_number(tape, plane, tape.symbol(W), tape.load(TWO_PI), {tape.symbol(W): Fraction(1, 3)})
    assert found == expected
