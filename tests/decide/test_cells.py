"""Cells cover the region, one over each point off the cuts; of those that are called connected the box lies inside.

Signs on intervals are those of the values, wherever one is named.
"""

import itertools
import random
from fractions import Fraction
from itertools import product

import pytest
import sympy as sp
from flint import acb, arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.cells import cells_of, parts_of_slit, univariate
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.intervals import Edge, Interval
from canon.decide.region import Region, Requirement, holds
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Tape

x, y = sp.symbols("x y", real=True)
a = sp.Symbol("a", positive=True)
d = sp.Symbol("d", nonpositive=True)
pi, I = sp.pi, sp.I  # noqa: E741
# off every cut, which are at rational numbers of small denominators and at multiples of π
PLACES = [Fraction(n, 13) + Fraction(1, 1000) for n in (-71, -38, -22, -15, -8, -3, 2, 7, 12, 16, 19, 30, 55, 90)]

REGIONS = [
    ((("positive", x), ("nonzero", y - 2)), True),
    ((("positive", 4 - x), ("positive", x + 1), ("nonzero", x * (x - 1))), True),
    ((("positive", (x - 1) * (x + 2)),), True),
    ((("positive", x**2 - 4), ("nonzero", 2 * y + 1)), True),
    ((("positive", x**3 - 6 * x**2 + 11 * x - 6),), True),
    ((("positive", 1 + x**2),), True),
    ((("nonzero", x - y),), False),
    ((("positive", x * y),), True),
    ((("positive", x * y - 1), ("positive", x)), False),
    ((("positive", x - pi / 2), ("positive", 2 * pi - x), ("nonzero", sp.sin(x))), False),
    ((("positive", x), ("positive", pi - x), ("nonzero", sp.sin(x)), ("nonzero", y)), True),
    ((("positive", 3 * pi - 2 * x), ("nonzero", x - pi / 3)), True),
    ((("uncut", y, x),), True),
    ((("uncut", y - 1, 1 + x**2),), True),
    ((("uncut", x * y, x),), True),
    ((("nonzero", a - 1), ("positive", d + 5)), True),
    ((("slit", x + I * y),), True),
    ((("slit", x + I * (1 + y**2)),), True),
    ((("slit", x * y + I * (x - y)),), False),
    ((("uncut", x - y, x + y),), False),
    ((("slit", sp.exp(I * x)), ("positive", 4 - x), ("positive", x + 5)), True),
    ((("slit", sp.exp(2 * I * x)), ("positive", 2 - x), ("positive", x + 3)), True),
    ((("slit", sp.exp(2 * I * x + I)), ("positive", 2 - x), ("positive", x + 3)), False),
]


def region_of(tape: Tape, conditions: tuple) -> Region:
    return Region(tuple(Requirement(kind, tuple(map(tape.load, f)), "") for kind, *f in conditions), (), ())


def inside(tape: Tape, region: Region, place: dict) -> bool:
    with precision(128):
        try:
            balls = evaluate(tape, tape.reach(region.nodes()), {n: arb(rational(v)) for n, v in place.items()})
        except OutOfDomain:
            return False
        return all(holds(requirement, balls) for requirement in region.requirements)


def between(interval: Interval, value: Fraction) -> bool:
    low = interval.low is None or interval.low.compare(Edge(value)) < 0
    return low and (interval.high is None or interval.high.compare(Edge(value)) > 0)


@pytest.mark.parametrize("finer", [False, True])
@pytest.mark.parametrize(("conditions", "boxes"), REGIONS, ids=str)
def test_cells_cover_the_region(conditions: tuple, boxes: bool, finer: bool):
    tape = Tape()
    region = region_of(tape, conditions)
    names = sorted(set().union(*(tape.symbols_of(n) for n in region.nodes())), key=str)
    cells = cells_of(tape, region, [tape.symbol(s) for s in names], Budget(20), finer=finer)
    assert cells is not None
    assert not boxes or all(cell.connected for cell in cells)
    met = 0
    for values in product(PLACES, repeat=len(names)):
        if any((v < 0 and s.is_positive) or (v > 0 and s.is_nonpositive) for v, s in zip(values, names, strict=True)):
            continue
        place = {tape.symbol(s): v for s, v in zip(names, values, strict=True)}
        over = [c for c in cells if all(between(c.intervals[n], v) for n, v in place.items())]
        assert len(over) <= 1
        if inside(tape, region, place):
            met += 1
            assert len(over) == 1
            assert inside(tape, over[0].region, place)
        elif boxes and not finer:
            assert not over
        elif over and not finer:
            assert not over[0].connected
    assert met
    assert all("<" in cell.describe(tape) or cell.describe(tape) == "everywhere" for cell in cells)


def test_what_is_not_cut():
    tape = Tape()
    names = [tape.symbol(x)]
    assert cells_of(tape, Region((), (tape.load(x**2 + y**2 - 1),), ()), names, Budget(20)) is None
    assert cells_of(tape, Region((), (), ()), [tape.load(sp.Symbol("z"))], Budget(20)) is None
    assert cells_of(tape, Region((), (), ()), [tape.load(sp.Symbol("n", integer=True))], Budget(20)) is None
    many = region_of(tape, tuple(("nonzero", x - k) for k in range(48)))
    assert cells_of(tape, many, names, Budget(20)) is None  # 49 of them
    assert len(cells_of(tape, region_of(tape, (("nonzero", x), ("nonzero", 2 * x))), names, Budget(20)) or ()) == 2
    (whole,) = cells_of(tape, Region((), (), ()), names, Budget(20)) or ()
    assert whole.connected


@pytest.mark.parametrize("f", [x + I * y, (x - I * y) ** 2, sp.exp(I * x) * (y + 2 * I), 1 / (x + I)], ids=str)
def test_the_parts_of_a_complex_number(f: sp.Expr):
    tape = Tape()
    node = tape.load(f)
    parts = parts_of_slit(tape, Requirement("slit", (node,), ""))
    for place in ((Fraction(2, 3), Fraction(-5, 7)), (Fraction(-3), Fraction(1, 9))):
        with precision(128):
            at = {tape.symbol(s): arb(rational(v)) for s, v in zip((x, y), place, strict=True)}
            balls = evaluate(tape, tape.reach([node, *parts]), at)
            assert (acb(balls[parts[1]]) + acb(0, 1) * balls[parts[0]] - balls[node]).contains(0)


def test_polynomials_in_one_symbol():
    tape = Tape()
    name = tape.symbol(x)
    p = univariate(tape, tape.load((2 * x - 3) ** 3 * x**2 / 5 + x / 7 - 4), name)
    assert p is not None
    for value in (Fraction(0), Fraction(5, 3), Fraction(-2)):
        expected = (2 * value - 3) ** 3 * value**2 / 5 + value / 7 - 4
        assert p(rational(value)) == rational(expected)
    assert all(univariate(tape, tape.load(f), name) is None for f in (1 / x, sp.sin(x), x * y, x + pi))


BOX = {
    x: [(None, None), (-2, 3), (0, None), (None, -1), (1, Fraction(3, 2)), (Fraction(-1, 2), 0)],
    y: [(None, None), (-1, 1), (2, 5), (None, 0)],
}
FORMS = [
    x, x - 3, 2 * x + 1, pi - x, 3 * x - pi, x - y, x + 2 * y + 7, x * y, x * y - 1, x * y + 3, x**2 + x * y + 1,
    x**2 - 2, x**2 + 1, x**3 - 2 * x - 5, x**2 - x - 6, (x - 1) ** 2 * (y + 2), x**2 * y - 4 * y, x**4 - 5 * x + 9,
    x - pi * y, 6 + x - x**2, x**2 - 2 * x * y + y**2 + 1, x**5 + y - 40, (2 + x) * (3 - x) * (y + 1), a + x, a * x - 1,
    d - 1 - x**2, 1 + sp.sin(x), sp.exp(x) - 1, 2 - sp.cos(y), sp.exp(y) + x**2, sp.cos(x / 2), sp.sin(x + 1),
    x**8 + y**8 + 1,
]  # fmt: skip


@pytest.mark.parametrize("f", FORMS, ids=str)
def test_the_sign_on_a_box_is_that_of_the_values(f: sp.Expr):
    rng = random.Random(7)
    for ends_x, ends_y in product(BOX[x], BOX[y]):
        tape = Tape()
        node, box = tape.load(f), {}
        for name, ends in ((x, ends_x), (y, ends_y)):
            box[tape.symbol(name)] = Interval(*(None if e is None else Edge(Fraction(e)) for e in ends))
        sign = definite_sign(tape, node, box, Budget(20))
        seen = set()
        for _ in range(8):
            values = [_between(rng, *ends) for ends in (ends_x, ends_y)]
            at = {tape.symbol(s): v for s, v in zip((x, y), values, strict=True)}
            at |= {tape.symbol(a): _between(rng, 0, None), tape.symbol(d): _between(rng, None, 0)}
            with precision(256):
                ball = evaluate(tape, tape.reach([node]), {n: arb(rational(v)) for n, v in at.items()})[node]
                seen.add("pos" if ball > 0 else "neg" if ball < 0 else "?")
        assert sign is None or seen == {sign}
        if f in (x, x - 3, 2 * x + 1) or (f in (x**2 - 2, x**3 - 2 * x - 5, x**2 - x - 6) and ends_y == (None, None)):
            assert (sign is not None) is (len(_sides(f, ends_x)) == 1)


def _between(rng: random.Random, low: Fraction | int | None, high: Fraction | int | None) -> Fraction:
    """A number between them, often close to one of them."""
    t = Fraction(rng.choice((1, 10**3, 10**9, 3 * 10**9, 10**10 - 7)), 10**10)
    if low is not None and high is not None:
        return low + t * (Fraction(high) - low)
    away = t * rng.choice((1, 100))
    return low + away if low is not None else high - away if high is not None else away * rng.choice((1, -1))


def _sides(f: sp.Expr, ends: tuple) -> set[bool]:
    """The signs that a polynomial in x has between these ends."""
    low, high = -1000 if ends[0] is None else ends[0], 1000 if ends[1] is None else ends[1]
    edges = [low, *sorted(r for r in sp.real_roots(f, x) if low < r < high), high]
    return {bool(f.subs(x, (u + v) / 2) > 0) for u, v in itertools.pairwise(edges)}
