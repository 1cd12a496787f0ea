"""Bases over Q: every element is the combination that is named, and the chosen ones are independent."""

import random
from fractions import Fraction

import pytest
import sympy as sp

from canon.decide.fraction_field import Element
from canon.decide.linear import divided_basis, rational_basis
from canon.decide.tape import Tape, Unsupported
from canon.decide.tower import Tower
from properties.towers import tower_of

x, y = sp.symbols("x y", real=True)


@pytest.fixture(scope="module")
def tower() -> Tower:
    tape = Tape()
    return tower_of(tape, tape.load(sp.sqrt(1 + x**2) * y), [])


def elements(tower: Tower, rng: random.Random, count: int) -> list[Element]:
    """Random combinations of a few elements with several denominators."""
    field = tower.field
    a, b, c = (field.generator(k) for k in range(3))
    basis = [
        a,
        b,
        field.product([a, field.power(b, -1)]),
        field.product([c, field.power(b, -2)]),
        field.product([a, b]),
    ]
    return [
        field.combine([(Fraction(rng.randint(-4, 4) or 1, rng.choice((1, 2, 3))), rng.choice(basis)) for _ in range(2)])
        for _ in range(count)
    ]


@pytest.mark.parametrize("seed", range(12))
def test_each_element_is_its_combination(tower: Tower, seed: int):
    rng, field = random.Random(seed), tower.field
    old: list[Element] = []
    for x in elements(tower, rng, 2):
        if rational_basis(tower, old, [x])[1]:
            old.append(x)
    new = [x for x in elements(tower, rng, 4) if x[0]]
    combinations, chosen = rational_basis(tower, old, new)
    both = [*old, *new]
    for x, combination in zip(new, combinations, strict=True):
        assert field.equal(x, field.combine([(q, both[k]) for k, q in combination.items()]))
        assert all(k < len(old) or k in chosen for k in combination)
    kept = [*old, *(both[k] for k in chosen)]
    assert len(rational_basis(tower, [], kept)[1]) == len(kept), "the chosen ones and the old are independent"
    combinations, parts = divided_basis(tower, old, new, 10**6)
    assert parts.keys() == set(chosen)
    assert all((q * parts[k]).denominator == 1 for c in combinations for k, q in c.items() if k in parts)


def test_multiples_that_are_too_high_are_refused(tower: Tower):
    field = tower.field
    a = field.generator(0)
    many = field.combine([(Fraction(400), a)])
    assert divided_basis(tower, [a], [many], 400)[0] == [{0: Fraction(400)}]
    for most, factor in ((399, 400), (400, Fraction(1601, 4))):
        with pytest.raises(Unsupported):
            divided_basis(tower, [a], [field.combine([(Fraction(factor), a)])], most)
    with pytest.raises(Unsupported):
        divided_basis(tower, [], [a, field.combine([(Fraction(1, 401), a)])], 400)
