"""The profiles of Hypothesis and the campaigns of the thorough one, for these tests too."""

from properties.profiles import pytest_collection_modifyitems

__all__ = ["pytest_collection_modifyitems"]
