"""Inertia tensors, exact: of masses, bodies put together, bodies moved and turned, and polyhedra."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, listed, whole_number
from canon.mechanics.formulas import as_expression
from canon.mechanics.vanishing import sign_at_a_point, vanishes

Vector = Sequence[Any]


@dataclass(frozen=True)
class RigidBody:
    """A rigid body: its mass, its centre of mass (3,), and the inertia tensor about the centre, (3, 3).

    The entries are sympy expressions; rational numbers stay exact. I_xx = Σ m (y² + z²), I_xy = −Σ m x y (Goldstein,
    Poole and Safko (2002), eq. 5.6).

    **Raises:** `InputError` for a centre that isn't three exact entries, or a tensor that isn't symmetric, 3 by 3.
    """

    mass: Any
    centre: sp.ImmutableMatrix
    tensor: sp.ImmutableMatrix

    def __post_init__(self) -> None:
        tensor = _square(self.tensor, "tensor")
        if tensor is None or not all(vanishes(entry) for entry in tensor - tensor.T):
            raise InputError("an inertia tensor is a symmetric 3 by 3 matrix", "tensor")
        object.__setattr__(self, "mass", as_expression(self.mass, "mass"))
        object.__setattr__(self, "centre", _vector(self.centre, "centre"))
        object.__setattr__(self, "tensor", tensor)

    def about(self, point: Vector) -> sp.ImmutableMatrix:
        """The tensor about any point, by the parallel axes (Steiner): I + m (d² 1 − d dᵀ), d = centre − point."""
        d = self.centre - _vector(point, "point")
        return sp.ImmutableMatrix((self.tensor + self.mass * _spread(d)).applyfunc(sp.expand))

    def about_axis(self, point: Vector, direction: Vector) -> Any:
        """The moment of inertia about the axis through a point in a direction, of any length but 0."""
        n = _vector(direction, "direction")
        square = n.dot(n)
        if vanishes(square):
            raise InputError("an axis needs a direction other than 0", "direction")
        return sp.simplify((n.T * self.about(point) * n)[0, 0] / square)

    def moved(self, shift: Vector) -> RigidBody:
        """The body at another place."""
        return RigidBody(self.mass, sp.ImmutableMatrix(self.centre + _vector(shift, "shift")), self.tensor)

    def turned(self, rotation: Any) -> RigidBody:
        """The body turned about the origin by a matrix R with RᵀR = 1: centre → R centre, I → R I Rᵀ.

        **Raises:** `InputError` where R isn't orthogonal.
        """
        R = _square(rotation, "rotation")
        if R is None or not all(vanishes(entry) for entry in R.T * R - sp.eye(3)):
            raise InputError("a rotation is a 3 by 3 matrix R with transpose(R) R = 1", "rotation")
        turned = (R * self.tensor * R.T).applyfunc(sp.expand)
        return RigidBody(self.mass, sp.ImmutableMatrix(R * self.centre), sp.ImmutableMatrix(turned))

    def __add__(self, other: RigidBody) -> RigidBody:
        return composite([self, other])


def point_masses(masses: Iterable[Any], places: Iterable[Vector]) -> RigidBody:
    """Masses at their places, joined rigidly.

    **Raises:** `InputError` where their numbers differ, there are none, or the whole mass is 0.
    """
    weights, points = (
        [as_expression(m, "masses") for m in listed(masses, "masses", "masses")],
        [_vector(r, "places") for r in listed(places, "places", "places")],
    )
    if not weights or len(weights) != len(points):
        raise InputError(f"{len(weights)} masses at {len(points)} places", "masses")
    return composite([RigidBody(m, r, sp.ImmutableMatrix.zeros(3, 3)) for m, r in zip(weights, points, strict=True)])


def composite(bodies: Iterable[RigidBody]) -> RigidBody:
    """Bodies joined to one; a hole is a body of negative mass. **Raises:** `InputError` where the whole mass is 0."""
    parts = listed(bodies, "bodies", "bodies")
    for part in parts:
        instance_of(part, RigidBody, "bodies")
    mass: Any = sp.simplify(sp.Add(*(b.mass for b in parts)))
    if vanishes(mass):
        raise InputError("a body without mass has no centre", "bodies")
    moment = sum((b.mass * b.centre for b in parts), sp.zeros(3, 1))
    centre = sp.ImmutableMatrix((moment / mass).applyfunc(sp.simplify))
    tensor: Any = sum((b.tensor + b.mass * _spread(b.centre - centre) for b in parts), sp.zeros(3, 3))
    return RigidBody(mass, centre, sp.ImmutableMatrix(tensor.applyfunc(sp.simplify)))


def polyhedron(vertices: Iterable[Vector], faces: Iterable[Sequence[int]], density: Any = 1) -> RigidBody:
    """A solid polyhedron of uniform density, exactly: the sum over the tetrahedra from the origin to its faces.

    Of a tetrahedron 0, a, b, c with det(a, b, c) = 6 V: ∫ x_i x_j dV = V/20 (Σ over a, b, c of each x_i x_j, and of
    s = a + b + c, s_i s_j) (Tonon, J. Math. Stat. 1, 2005).

    **Arguments:** the corners; the faces, each by the numbers (from 0) of its corners, anticlockwise as seen from
    outside; the density.

    **Raises:** `InputError` for a face with fewer than three corners or with one that there isn't, and for faces that
    don't close or are seen from inside (every edge must be run through once in each sense).
    """
    corners = [_vector(v, "vertices") for v in listed(vertices, "vertices", "vertices")]
    sides = [listed(face, "numbers of corners", "faces") for face in listed(faces, "faces", "faces")]
    _check_faces(sides, len(corners))
    volume, first, second = sp.Integer(0), sp.zeros(3, 1), sp.zeros(3, 3)
    for face in sides:
        a = corners[face[0]]
        for i, j in pairwise(face[1:]):
            b, c = corners[i], corners[j]
            sixth = sp.Matrix.hstack(a, b, c).det()
            s = a + b + c
            volume += sixth / 6
            first += sixth * s / 24
            second += sixth * (a * a.T + b * b.T + c * c.T + s * s.T) / 120
    volume: Any = sp.simplify(volume)
    if volume.is_negative or (volume.is_number and sign_at_a_point(volume) == -1):
        raise InputError("the faces are seen from inside: turn the order of their corners round", "faces")
    if vanishes(volume):
        raise InputError("the polyhedron has no volume", "faces")
    density = as_expression(density, "density")
    centre = sp.ImmutableMatrix((first / volume).applyfunc(sp.simplify))
    about_origin = density * (second.trace() * sp.eye(3) - second)
    tensor = about_origin - density * volume * _spread(centre)
    return RigidBody(density * volume, centre, sp.ImmutableMatrix(tensor.applyfunc(sp.simplify)))


def principal_moments(tensor: Any) -> tuple[Any, ...]:
    """The principal moments of a tensor, ascending where they are numbers, each as often as it occurs.

    **Raises:** `InputError` where the tensor isn't symmetric.
    """
    matrix = _square(tensor, "tensor")
    if matrix is None or not all(vanishes(entry) for entry in matrix - matrix.T):
        raise InputError("an inertia tensor is a symmetric 3 by 3 matrix", "tensor")
    roots: Any = matrix.eigenvals()
    found = [value for value, count in roots.items() for _ in range(int(count))]
    numbers = all(value.is_number for value in found)
    return tuple(sorted(found, key=lambda v: sp.re(v.evalf(30)))) if numbers else tuple(found)


def _spread(d: Any) -> Any:
    """d² 1 − d dᵀ."""
    return d.dot(d) * sp.eye(3) - d * d.T


def _vector(value: Any, where: str) -> sp.ImmutableMatrix:
    entries = [as_expression(x, where) for x in listed(value, "three components", where)]
    if len(entries) != 3:
        raise InputError(f"three components are expected, not {len(entries)}", where)
    return sp.ImmutableMatrix(entries)


def _square(value: Any, where: str) -> sp.ImmutableMatrix | None:
    """Three rows of three exact entries; None for another shape."""
    rows = value.tolist() if isinstance(value, sp.MatrixBase) else listed(value, "rows", where)
    rows = [listed(row, "entries", where) for row in rows]
    if len(rows) != 3 or any(len(row) != 3 for row in rows):
        return None
    return sp.ImmutableMatrix([[as_expression(entry, where) for entry in row] for row in rows])


def _check_faces(faces: Sequence[Sequence[int]], count: int) -> None:
    edges: dict[tuple[int, int], int] = {}
    for face in faces:
        for k in face:
            whole_number(k, "faces")
        if len(face) < 3 or any(not 0 <= k < count for k in face):
            raise InputError(f"a face is at least three of the corners 0 to {count - 1}, not {tuple(face)}", "faces")
        for edge in zip(face, (*face[1:], face[0]), strict=True):
            edges[edge] = edges.get(edge, 0) + 1
    for (i, j), times in edges.items():
        if times > 1 or edges.get((j, i), 0) != 1:
            said = f"the edge from corner {i} to corner {j} isn't shared by two faces, once in each sense"
            raise InputError(said, "faces")
