"""Integrals round loops are those that Stokes' theorem gives; a loop that is called inside lies there."""

import math
import random
from fractions import Fraction

import pytest
import sympy as sp
from flint import arb

from canon.budget import Budget
from canon.decide.enclosure import evaluate, precision
from canon.decide.loops import Ellipse, _inside, circulation, integral
from canon.decide.region import Region, Requirement
from canon.decide.sample import Sample
from canon.decide.tape import Tape

x, y, z = sp.symbols("x y z", real=True)
NAMES = (x, y, z)
POTENTIALS = [
    x**2 * y - y**3, sp.exp(x) * sp.sin(y), sp.sqrt(9 + x * y), sp.log(20 + x**2 * y) * z, sp.Abs(x + 9) * y,
    sp.atan(x * y), x * sp.Function("V")(y),
]  # fmt: skip
LOOPS = [  # centre, first, second, and whether it goes round the origin
    ((0, 0), (1, 0), (0, 1), True),
    ((Fraction(1, 3), Fraction(-1, 2)), (Fraction(3, 2), Fraction(1, 4)), (Fraction(-1, 3), Fraction(4, 3)), True),
    ((2, 1), (1, 0), (0, Fraction(1, 2)), False),
]


def loop(tape: Tape, centre, first, second) -> Ellipse:
    plane = (tape.symbol(x), tape.symbol(y))
    place = Sample({tape.symbol(n): Fraction(1, 7) for n in NAMES}, {}, {"V": _square()}, {})
    vectors = [tuple(map(Fraction, v)) for v in (centre, first, second)]
    return Ellipse(place, plane, *vectors)


def _square():
    from canon.decide.arbitrary import choose_functions

    tape = Tape()
    node = tape.load(sp.Function("V")(y))
    return choose_functions(tape, tape.reach([node]), random.Random(1))["V"]


def form(tape: Tape, dx, dy) -> dict:
    return {tape.symbol(x): tape.load(dx), tape.symbol(y): tape.load(dy)}


@pytest.mark.parametrize(("centre", "first", "second", "round_origin"), LOOPS)
def test_integrals_round_a_loop(centre, first, second, round_origin):
    tape = Tape()
    way = loop(tape, centre, first, second)
    area = math.pi * float(first[0] * Fraction(second[1]) - first[1] * Fraction(second[0]))
    r = x**2 + y**2
    known = [(-y, x, 2 * area), (x * 0 + 5, 3 * x - 1, 3 * area), (-y / r, x / r, 2 * math.pi * round_origin)]
    for dx, dy, expected in known:
        found = integral(tape, form(tape, dx, dy), way)
        assert found is not None
        assert abs(found - arb(expected)) < 1e-9
        assert found.rad() < 1e-6
    for potential in POTENTIALS:
        found = integral(tape, form(tape, potential.diff(x).doit(), potential.diff(y).doit()), way)
        assert found is not None, potential
        assert abs(found) < 1e-6, potential
    with precision(64):
        at = way.point(arb(Fraction(3, 5).numerator) / 5, arb(4) / 5)
    wanted = [
        c + Fraction(3, 5) * a + Fraction(4, 5) * b for c, a, b in zip(way.centre, way.first, way.second, strict=True)
    ]
    assert all(abs(at[n] - arb(float(v))) < 1e-12 for n, v in zip(way.plane, wanted, strict=True))
    table = way.describe(tape)
    assert table.keys() == {"x", "y", "z", "V"}
    shown = [sp.sympify(table[n], locals={"s": sp.atan2(4, 3)}) for n in "xy"]
    assert shown == [sp.Rational(v.numerator, v.denominator) for v in wanted]


def test_a_modulus_of_complex_numbers_is_not_integrated():
    """It isn't analytic, as the enclosure's error needs it."""
    tape = Tape()
    way = loop(tape, *LOOPS[0][:3])
    name = sp.Symbol("w")
    place = Sample({**way.place.point, tape.symbol(name): (Fraction(5), Fraction(1))}, {}, {}, {})
    slopes = form(tape, x**0 * 0, sp.Abs(name + x))
    assert integral(tape, slopes, Ellipse(place, way.plane, way.centre, way.first, way.second)) is None


CONDITIONS = [
    ((x - 1) ** 2 + y**2 - sp.Rational(1, 100),),
    (sp.Rational(199, 200) - x,),
    (x**2 + y**2 - sp.Rational(1, 4),),
    (x + sp.Rational(6, 5), 4 - x),
    (9 - x**2 - y**2, y + sp.Rational(11, 10)),
]


@pytest.mark.parametrize("conditions", CONDITIONS, ids=str)
def test_a_loop_is_inside_where_its_points_are(conditions):
    for centre, first, second, _ in LOOPS:
        tape = Tape()
        way = loop(tape, centre, first, second)
        nodes = [tape.load(c) for c in conditions]
        region = Region(tuple(Requirement("positive", (n,), "") for n in nodes), (), ())
        values = []
        for k in range(120):
            s = 2 * math.pi * k / 120
            balls = evaluate(tape, tape.reach(nodes), way.point(arb(math.cos(s)), arb(math.sin(s))), {})
            values.append(min(float(balls[n].mid()) for n in nodes))
        assert abs(min(values)) > 1e-3
        assert _inside(tape, way, region, Budget(20)) == (min(values) > 0)


@pytest.mark.parametrize("slight", [0, sp.Rational(1, 1000)])
def test_a_form_that_is_closed_and_not_exact(slight):
    """1/1000 of the angle's differential beside an exact form, where x² + y² isn't 0."""
    tape = Tape()
    r = x**2 + y**2
    potential = x * y**2 + sp.log(r)
    slopes = form(tape, potential.diff(x) - slight * y / r, potential.diff(y) + slight * x / r)
    region = Region((Requirement("positive", (tape.load(r),), ""),), (), ())
    found = circulation(tape, slopes, region, random.Random(1), Budget(20), most=12)
    assert (found is not None) == bool(slight)
    if found is not None:
        assert abs(abs(found.value) - arb(2) * arb.pi() / 1000) < 1e-6
