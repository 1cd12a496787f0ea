"""Arguments whose ratios are long numbers: no polynomial of that degree is ever made."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide import ladder
from canon.decide.region import Region
from canon.decide.tape import Tape

x = sp.Symbol("x", real=True)
NEAR = sp.Rational(999999999, 1000000000)


@pytest.mark.parametrize(
    ("f", "status"),
    [
        (sp.cosh(x) / sp.cosh(NEAR * x) - 1, "refuted"),
        (sp.cosh(x) / sp.cosh(NEAR * x) * sp.cosh(NEAR * x) - sp.cosh(x), "proved"),
        (sp.sin(x) / (2 + sp.cos(NEAR * x)) - sp.sin(NEAR * x) / (2 + sp.cos(x)), "refuted"),
        (sp.exp(x) ** 300 - sp.exp(300 * x), "proved"),
        (sp.exp(sp.Rational(1001, 1000) * x) - sp.exp(x), "refuted"),
    ],
)
def test_close_exponents(f: sp.Expr, status: str):
    tape = Tape()
    (answer,) = ladder.vanish(tape, [tape.load(f)], Region((), (), ()), budget=Budget(20))
    assert answer.status == status


def test_the_tower_gives_up_at_once():
    tape = Tape()
    node = tape.load(sp.cosh(x) * sp.cosh(NEAR * x) - sp.cosh((1 + NEAR) * x) / 2 - sp.cosh((1 - NEAR) * x) / 2)
    (answer,) = ladder.vanish(tape, [node], Region((), (), ()), budget=Budget(20))
    assert answer.status == "supported"
