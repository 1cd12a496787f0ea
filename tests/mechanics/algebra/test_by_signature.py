"""Semisimple algebras by the signature of their Killing form alone."""

import pytest

from canon.mechanics.algebra.by_signature import semisimple_of
from canon.mechanics.algebra.names import read_name


@pytest.mark.parametrize(
    "name",
    ["so(3)", "sl(2,R)", "so(4)", "so(3,1)", "so(2,2)", "so(3) + sl(2,R)", "su(3)", "su(2,1)", "sl(3,R)", "so(5)",
     "so(4,1)", "so(3,2)", "so(3)^3", "so(3,1) + so(3)", "sl(2,R)^3", "su(2,1) + so(3)", "su(4)", "so(8,C)"],
)  # fmt: skip
def test_small_ones_are_known(name):
    named = read_name(name)
    negative = sum(simple.compact_dimension for simple in named.simple)
    found = semisimple_of(named.dimension - negative, negative)
    if name in ("su(4)", "so(8,C)"):  # so has so(3)^5; too large
        assert found is None
    else:
        assert found == named


def test_none_and_several():
    assert semisimple_of(2, 2) is None  # of dimension 4 there is none
    assert semisimple_of(6, 6) is None  # so(3,1)^2 and so(3) + sl(2,R)^3
    assert semisimple_of(0, 0) is None
