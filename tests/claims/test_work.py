"""What deciding a claim does, counted and not timed: a claim does only what it needs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import sympy as sp
from sympy.printing.str import StrPrinter

from canon import PhaseSpace, Transformation, bracket, conserved, verify
from canon.budget import Budget
from canon.claims import scale
from canon.claims.kinds import kind_named
from canon.claims.question import FIRST_BATCH, Question
from canon.decide import ladder, modular
from canon.decide.tower import Tower

N = 5
SPACE = PhaseSpace(
    [f"q{k}" for k in range(N)],
    [f"p{k}" for k in range(N)],
    new=([f"Q{k}" for k in range(N)], [f"P{k}" for k in range(N)]),
)


def rotation(error: sp.Expr = sp.S.Zero) -> Transformation:
    """Every pair turned by an angle that depends on the pair's radius; the first momentum is off by `error`."""
    Q, P = [], []
    for q, p in zip(SPACE.q, SPACE.p, strict=True):
        angle = q**2 + p**2
        Q.append(q * sp.cos(angle) + p * sp.sin(angle))
        P.append(p * sp.cos(angle) - q * sp.sin(angle))
    P[0] = P[0] * (1 + error)
    return Transformation(SPACE, Q=Q, P=P)


class Count:
    """Counts the calls of a function and lets them through."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function, self.calls = function, 0

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        self.calls += 1
        return self.function(*arguments, **keywords)


@pytest.fixture
def towers(monkeypatch: pytest.MonkeyPatch) -> Count:
    """The towers that the ladder builds."""
    count = Count(Tower)
    monkeypatch.setattr(ladder, "Tower", count)
    return count


@pytest.fixture
def brackets(monkeypatch: pytest.MonkeyPatch) -> Count:
    """The fundamental brackets that are built."""
    count = Count(scale.poisson_bracket)
    monkeypatch.setattr(scale, "poisson_bracket", count)
    return count


@pytest.fixture
def modular_tests(monkeypatch: pytest.MonkeyPatch) -> Count:
    """The evaluations over prime fields."""
    count = Count(modular.vanishing)
    monkeypatch.setattr(modular, "vanishing", count)
    return count


def test_a_refutation_at_the_first_witness_builds_no_tower_and_few_brackets(towers: Count, brackets: Count) -> None:
    question = Question(rotation(sp.Rational(1, 1000)).canonical(), Budget(10.0))
    outcome = question.decide(scale.Brackets(question).residuals(question.tape.one), question.region())
    assert outcome.status == "refuted"
    assert towers.calls == 0
    assert brackets.calls == FIRST_BATCH < N * (2 * N - 1)


def test_a_proof_builds_one_tower_for_all_brackets(towers: Count, brackets: Count, modular_tests: Count) -> None:
    assert verify(rotation().canonical()).status == "proved"
    assert towers.calls == 1
    assert brackets.calls == N * (2 * N - 1)
    assert modular_tests.calls == 0


def differentiated(claim: Any) -> tuple[Question, dict[sp.Symbol, int]]:
    """The question after its answer, and how many nodes were differentiated by each variable."""
    question = Question(claim, Budget(10.0))
    assert kind_named(claim.kind)(question).status == "proved"
    tape = question.tape
    return question, {tape.symbol_at(variable): len(known) for variable, known in tape.derivatives.items()}


def test_a_bracket_takes_the_derivatives_that_it_needs_and_builds_no_jacobian() -> None:
    (q, *_), (p, *_) = SPACE.q, SPACE.p
    subject = rotation().canonical().subject
    keys = {name: bracket(SPACE, f, f, 0).keys["f"] for name, f in (("f", sp.sin(q)), ("g", p**2))}
    keys["equals"] = bracket(SPACE, 2 * p * sp.cos(q), q, 0).keys["f"]
    question, counts = differentiated(subject.claim("bracket", keys))
    assert set(counts) == {q, p}
    assert sum(counts.values()) <= 4
    (node,) = {question.load(subject.transformation.Q[0])} if subject.transformation else {None}
    assert all(node not in known for known in question.tape.derivatives.values())


def test_a_constant_of_motion_costs_the_two_gradients_of_what_it_depends_on() -> None:
    (x, y, *_), (px, py, *_) = SPACE.q, SPACE.p
    H = sum(p**2 for p in SPACE.p) / 2 + (x**2 + y**2) ** 2 + sum(q**2 for q in SPACE.q[2:])
    _, counts = differentiated(conserved(SPACE, H, x * py - y * px))
    assert set(counts) - {SPACE.t} == {x, y, px, py}


def test_nothing_is_put_into_words_before_somebody_asks(monkeypatch: pytest.MonkeyPatch) -> None:
    q, p = SPACE.q[0], SPACE.p[0]
    claim = Transformation(
        PhaseSpace([q], [p], new=(["Q"], ["P"])),
        Q=[sp.log(1 + sp.sqrt(q) * sp.cos(p))],
        P=[2 * (1 + sp.sqrt(q) * sp.cos(p)) * sp.sqrt(q) * sp.sin(p)],
    ).canonical()
    with monkeypatch.context() as patch:
        printed = Count(StrPrinter.doprint)
        patch.setattr(StrPrinter, "doprint", lambda self, expression: printed(self, expression))
        verdict = verify(claim)
        long = printed.calls
    assert verdict.status == "proved"
    assert long <= 4  # names and the scale, no formula
    assert verdict.certificate is not None
    assert "q0 > 0" in verdict.certificate["domain"]
