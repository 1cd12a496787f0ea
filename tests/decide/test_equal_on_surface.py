"""What an equation of a surface puts in the place of a coordinate, and which calls it makes one."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.equal_on_surface import by_equal_arguments, solved_for
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.domain import Domain

x, y = sp.symbols("x y", real=True)
V, W = sp.Function("V"), sp.Function("W")


@pytest.mark.parametrize("equation", [3 * x - y, x - 2 * y + 5, (x + 7 * y) / 3 - 1])
def test_the_coordinate_has_the_value_that_the_equation_gives(equation: sp.Expr) -> None:
    tape = Tape()
    region = Region.of(tape, Domain((), (equation,)), [x, y])
    found = solved_for(tape, tape.load(sp.sin(x + 2 * y)), region)
    assert found is not None
    node, free = found
    assert not free.surface
    (rest,) = (tape.symbol_at(name) for name in free.symbols)
    (given,) = {x, y} - {rest}
    (value,) = sp.solve(equation, given)
    assert sp.expand(tape.to_sympy(node).args[0] - (x + 2 * y).subs(given, value)) == 0


@pytest.mark.parametrize(
    ("formula", "equal"),
    [
        (V(x**2) - V(y**2), True),
        (V(x) - V(y), False),
        (W(x**2, x * y) - W(y**2, x * y), True),
        (W(x**2, x) - W(y**2, y), False),
        (W(x, x**2) - W(y, y**2), False),
    ],
)
def test_all_arguments_agree_of_calls_that_are_taken_for_one(formula: sp.Expr, equal: bool) -> None:
    tape = Tape()
    node, region = tape.load(formula), Region.of(tape, Domain((), (x**2 - y**2,)), [x, y])
    assert (by_equal_arguments(tape, node, region, Budget(20)) is not None) is equal
