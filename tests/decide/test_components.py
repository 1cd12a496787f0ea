"""The pieces of a surface's equations vanish, one of each group, just where the equations do."""

from itertools import product

import pytest
import sympy as sp

from canon.decide.components import pieces, without_powers
from canon.decide.tape import Tape

x, y, z = sp.symbols("x y z", real=True)
w = sp.Symbol("w")  # not real
I = sp.I  # noqa: E741
GRID = range(-2, 3)

EQUATIONS = [
    (x - 1) ** 2 * (y + 2) ** 3,
    (x**2 - y**2) * (2 * x + 3 * y - 1),
    (x**2 - y) / (x + 3),
    (x**2 - y**2) / (x - y) ** 2,  # x = y is taken out
    (x - y) * (x + 1) / (x - y),
    3 * (x - y) ** -2,  # nowhere
    x / 2 + 1 / (y - sp.Rational(5, 2)),
    1 / (x - sp.Rational(7, 2)) - 1 / (2 * y - sp.Rational(1, 3)),
    x**2 + y**2,
    -((x - 1) ** 2) - 2 * (x + y) ** 2,
    (x - 1) ** 2 + 3 * (x + y - 2) ** 2 + 5 * (z - x + y) ** 2,
    x**2 + y**2 - 1,
    x**2 + y**2 + 1,  # nowhere
    -(x**2) - y**2 + 4,
    x**2 + x * y + y**2,
    x**2 + 3 * x * y + y**2,
    x * y - 2,
    x**2 + y * z,
    x**2 + y**2 + z,
    x**2 - 2 * y**2,
    x**2 + 2 * y + 1,
    x + I * y - 1 - I,
    (x + I * y) ** 2 - 3 - 4 * I,
    (x + I) * (y - I) - 1 - I * (x - y),
    1 / (x + I * y + 5) - 1 / (6 + 2 * I),
    (y - 1) / (x + 2 * I) + I * (y**2 - 1),
    1 / (x / (y + sp.Rational(1, 2)) + I) - 1 / (2 + I),
    (x + I * y) ** -2 + sp.Rational(1, 4),
    I * x - I,
]


@pytest.mark.parametrize("equation", EQUATIONS, ids=str)
def test_pieces_vanish_where_the_equation_does(equation: sp.Expr):
    tape = Tape()
    found = pieces(tape, [tape.load(equation)])
    assert all(piece.polynomial is not None for group in found for piece in group)
    assert all(piece.polynomial.leading_coefficient() == 1 for group in found for piece in group if len(group) > 1)
    names = sorted(equation.free_symbols, key=str)
    order = sorted(names, key=tape.symbol)
    below = [power.base for power in equation.atoms(sp.Pow) if power.exp.is_negative]
    for place in product(GRID, repeat=len(names)):
        at = dict(zip(names, place, strict=True))
        if any(sp.expand(f.subs(at)) == 0 for f in below):
            continue
        vanishes = all(any(p.polynomial(*(at[n] for n in order)) == 0 for p in group) for group in found)
        assert (abs(complex(equation.subs(at))) < 1e-12) is vanishes, place


@pytest.mark.parametrize(
    ("equation", "groups"),
    [
        ((x - 1) ** 2 * (y + 2) ** 3, [2]),
        (x**2 + y**2, [1, 1]),
        ((x - 1) ** 2 + 3 * (x + y - 2) ** 2 + 5 * (z - x + y) ** 2, [1, 1, 1]),
        (x**2 + w**2, [1]),  # w = ±i·x are zeros too
        (x + I * y, [1, 1]),
        (x * w - 2, [1]),
        (x + I * w, [1]),  # w isn't real: no real and imaginary parts
        (sp.sqrt(x) * (y - 1) / (1 + sp.exp(z)), [2]),  # what is below isn't among them
        ((x**2 - y**2) / (x - y) ** 2, [1]),  # x = y is taken out
        (3 * sp.sqrt(x) * (y - 1), [2]),
        (1 + sp.sqrt(x) * (y - 1), [1]),
        (3 * (x - y) ** -2, [0]),
        ((x - y) - (x - y), []),
        (x**5 - x - 1, [1]),
        ((x + y + z + 1) ** 41, [1]),  # more than is multiplied out
        ((x + y + z + 2) ** 20 - 1, [1]),
    ],
)
def test_how_many_pieces_there_are(equation: sp.Expr, groups: list[int]):
    tape = Tape()
    assert [len(group) for group in pieces(tape, [tape.load(equation)])] == groups


def test_equal_equations_are_one_and_powers_are_left_out():
    tape = Tape()
    nodes = [tape.load(f) for f in ((x - y) ** 3, (x - y) ** 2 * 7, sp.Integer(0))]
    assert len(pieces(tape, nodes)) == 1
    (node,) = without_powers(tape, nodes)
    assert node in (tape.load(x - y), tape.load(y - x))
