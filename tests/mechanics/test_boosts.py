"""Boosts and Wigner's rotation."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.boosts import boost, compose_boosts, split_boost

Q = sp.Rational


def test_parallel_boosts_add_without_a_rotation():
    found = compose_boosts((Q(1, 2), 0, 0), (Q(1, 3), 0, 0))
    assert found.velocity == sp.ImmutableMatrix([Q(5, 7), 0, 0])
    assert found.rotation == sp.eye(3)


def test_perpendicular_boosts_leave_a_rotation():
    """cos = (g1 + g2)/(1 + g1 g2): with 3/5 and 4/5, g = 5/4 and 5/3 (Thomas 1927; Jackson, section 11.8)."""
    found = compose_boosts((Q(3, 5), 0, 0), (0, Q(4, 5), 0))
    assert found.velocity == sp.ImmutableMatrix([Q(3, 5), Q(16, 25), 0])
    first, second = Q(5, 4), Q(5, 3)
    assert found.cosine == (first + second) / (1 + first * second)
    assert found.rotation[2, 2] == 1
    assert found.rotation[0, 1] > 0  # from y towards x: against the turn from the second velocity to the first
    other = compose_boosts((0, Q(4, 5), 0), (Q(3, 5), 0, 0))
    assert other.rotation == found.rotation.T
    assert other.velocity.dot(other.velocity) == found.velocity.dot(found.velocity)


def test_a_general_pair_splits_and_multiplies_back():
    second, first = (Q(1, 2), Q(1, 2), 0), (0, Q(1, 3), Q(2, 3))
    found = compose_boosts(second, first)
    rotation = sp.diag(1, sp.Matrix(found.rotation))
    back = boost(found.velocity) * rotation
    difference = (back - boost(second) * boost(first)).applyfunc(lambda x: sp.N(x, 40))
    assert max(abs(x) for x in difference) < 1e-35


def test_the_speed_of_light_as_given():
    c = sp.Symbol("c", positive=True)
    found = compose_boosts((c / 2, 0, 0), (c / 3, 0, 0), c)
    assert sp.simplify(found.velocity[0] - 5 * c / 7) == 0


def test_a_boost_of_any_velocity_is_its_own_split():
    v = sp.Symbol("v", real=True)
    found = split_boost(boost((v, 0, 0)))
    assert (sp.simplify(found.velocity[0] - v), found.rotation) == (0, sp.eye(3))


def test_a_matrix_whose_entries_hide_their_zeros_is_split():
    """With 1 = √(3 + 2√2) − √2 in a corner, and in rapidities: exact, though nothing is simplified."""
    one, u = sp.sqrt(3 + 2 * sp.sqrt(2)) - sp.sqrt(2), sp.Symbol("u", real=True)
    assert split_boost(sp.diag(1, 1, 1, one)).velocity == sp.zeros(3, 1)
    found = split_boost([[sp.cosh(u), sp.sinh(u), 0, 0], [sp.sinh(u), sp.cosh(u), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert sp.simplify(found.velocity[0] - sp.tanh(u)) == 0
    with pytest.raises(InputError, match="handedness"):
        split_boost(sp.diag(1, 1, 1, -one))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: boost((1, 0, 0)), "below that of light"),
        (lambda: boost((Q(1, 2), 0)), "three components"),
        (lambda: split_boost(sp.diag(1, 1, 1, 2)), "no Lorentz"),
        (lambda: split_boost(sp.diag(-1, -1, -1, -1)), "turns time"),
        (lambda: split_boost(sp.diag(1, -1, 1, 1)), "handedness"),
        (lambda: split_boost(-boost((Q(3, 5), 0, 0))), "turns time"),
        (lambda: split_boost(sp.diag(1, 1, 1, 1 + Q(1, 10**70))), "is not g"),
        (lambda: boost(("__import__('os')", 0, 0)), "an expression is expected"),
        (lambda: boost((0.5, 0, 0)), "Rational"),
        (lambda: boost((0, sp.sqrt(3 + 2 * sp.sqrt(2)) - sp.sqrt(2), 0)), "below that of light"),
        (lambda: boost((Q(1, 2), 0, 0), 0), "speed of light"),
        (lambda: boost((Q(1, 2), 0, 0), -1), "speed of light"),
        (lambda: boost((sp.I / 2, 0, 0)), "real"),
        (lambda: split_boost(3), "four rows"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
