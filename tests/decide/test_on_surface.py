"""Vanishing on a surface, with fractions as coefficients."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide import ladder
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.domain import Domain

x, y = sp.symbols("x y", real=True)


@pytest.mark.parametrize("factor", [sp.Rational(1, 3), 7, sp.Rational(1001, 1000) * x])
@pytest.mark.parametrize("equation", [x**2 - y**2, x * y - sp.Rational(2, 3)])
def test_a_multiple_of_the_equation_vanishes_on_it(factor, equation):
    tape = Tape()
    node = tape.load(sp.sin(x) + factor * equation - sp.sin(x) * (sp.sin(y) ** 2 + sp.cos(y) ** 2))
    region = Region.of(tape, Domain((), (equation,)), [x, y])
    (answer,) = ladder.vanish(tape, [node], region, budget=Budget(20))
    assert answer.status == "proved"
