"""The laws are tested too: each is broken by some wrong bracket or composition, and true ones pass."""

from collections.abc import Callable
from typing import Any

import pytest
import sympy as sp
from hypothesis import strategies as st

from canon import InputError, PhaseSpace, Transformation, poisson_bracket
from canon.mechanics.composition import compose
from canon.testing import GENERATING_LAWS, GROUP_LAWS, Law, assert_law, bracket_laws, check_laws, functions, group_laws

Bracket = Callable[[Any, Any, PhaseSpace], Any]


def half(f: Any, g: Any, s: PhaseSpace) -> Any:
    return sp.Add(*(f.diff(q) * g.diff(p) for q, p in zip(s.q, s.p, strict=True)))


def doubled(f: Any, g: Any, s: PhaseSpace) -> Any:
    return 2 * poisson_bracket(f, g, s)


def moyal(f: Any, g: Any, s: PhaseSpace) -> Any:
    """A commutator of quantum mechanics: all of the bracket's algebra, but no derivation."""
    q, p = s.q[0], s.p[0]
    third = f.diff(q, 3) * g.diff(p, 3) - 3 * f.diff(q, 2, p) * g.diff(q, p, 2)
    third += 3 * f.diff(q, p, 2) * g.diff(q, 2, p) - f.diff(p, 3) * g.diff(q, 3)
    return poisson_bracket(f, g, s) - third / 24


def weighted(f: Any, g: Any, s: PhaseSpace) -> Any:
    """Antisymmetric and a derivation, but not Jacobi's in two degrees of freedom."""
    return s.q[0] * poisson_bracket(f, g, s)


def squared(f: Any, g: Any, s: PhaseSpace) -> Any:
    return poisson_bracket(f, g, s) * (1 + f**2 + g**2)


def laws(*names: str, bracket: Bracket = poisson_bracket) -> list[Law]:
    found = [law for law in bracket_laws(bracket) if law.name in names]
    assert len(found) == len(names)
    return found


def test_the_bracket_itself() -> None:
    assert check_laws(bracket_laws(), max_examples=2) == 7


@pytest.mark.parametrize(
    ("bracket", "broken", "kept"),
    [
        (half, ("antisymmetry", "no self-bracket"), ("linearity", "Leibniz' rule", "chain rule")),
        (doubled, ("fundamental brackets",), ("antisymmetry", "Jacobi's identity")),
        (moyal, ("Leibniz' rule", "chain rule"), ("antisymmetry", "fundamental brackets")),
        pytest.param(
            weighted, ("Jacobi's identity", "fundamental brackets"), ("Leibniz' rule",), marks=pytest.mark.slow
        ),
        (squared, ("linearity",), ("antisymmetry",)),
    ],
)
def test_a_wrong_bracket_breaks_these_laws(bracket: Bracket, broken: tuple[str, ...], kept: tuple[str, ...]) -> None:
    spaces = st.just(PhaseSpace("x y", "u v"))
    for law in laws(*broken, bracket=bracket):
        with pytest.raises(AssertionError, match=f"{law.name}.*\n(?s:.*)refuted"):
            check_laws([law], spaces=spaces, makers={"function": cubic}, max_examples=60)
    assert check_laws(laws(*kept, bracket=bracket), spaces=spaces, makers={"function": cubic}, max_examples=4)


def cubic(space: PhaseSpace) -> st.SearchStrategy[Any]:
    """Cubes of a sum, in which third derivatives don't vanish, and simple functions."""
    q, p = space.q[0], space.p[0]
    return st.sampled_from([q**3, p**3, q * p, q, p, space.q[-1] * space.p[-1] + q]) | functions(
        space.old, transcendental=False
    )


def test_a_wrong_composition_is_caught() -> None:
    def forgetful(first: Any, second: Any) -> Any:
        return first

    (law,) = (law for law in group_laws(forgetful) if law.name == "identity first")
    with pytest.raises(AssertionError, match="identity first: f ∘ 1 = f"):
        check_laws([law], max_examples=5)
    assert check_laws([law for law in group_laws() if law.name == "identity first"], max_examples=2) == 1


def test_a_composition_that_takes_no_map_back_is_caught() -> None:
    def careless(first: Any, second: Any) -> Any:
        made = compose(first, second)
        return Transformation(made.space, Q=[-Q for Q in made.expressions[: made.space.n]], P=made.P)

    (law,) = (law for law in group_laws(careless) if law.name == "inverse last")
    with pytest.raises(AssertionError, match="inverse last: f⁻¹ ∘ f = 1"):
        check_laws([law], max_examples=5)


def test_a_composition_that_takes_the_second_map_alone_breaks_the_inverse_of_a_product() -> None:
    (law,) = (law for law in group_laws(lambda first, second: second) if law.name == "inverse of a product")
    with pytest.raises(AssertionError, match="inverse of a product: f⁻¹ ∘ g⁻¹ is the inverse of g ∘ f"):
        check_laws([law], max_examples=5)


def test_groups_and_generating_functions() -> None:
    assert check_laws(GROUP_LAWS, max_examples=2) == 8
    assert check_laws(GENERATING_LAWS, max_examples=2) == 3


def test_a_law_of_other_objects() -> None:
    law = Law("even", "H(q, −p) = H", ("energy",), lambda s, H: [H.subs({x: -x for x in s.p}) - H])
    with pytest.raises(InputError, match="no strategy for 'energy', which the law 'even' takes"):
        check_laws([law])
    even = {"energy": lambda s: st.sampled_from([s.p[0] ** 2, s.q[0]])}
    assert check_laws([law], makers=even) == 1
    with pytest.raises(AssertionError, match=r"even: H\(q, −p\) = H"):
        check_laws([law], makers={"energy": lambda s: st.just(s.p[0])})


def test_a_law_that_asks_nothing_is_none() -> None:
    space = PhaseSpace("q", "p")
    with pytest.raises(InputError, match="'empty' has no residual"):
        assert_law(Law("empty", "nothing", ("function",), lambda space, f: []), space, space.q[0])
