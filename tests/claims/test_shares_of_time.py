"""What exact arguments may not use up: time for numerical evidence, and for minors that are easy."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.claims import question as of_question
from canon.claims.reader import read_text
from canon.claims.special_parameters import _without_common_zero
from canon.claims.verify import verify
from canon.decide.answer import Answer

IDENTITY = (
    '[phase_space]\nq = ["x"]\np = ["y"]\n[[claim]]\nkind = "identity"\nlhs = "(x+y)**2"\nrhs = "x**2+2*x*y+y**2"\n'
)


def test_evidence_is_gathered_when_proofs_have_used_up_their_share(monkeypatch):
    shares = []

    def without_result(tape, nodes, region, *, budget: Budget, **_):
        shares.append(budget.seconds)
        return [Answer("undecided", "", "the budget ended") for _ in nodes]

    monkeypatch.setattr(of_question.ladder, "vanish", without_result)
    (claim,) = read_text(IDENTITY).claims
    verdict = verify(claim, budget=5.0)
    assert verdict.status == "supported"
    assert verdict.numeric is not None
    assert verdict.numeric.points > 100
    assert max(shares) < 0.9 * 5.0


@pytest.mark.parametrize(
    ("values", "expected"),
    [(["1-g", "4-2*g"], True), (["1-g", "2-2*g"], False), (["1-g", None, "1+g"], True), (["g", "g**2"], False)],
)
def test_values_at_several_points_without_a_common_zero(values, expected):
    g = sp.Symbol("g", real=True)
    formulas = [None if v is None else sp.sympify(v, locals={"g": g}) for v in values]
    assert _without_common_zero(formulas, ()) is expected


def test_the_integrals_of_four_calogero_particles_are_independent_for_every_coupling():
    pairs = [(i, j) for i in range(1, 5) for j in range(i + 1, 5)]
    square = {p: f"(1/(x{p[0]}-x{p[1]}))**2" for p in pairs}
    force = "+".join(f"p{i}*({'+'.join(square[p] for p in pairs if i in p)})" for i in range(1, 5))
    energy = "(p1**2+p2**2+p3**2+p4**2)/2+g**2*(" + "+".join(square.values()) + ")"
    text = '[phase_space]\nq = ["x1", "x2", "x3", "x4"]\np = ["p1", "p2", "p3", "p4"]\n[symbols]\ng = "real"\n'
    cubic = f"p1**3+p2**3+p3**3+p4**3+3*g**2*({force})"
    text += f'[[claim]]\nkind = "independent"\nfunctions = ["p1+p2+p3+p4", "{energy}", "{cubic}"]\n'
    (claim,) = read_text(text).claims
    assert verify(claim, budget=30.0).status == "proved"
