"""For the test suites of others: assertions about maps, each of which says what fails, where, and by how much."""

from canon.testing.assertions import (
    assert_canonical,
    assert_order,
    assert_reversible,
    assert_symplectic,
    assert_volume_preserving,
)

__all__ = [
    "assert_canonical",
    "assert_order",
    "assert_reversible",
    "assert_symplectic",
    "assert_volume_preserving",
]
