"""What true rules make of random formulas is never refuted, nor what spoils them proved: a short run of both."""

import random
from fractions import Fraction

import pytest

from properties.rewriting_rules import RULES, SPECIAL, TURNS, x, y
from properties.rewritten import asked, at_witness, in_a_file, in_python, made, wrong
from properties.soundness import oracle
from properties.soundness.identities import Equation

UNIT = (Fraction(0), Fraction(1))
BOX: oracle.Box = dict.fromkeys(("x", "y", "a", "m"), UNIT)


@pytest.mark.parametrize("family", sorted(RULES))
def test_rules_hold_wherever_both_sides_are_defined(family):
    """By mpmath at many points: on the rules everything rests."""
    for name, rule in RULES[family].items():
        for inner in ((x, y), (x * 3 + 1, y - 2), (-x, x * y + 1), (x + 1, y / 2)):
            lhs, rhs = rule(*inner)
            point, _ = oracle.differs(
                random.Random(name), lhs, rhs, ["x", "y", "a", "n", "m"], BOX, count=8, integers=("n",)
            )
            assert point is None, (family, name, point)


@pytest.mark.parametrize(
    "seeds",
    [range(50_000_000, 50_000_012), pytest.param(range(50_000_012, 50_000_040), marks=pytest.mark.slow)],
    ids=["twelve", "twenty-eight"],
)
def test_no_verdict_of_a_few_is_wrong_and_most_are_decided(seeds):
    cases = (asked(seed) for seed in seeds)
    counts = [found for found in cases if found is not None]
    assert not [found for found in counts if any("wrong" in said or "crash" in said for said in found)]
    decided = [said.endswith(("proved", "refuted")) for found in counts for said in found]
    assert sum(decided) > 0.8 * len(decided)


def test_cases_are_true_and_false():
    truths = [found.truth for seed in range(60) if (found := made(seed)) is not None]
    assert {True, False} <= {*truths}


def test_a_wrong_verdict_would_be_noticed():
    case = next(found for seed in range(60) if (found := made(seed)) is not None and found.truth is False)
    assert wrong(case, "proved", None, python=False) == "wrong proof"
    case = next(found for seed in range(60) if (found := made(seed)) is not None and found.truth is True)
    assert wrong(case, "refuted", None, python=True) == "wrong refutation"
    patient = 60.0  # a machine with much else to do takes longer
    assert {in_a_file(case, 1, patient)[0], in_python(case, 1, patient)[0]} == {"proved"}


def test_a_witness_out_of_what_was_written_is_not_judged():
    case = made(40011113)
    assert case is not None
    assert wrong(case, "refuted", {"x": "-9/2", "y": "-6/13"}, python=True) == ""
    assert wrong(case, "refuted", {"x": "-9/2", "y": "-6/13"}, python=False) == "wrong witness: outside"


def test_a_witness_is_evaluated():
    lhs, rhs = TURNS["tangent by an eighth"](x, y)
    equation = Equation(lhs, rhs, {}, {"x": (Fraction(0), None)})
    assert at_witness(equation, {"x": "1/3", "n": "2"}) == "equal"
    assert at_witness(equation, {"x": "-1/3", "n": "2"}) == "outside"
    assert at_witness(Equation(lhs, rhs * 2, {}, {}), {"x": "1/3", "n": "2"}) == "differs"
    doubled, _ = SPECIAL["Jacobi's sine doubled"](x, y)
    assert at_witness(Equation(doubled, doubled + x, {}, {}), {"x": "1/3", "m": "1/2"}) == "differs"
