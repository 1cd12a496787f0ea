"""Settings that every test shares: the Hypothesis profiles, chosen by the environment variable `CANON_PROFILE`.

`dev` (the default) is quick, `ci` is reproducible, and `thorough` is for campaigns that run for long.
"""

import os

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("dev", max_examples=25, deadline=None, print_blob=True)
settings.register_profile(
    "ci", max_examples=40, deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile(
    "thorough", max_examples=2000, deadline=None, print_blob=True, suppress_health_check=[HealthCheck.too_slow]
)

PROFILE = os.environ.get("CANON_PROFILE", "dev")
settings.load_profile(PROFILE)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave out what is marked `thorough`, unless the thorough profile asks for it."""
    if PROFILE == "thorough":
        return
    skip = pytest.mark.skip(reason="a campaign: set CANON_PROFILE=thorough to run it")
    for item in items:
        if "thorough" in item.keywords:
            item.add_marker(skip)
