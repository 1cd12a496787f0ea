"""A short run of the campaign against the verdicts; the figures of a long one stand in the audit."""

import pytest
from hypothesis import settings

from properties.soundness.campaign import run, summary
from properties.soundness.cases import case


def check(cases: int, seed: int) -> None:
    """No verdict is wrong, nothing crashes, and most is decided."""
    figures = summary(list(run(cases, seed, 1)))
    assert not figures["wrong"], figures["wrong"]
    assert not figures["crashed"], figures["crashed"]
    assert figures["decided_share"] > 0.85, figures


def test_no_wrong_verdict_among_a_few_hundred():
    check(4 * settings.default.max_examples + 60, 5)


@pytest.mark.thorough
def test_no_wrong_verdict_among_ten_thousand():
    check(10_000, 1)


def test_the_oracle_knows_true_and_false_cases():
    """The campaign would be idle if its cases were all true, or of unknown truth."""
    found = [c for c in map(case, range(120)) if c is not None]
    assert sum(c.truth is True for c in found) > 20
    assert sum(c.truth is False for c in found) > 30
    assert {c.family for c in found} == {"map", "mutant", "identity", "generating", "surface", "bracket"}
