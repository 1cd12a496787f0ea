"""Assembles a model from bodies and the contributions of the effects that a scene names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.scenes.bodies import Start
from canon.scenes.effects.effect import Contribution, Particle, Surroundings, Vector, square
from canon.scenes.model import Formula, Friction, Model, Term
from canon.scenes.multiplied_out import check_size
from canon.scenes.own_hamiltonian import angular_momenta

KINETIC: Final = "kinetic"
Named = tuple[str, Contribution]


def model_of_bodies(surroundings: Surroundings, effects: Sequence[Named]) -> Model:
    """The model of bodies under effects, each with the name of its kind."""
    bodies = surroundings.particles
    shifts = {body.name: shift_of(body, effects) for body in bodies}
    terms = [Term(KINETIC, sp.Add(*(kinetic(body, body.p, surroundings) for body in bodies)))]
    terms += _shifted(bodies, effects, surroundings)
    for kind, part in effects:
        terms += [Term(kind, expr) for expr in (part.generator, part.potential) if expr != 0]
    q = tuple(symbol for body in bodies for symbol in body.x)
    p = tuple(symbol for body in bodies for symbol in body.p)
    H = sp.Add(*(term.expr for term in terms))
    frictions = tuple(
        _friction(kind, part, bodies, shifts, effects, H, surroundings)
        for kind, part in effects
        if part.rates or part.resistance is not None
    )
    lrl = next((part.lrl for _, part in effects if part.lrl), {})
    places, momenta = ([tuple(getattr(body, word)) for body in bodies] for word in ("x", "p"))
    total = {f"P_{axis}": sp.Add(*column) for axis, column in zip("xyz", zip(*momenta, strict=True), strict=False)}
    held = tuple((kind, g) for kind, part in effects for g in part.constraints)
    if held:
        _check_constrained(effects, surroundings)
    mass = tuple(body.mass for body in bodies for _ in body.x)
    scatters = {name: V for _, part in effects for name, V in part.scatters.items()}
    turning = angular_momenta(places, momenta)
    slack = [part.unilateral for _, part in effects for _ in part.constraints]
    strings = tuple(k for k, unilateral in enumerate(slack) if unilateral)
    charge = tuple(body.charge or sp.S.Zero for body in bodies for _ in body.x)
    return Model(
        q, p, surroundings.t, tuple(terms), frictions, total, turning, lrl, held, strings, mass, charge, scatters
    )


def _check_constrained(effects: Sequence[Named], surroundings: Surroundings) -> None:
    """Refuse what constraints can't be joined with."""
    for kind, part in effects:
        if surroundings.relativistic and (part.rates or part.resistance is not None):
            raise InputError(
                f"the effect {kind!r} together with a constraint is not available in relativistic dynamics", "effect"
            )
        if surroundings.relativistic and part.unilateral:
            raise InputError("a string is not available in relativistic dynamics", "effect")


def model_of_system(model: Model, effects: Sequence[Named]) -> Model:
    """A system in its own coordinates under further effects; friction is −2λp."""
    terms = [*model.terms, *(Term(kind, part.potential) for kind, part in effects if part.potential != 0)]
    frictions = []
    for kind, part in effects:
        for rate in part.rates.values():
            D = 2 * rate * sp.eye(model.n)
            force = tuple(-2 * rate * p for p in model.p)
            frictions.append(Friction(kind, force, D.as_immutable(), (sp.S.Zero,) * model.n, rate))
    return Model(
        model.q, model.p, model.t, tuple(terms), tuple(frictions), model.momenta, model.angular_momenta, model.lrl
    )


def kinetic(body: Particle, p: Vector, surroundings: Surroundings) -> Formula:
    """p²/2m, or √(p²c² + m²c⁴)."""
    if not surroundings.relativistic:
        return square(p) / (2 * body.mass)
    c = surroundings.constants.get("c", sp.S.One)
    return sp.sqrt(square(p) * c**2 + body.mass**2 * c**4)


def shift_of(body: Particle, effects: Sequence[Named]) -> Vector:
    """The sum of the effects' shifts of a body's momentum."""
    found: list[Formula] = [sp.S.Zero] * body.dimension
    for _, part in effects:
        for k, value in enumerate(part.shift.get(body.name, ())):
            found[k] += value
    return tuple(found)


def _shifted(bodies: Sequence[Particle], effects: Sequence[Named], surroundings: Surroundings) -> list[Term]:
    """What the shifts change of the kinetic energy: T(p − s) − T(p)."""
    kinds = [kind for kind, part in effects if part.shift]
    if not kinds:
        return []
    changes = []
    for body in bodies:
        s = shift_of(body, effects)
        if any(value != 0 for value in s):
            moved = kinetic(body, tuple(p - value for p, value in zip(body.p, s, strict=True)), surroundings)
            change = moved - kinetic(body, body.p, surroundings)
            changes.append(change if surroundings.relativistic else sp.expand(check_size(change, "effect")))
    return [Term(kinds[0], sp.Add(*changes))]


def _friction(
    kind: str,
    part: Contribution,
    bodies: Sequence[Particle],
    shifts: dict[str, Vector],
    effects: Sequence[Named],
    H: Formula,
    surroundings: Surroundings,
) -> Friction:
    """−2 m λ v, or −α v, of the velocity v = ∂H/∂p."""
    p = [symbol for body in bodies for symbol in body.p]
    masses: list[Any] = [body.mass for body in bodies for _ in body.p]
    alpha = sp.zeros(len(p), len(p))
    if part.resistance is not None:
        alpha += part.resistance
    rates = [part.rates.get(body.name, sp.S.Zero) for body in bodies for _ in body.p]
    alpha += sp.diag(*(2 * m * rate for m, rate in zip(masses, rates, strict=True)))
    same = rates[0] if part.resistance is None and len({*rates}) == 1 else None
    if surroundings.relativistic:
        velocity = sp.Matrix([H.diff(y) for y in p])
        return Friction(kind, tuple(-(alpha * velocity)))
    generator = sp.Add(*(other.generator for _, other in effects))
    at_rest = [value for body in bodies for value in shifts[body.name]]
    at_rest = [s - m * generator.diff(y) for s, m, y in zip(at_rest, masses, p, strict=True)]
    D = alpha * sp.diag(*(1 / m for m in masses))
    force = -(D * (sp.Matrix(p) - sp.Matrix(at_rest)))
    return Friction(kind, tuple(force), D.as_immutable(), tuple(at_rest), same)


@dataclass(frozen=True)
class InitialState:
    """q and p at the beginning, as floats, in the file's order."""

    q: tuple[float, ...]
    p: tuple[float, ...]


def initial_state(starts: Sequence[Start], surroundings: Surroundings, effects: Sequence[Named]) -> InitialState:
    """The canonical state: p = m γ u + s with u = v − ∂G/∂p, the velocity in the frame at rest.

    **Raises:** `InputError` for a body as fast as light.
    """
    generator = sp.Add(*(part.generator for _, part in effects))
    here: dict[Any, Any] = {surroundings.t: sp.S.Zero}
    for start in starts:
        here |= dict(zip(start.particle.x, start.position, strict=True))
    q, p = list[float](), list[float]()
    for index, start in enumerate(starts, 1):
        body = start.particle
        q += map(float, start.position)
        if start.momentum is not None:
            p += map(float, start.momentum)
            continue
        velocity = start.velocity or ()
        u = [v - generator.diff(y).xreplace(here) for v, y in zip(velocity, body.p, strict=True)]
        gamma: Any = sp.S.One
        if surroundings.relativistic:
            c = surroundings.constants.get("c", sp.S.One)
            slow = 1 - square(tuple(u)) / c**2
            if not slow > 0:
                raise InputError("the velocity is not below the speed of light c", f"body {index}, key 'velocity'")
            gamma = 1 / sp.sqrt(slow)
        s = [value.xreplace(here) for value in shift_of(body, effects)]
        p += [float(body.mass * gamma * w + value) for w, value in zip(u, s, strict=True)]
    return InitialState(tuple(q), tuple(p))
