"""What is called continuous at an end of an interval has a value there, and tends to it."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.continuous_at import at_edge, is_continuous_at
from canon.decide.intervals import Edge, Interval
from canon.decide.tape import Tape

x, y = sp.symbols("x y", real=True)
AT_0 = {
    sp.sin(x) / (2 + x): True,
    sp.sin(x) / x: False,
    sp.sqrt(x + 1): True,
    sp.sqrt(x): False,  # it is, but without a slope
    sp.log(x + y): True,
    sp.log(x + y - 1): False,
    sp.atan2(x, 1 + y): True,
    sp.atan2(x, -1 - y): False,  # a cut: pi on the one side, -pi on the other
    sp.atan2(x + 1, -1 - y): True,
    sp.atan2(x - 1, -1 - y): True,
    abs(x - y): True,
    abs(x): True,  # 0 all along the slice
    abs(x + y - 1): False,
    sp.asin(x + 1): True,
    sp.asin(x + y / 3 - sp.Rational(1, 2)): True,
    sp.asin(1 - x - (y - 1) ** 2 / 4): False,  # 1 at y = 1
    sp.sign(x): False,
}


@pytest.mark.parametrize(("formula", "continuous"), AT_0.items(), ids=str)
def test_at_0_for_all_y_of_an_interval(formula: sp.Expr, continuous: bool) -> None:
    tape, edge = Tape(), Edge(Fraction(0))
    node = tape.load(formula)
    sides = {x: Interval(edge, Edge(Fraction(1))), y: Interval(Edge(Fraction(1, 2)), Edge(Fraction(3)))}
    box = {tape.symbol(symbol): interval for symbol, interval in sides.items()}
    assert is_continuous_at(tape, node, tape.symbol(x), at_edge(tape, edge), box, Budget(10)) is continuous
