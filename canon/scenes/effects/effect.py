"""What an effect is: its name, its parameters, and what it adds to a scene that names it.

An effect that a scene does not name is not called: it adds no term, no state and no operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.model import Formula
from canon.scenes.rigid import RigidBody
from canon.scenes.skates import Blade
from canon.scenes.values import expression, needed
from canon.vocabulary import nearest

Vector = tuple[Formula, ...]
AXES = "xyz"
RADIUS = sp.Symbol("r", positive=True)
"""The distance from the centre, in potentials that are given in r."""


@dataclass(frozen=True)
class Particle:
    """A body as effects see it: its place `x` and canonical momentum `p` (d symbols each), mass and charge.

    The variables of a system in its own coordinates are one particle too; its mass is None, as an absent charge is.
    """

    name: str
    x: tuple[sp.Symbol, ...]
    p: tuple[sp.Symbol, ...]
    mass: Formula
    charge: Formula = None

    @property
    def dimension(self) -> int:
        """Components of its place."""
        return len(self.x)

    @property
    def names(self) -> Mapping[str, Formula]:
        """Its coordinates by the names that expressions use: x, y, z; a system's own."""
        if self.mass is None:
            return {symbol.name: symbol for symbol in self.x}
        return dict(zip(AXES, self.x, strict=False))


@dataclass(frozen=True)
class Surroundings:
    """What an effect may ask of its scene."""

    particles: tuple[Particle, ...]
    constants: Mapping[str, Formula]
    t: sp.Symbol
    relativistic: bool = False
    is_system: bool = False
    rigid: tuple[RigidBody, ...] = ()


@dataclass(frozen=True)
class Contribution:
    """What one effect adds.

    **Arguments:** `potential` V(x, t), and `generator` G(x, p, t), linear in the momenta: both are terms of H; `shift`,
    for each particle's name the s(x, t) that takes p to p − s in its kinetic energy; `rates`, for each particle's name
    the λ of a force −2 m λ v; `resistance`, the matrix α of a force −α v, over all coordinates; `constraints`, the
    g(x, t) that it keeps at 0, or below where it is `unilateral`; `lrl`, the Laplace–Runge–Lenz vector of the motion
    that this effect alone makes; `index`, for each ray's name the refractive index n(x), which makes the body one;
    `scatters`, for each particle's name the potential V(r) that deflects it, in the symbol `RADIUS`; `torques`, for
    each rigid body's name the one on it that has no potential, in the body's frame; `blades`, for each particle's name
    the skate that it is on.
    """

    potential: Formula = sp.S.Zero
    generator: Formula = sp.S.Zero
    shift: Mapping[str, Vector] = field(default_factory=dict)
    rates: Mapping[str, Formula] = field(default_factory=dict)
    resistance: Formula | None = None
    constraints: tuple[Formula, ...] = ()
    unilateral: bool = False
    lrl: Mapping[str, Formula] = field(default_factory=dict)
    index: Mapping[str, Formula] = field(default_factory=dict)
    scatters: Mapping[str, Formula] = field(default_factory=dict)
    torques: Mapping[str, Vector] = field(default_factory=dict)
    blades: Mapping[str, Blade] = field(default_factory=dict)


@dataclass(frozen=True)
class Effect:
    """An effect of the catalogue: `parameters` (those in `optional` can be left out), `breaks`, the monitors that it
    breaks in general, and `add`, from what a scene gives it to its contribution. `on_systems`: it also acts on a system
    in its own coordinates. `on_rigid`: it acts on rigid bodies, and on nothing else.
    """

    kind: str
    meaning: str
    parameters: tuple[str, ...]
    breaks: tuple[str, ...]
    add: Callable[[Given], Contribution]
    optional: tuple[str, ...] = ()
    hamiltonian: bool = True
    on_systems: bool = False
    on_rigid: bool = False


class Given:
    """An effect's table in a scene file, read in the names that are open to it."""

    def __init__(self, table: Table, surroundings: Surroundings, where: str) -> None:
        self.table = table
        self.where = where
        self.surroundings = surroundings

    @property
    def kind(self) -> str:
        """The name of the effect."""
        return str(self.table.get("kind", ""))

    def has(self, name: str) -> bool:
        """Whether the key is given."""
        return name in self.table

    def place(self, name: str) -> str:
        """The place of a key, for errors."""
        return key(name, self.where)

    def fail(self, message: str, name: str = "") -> InputError:
        """An error at a key."""
        return InputError(message, self.place(name) if name else self.where)

    @property
    def particles(self) -> tuple[Particle, ...]:
        """The bodies that it acts on: those of `bodies`, or all. **Raises:** `InputError` for one that there isn't."""
        return self._named(self.surroundings.particles)

    @property
    def rigid(self) -> tuple[RigidBody, ...]:
        """The rigid bodies that it acts on: those of `bodies`, or all. **Raises:** `InputError`."""
        return self._named(self.surroundings.rigid)

    def _named(self, everything: tuple[Any, ...]) -> tuple[Any, ...]:
        known = {particle.name: particle for particle in everything}
        if "bodies" not in self.table:
            return everything
        names = document.listing(self.table["bodies"], self.place("bodies"), document.BIGGEST)
        for name in names:
            if name not in known:
                advice = nearest(str(name), known) or f": the bodies are {', '.join(known)}"
                raise self.fail(f"there is no body {str(name)[:80]!r}{advice}", "bodies")
            if names.count(name) > 1:
                raise self.fail(f"the body {name!r} is listed twice", "bodies")
        return tuple(known[name] for name in names)

    @property
    def charged(self) -> tuple[Particle, ...]:
        """The bodies with a charge that it acts on. **Raises:** `InputError` where one of `bodies` has none, or all."""
        without = [particle.name for particle in self.particles if particle.charge is None]
        if without and ("bodies" in self.table or len(without) == len(self.particles)):
            raise self.fail(f"the body {without[0]!r} has no charge: give it one, as in charge = -1.0")
        return tuple(particle for particle in self.particles if particle.charge is not None)

    def names(self, particle: Particle | None, *more: str) -> dict[str, Formula]:
        """The names open to an expression: a particle's coordinates, or none; time; the constants."""
        own = dict(particle.names) if particle is not None else {}
        return {**self.surroundings.constants, "t": self.surroundings.t, **own, **dict.fromkeys(more)}

    def formula(self, name: str, particle: Particle | None = None, default: Any = None) -> Formula:
        """A number, or an expression in a particle's coordinates and time (in time alone where there is none)."""
        value = needed(self.table, name, self.where) if default is None else self.table.get(name, default)
        return expression(value, self.names(particle), self.place(name))

    def vector(self, name: str, dimension: int, particle: Particle | None = None, default: Any = None) -> Vector:
        """A vector of this dimension; a number in its place acts along the last axis."""
        value = needed(self.table, name, self.where) if default is None else self.table.get(name, default)
        if not isinstance(value, list):
            return (*(sp.S.Zero,) * (dimension - 1), expression(value, self.names(particle), self.place(name)))
        if len(value) != dimension:
            raise self.fail(f"{len(value)} components where the bodies have {dimension}", name)
        return tuple(
            expression(item, self.names(particle), f"{self.place(name)}, entry {i}") for i, item in enumerate(value, 1)
        )

    def axial(self, name: str, dimension: int, particle: Particle | None = None) -> Vector:
        """An axial vector (3,): in a plane a number, along its normal; in space a vector, or a number along z.

        **Raises:** `InputError` on a line.
        """
        if dimension == 1:
            raise self.fail("on a line there is nothing to turn about: give positions in a plane or in space")
        value = needed(self.table, name, self.where)
        if dimension == 2 and isinstance(value, list) and len(value) != 3:
            raise self.fail("in a plane this is a number, along the plane's normal", name)
        found = self.vector(name, 3, particle)
        if dimension == 2 and any(component != 0 for component in found[:2]):
            raise self.fail("in a plane only the component along its normal can be other than 0", name)
        return found

    def from_centre(self, particle: Particle, name: str = "centre") -> Vector:
        """The particle's place as seen from the centre, the origin where it is left out."""
        value = self.table.get(name)
        if value is None:
            return tuple(particle.x)
        centre = self.vector(name, particle.dimension)
        if not isinstance(value, list):
            raise self.fail("a centre is a list of components", name)
        return tuple(x - c for x, c in zip(particle.x, centre, strict=True))


def length(vector: Vector) -> Formula:
    """|v|; on a line the absolute value."""
    return sp.Abs(vector[0]) if len(vector) == 1 else sp.sqrt(square(vector))


def square(vector: Vector) -> Formula:
    """v·v."""
    return sp.Add(*(component**2 for component in vector))


def dot(a: Vector, b: Vector) -> Formula:
    """a·b."""
    return sp.Add(*(x * y for x, y in zip(a, b, strict=True)))


def cross(a: Vector, b: Vector) -> Vector:
    """a × b of vectors (3,)."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def in_space(vector: Vector) -> Vector:
    """A vector of a plane or of space, as one of space."""
    return (*vector, *(sp.S.Zero,) * (3 - len(vector)))


def lrl_vector(mass: Formula, a: Formula, x: Vector, p: Vector) -> dict[str, Formula]:
    """A = p × (x × p) − m a x/|x|, the components in the motion's plane or space. Goldstein, 3.9."""
    full = [
        value - mass * a * y / length(x)
        for value, y in zip(cross(in_space(p), cross(in_space(x), in_space(p))), in_space(x), strict=True)
    ]
    return {f"A_{axis}": component for axis, component in zip(AXES, full[: len(x)], strict=False)}
