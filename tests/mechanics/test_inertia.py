"""Inertia tensors: textbook bodies, parallel axes, composites and polyhedra, exactly."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.inertia import RigidBody, composite, point_masses, polyhedron, principal_moments

a, b, c, m, M = sp.symbols("a b c m M", positive=True)
BOX = [(x, y, z) for x in (0, a) for y in (0, b) for z in (0, c)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def test_two_atoms():
    """mu d² about the centre, 0 along the line (Landau and Lifshitz, Mechanics, § 32, problem 1)."""
    body = point_masses([m, M], [(0, 0, 0), (0, 0, a)])
    mu = m * M / (m + M)
    assert sp.simplify(body.tensor - sp.diag(mu * a**2, mu * a**2, 0)).is_zero_matrix
    assert sp.simplify(body.about_axis((0, 0, 0), (1, 0, 0)) - M * a**2) == 0


def test_a_box_as_a_polyhedron():
    body = polyhedron(BOX, FACES, density=M / (a * b * c))
    assert sp.simplify(body.mass - M) == 0
    assert body.centre == sp.ImmutableMatrix([a / 2, b / 2, c / 2])
    wanted = sp.diag(b**2 + c**2, a**2 + c**2, a**2 + b**2) * M / 12
    assert sp.simplify(body.tensor - wanted).is_zero_matrix
    assert sp.simplify(body.about((0, 0, 0))[0, 1] + M * a * b / 4) == 0  # −∫ x y dm


def test_a_tetrahedron_and_its_principal_moments():
    body = polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    assert body.mass == sp.Rational(1, 6)
    assert body.centre == sp.ImmutableMatrix([sp.Rational(1, 4)] * 3)
    assert body.about((0, 0, 0))[0, 0] == sp.Rational(1, 30)
    assert body.about((0, 0, 0))[0, 1] == -sp.Rational(1, 120)
    third = sp.Rational(1, 96)
    assert principal_moments(body.tensor) == (third, third, sp.Rational(1, 60))


def test_a_box_with_a_hole_is_the_box_less_a_body():
    big = polyhedron(BOX, FACES).moved((-a / 2, -b / 2, -c / 2))
    small = RigidBody(-big.mass / 8, big.centre, -big.tensor / 32)
    rest = composite([big, small])
    assert sp.simplify(rest.mass - a * b * c * sp.Rational(7, 8)) == 0
    assert sp.simplify(rest.tensor - sp.Rational(31, 32) * big.tensor).is_zero_matrix


def test_turning_and_parallel_axes():
    body = point_masses([1, 2, 3], [(1, 0, 0), (0, 2, 0), (0, 0, 1)])
    R = sp.Matrix([[sp.Rational(3, 5), -sp.Rational(4, 5), 0], [sp.Rational(4, 5), sp.Rational(3, 5), 0], [0, 0, 1]])
    places = [R * sp.Matrix(v) for v in ((1, 0, 0), (0, 2, 0), (0, 0, 1))]
    assert body.turned(R) == point_masses([1, 2, 3], places)
    moved = point_masses([1, 2, 3], [(2, 1, 1), (1, 3, 1), (1, 1, 2)])
    assert body.moved((1, 1, 1)) == moved
    assert body.about((-1, -1, -1)) == moved.about((0, 0, 0))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: polyhedron(BOX, FACES[1:]), "shared by two faces"),
        (lambda: polyhedron(BOX, [f[::-1] for f in FACES]), "from inside"),
        (lambda: polyhedron(BOX, [(0, 1)]), "at least three"),
        (lambda: polyhedron(BOX, [(0, 1, 8)]), "corners 0 to 7"),
        (lambda: polyhedron(BOX, [(0, -1, 2)]), "corners 0 to 7"),
        (lambda: point_masses([1], [(0, 0, 0)]).turned([[1, 0, 0], [0, 1], [0, 0, 1]]), "rotation"),
        (lambda: point_masses([1, -1], [(0, 0, 0), (1, 0, 0)]), "without mass"),
        (lambda: point_masses([1], []), "1 masses"),
        (lambda: point_masses([1], [(0, 0)]), "three components"),
        (lambda: point_masses([1], [(0, 0, 0)]).turned(2 * sp.eye(3)), "rotation"),
        (lambda: principal_moments([[1, 2, 0], [0, 1, 0], [0, 0, 1]]), "symmetric"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
