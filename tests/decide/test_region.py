"""A point is admitted, and a condition holds, only where a ball leaves no doubt of it."""

from fractions import Fraction

import pytest
import sympy as sp
from flint import acb, arb

from canon.decide.region import Region, Requirement, admits, affine, bounds, holds
from canon.decide.sample import Sample, deeply_zero
from canon.decide.sampling import _evidence_of
from canon.decide.tape import Tape

x = sp.Symbol("x", real=True)
BALLS = {
    "one": arb(1), "minus one": arb(-1), "zero": arb(0), "half": arb(0.5), "about one": arb(1, 0.1),
    "about minus one": arb(-1, 0.1), "about zero": arb(0, 0.1),
    "i": acb(0, 1), "about i": acb(arb(0, 0.1), arb(1, 0.1)),
}  # fmt: skip
REAL = set(BALLS) - {"i", "about i"}
ADMITTED = {
    (): set(BALLS),
    ("real",): REAL,
    ("integer",): {"one", "minus one", "zero"},
    ("rational",): {"one", "minus one", "zero", "half"},
    ("positive",): {"one", "half", "about one"},
    ("negative",): {"minus one", "about minus one"},
    ("nonnegative",): {"one", "half", "about one", "zero"},
    ("nonpositive",): {"minus one", "about minus one", "zero"},
    ("real", "nonzero"): {"one", "half", "minus one", "about one", "about minus one"},
    ("integer", "positive"): {"one"},
    ("integer", "nonnegative"): {"one", "zero"},
}


@pytest.mark.parametrize(("facts", "names"), ADMITTED.items(), ids=[", ".join(facts) for facts in ADMITTED])
def test_what_is_admitted(facts, names):
    symbol = sp.Symbol("s", **dict.fromkeys(facts, True))
    assert {name for name, ball in BALLS.items() if admits(symbol, ball)} == names


def test_conditions_hold_where_balls_show_it():
    def held(kind: str, *nodes: int) -> set[str]:
        requirement = Requirement(kind, nodes, "")
        return {name for name, ball in BALLS.items() if holds(requirement, {0: ball, 1: arb(-1), 2: arb(1)})}

    assert held("positive", 0) == {"one", "half", "about one"}
    assert held("nonzero", 0) == set(BALLS) - {"zero", "about zero"}
    assert held("slit", 0) == set(BALLS) - {"zero", "about zero", "minus one", "about minus one"}
    assert held("uncut", 0, 1) == REAL - {"zero", "about zero"}
    assert held("uncut", 0, 2) == REAL


def test_bounds_contain_what_conditions_allow():
    tape = Tape()
    node = tape.symbol(x)
    conditions = [
        (x + 1, (-1.0, None)),
        (3 - 2 * x, (None, 1.5)),
        (sp.pi - x, (None, 3.141592653589793)),
        (x, (0.0, None)),
    ]
    for condition, (low, high) in conditions:
        region = Region((Requirement("positive", (tape.load(condition),), ""),), (), ())
        assert bounds(tape, region)[node] == (
            -float("inf") if low is None else low,
            float("inf") if high is None else high,
        )
    both = Region(tuple(Requirement("positive", (tape.load(c),), "") for c, _ in conditions), (), ())
    assert bounds(tape, both)[node] == (0.0, 1.5)
    assert affine(tape, tape.load(2 * x - sp.Rational(3, 2))) == (-1.5, Fraction(2), node)
    assert affine(tape, tape.load(x**2)) is affine(tape, tape.load(x + sp.Symbol("y", real=True))) is None


def test_evidence_is_the_residual_that_is_worst_for_its_ball():
    balls = [{0: arb(1e-9, 1e-6)}, {0: arb(3e-6, 2e-6)}, {0: arb(1e-5, 1e-4)}]
    evidence = _evidence_of([Sample({}, {}, {}, b) for b in balls], [0], 64)
    assert evidence is not None
    assert evidence.points == 3
    assert (evidence.max_residual, evidence.bound) == pytest.approx((3e-6, 2e-6), rel=1e-6)


def test_what_cannot_be_looked_at_deeply_is_no_evidence():
    tape = Tape()
    zero, log = tape.load(sp.sqrt(x**2) - sp.Abs(x)), tape.load(sp.log(x))
    tiny = tape.load(sp.sqrt(x**2) - sp.Abs(x) + sp.Rational(1, 10**150))
    for value, node, deep in ((-1, zero, True), (-1, log, False), (1, log, True), (2, log, False), (1, tiny, False)):
        point = Sample({tape.symbol(x): Fraction(value)}, {}, {}, {node: arb(0, 1)})
        assert deeply_zero(tape, node, [point]) == deep
