"""Exact and sampled answers beside each other; a decider that is broken on purpose raises the alarm."""

import json
from dataclasses import replace

import pytest

from canon import PhaseSpace, Transformation, verify
from canon.claim import Claim
from canon.claims.agreement import compared
from canon.claims.outcome import Outcome, exact
from canon.claims.worker import Entry
from canon.decide import ladder, other_arguments
from canon.report.record import claim_record, exit_status
from canon.verdict import Evidence, Verdict

SPACE = PhaseSpace("q", "p", new=("Q", "P"))
q, p = SPACE.symbols("q p")
SQUEEZE = Transformation(SPACE, Q=(2 * q,), P=(p,)).canonical()
EVIDENCE = Evidence(1000, 1e-16, 1e-15)
PROVED = Outcome("proved", method="normal form", numeric=Evidence(2, 0.0, 1e-19, 64))
SUPPORTED = Outcome("supported", method="sampling", numeric=EVIDENCE)
AT_A_POINT = Outcome("refuted", witness={"q": "1"}, detail={"fails": "{Q, P}", "residual": "1"})
EXACTLY = exact("refuted", "the form has a period")
EVERYWHERE = replace(EXACTLY, everywhere=True)
UNDECIDED = Outcome("undecided", note="too hard")


@pytest.mark.parametrize(
    ("symbolic", "numeric", "status", "alarmed"),
    [
        (PROVED, SUPPORTED, "proved", False),
        (PROVED, AT_A_POINT, "undecided", True),
        (PROVED, UNDECIDED, "proved", False),
        (EVERYWHERE, SUPPORTED, "undecided", True),
        (EVERYWHERE, UNDECIDED, "refuted", False),
        (EXACTLY, SUPPORTED, "refuted", False),
        (EXACTLY, UNDECIDED, "refuted", False),
        (EXACTLY, AT_A_POINT, "refuted", False),
        (AT_A_POINT, SUPPORTED, "refuted", False),
        (AT_A_POINT, AT_A_POINT, "refuted", False),
        (UNDECIDED, SUPPORTED, "supported", False),
        (UNDECIDED, AT_A_POINT, "refuted", False),
        (UNDECIDED, UNDECIDED, "undecided", False),
        (SUPPORTED, AT_A_POINT, "refuted", False),
    ],
)
def test_answers_beside_each_other(symbolic: Outcome, numeric: Outcome, status: str, alarmed: bool) -> None:
    found = compared(symbolic, numeric)
    assert found.status == status
    assert ("alarm" in found.detail) is alarmed
    if alarmed:
        assert found.detail["symbolic"]["verdict"] == symbolic.status
        assert found.detail["numeric"]["verdict"] == numeric.status


def test_the_sampled_evidence_stands_beside_a_proof() -> None:
    assert compared(PROVED, SUPPORTED).numeric == EVIDENCE
    assert compared(PROVED, UNDECIDED).numeric == PROVED.numeric


def broken(monkeypatch: pytest.MonkeyPatch, *, blind: bool) -> None:
    """A normal form to which everything is zero; `blind`: the exact deciders look at no point either."""
    monkeypatch.setattr(ladder, "reduce_to_zero", lambda tower, nodes, *_: (set(nodes), set(), []))
    monkeypatch.setattr(ladder._Ladder, "refute", lambda *_: None)
    if blind:
        monkeypatch.setattr(ladder, "excludes_zero", lambda ball: False)


def test_a_wrong_proof_is_an_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    broken(monkeypatch, blind=True)
    assert verify(SQUEEZE).status == "proved", "the decider is not broken: this test shows nothing"
    verdict = verify(SQUEEZE, method="all")
    assert verdict.status == "undecided"
    assert verdict.detail["symbolic"]["verdict"] == "proved"
    assert verdict.detail["numeric"]["verdict"] == "refuted"
    assert verdict.detail["numeric"]["fails"] == "{Q, P}"
    assert "report" in str(verdict)


def test_a_decider_that_contradicts_itself_is_an_alarm_too(monkeypatch: pytest.MonkeyPatch) -> None:
    broken(monkeypatch, blind=False)
    verdict = verify(SQUEEZE)
    assert verdict.status == "undecided"
    assert "normal form against a ball" in verdict.detail["alarm"]


@pytest.mark.parametrize("expect", ["holds", "fails", "undecided"])
def test_an_alarm_is_never_expected(monkeypatch: pytest.MonkeyPatch, expect: str) -> None:
    broken(monkeypatch, blind=True)
    claim = Claim("canonical", SQUEEZE.subject, SQUEEZE.keys, expect=expect)
    record = claim_record(Entry("a.toml", 0, claim), claim, verify(claim, method="all"))
    assert record["expected"] is False
    assert "contradict" in json.loads(json.dumps(record))["detail"]["alarm"]
    assert exit_status([record], []) == 2


def test_a_wrong_zero_is_an_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    """A decider that takes a regular mixed Hessian, or a minor, for zero."""
    from canon import GeneratingFunction, independent

    claims = [
        GeneratingFunction(SPACE, type=2, F=q * SPACE.P[0] + q**2).transformation().canonical(),
        independent(SPACE, (q**2 + p,)),
    ]
    broken(monkeypatch, blind=True)
    monkeypatch.setattr(other_arguments, "number_is_zero", lambda *_: True)
    for claim in claims:
        verdict = verify(claim, method="all")
        assert verdict.detail["symbolic"]["verdict"] == "refuted"
        assert verdict.detail["numeric"]["verdict"] == "supported"


def test_without_an_alarm_what_was_expected_is() -> None:
    claim = Claim("canonical", SQUEEZE.subject, SQUEEZE.keys, expect="undecided")
    record = claim_record(Entry("a.toml", 0, claim), claim, Verdict("undecided", "canonical"))
    assert record["expected"] is True
