"""Fractions and grouped sums have the values of what they were made from, and agree on what is 0.

Formulas are drawn by chance over a field with relations of several degrees. A point of it is known in floating point
numbers: x, y and the real roots that its generators stand for.
"""

import math
import random
from fractions import Fraction

import pytest

from canon.budget import Budget
from canon.decide.fraction_field import Element, FractionField
from canon.decide.grouped_sums import Grouped, GroupedSums
from canon.decide.ring import Ring

X, Y = 0.731, 1.377
R, S, T = math.hypot(1, X), math.sqrt(X + Y), X ** (1 / 3)
POINT = (X, Y, R, S, T, math.cos(Y), math.sin(Y), math.sqrt(R + Y))
"""x, y; r² = 1 + x², s² = x + y, t³ = x; a cosine and a sine; q² = r + y."""


def field() -> FractionField:
    ring = Ring(len(POINT), 2e7, Budget(60))
    x, y, r, _, _, c, _, _ = ring.generators
    made = FractionField(ring)
    for generator, degree, lower in ((2, 2, x**2 + 1), (3, 2, x + y), (4, 3, x), (6, 2, 1 - c**2), (7, 2, r + y)):
        made.relate(generator, degree, ring.one * lower)
    return made


Both = tuple[Element, Grouped, float]


class Formulas:
    """Random formulas, each as a fraction, as a grouped sum and as a number."""

    def __init__(self, seed: int) -> None:
        self.rng, self.field = random.Random(seed), field()
        self.sums = GroupedSums(self.field)
        self.pool: list[Both] = [self.generator(k) for k in range(len(POINT))]

    def generator(self, k: int) -> Both:
        element = self.field.generator(k)
        return element, self.sums.lift(element), POINT[k]

    def combined(self, terms: list[tuple[Fraction, Both]], constant: Fraction) -> Both:
        return (
            self.field.combine([(c, x[0]) for c, x in terms], constant),
            self.sums.combine([(c, x[1]) for c, x in terms], constant),
            float(constant) + sum(float(c) * x[2] for c, x in terms),
        )

    def product(self, factors: list[Both]) -> Both:
        return (
            self.field.product([x[0] for x in factors]),
            self.sums.product([x[1] for x in factors]),
            math.prod(x[2] for x in factors),
        )

    def power(self, x: Both, e: int) -> Both:
        return self.field.power(x[0], e), self.sums.power(x[1], e), x[2] ** e

    def grown(self) -> Both:
        rng = self.rng
        kind = rng.random()
        if kind < 0.5:
            terms = [(Fraction(rng.randint(-3, 3), rng.choice((1, 2, 3))), x) for x in self.some(rng.randint(2, 3))]
            return self.combined(terms, Fraction(rng.choice((0, 0, 1, -1, 3)), 2))
        if kind < 0.75:
            return self.product(self.some(rng.randint(2, 3)))
        x = self.some(1)[0]
        return self.power(x, rng.choice((2, 3, -1, -1, -2) if abs(x[2]) > 0.05 else (2, 3, 0)))

    def some(self, count: int) -> list[Both]:
        return [self.rng.choice(self.pool) for _ in range(count)]

    def value(self, x: Element) -> float:
        below = math.prod(self.number(self.field.factors[k]) ** e for k, e in x[1].items())
        return self.number(x[0]) / below

    def number(self, p) -> float:
        terms = self.field.ring.terms(p).items()
        return sum(float(c) * math.prod(v**e for v, e in zip(POINT, m, strict=True)) for m, c in terms)


@pytest.mark.parametrize("seed", range(12))
def test_values_are_those_of_the_formula(seed: int):
    formulas = Formulas(seed)
    for _ in range(10):
        element, grouped, value = formulas.grown()
        if not 1e-3 < abs(value) < 1e3 or len(element[0]) > 60:
            continue
        formulas.pool.append((element, grouped, value))
        close = {"rel": 1e-6, "abs": 1e-6}
        assert formulas.value(element) == pytest.approx(value, **close)
        assert formulas.value(formulas.sums.collapse(grouped)) == pytest.approx(value, **close)
        assert not formulas.field.is_zero(element)
        assert not formulas.sums.is_zero(grouped)


@pytest.mark.parametrize("seed", range(12))
def test_what_is_zero_is_seen_and_what_is_nearly_zero_is_not_taken_for_it(seed: int):
    formulas = Formulas(seed)
    one = Fraction(1)
    for _ in range(6):
        formulas.pool.append(formulas.grown())
        formulas.pool = [x for x in formulas.pool if 1e-3 < abs(x[2]) < 1e3 and len(x[0][0]) < 40]
    a, b, c = formulas.some(3)
    together = formulas.product([formulas.combined([(one, a), (Fraction(2, 3), b)], Fraction(0)), c])
    parts = [formulas.product([a, c]), formulas.product([b, c])]
    inverse = formulas.power(formulas.product([a, b]), -1)
    others = [formulas.power(a, -1), formulas.power(b, -1)]
    assert formulas.sums.node(("n", Fraction(3)), {}) == formulas.sums.lift(formulas.field.constant(3))
    assert formulas.sums.node(("n", Fraction(0)), {}) == {}
    assert formulas.sums.power(a[1], 0) == formulas.sums.lift(formulas.field.constant(1))
    powers = formulas.product([formulas.power(c, 5), formulas.power(c, -3), formulas.power(c, -2)])
    for slight in (0, Fraction(1, 1000)):
        assert not slight or abs(parts[1][2]) > 0
        difference = formulas.combined(
            [(one, together), (-one, parts[0]), (-Fraction(2, 3) + slight, parts[1])], Fraction(0)
        )
        ratio = formulas.combined([(one + slight, inverse), (-one, formulas.product(others))], Fraction(0))
        unit = formulas.combined([(one, powers)], -one + slight)
        for element, grouped, _ in (difference, ratio, unit):
            assert formulas.field.is_zero(element) == (not slight)
            assert formulas.sums.is_zero(grouped) == (not slight)


def test_a_sum_that_vanishes_by_parity_alone():
    """1/r and 1/s stay apart: (x + y)/s − s and r/(1 + x²) − 1/r are 0, each in a class of its own."""
    formulas = Formulas(0)
    one, (x, y, r, s) = Fraction(1), formulas.pool[:4]
    below = formulas.power(formulas.combined([(one, formulas.power(x, 2))], one), -1)
    for wrong in (0, Fraction(1, 1000)):
        total = formulas.combined(
            [
                (one, formulas.product([formulas.combined([(one, x), (one, y)], wrong * one), formulas.power(s, -1)])),
                (-one, s),
                (one, formulas.product([r, below])),
                (-one, formulas.power(r, -1)),
            ],
            Fraction(0),
        )
        assert formulas.sums.is_zero(total[1]) == (not wrong)
