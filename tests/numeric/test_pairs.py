"""Pairs of doubles against sixty digits: every operation within the stated unit, also where values all but vanish."""

from fractions import Fraction

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from canon.cost.in_pairs import evaluate_in_pairs
from canon.decide.tape import Tape, Unsupported
from canon.numeric import pairs
from canon.numeric.pairs import UNIT, Pair

COUNT = 60


def some(low: float, high: float) -> Pair:
    random = np.random.default_rng(3)
    a = random.uniform(low, high, COUNT)
    return Pair(a, a * 2.0**-54 * random.uniform(-1, 1, COUNT))


def exact(a: Pair, k: int) -> mp.mpf:
    return mp.mpf(float(np.broadcast_to(a.high, COUNT)[k])) + mp.mpf(float(np.broadcast_to(a.low, COUNT)[k]))


def sine(a: Pair) -> Pair:
    return pairs.sine_and_cosine(a)[0]


def cosine(a: Pair) -> Pair:
    return pairs.sine_and_cosine(a)[1]


NEAR_PI = Pair(np.pi * np.arange(1, COUNT + 1), np.zeros(COUNT))
CASES = [
    (pairs.add, lambda a, b: a + b, [some(-3, 3), some(-2, 2)]),
    (pairs.subtract, lambda a, b: a - b, [some(1, 1 + 1e-9), Pair(np.ones(COUNT), np.zeros(COUNT))]),
    (pairs.multiply, lambda a, b: a * b, [some(-3, 3), some(1e-3, 2)]),
    (pairs.divide, lambda a, b: a / b, [some(-3, 3), some(1e-3, 2)]),
    (pairs.square_root, mp.sqrt, [some(1e-9, 8)]),
    (pairs.exponential, mp.exp, [some(-30, 30)]),
    (pairs.logarithm, mp.log, [some(1e-3, 8)]),
    (pairs.logarithm, mp.log, [some(1 - 1e-8, 1 + 1e-8)]),
    (sine, mp.sin, [some(-1e6, 1e6)]),
    (sine, mp.sin, [NEAR_PI]),
    (cosine, mp.cos, [some(-9, 9)]),
    (pairs.angle, mp.atan2, [some(-1e-6, 1e-6), some(-3, 3)]),
    (lambda a: pairs.power(a, -3), lambda a: a**-3, [some(1e-3, 3)]),
]


@pytest.mark.parametrize(("ours", "theirs", "arguments"), CASES)
def test_operations_are_within_their_unit(ours, theirs, arguments):
    found = ours(*arguments)
    with mp.workdps(60):
        for k in range(COUNT):
            true = theirs(*(exact(a, k) for a in arguments))
            assert abs(exact(found, k) - true) <= UNIT * abs(true)


def test_large_angles_have_no_value():
    assert np.isnan(sine(Pair(np.array([1e9]), np.array([0.0]))).high).all()


def test_formulas_on_the_tape():
    x = sp.Symbol("x", positive=True)
    formula = (
        sp.sqrt(x) * sp.log(1 + x) / 3 - sp.pi * x ** sp.Rational(2, 3) + sp.atan(x) * sp.exp(-x) + sp.acos(x / 9) / x
        - sp.asin(x / 7) * sp.cos(x) ** 3 + sp.Abs(x - 2)
    )  # fmt: skip
    tape = Tape()
    node = tape.load(formula)
    points = np.array([0.3, 1.7, 5.5])
    found = evaluate_in_pairs(tape, tape.reach([node]), {tape.symbol(x): points})[node]
    with mp.workdps(60):
        for k, point in enumerate(points):
            true = mp.mpf(sp.N(formula.subs(x, sp.Rational(Fraction(point))), 50))
            assert abs(mp.mpf(float(found.high[k])) + mp.mpf(float(found.low[k])) - true) < 40 * UNIT * (1 + abs(true))


def test_complex_numbers_are_refused():
    x = sp.Symbol("x", real=True)
    tape = Tape()
    node = tape.load(sp.I * x)
    with pytest.raises(Unsupported):
        evaluate_in_pairs(tape, tape.reach([node]), {tape.symbol(x): np.ones(2)})
