"""Evaluation over a prime field: its points satisfy every relation; what vanishes there is what is 0 in the tower."""

import random
from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.ladder import _Ladder, look
from canon.decide.modular import Evaluator, vanishing
from canon.decide.region import Region
from canon.decide.tape import Tape
from properties.towers import tower_of

x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)
THIRD = sp.Rational(1, 3)
ZERO = [  # sums that are 0, written so that not every node is
    (x + y) ** 3 - x**3 - y**3 - 3 * x * y * (x + y),
    sp.sqrt(1 + x**2) ** 4 / (1 + x**2) - 1 - x**2,
    (sp.sqrt(a) + sp.sqrt(b)) * (sp.sqrt(a) - sp.sqrt(b)) - a + b,
    a**THIRD * (a**THIRD) ** 2 - a + 1 / sp.sqrt(a + b) - sp.sqrt(a + b) / (a + b),
    sp.sin(x + y) - sp.sin(x) * sp.cos(y) - sp.cos(x) * sp.sin(y),
    sp.cos(2 * x) / 3 - sp.Rational(2, 3) * sp.cos(x) ** 2 + THIRD,
    sp.exp(2 * x) / sp.exp(y) - sp.exp(x) * sp.exp(x - y),
    (x + sp.I * y) * (x - sp.I * y) - x**2 - y**2,
    sp.log(a * b) - sp.log(a) - sp.log(b),
    sp.sqrt(a + sp.sqrt(b)) ** 2 - a - sp.sqrt(b) + (1 / (1 + sp.sqrt(2)) - sp.sqrt(2) + 1) * x,
    sp.Abs(x) ** 2 / x**2 - 1,
]


@pytest.mark.parametrize("formula", ZERO, ids=str)
def test_what_is_zero_vanishes_and_nothing_beside_it(formula: sp.Expr):
    tape = Tape()
    node = tape.load(formula)
    factor = tape.load(1 + x**2 + a)
    others = [tape.plus(node, tape.number(Fraction(1, 1000))), tape.plus(node, tape.scaled(factor, Fraction(1, 7)))]
    parts = [tape.mul(((node, 1), (factor, -1))), tape.mul(((factor, 1), (others[0], -1)))]
    tower = tower_of(tape, tape.plus(node, *others, *parts), [])
    zero, log_error = vanishing(tower, [node, *others, *parts], random.Random(4))
    assert zero == {node: True, others[0]: False, others[1]: False, parts[0]: True, parts[1]: False}
    assert log_error <= -100


@pytest.mark.parametrize("seed", range(3))
def test_points_satisfy_the_relations(seed: int):
    tape = Tape()
    formula = (
        sp.sqrt(1 + x**2) + a**THIRD + sp.sin(x) * sp.cos(x + y) + sp.sqrt(2) * sp.sqrt(a + sp.sqrt(b))
        + sp.I * sp.exp(y) + sp.Abs(x) + (a + 1) ** sp.Rational(2, 5)
    )  # fmt: skip
    tower = tower_of(tape, tape.load(formula), [])
    evaluator = Evaluator(tower, random.Random(seed), 159)
    point = evaluator.point()
    assert evaluator.p.bit_length() == 159
    assert sum(bool(made.degree) for made in tower.generators) >= 8
    for made in tower.generators:
        if made.degree:
            lower = evaluator._polynomial(evaluator.lower[made.index], point)
            assert pow(point[made.index], made.degree, evaluator.p) == lower
    again = Evaluator(tower, random.Random(seed + 100), 159)
    assert again.p != evaluator.p
    assert again.point() != evaluator.point() != evaluator.point()


def test_the_error_bound_grows_with_degree_and_radicals():
    """D·4^k/p for a polynomial of degree D with k radicals, up to the bits that bound the coefficients."""
    tape = Tape()
    low, high, rooted = (
        tape.load(f) for f in (x**2 - y, x**4096 - y, sp.sqrt(1 + x) + sp.sqrt(1 + y) + sp.sqrt(x + y))
    )
    bounds = []
    for node in (low, high, rooted):
        evaluator = Evaluator(tower_of(tape, node, []), random.Random(1), 159)
        bounds.append(evaluator.log2_error([node]))
    assert -158 < bounds[0] < -140
    assert bounds[0] + 10 < bounds[1] < bounds[0] + 13
    assert bounds[0] + 6 <= bounds[2] < bounds[0] + 12


def test_the_ladder_supports_what_vanishes_and_gives_up_the_rest():
    tape = Tape()
    node = tape.load(ZERO[2])
    other = tape.plus(node, tape.number(Fraction(1, 1000)))
    region = Region((), (), tuple(tape.support(node)))
    steps = _Ladder(tape, region, Budget(20), random.Random(1))
    assert steps._modular_nonzero(tower_of(tape, tape.plus(node, other), []), [node, other]) == {other}
    assert steps.evidence.keys() == {node}
    assert steps.evidence[node] <= -100


def test_a_look_that_has_no_time_sees_nothing():
    tape = Tape()
    node = tape.load(x + 1)
    region = Region((), (), (tape.symbol(x),))
    assert look(tape, [node], region, budget=Budget(0.0)) == ([], False)
    points, refuted = look(tape, [node], region, budget=Budget(20))
    assert points
    assert refuted
