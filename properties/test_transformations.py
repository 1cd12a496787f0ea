"""The group of canonical transformations: what is canonical by construction is proved so, and composes."""

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from canon.claims.verify import verify
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation
from canon.testing import GROUP_LAWS, Law, assert_law, canonical_maps, phase_spaces
from canon.testing.checking import elementary_maps, single_factors


@pytest.mark.parametrize("law", GROUP_LAWS, ids=lambda law: law.name)
def test_law(law: Law):
    @settings(max_examples=max(3, settings.default.max_examples // 6))
    @given(st.data())
    def holds(data: st.DataObject):
        space = data.draw(phase_spaces(max_degrees=2))
        most = 3 - len(law.takes) // 2
        kinds = {
            "map": canonical_maps(space, max_factors=most),
            "elementary map": elementary_maps(space),
            "factor": single_factors(space),
        }
        maps = [_moved(data.draw(kinds[kind]), space, k) for k, kind in enumerate(law.takes)]
        assert_law(law, space, *maps)

    holds()


def _moved(made: Transformation, space: PhaseSpace, k: int) -> Transformation:
    """The same map between variables of its own, so that several can be composed: old names k, new names k + 1."""

    def names(word: str, level: int) -> list[str]:
        return [f"{word}{level}_{i}" for i in range(space.n)]

    own = PhaseSpace(
        names("q", k), names("p", k), new=(names("q", k + 1), names("p", k + 1)), real=list(space.parameters)
    )
    renamed = dict(zip(space.old, own.old, strict=True))
    images = [f.xreplace(renamed) for f in made.expressions]
    return Transformation(own, Q=images[: space.n], P=images[space.n :])


@given(st.data())
def test_canonical_by_construction(data: st.DataObject):
    space = data.draw(phase_spaces())
    made = data.draw(canonical_maps(space))
    verdict = verify(made.canonical(), budget=20)
    assert verdict.status in ("proved", "supported"), (made, verdict)


@settings(max_examples=max(5, settings.default.max_examples // 3))
@given(st.data())
def test_the_inverse_direction_is_canonical_with_the_inverse_scale(data: st.DataObject):
    space = data.draw(phase_spaces(max_degrees=2))
    made = data.draw(canonical_maps(space, max_factors=2))
    back = Transformation(space.swapped(), q=[3 * f.expr for f in made.Q], p=[f.expr for f in made.P])
    assert verify(back.canonical(scale=1), budget=20).status == "refuted"
    verdict = verify(back.canonical(scale=sp.Rational(1, 3)), budget=20)
    assert verdict.status in ("proved", "supported"), (made, verdict)
