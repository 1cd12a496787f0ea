"""Composition in every direction, its domain, and the extension by time: laws of the group of canonical maps."""

from itertools import product

import pytest
import sympy as sp

from canon import GeneratingFunction, InputError, PhaseSpace, Transformation
from canon.mechanics.composition import compose, extended_by_time

SPACE = PhaseSpace("q", "p", new=("Q", "P"))
(q, p), (Q, P) = SPACE.old, SPACE.new
# each of them as Q(q, p), as q(Q, P), and by F₂
KICK = (
    Transformation(SPACE, Q=q, P=p + q**3),
    Transformation(SPACE, q=Q, p=P - Q**3),
    GeneratingFunction(SPACE, 2, q * P - q**4 / 4).transformation(),
)
DRIFT = (
    Transformation(SPACE, Q=q + 2 * p, P=p),
    Transformation(SPACE, q=Q - 2 * P, p=P),
    GeneratingFunction(SPACE, 2, q * P + P**2).transformation(),
)


@pytest.mark.parametrize(("one", "two"), list(product(range(3), repeat=2)))
def test_however_two_maps_are_given_their_composition_is_the_same(one: int, two: int, vanishes) -> None:
    """The first, then the second: Q = q + 2(p + q³), P = p + q³."""
    both = compose(KICK[one], DRIFT[two])
    assert both.direction == ("backward" if one == 1 else "forward")
    known = (Q - 2 * P, P - (Q - 2 * P) ** 3) if one == 1 else (q + 2 * (p + q**3), p + q**3)
    assert vanishes(u - v for u, v in zip(both.expressions, known, strict=True))


def test_a_composition_is_asked_about_where_both_maps_are() -> None:
    """q > 1 of the first, and the q > 5 of the second at the image q³ of the first; a backward map keeps its own."""
    first, second = SPACE.where(q > 1), SPACE.where(q > 5)
    stretch = Transformation(first, Q=q**3, P=p / (3 * q**2))
    both = compose(stretch, Transformation(second, Q=q, P=p))
    assert {condition.terms for condition in both.space.domain.conditions} == {(q - 1,), (q**3 - 5,)}
    plain = compose(Transformation(first, Q=q, P=p + q), Transformation(SPACE, Q=q, P=p))
    assert plain.space.domain == first.domain
    back = compose(Transformation(first, q=Q, p=P), Transformation(second, q=Q, p=P))
    assert back.space.domain == first.domain


def test_names_of_a_composition_stay_apart() -> None:
    """A new name that is an old one of the first map is primed; one name for a variable and a parameter is refused."""
    crossed = PhaseSpace("Q", "P", new=("q", "p"))
    second = Transformation(crossed, Q=crossed.old[1], P=-crossed.old[0])
    both = compose(Transformation(SPACE, Q=q, P=p + q), second)
    assert [str(x) for x in both.space.new] == ["q_new", "p_new"]
    assert both.expressions == (p + q, -q)
    other = PhaseSpace("x", "y", new=("X", "Y"), real="q")
    with pytest.raises(InputError, match="'q' is a variable of one map and a parameter"):
        compose(KICK[0], Transformation(other, Q=other.old[0], P=other.old[1]))
    two = PhaseSpace("a b", "c d", new=("A B", "C D"))
    with pytest.raises(InputError, match="1 pairs cannot be put into 2"):
        compose(KICK[0], Transformation(two, Q=two.q, P=two.p))


@pytest.mark.parametrize("dimension", [1, 2])
def test_a_map_that_depends_on_time_is_canonical_beside_it(dimension: int, vanishes) -> None:
    """T = t, P_T = p_t − R: all brackets are the canonical ones; H + p_t goes into K + P_T, but for an f(t)."""
    names = [[f"{s}{k}" for k in range(dimension)] for s in "qpQP"]
    space = PhaseSpace(names[0], names[1], new=(names[2], names[3]))
    t = space.t
    moved = Transformation(
        space, Q=[x + t**2 * y for x, y in zip(space.q, space.p, strict=True)], P=[y + t for y in space.p]
    )
    extended = extended_by_time(moved)
    assert extended.space.n == dimension + 1
    assert vanishes(extended.symplectic_residual())
    H = sp.Add(*(y**2 / 2 + x**4 for x, y in zip(space.q, space.p, strict=True)))
    images = dict(zip(extended.space.new, extended.expressions, strict=True))
    K = moved.transformed(H).xreplace({t: extended.space.Q[-1]})
    difference = (K + extended.space.P[-1]).xreplace(images) - H - extended.space.p[-1]
    assert vanishes(difference.diff(x) for x in (*space.old, extended.space.p[-1]))
    assert str(extended.P[-1]).startswith(f"{extended.space.p[-1]} - (")
