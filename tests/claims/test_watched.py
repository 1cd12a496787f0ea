"""A single claim tells how much of its time is spent."""

import copy

import pytest

from canon import verify
from canon.budget import Budget
from canon.claims.reader import read_text

TEXT = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[transformation]
Q = ["sqrt(2*q)*cos(p)"]
P = ["sqrt(2*q)*sin(p)"]
[domain]
where = ["q > 0"]
[[claim]]
kind = "canonical"
"""


def test_a_watcher_is_told_of_the_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(verify.__globals__, "SELDOM", 0.0)
    (claim,) = read_text(TEXT).claims
    parts: list[float] = []
    assert verify(claim, budget=1e6, watch=parts.append).status == "proved"
    assert parts == sorted(parts)
    assert 0 < parts[0] <= parts[-1] < 1e-3
    assert verify(claim, budget=1e6).status == "proved"


def test_shares_tell_too_and_other_processes_do_not() -> None:
    heard: list[int] = []
    budget = Budget(100.0, lambda: heard.append(1))
    budget.share(0.5).share(0.5).check()
    assert heard == [1]
    copy.copy(budget).check()  # which goes the way of pickles
    assert heard == [1]
