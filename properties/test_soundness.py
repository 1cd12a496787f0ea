"""A short run of the campaign against the verdicts; the figures of a long one stand in the audit."""

import random

import pytest
from hypothesis import settings

from properties.soundness.campaign import judged, run, summary
from properties.soundness.cases import KINDS_OF_CLAIMS, case
from properties.soundness.known import FAMILIES, known_case


def check(cases: int, seed: int) -> None:
    """No verdict is wrong, nothing crashes, and most is decided."""
    figures = summary(list(run(range(seed * 1_000_000, seed * 1_000_000 + cases), 1)))
    assert not figures["wrong"], figures["wrong"]
    assert not figures["crashed"], figures["crashed"]
    assert figures["decided_share"] > 0.85, figures


def test_no_wrong_verdict_among_a_few_hundred():
    check(2 * settings.default.max_examples + 60, 5)


@pytest.mark.thorough
def test_no_wrong_verdict_among_ten_thousand():
    check(10_000, 1)


def test_the_oracle_knows_true_and_false_cases():
    """The campaign would be idle if its cases were all true, or of unknown truth."""
    found = [c for c in map(case, range(120)) if c is not None]
    assert sum(c.truth is True for c in found) > 20
    assert sum(c.truth is False for c in found) > 30
    assert {"map", "mutant", "identity"} <= {c.family for c in found}


@pytest.mark.parametrize("family", sorted(KINDS_OF_CLAIMS))
def test_every_kind_of_claim_is_stated_truly_and_falsely(family):
    """Both truths occur among some claims of the kind, and no verdict of a few of them is wrong."""
    found = [KINDS_OF_CLAIMS[family](random.Random(f"{family} {k}")) for k in range(24)]
    cases = [c for c in found if c is not None]
    assert {True, False} <= {c.truth for c in cases}
    records = [judged(k, c) for k, c in enumerate(cases[:4])]
    assert not [r for r in records if r.wrong or r.outcome in ("refused", "crash")]


def test_no_wrong_verdict_where_the_truth_is_known_by_construction():
    figures = summary(list(run(range(3_000_000, 3_000_060 + 2 * settings.default.max_examples), 1, known_case)))
    assert not figures["wrong"], figures["wrong"]
    assert not figures["crashed"], figures["crashed"]
    assert figures["decided_share"] > 0.75, figures


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_every_family_of_known_truth_has_true_and_false_cases(family):
    found = [FAMILIES[family](random.Random(f"{family} {k}")) for k in range(40)]
    assert {c.truth for c in found if c is not None} == {True, False}
