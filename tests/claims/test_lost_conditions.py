"""A certificate speaks of the claim that was made, with its domain: what doesn't show in a formula is written out."""

import json

import pytest
import sympy as sp

from canon import Condition, Formula, InputError, PhaseSpace, Transformation, compose, identity, proof
from canon.checker.check import check

SPACE = PhaseSpace("q", "p", new=("Q", "P"), positive="m", complex="z")
q, p, Q, P, m = SPACE.symbols("q p Q P m")


def refusal(claim):
    with pytest.raises(InputError) as caught:
        proof(claim)
    return str(caught.value)


@pytest.mark.parametrize("text", ["sqrt(q)**2", "exp(log(q))", "q*sqrt(q)/sqrt(q)"])
def test_the_conditions_of_a_text_are_in_its_certificate(text):
    """|q| = q is claimed where q > 0 alone, which sympy's q doesn't show."""
    found = proof(identity(SPACE, sp.Abs(q), SPACE.formula(text)))
    assert found.verdict.status == "proved"
    assert found.tables["claim"]["rhs"] == text
    assert check(json.loads(json.dumps(found.certificate))).status in ("confirmed", "confirmed in part")


def test_a_condition_that_nobody_could_read_again_is_told():
    positive = Formula(q, (Condition("positive", (q,)),))
    assert "the condition q > 0 doesn't come back" in refusal(identity(SPACE, sp.Abs(q), positive))
    assert proof(identity(SPACE.where(q > 0), sp.Abs(q), positive)).certificate
    root = Transformation(SPACE, Q=sp.sqrt(q), P=2 * sp.sqrt(q) * p)
    square = Transformation(PhaseSpace("Q", "P", new=("X", "Y")), Q=Q**2, P=P / (2 * Q))
    assert "q > 0 doesn't come back" in refusal(compose(root, square).bracket_invariance(sp.Symbol("X", real=True), 1))


def test_a_domain_comes_back_with_its_own_names():
    below = PhaseSpace("q", "p", real=[sp.Symbol("c", nonpositive=True)])
    (c,) = below.parameters
    assert "doesn't come back" in refusal(identity(below.where(q + c > 0), sp.Abs(q), q))
    called = PhaseSpace("q", "p", real="pi")
    assert "doesn't come back" in refusal(identity(called.where(q > sp.pi), sp.Abs(q), q))
    assert proof(identity(called.where(q > called.symbol("pi") ** 2), sp.Abs(q), q)).certificate
    waves = PhaseSpace("q", "p", functions="sin")
    assert "doesn't come back" in refusal(identity(waves.where(sp.sin(q) > 0), q * p, p * q))


def test_conditions_that_say_the_same_are_the_same():
    for claim in (
        identity(SPACE.where(2 * q > 0), sp.Abs(q), q),
        identity(SPACE.where(sp.Ne(-3 * q, 0)), q / q, 1),
        identity(SPACE, SPACE.formula("p/(2*q)"), p / (2 * q)),
        identity(SPACE, sp.log(q**2) / (m * q), sp.log(q**2) / (q * m)),
    ):
        assert proof(claim).certificate
