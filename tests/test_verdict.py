"""Verdicts, claims, budgets and errors as values."""

import pickle
import time

import pytest

from canon.budget import Budget
from canon.claim import Claim
from canon.decide.certificate import Certificate
from canon.errors import BudgetExceeded, ClaimFailed, InputError
from canon.verdict import Evidence, Verdict


def test_truth_is_proved_or_refuted():
    assert Verdict("proved", "canonical")
    assert not Verdict("refuted", "canonical")
    for unknown in ("supported", "undecided"):
        with pytest.raises(TypeError, match="neither true nor false"):
            bool(Verdict(unknown, "canonical"))  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match="a verdict is one of"):
        Verdict("true", "canonical")  # pyright: ignore[reportArgumentType]


def test_require_returns_the_proof_or_raises_what_is_known():
    proved = Verdict("proved", "canonical", method="normal form")
    assert proved.require() is proved
    refuted = Verdict("refuted", "bracket", witness={"q": "1/2", "z": {"re": "1", "im": "2"}}, detail={"value": "2*q"})
    with pytest.raises(ClaimFailed, match=r"q = 1/2, z = 1 \+ 2\*1j\n  value: 2\*q") as caught:
        refuted.require()
    assert caught.value.verdict is refuted


def test_a_verdict_shows_itself():
    verdict = Verdict("supported", "volume", title="t", seconds=0.004, numeric=Evidence(10, 1e-16, 1e-14))
    assert str(verdict).startswith("supported: volume (t), 4 ms\n  10 points in 53 bits")
    assert verdict._repr_markdown_().startswith("**supported**: volume")
    assert verdict._repr_latex_().startswith("$")


def test_a_claim_knows_what_meets_it():
    claim = Claim("bracket", None, {"f": 1})
    assert claim.is_met_by("supported")
    assert not claim.is_met_by("refuted")
    assert Claim("bracket", None, expect="fails").is_met_by("refuted")
    assert Claim("bracket", None, expect="undecided").is_met_by("undecided")
    assert pickle.loads(pickle.dumps(claim)) == claim  # noqa: S301 - our own
    with pytest.raises(TypeError):
        claim.keys["f"] = 2  # pyright: ignore[reportIndexIssue]
    with pytest.raises(InputError, match="expect is one of"):
        Claim("bracket", None, expect="yes")


def test_a_budget_is_a_deadline():
    whole = Budget(1000.0)
    part = whole.share(0.5)
    assert 0 < part.left() <= 500 < whole.left() <= 1000
    whole.check()
    budget = Budget(0.02)
    time.sleep(0.03)
    assert budget.spent()
    assert budget.left() == 0
    with pytest.raises(BudgetExceeded, match=r"budget of 0\.02 s"):
        budget.check()
    assert Budget().left() == float("inf")
    with pytest.raises(AttributeError, match="immutable"):
        budget.seconds = 3
    for wrong in (-1, float("nan")):
        with pytest.raises(ValueError, match="number of seconds"):
            Budget(wrong)


def test_errors_name_their_place():
    error = InputError("unknown name 'x'", "key 'f'").at("claim 2")
    assert str(error) == "claim 2, key 'f': unknown name 'x'"
    assert pickle.loads(pickle.dumps(error)).where == error.where  # noqa: S301 - our own


def test_the_number_of_a_claim_that_something_is_not_zero_is_no_residual() -> None:
    evidence = Evidence(1, 2.0, 1e-16)
    assert "1 point in 53 bits, the minor's size 2 " in str(Verdict("supported", "independent", numeric=evidence))
    assert "1 point in 53 bits, largest residual 2 " in str(Verdict("supported", "bracket", numeric=evidence))


def test_a_notebook_shows_certificate_and_witness() -> None:
    data = {"kind": "canonical", "domain": ["m_1 > 0"], "arguments": [{"method": "normal form", "x": None}]}
    certificate = Certificate(lambda: data)
    assert repr(certificate) == "Certificate(made when it is looked at)"
    shown = certificate._repr_latex_()
    assert r"\text{domain 1} &\colon \text{m\_1 > 0}" in shown
    assert shown.count("{") - shown.count(r"\{") == shown.count("}") - shown.count(r"\}")
    assert repr(certificate) == "Certificate(kind, domain, arguments)"
    refuted = Verdict("refuted", "canonical", witness={"q_1": "1/2"})
    assert r"q_{1} = \frac{1}{2}" in refuted._repr_latex_()


def test_a_title_is_words_in_markdown():
    """Markdown lets tags, links and formulas through: a title that holds some is shown as it was written."""
    shown = Verdict("proved", "identity", "<b>x</b> [a](b) `c` $d$ e_f\ng & \\(h")._repr_markdown_()
    assert shown.startswith(r"**proved**: identity (&lt;b>x&lt;/b> \[a\](b) \`c\` \$d\$ e\_f g &amp; \\(h)")
