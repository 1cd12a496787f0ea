"""From claim to verdict: methods, budgets, certificates, what is built, and what is taught."""

import json

import pytest
import sympy as sp

from canon.claim import Claim
from canon.claims import question as questions
from canon.claims.keys import KEYS
from canon.claims.kinds import KINDS
from canon.claims.outcome import Outcome, combined
from canon.claims.scale import never_zero
from canon.claims.verify import verify
from canon.decide import derivative as derivatives
from canon.decide import ladder
from canon.domain import Condition
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics import PhaseSpace, Transformation
from canon.mechanics.statements import bracket, identity, independent

SPACE = PhaseSpace("q", "p", new=("Q", "P"), positive="m")
q, p, m = SPACE.symbols("q p m")


def exchange(sign: int = -1) -> Transformation:
    return Transformation(SPACE, Q=(p,), P=(sign * q,))


def test_every_kind_of_this_version_is_decided():
    assert set(KINDS) == set(KEYS)


def test_an_unknown_kind_names_the_nearest():
    with pytest.raises(InputError, match="canonical"):
        verify(Claim("canonicall", exchange().subject()))


def test_methods():
    true, false = exchange().canonical(), exchange(1).canonical()
    glance = verify(true, method="symbolic").numeric
    assert glance is not None
    assert (glance.points, glance.max_residual <= glance.bound) == (2, True)
    numeric = verify(true, method="numeric")
    assert numeric.status == "supported"
    assert numeric.numeric is not None
    both = verify(true, method="all")
    assert both.status == "proved"
    assert both.numeric is not None
    assert both.numeric.points == 1000
    assert {verify(false, method=method).status for method in ("symbolic", "numeric", "all")} == {"refuted"}
    with pytest.raises(InputError, match="method"):
        verify(true, method="quick")  # type: ignore[arg-type]


def test_what_is_no_claim():
    for nothing in ("canonical", Claim("canonical", None), exchange()):
        with pytest.raises(InputError, match="a claim about something is expected"):
            verify(nothing)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="key 'functions': the list is empty"):
        verify(independent(SPACE, []))


@pytest.mark.parametrize("method", ["symbolic", "numeric", "all"])
def test_a_refutation_by_a_point_says_the_number_there(method):
    verdict = verify(exchange(1).canonical(), method=method)
    assert verdict.numeric is not None
    assert verdict.numeric.points == 1
    assert verdict.numeric.max_residual == abs(float(verdict.detail["residual"])) > verdict.numeric.bound
    assert "residual" not in str(verdict).split("residual:", 1)[1]  # said once, with the witness


def test_the_number_of_independence_is_the_minor():
    proved = verify(Claim("independent", exchange().subject(), {"functions": (Formula(2 * q, ()), Formula(p, ()))}))
    assert proved.numeric is not None
    assert (proved.numeric.points, proved.numeric.max_residual) == (1, 2.0)
    refuted = verify(
        Claim("independent", exchange().subject(), {"functions": (Formula(q * p, ()), Formula(q**2 * p**2, ()))})
    )
    assert refuted.status == "refuted"
    assert refuted.numeric is not None
    assert refuted.numeric.max_residual <= refuted.numeric.bound


def test_a_certificate_is_data_that_json_can_hold():
    verdict = verify(
        Transformation(SPACE, Q=(q * sp.cos(m) + p * sp.sin(m),), P=(p * sp.cos(m) - q * sp.sin(m),)).canonical()
    )
    assert verdict.certificate is not None
    data = json.loads(json.dumps(dict(verdict.certificate), default=str))
    assert data["verdict"] == "proved"
    assert data["arguments"]


@pytest.mark.parametrize("budget", [-1, float("nan"), "3", None, 10**5000, [1.0]], ids=lambda x: type(x).__name__)
def test_what_is_no_budget_is_refused(budget):
    with pytest.raises(InputError, match="a budget is a number of seconds from 0 on"):
        verify(Transformation(SPACE, Q=(q,), P=(p,)).canonical(), budget=budget)


def test_no_budget_is_no_verdict():
    verdict = verify(Transformation(SPACE, Q=(sp.sin(q),), P=(p / sp.cos(q),)).canonical(), budget=0.0)
    assert verdict.status == "undecided"


def test_a_refutation_builds_no_normal_form(monkeypatch):
    def never(*_: object) -> None:
        raise AssertionError("a normal form was built")

    monkeypatch.setattr(ladder._Ladder, "normal_forms", never)
    monkeypatch.setattr("canon.claims.repair.lesson", lambda *_: {})
    assert verify(exchange(1).canonical()).status == "refuted"


def test_a_bracket_takes_only_the_derivatives_that_it_needs(monkeypatch):
    taken = []
    real = derivatives.derivative

    def counted(tape, node, variable):
        taken.append((node, variable))
        return real(tape, node, variable)

    monkeypatch.setattr(derivatives, "derivative", counted)
    space = PhaseSpace("x y z", "px py pz")
    x, px = space.symbols("x px")
    from canon.expression import Formula
    from canon.mechanics import Subject

    keys = {"f": Formula(x**2, ()), "g": Formula(px, ()), "equals": Formula(2 * x, ())}
    assert verify(Claim("bracket", Subject(space), keys)).status == "proved"
    assert len(taken) == 2


def test_a_variable_of_the_other_side_is_refused():
    claim = exchange().canonical()
    wrong = Claim("bracket_invariance", claim.subject, {"f": _formula(q), "g": _formula(q)})
    with pytest.raises(InputError, match="old variables"):
        verify(wrong)


def _formula(expression: sp.Expr):
    from canon.mechanics.formulas import as_formula

    return as_formula(expression)


def test_outcomes_combine():
    words = {
        ("proved", "proved"): "proved",
        ("proved", "supported"): "supported",
        ("supported", "undecided"): "undecided",
        ("undecided", "refuted"): "refuted",
    }
    for pair, expected in words.items():
        assert combined(Outcome(word) for word in pair).status == expected  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("a", False),
        ("1 + a**2", True),
        ("c*d", True),
        ("c - 1", False),
        ("n", True),
        ("1 + c", True),
        ("a*b - 1", True),
    ],
)
def test_what_is_nowhere_zero(expression, expected):
    names = {"a": sp.Symbol("a", real=True), "b": sp.Symbol("b", real=True), "n": sp.Symbol("n", real=True, zero=False)}
    names |= {letter: sp.Symbol(letter, positive=True) for letter in "cd"}
    a, b = names["a"], names["b"]
    known = {
        "a": a, "1 + a**2": 1 + a**2, "c*d": names["c"] * names["d"], "c - 1": names["c"] - 1, "n": names["n"],
        "1 + c": 1 + names["c"], "a*b - 1": a * b - 1,
    }  # fmt: skip
    conditions = (Condition("nonzero", (2 * (a * b - 1),)),)
    assert never_zero(known[expression], conditions) is expected


def test_first_batches_are_small():
    assert questions.FIRST_BATCH <= 10


def test_coefficients_that_are_no_numbers_of_the_rationals_are_not_expanded(monkeypatch):
    def refused(*_: object) -> None:
        raise AssertionError("a polynomial was made of it")

    a = sp.Symbol("a", real=True)
    monkeypatch.setattr(sp, "Poly", refused)
    assert not never_zero((1 + a * sp.sin(1)) * (2 + a**2 * sp.cos(2)) + sp.cos(a**0) * a)
    monkeypatch.undo()
    assert never_zero(a**2 + a + 1)


def test_what_a_refutation_depends_on() -> None:
    """{r, p_r} is off at x, y; which momenta a point has doesn't matter, and nobody is shown them."""
    space = PhaseSpace("x y", "px py", new=("r phi", "pr L"))
    x, y, px, py = space.symbols("x y px py")
    polar = Transformation(space, Q=[sp.sqrt(x**2 + y**2), sp.atan2(y, x)], P=[x * px + y * py, x * py - y * px])
    found = verify(polar.canonical())
    assert found.matters == ("x", "y")
    assert set(found.witness or {}) == {"x", "y", "px", "py"}
    assert "px =" not in str(found)
    assert "px =" not in found._repr_latex_()
    tied = verify(identity(space.where("px + x > 0", "px < y + 20"), x, 2 * x))
    assert tied.matters == ("px", "x", "y")  # the domain ties px to x, and y to px; py is free
    assert verify(identity(space, x * y * px * py, 1)).matters is None
    everywhere = verify(bracket(space, x, px, 2))
    assert (everywhere.matters, len(everywhere.witness or {})) == ((), 4)
    assert "px =" not in str(everywhere)
    assert "wherever the formulas are defined" in str(everywhere)
