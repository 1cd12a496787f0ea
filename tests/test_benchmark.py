"""The benchmark's cases are what they say: identities are proved, near misses refuted (the quick ones; no times)."""

import importlib
from pathlib import Path
from types import ModuleType

import pytest

FOLDER = Path(__file__).parents[1] / "docs" / "performance"
SLOW = ("16", "17", "18", "19", "20", "22", "34", "36", "43", "45", "49", "52", "53")
"""Numbers of cases that sympy takes long to build, or that take longer than a tenth of a second."""


@pytest.fixture
def measure(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module that measures a case."""
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("measure")


def test_the_set_has_53_identities_and_19_near_misses(measure: ModuleType) -> None:
    names = list(measure.all_cases())
    assert [sum(name.startswith(letter) for name in names) for letter in "cn"] == [53, 19]


def test_identities_are_proved_and_near_misses_refuted(measure: ModuleType) -> None:
    for name, build in measure.all_cases().items():
        if name[1:3] not in SLOW:
            case = build()
            assert (name, measure.verdict(case)[0]) == (name, "proved" if case.holds else "refuted")


def test_phases_add_up_to_the_time_of_a_verdict(measure: ModuleType) -> None:
    build = measure.all_cases()["c07_polar_inverse"]
    spent = measure.canon_phases(build)
    assert spent["tower"] > 0
    assert spent["normal form"] > 0
    assert all(seconds >= 0 for seconds in spent.values())
