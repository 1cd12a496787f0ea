"""Regions in which every loop can be contracted: shown of those, and never of one with a hole."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.contractible import is_sum_of_squares, loops_contract
from canon.decide.region import Region, Requirement
from canon.decide.tape import Tape

x, y, z, w = COORDINATES = sp.symbols("x y z w", real=True)
a = sp.Symbol("a", positive=True)
c = sp.Symbol("c", real=True)
u = sp.Symbol("u", nonnegative=True)
n = sp.Symbol("n", integer=True)
WHOLE = ("nonzero", x**2 + y**2)


def shown(*conditions: tuple, coordinates: tuple = COORDINATES, surface: tuple = ()) -> bool:
    tape = Tape()
    made = tuple(Requirement(kind, tuple(map(tape.load, nodes)), kind) for kind, *nodes in conditions)
    region = Region(made, tuple(map(tape.load, surface)), tuple(tape.symbol(s) for s in coordinates))
    return loops_contract(tape, region, [tape.symbol(s) for s in coordinates], Budget(20))


@pytest.mark.parametrize(
    "conditions",
    [
        (),
        (("positive", x),),
        (("nonzero", x),),
        (("nonzero", x), ("nonzero", y), ("positive", 1 - x), ("positive", x + y - z)),
        (("positive", x + y - z), ("positive", 1 - x - y + z), ("nonzero", 3 * x + 3 * y - 3 * z - 1)),
        (("positive", 1 + x**2 + y**2),),
        (("nonzero", x - y + a * z),),
        (("positive", y - x**2),),  # y alone is straightened
        (("nonzero", y - x**2),),
        (("nonzero", a * y - x * z),),
        (("positive", x), ("positive", x * y - z)),
        (("nonzero", x * y), ("positive", x**2 - 4)),
        (("uncut", y, x),),
        (("uncut", y - z**2, x + 3),),
        (("uncut", 2 * x + y, x + z),),
        (("uncut", y, 1 + x**2),),
        (("uncut", 1 + x**2, y),),
        (("nonzero", x**2 + y**2 + z**2),),  # codimension three
        (("nonzero", (x - 1) ** 2 + 2 * (2 * y + c) ** 2 + 3 * (z - w) ** 2),),
        (("positive", x**2 + y**2 + z**2),),
        (("nonzero", sp.sqrt(x**2 + y**2 + z**2)), ("positive", x)),
        (("positive", x), WHOLE),
        (("positive", x - 1), WHOLE),
        (("uncut", y, x), WHOLE),
        (("nonzero", y), WHOLE),
        (("uncut", y, -x - 1), WHOLE),
        (("nonzero", 1 + sp.I * x),),
        (("nonzero", x + sp.I * (x - 1)), ("nonzero", y)),
        (("nonzero", c**2 + a),),
        (("nonzero", c),),
        (("positive", x**2 - y**2 - a), ("positive", x), ("positive", y), ("positive", 1 - y), ("positive", 3 + a - x))[
            1:
        ],
    ],
    ids=str,
)
def test_every_loop_is_shown_to_contract(conditions: tuple):
    assert shown(*conditions)


@pytest.mark.parametrize(
    "conditions",
    [
        (WHOLE,),  # a plane without a point, times a plane
        (("positive", x**2 + y**2),),
        (("nonzero", x**2 + y**2), ("positive", x**2 + y**2)),
        (("nonzero", x**2 + y**2), ("nonzero", 2 * x**2 + 2 * y**2)),
        (("nonzero", x**2 + y**2), ("nonzero", z)),
        (("nonzero", x**2 + y**2), ("uncut", y - 1, x)),
        (("nonzero", x**2 + y**2), ("positive", 1 - x)),
        (("nonzero", x**2 + y**2), ("positive", x + 1)),
        (("nonzero", (x - y) ** 2 + (x + y) ** 2),),
        (("nonzero", (x - y) ** 2 + z**2),),
        (("nonzero", (x - y) ** 2 + (x - y) ** 4 + z**2),),
        (("nonzero", x**2 + (x - y) ** 2 + (x + y) ** 2),),  # three forms of two coordinates
        (("nonzero", x**2 + y**2 + c**2),),  # c may be 0
        (("nonzero", x**2 + y**2 + x**2 * z**2),),
        (("nonzero", x**2 * y**2 + z**2 + w**2),),  # x = 0 or y = 0: codimension three, but not by affine forms
        (("positive", x**2 + y**2 - 1),),
        (("positive", x**2 + y**2 + z**2 - 1), ("positive", 1 - z), ("positive", z + 1)),
        (("nonzero", x**2 + y**2 - 1),),
        (("uncut", x, y), ("uncut", x, -y)),
        (("uncut", x, y), ("uncut", y, x)),
        (("nonzero", x + sp.I * y),),  # two real equations
        (("nonzero", x + sp.I * y), ("nonzero", x - sp.I * y)),
        (("nonzero", x + sp.I * (y - z)),),
        (("nonzero", x - 1 + y * sp.I * x),),
        (("slit", x + sp.I * y),),
        (("nonzero", y - x**2), ("nonzero", y + x**2)),
        (("positive", y**2 - x**2 - z**2),),
        (("positive", z + x**2 + y**2 - 1), ("positive", z), ("positive", sp.Rational(1, 2) - z)),  # z isn't free
    ],
    ids=str,
)
def test_nothing_is_shown_of_a_region_that_may_have_a_hole(conditions: tuple):
    assert not shown(*conditions)


def test_what_is_not_looked_at():
    assert not shown(surface=(x**2 + y**2 - 1,))
    assert not shown(coordinates=(x, n))
    assert not shown(coordinates=(x, sp.Symbol("z")))
    assert shown(WHOLE, coordinates=(x, z))  # at fixed y
    below = ("positive", x**2 + y**2 - 1 - u)
    assert not shown(below, coordinates=(x, y, u))
    assert shown(("positive", x**2 + y**2 - 1 - z), coordinates=(x, y, z))


@pytest.mark.parametrize(
    ("f", "squares"),
    [
        (x**2 + y**2, True),
        (x**2 + 2 * (x - y) ** 4 + 3, True),
        (x**2 + y**2 - 1, False),
        (x**2 - y**2, False),
        (x**2 + y**3, False),
        (x**2 + y, False),
        (x**2 + y**-2, False),
        (x**2 + sp.I * y**2, False),
        (x**2, False),
        (x**2 * y**2 + z**2, True),
        (x**2 * y + z**2, False),
    ],
)
def test_sums_of_squares(f: sp.Expr, squares: bool):
    tape = Tape()
    assert is_sum_of_squares(tape, tape.load(f)) is squares
