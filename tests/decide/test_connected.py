"""Parts of boxes that inequalities cut out: which are shown to be connected, and what is proved on them."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide.connected import is_connected
from canon.decide.intervals import Edge, Interval
from canon.decide.tape import Tape

x, y = sp.symbols("x y", real=True)


@pytest.mark.parametrize(
    ("conditions", "x_ends", "y_ends", "expected"),
    [
        ([1 - x * y], (0, None), (0, None), True),
        ([1 - x**2 - y**2], (0, None), (0, None), True),
        ([1 - x**2 - y**2, 2 - x**2 - 3 * y**2], (0, None), (0, None), True),
        ([(x - 1) ** 2 - y - sp.Rational(1, 10)], (0, 2), (0, 1), False),
        ([x**2 + y**2 - 1], (None, None), (None, None), False),
        ([x * y - 1], (None, None), (None, None), False),
        ([x * y - 1], (0, None), (0, 3), True),
        ([x + 1 / y], (None, 0), (None, None), False),
        ([1 - 1 / y], (None, None), (None, None), False),
        ([x - 1 / y], (0, 1), (None, 2), False),
        ([1 - x**2 - y, y - sp.Rational(1, 2) + x], (0, None), (0, None), False),
    ],
)
def test_connected(conditions, x_ends, y_ends, expected):
    tape = Tape()
    box = {}
    for symbol, ends in ((x, x_ends), (y, y_ends)):
        box[tape.symbol(symbol)] = Interval(*(None if end is None else Edge(Fraction(end)) for end in ends))
    assert is_connected(tape, [tape.load(c) for c in conditions], box, Budget(10)) is expected


@pytest.mark.parametrize(
    ("where", "left", "right", "expected"),
    [
        ("x>0; y>0; x*y<1", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))", "proved"),
        ("x*y<1", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))", "proved"),
        ("x*y<1", "atan(x)+atan(y)", "1001/1000*atan((x+y)/(1-x*y))", "refuted"),
        ("x>0; y>0; x*y<2", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))", "refuted"),
        ("x*y>1", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))+pi", "refuted"),
        ("x**2+y**2<1", "asin(x/sqrt(1-y**2))", "atan2(x, sqrt(1-x**2-y**2))", "proved"),
        ("x**2+y**2<1", "asin(x/sqrt(1-y**2))", "atan2(x, -sqrt(1-x**2-y**2))", "refuted"),
    ],
)
def test_identities_where_an_inequality_is_not_affine(where, left, right, expected):
    text = f'[phase_space]\nq = ["x"]\np = ["y"]\n[domain]\nwhere = {where.split("; ")!r}\n'
    text += f'[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'
    (claim,) = read_text(text).claims
    assert verify(claim, budget=20.0).status == expected
