"""Records: what JSON holds of a verdict, exact numbers as text, and the exit status."""

import json
from fractions import Fraction

import pytest
import sympy as sp

from canon.claim import Claim
from canon.claims.worker import Entry
from canon.report.record import claim_record, error_record, exit_status, number, plain, run_record
from canon.verdict import Evidence, Verdict

CLAIM = Claim("canonical", None, title="a map", expect="fails", index=2)
ENTRY = Entry("maps.toml", 2, CLAIM)


def test_a_refuted_claim_as_data() -> None:
    verdict = Verdict(
        "refuted",
        "canonical",
        "a map",
        "ball at a point",
        0.00412345678,
        witness={"q": Fraction(3, 2), "z": (Fraction(1, 2), Fraction(1)), "V": "x**2"},
        detail={"brackets": {"{Q,P}": sp.Integer(2)}, "scale": None},
    )
    record = claim_record(ENTRY, CLAIM, verdict)
    assert record == {
        "file": "maps.toml",
        "index": 2,
        "kind": "canonical",
        "title": "a map",
        "verdict": "refuted",
        "expected": True,
        "method": "ball at a point",
        "seconds": 0.004123,
        "numeric": None,
        "witness": {"q": "3/2", "z": {"re": "1/2", "im": "1"}, "V": "x**2"},
        "certificate": None,
        "detail": {"brackets": {"{Q,P}": "2"}, "scale": None, "one_digit_more": "exact"},
    }
    assert json.loads(json.dumps(record, allow_nan=False)) == record


def test_evidence_as_data() -> None:
    verdict = Verdict("supported", "bracket", numeric=Evidence(1000, 2.2e-16, float("inf"), 53))
    record = claim_record(ENTRY, CLAIM, verdict)
    assert record["numeric"] == {"points": 1000, "max_residual": 2.2e-16, "bound": "inf", "bits": 53}
    assert record["expected"] is False


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (Fraction(3, 2), "3/2"),
        (Fraction(2), "2"),
        (5, "5"),
        (0.1, "0.1"),
        (1 - 2j, {"re": "1.0", "im": "-2.0"}),
        ((Fraction(1, 3), Fraction(-1)), {"re": "1/3", "im": "-1"}),
        ({"re": "1/3", "im": "-1"}, {"re": "1/3", "im": "-1"}),
        ("sin(x)", "sin(x)"),
        (sp.Rational(1, 7), "1/7"),
    ],
)
def test_numbers_of_a_witness(value: object, shown: object) -> None:
    assert number(value) == shown


def test_plain_data() -> None:
    x = sp.Symbol("x")
    assert plain({x: (x**2, Fraction(1, 2), True, None, 3, float("nan"))}) == {
        "x": ["x**2", "1/2", True, None, 3, "nan"]
    }
    assert plain({"b", "a"}) == ["a", "b"]


def test_a_run_counts_each_verdict_once() -> None:
    claims = [claim_record(ENTRY, CLAIM, Verdict("refuted", "canonical")) for _ in range(2)]
    record = run_record(claims, [error_record("bad.toml", "claim 2, key 'f'", "…")])
    assert record["format"] == 1
    assert record["summary"] == {"proved": 0, "refuted": 2, "supported": 0, "undecided": 0, "errors": 1}
    assert list(record) == ["format", "claims", "errors", "summary"]


@pytest.mark.parametrize(
    ("verdicts", "errors", "status"),
    [
        ([("proved", True), ("refuted", True), ("undecided", True)], 0, 0),
        ([("undecided", False)], 0, 2),
        ([("undecided", False), ("refuted", False)], 0, 1),
        ([("supported", False)], 0, 1),
        ([("proved", False)], 0, 1),
        ([("refuted", False)], 1, 3),
        ([], 0, 0),
    ],
)
def test_exit_status(verdicts: list[tuple[str, bool]], errors: int, status: int) -> None:
    claims = [{"verdict": verdict, "expected": expected} for verdict, expected in verdicts]
    assert exit_status(claims, [error_record("f", "", "m")] * errors) == status
