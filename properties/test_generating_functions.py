"""Generating functions of every type: their maps are canonical, and Legendre transforms lead there and back."""

import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from canon.claims.audit import audit
from canon.claims.verify import verify
from canon.errors import InputError
from canon.testing import GENERATING_LAWS, Law, assert_law, generating_functions, phase_spaces


@pytest.mark.parametrize("law", GENERATING_LAWS, ids=lambda law: law.name)
def test_law(law: Law):
    @settings(max_examples=max(4, settings.default.max_examples // 4))
    @given(st.data())
    def holds(data: st.DataObject):
        space = data.draw(phase_spaces(max_degrees=2))
        back = law.name == "there and back"
        F = data.draw(generating_functions(space, solvable=back))
        try:
            residuals = list(law.residuals(space, F))
        except InputError:
            assume(not back)
            return
        assert residuals
        assert_law(law, space, F)

    holds()


@settings(max_examples=max(5, settings.default.max_examples // 2))
@pytest.mark.parametrize("kind", [1, 2, 3, 4])
@given(data=st.data())
def test_the_map_of_a_function_of_each_type_is_canonical(kind: int, data: st.DataObject):
    space = data.draw(phase_spaces(max_degrees=2))
    F = data.draw(generating_functions(space, types=(kind,), solvable=False))
    verdict = verify(F.transformation().canonical(), budget=20)
    assert verdict.status == "proved", (F, verdict)


@settings(max_examples=max(5, settings.default.max_examples // 4))
@given(st.data())
def test_a_nearly_singular_hessian_is_regular_all_the_same(data: st.DataObject):
    """A caustic is where the determinant vanishes, not where it is 1e-12: neither proof nor numbers mind."""
    space = data.draw(phase_spaces(max_degrees=2))
    smallest = data.draw(st.sampled_from([sp.Rational(1, 10**3), sp.Rational(1, 10**12)]))
    F = data.draw(generating_functions(space, smallest=smallest))
    assert verify(F.transformation().canonical(), budget=20).status == "proved"
    try:
        explicit = F.transformation().forward()
    except InputError:
        assume(False)
        return
    report = audit(explicit, domain=(-1, 1), samples=10, parameters={"a": 0.5})
    assert not report.failures, (F, report)


@settings(max_examples=max(5, settings.default.max_examples // 4))
@given(st.data())
def test_the_explicit_map_is_generated_and_canonical(data: st.DataObject):
    space = data.draw(phase_spaces(max_degrees=2))
    F = data.draw(generating_functions(space))
    try:
        explicit = F.transformation().forward()
    except InputError:
        assume(False)
        return
    assert verify(explicit.canonical(), budget=20).status == "proved"
    assert verify(explicit.generated_by(F), budget=20).status == "proved"
