"""A function that is called regular on a box is finite at the points of it, up to its edges."""

import random
from fractions import Fraction

import pytest
import sympy as sp
from flint import arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.intervals import Edge, Interval
from canon.decide.regular_on_box import is_regular
from canon.decide.tape import Tape
from canon.special import EllipticPi

x, m = sp.symbols("x m", real=True)
BOXES = [((0, 1), (0, 1)), ((-1, 1), (-3, Fraction(1, 2))), ((Fraction(1, 9), Fraction(11, 7)), (Fraction(1, 2), 2))]
CALLS = [  # a call, and on which of the boxes it is regular
    (sp.gamma(x), "ynY"), (sp.gamma(x + 1), "yyy"), (sp.LambertW(x), "yny"), (sp.elliptic_k(m), "yyn"),
    (sp.elliptic_e(m), "yyn"), (sp.elliptic_k(m - 1), "yyy"), (sp.elliptic_f(x, m), "yyn"),
    (sp.elliptic_e(x, m), "yyn"),
    (EllipticPi(x, m), "yyn"), (EllipticPi(m, x - 1), "yyn"), (EllipticPi(2 * x - 1, m), "yyn"),
    (EllipticPi(m + 1, m), "nnn"),
    (EllipticPi(x, m + 1), "nnn"), (EllipticPi(x - 1, x, m), "yyn"), (EllipticPi(m + 1, x, m), "nnn"),
    (sp.elliptic_f(x, 1), "yyn"), (sp.elliptic_e(2 * x, 1), "nnn"), (sp.elliptic_f(x / 2, 1), "yyy"),
    (sp.sin(x), "nnn"),
    (EllipticPi(1, x, m), "nnn"),
]  # fmt: skip


@pytest.mark.parametrize(("formula", "regular"), CALLS, ids=str)
def test_what_is_regular_has_values(formula: sp.Expr, regular: str):
    rng = random.Random(1)
    for (of_x, of_m), expected in zip(BOXES, regular, strict=True):
        tape = Tape()
        call = tape.load(formula)
        box = {tape.symbol(s): Interval(Edge(Fraction(a)), Edge(Fraction(b))) for s, (a, b) in ((x, of_x), (m, of_m))}
        found = is_regular(tape, call, box, Budget(10))
        assert found == (expected.lower() == "y")
        if not found:
            continue
        with precision(64):
            for _ in range(20):
                shares = [Fraction(rng.choice((1, 10**6 - 1, rng.randrange(1, 10**6))), 10**6) for _ in range(2)]
                ends = ((x, of_x), (m, of_m))
                place = {
                    tape.symbol(s): arb(rational(a + share * (b - a)))
                    for (s, (a, b)), share in zip(ends, shares, strict=True)
                }
                assert evaluate(tape, tape.reach([call]), place)[call].is_finite()


def test_what_is_not_regular_may_have_none():
    tape = Tape()
    call = tape.load(EllipticPi(m + 1, m))
    with pytest.raises(OutOfDomain):
        evaluate(tape, tape.reach([call]), {tape.symbol(m): arb(0.5)})
