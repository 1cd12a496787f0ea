"""The laws of Poisson brackets, for random functions on random phase spaces."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from canon.testing import BRACKET_LAWS, Law, assert_law, functions, phase_spaces, rationals


@pytest.mark.parametrize("law", BRACKET_LAWS, ids=lambda law: law.name)
def test_law(law: Law):
    @settings(max_examples=max(3, settings.default.max_examples // 4))
    @given(st.data())
    def holds(data: st.DataObject):
        space = data.draw(phase_spaces(max_degrees=2, new=False))
        simple = len(law.takes) > 2
        objects = [data.draw(functions(space.old, transcendental=not simple or k == 0)) for k in range(len(law.takes))]
        assert_law(law, space, *objects)

    holds()


@settings(max_examples=5)
@given(st.data())
def test_a_law_that_is_wrong_is_refuted(data: st.DataObject):
    """The laws are tested too: with one sign changed, Leibniz' rule fails and says where."""
    from canon.mechanics.poisson import poisson_bracket

    wrong = Law("wrong", "{f, g} = {g, f}", ("function", "function"), lambda s, f, g: [
        poisson_bracket(f, g, s) - poisson_bracket(g, f, s)])  # fmt: skip
    space = data.draw(phase_spaces(max_degrees=2, new=False))
    f = data.draw(rationals()) * space.q[0]
    with pytest.raises(AssertionError, match="refuted"):
        assert_law(wrong, space, f**3 + f, space.p[0])
