"""Settings that every test shares: the Hypothesis profiles, chosen by the environment variable `CANON_PROFILE`.

`dev` (the default) is quick: it leaves out what is marked `slow`. `ci` is reproducible and runs that too, and
`thorough` is for campaigns that run for long.
"""

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

PATIENT = [HealthCheck.too_slow]
"""How long examples take to make depends on what else the machine does."""

settings.register_profile("dev", max_examples=25, deadline=None, print_blob=True, suppress_health_check=PATIENT)
settings.register_profile(
    "ci", max_examples=40, deadline=None, derandomize=True, database=None, suppress_health_check=PATIENT
)
settings.register_profile("thorough", max_examples=2000, deadline=None, print_blob=True, suppress_health_check=PATIENT)

PROFILE = os.environ.get("CANON_PROFILE", "dev")
settings.load_profile(PROFILE)


LEFT_OUT = {
    "dev": {"thorough": "a campaign: set CANON_PROFILE=thorough to run it", "slow": "set CANON_PROFILE=ci to run it"},
    "ci": {"thorough": "a campaign: set CANON_PROFILE=thorough to run it"},
}

SLOW_CASES = Path(__file__).with_name("slow_cases.txt")
"""Single cases of parametrised tests, and others, that were measured to take more than a second of the processor.

After a line `[thorough]` come cases that take many, of tests whose other cases `ci` runs.
"""


def slow_cases() -> dict[str, str]:
    """The mark of each listed test."""
    mark, found = "slow", {}
    for line in SLOW_CASES.read_text(encoding="utf-8").splitlines():
        if line == "[thorough]":
            mark = "thorough"
        elif line[:1] not in ("", "#"):
            found[line] = mark
    return found


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what is marked for a profile of more patience than the one that is chosen.

    A listed case that no longer exists is an error, where all tests are collected.
    """
    listed = slow_cases()
    for item in items:
        if item.nodeid in listed:
            item.add_marker(listed[item.nodeid])
    gone = {*listed} - {item.nodeid for item in items}
    if gone and config.args == config.getini("testpaths"):
        raise pytest.UsageError(f"{SLOW_CASES.name}: there is no test {min(gone)} (any more)")
    for mark, reason in LEFT_OUT.get(PROFILE, {}).items():
        skip = pytest.mark.skip(reason=reason)
        for item in items:
            if mark in item.keywords:
                item.add_marker(skip)
