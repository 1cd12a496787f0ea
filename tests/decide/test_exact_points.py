"""Points of algebraic sets by Gröbner bases lie on them: exact coordinates exactly, irrational ones in their balls."""

import random
import time
from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.enclosure import precision
from canon.decide.exact_points import NoZero, algebraic_point
from canon.decide.on_surface import _in_ideal, _in_radical
from canon.decide.tape import Tape
from canon.decide.tower import Tower
from canon.errors import BudgetExceeded

x, y, z = NAMES = sp.symbols("x y z")
CHOSEN = {0: Fraction(2), 1: Fraction(-1, 3), 2: Fraction(5)}


def terms(f: sp.Expr) -> dict[tuple[int, ...], Fraction]:
    return {m: Fraction(int(c.p), int(c.q)) for m, c in sp.Poly(f, *NAMES, domain=sp.QQ).terms()}


def found(*equations: sp.Expr, seed: int = 0):
    return algebraic_point([terms(f) for f in equations], CHOSEN, random.Random(seed), 128, Budget())


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize(
    ("equations", "irrational"),
    [
        (((2 * x - 3) * (x**2 + 1), 3 * y - x), 0),  # the complex roots are passed over
        ((4 * x - 12 * y + 3, x**2 * (y - 1) + y - 1), 0),
        (((x - 1) ** 2, (y + 2) ** 2 * (x + 1)), 0),  # touching
        ((x * y - x, x**2 - x, (y - 1) * (y - 3)), 0),
        ((x**2 - 2, 3 * y + 5 * x - 7), 2),
        ((x**2 - 2, 3 * y + 5 * x - 7, 4 * z - x * y + 1), 3),
        ((x**2 + y**2 - 3, 2 * x - 5 * y), 2),
        ((y**3 - 5, x - y**2 + y / 3), 2),
        ((x**2 - 3, y - x * z), 2),  # y or z stays as it was chosen
        ((x**2 - x * y, x * y - y**2), 0),  # dependent: all of x = y
        (((x - y) * z, (x - y) * (z - 1)), 0),
    ],
)
def test_a_point_lies_on_the_set(equations: tuple[sp.Expr, ...], irrational: int, seed: int):
    point = found(*equations, seed=seed)
    assert point is not None
    exact, solved = point
    assert len(solved) == irrational or (irrational and seed)
    assert not exact.keys() & solved.keys()
    with precision(128):
        place = {k: rational(value) for k, value in exact.items()} | solved
        assert all(ball.rad() < 1e-30 for ball in solved.values())
        for f in equations:
            value = sum(
                (rational(c) * _product(place[k] ** e for k, e in enumerate(m) if e) for m, c in terms(f).items()),
                start=rational(Fraction(0)),
            )
            assert value.contains(0) if solved else value == 0


def _product(factors):
    out = rational(Fraction(1))
    for factor in factors:
        out = factor * out
    return out


def test_equations_of_one_coordinate():
    """Of which sympy keeps polynomials of another class, with other arguments."""
    for equation, root in ((x**4 - 4, 2**0.5), (x**3 - 2, 2 ** (1 / 3))):
        exact, solved = found(equation) or ({}, {})
        assert not exact
        assert abs(abs(float(solved[0].mid())) - root) < 1e-12


def test_free_coordinates_keep_their_values():
    exact, solved = found((x - 2) ** 2 * (x + 7), (x - 2) * y) or ({}, {})
    assert not solved
    assert (exact[0], exact.get(1)) in [(2, CHOSEN[1]), (-7, 0)]
    assert 2 not in exact  # z isn't spoken of


def test_what_has_no_zero_and_what_none_is_found_of():
    with pytest.raises(NoZero):
        found(x * y - 1, x)
    with pytest.raises(NoZero):
        found(x - y, x - y + 1)
    assert found(x**2 + 1, y - x) is None  # no real one
    assert found(x**2 + 1, y**2 + 2) is None
    assert found(x**9 - 2, y) is None  # of too high a degree
    assert found(x**8 - 1, y) is not None
    assert found() is None


def test_a_basis_that_takes_hours_is_left_when_the_time_is_over():
    """The cyclic roots of order 6, of which no clock is looked at in the middle."""
    size = 6
    names = sp.symbols(f"g:{size}", real=True)
    cyclic = [sum(sp.prod([names[(i + j) % size] for j in range(d)]) for i in range(size)) for d in range(1, size)]
    system = [
        {m: Fraction(int(c.p), int(c.q)) for m, c in sp.Poly(f, *names, domain=sp.QQ).terms()}
        for f in [*cyclic, sp.prod(names) - 1]
    ]
    chosen = {k: Fraction(k + 2) for k in range(size)}
    tape = Tape()
    tower = Tower(tape, [tape.load(sum(names))], budget=Budget())
    of, *equations = [tower.ring.polynomial(dict(f)) for f in system[1:]]
    start = time.process_time()
    with pytest.raises(BudgetExceeded):
        algebraic_point(system, chosen, random.Random(1), 128, Budget(0.1))
    for asked in (_in_ideal, _in_radical):
        with pytest.raises(BudgetExceeded):
            asked(tower, of, equations, Budget(0.1))
    assert time.process_time() - start < 20
