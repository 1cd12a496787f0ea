"""Four-vectors and tensors with the metric."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.boosts import boost
from canon.mechanics.four_tensors import (
    FourTensor,
    doppler,
    field_tensor,
    fields_of,
    four_force,
    four_vector,
    four_velocity,
)

Q = sp.Rational
E, B = (2, -1, 3), (1, 4, -2)
BOOST = boost((Q(3, 5), 0, 0))


def test_a_lower_vector_has_the_opposite_space():
    a = four_vector((5, 1, 2, 3))
    assert list(a.with_index(0, "d").components) == [5, -1, -2, -3]
    assert a.with_index(0, "d").with_index(0, "u") == a
    assert a.square == a.dot(a) == 11


def test_scalar_products_are_the_same_in_every_frame():
    a, b = four_vector((5, 1, 2, 3)), four_vector((Q(1, 2), 0, 7, -4))
    assert a.transformed(BOOST) != a
    assert a.transformed(BOOST).dot(b.transformed(BOOST)) == a.dot(b)
    lower = b.with_index(0, "d")
    assert lower.transformed(BOOST) == b.transformed(BOOST).with_index(0, "d")


def test_the_four_velocity_is_as_long_as_light_is_fast():
    c = sp.Symbol("c", positive=True)
    u = four_velocity((0, 2, 1), 3)
    assert u.square == 9
    assert u[2] / u[0] == Q(2, 3)
    assert sp.simplify(four_velocity((c / 2, 0, 0), c).square - c**2) == 0


def test_fields_across_a_boost_mix():
    """E'_∥ = E_∥, E'_⊥ = γ (E + v × B)_⊥, B'_⊥ = γ (B − v × E)_⊥ (Jackson, eq. 11.149)."""
    into = boost((-Q(3, 5), 0, 0))  # the frame that moves with v = 3/5 along x
    electric, magnetic = fields_of(field_tensor(E, B).transformed(into))
    g, v = Q(5, 4), Q(3, 5)
    assert electric == (E[0], g * (E[1] - v * B[2]), g * (E[2] + v * B[1]))
    assert magnetic == (B[0], g * (B[1] + v * E[2]), g * (B[2] - v * E[1]))


def test_the_invariants_of_the_fields():
    F = field_tensor(E, B)
    two = 2 * (sum(x * x for x in B) - sum(x * x for x in E))
    assert F.square == F.transformed(BOOST).square == two
    lower = F.with_index(1, "d")
    assert lower.indices == "ud"
    assert lower.contracted(0, 1).value == 0  # antisymmetric
    assert fields_of(lower.with_index(0, "d")) == (E, B)


def test_the_four_force_is_lorentz_s():
    """γ q (E·v/c, E + v × B), orthogonal to the four-velocity."""
    v, c, charge = (1, 2, -1), 5, Q(7, 2)
    u = four_velocity(v, c)
    force = four_force(charge, field_tensor(E, B, c), u)
    gamma = u[0] / c
    cross = sp.Matrix(v).cross(sp.Matrix(B))
    assert [sp.simplify(force[k + 1] - gamma * charge * (E[k] + cross[k])) for k in range(3)] == [0, 0, 0]
    assert sp.simplify(force[0] - gamma * charge * sp.Matrix(E).dot(sp.Matrix(v)) / c) == 0
    assert sp.simplify(force.dot(u)) == 0


def test_doppler_along_and_across_and_where_nothing_is_shifted():
    assert doppler((Q(3, 5), 0, 0), (1, 0, 0)) == Q(1, 2)  # receding
    assert doppler((-Q(3, 5), 0, 0), (1, 0, 0)) == 2
    assert doppler((0, Q(3, 5), 0), (2, 0, 0)) == Q(4, 5)  # across: time dilation
    sine = sp.sqrt(1 - Q(1, 9))  # exercise 15.1: cos = −1/3
    assert doppler((-Q(1, 5), Q(3, 5) * sine, 0), (1, 0, 0)) == 1


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: FourTensor([1, 2, 3], "u"), "components 4"),
        (lambda: FourTensor([[1, 2], [3]], "uu"), "components 4 × 4"),
        (lambda: FourTensor([1, 2, 3, 4], "x"), "letters"),
        (lambda: FourTensor([0.5, 0, 0, 0], "u"), "components"),
        (lambda: field_tensor(E, B).contracted(0, 1), "an upper and a lower"),
        (lambda: field_tensor(E, B).value, "no scalar"),
        (lambda: four_vector((1, 0, 0, 0)).transformed(2 * sp.eye(4)), "is not g"),
        (lambda: four_vector((1, 0, 0, 0)).with_index(1, "d"), "there is no 1"),
        (lambda: fields_of(FourTensor(sp.eye(4).tolist(), "uu")), "antisymmetric"),
        (lambda: doppler((2, 0, 0), (1, 0, 0)), "isn't below"),
        (lambda: doppler((0, 0, 0), (0, 0, 0)), "isn't 0"),
        (lambda: field_tensor((1, 2), B), "three components"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
