"""Motions that go on for ever: where Hamilton's equations have a solution at all times that stays in the domain.

What is said of "every motion that stays in the domain, for ever" is refuted by such a motion alone: H = p²/2 − exp(q)
has none with H < 0, each of them being at infinity after a finite time. A motion that a region never lets go (each of
its walls is a constant of the motion) goes on for ever if Hamilton's equations are linear in q and p, or if H is
Σ a p²/2 + V(q) with constants a > 0 and V bounded from below: p is bounded then by the energy, and q grows no faster
than time (Abraham and Marsden, Foundations of Mechanics, sections 2.1 and 3.7).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.along_a_range import holds, is_positive
from canon.claims.chart import required_of
from canon.claims.outcome import Residual
from canon.deadline import within
from canon.decide.derivative import derivative, poisson_bracket, substitute
from canon.decide.intervals import intervals_of
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.region import Region, Requirement
from canon.decide.regular_on_box import is_regular
from canon.decide.tape import Node, Unsupported
from canon.errors import InputError
from canon.sign import declared

if TYPE_CHECKING:
    from canon.claims.question import Question

DEPTHS = (0, 1, 10, 1000)
"""How far below 0 a potential may lie."""
MOST = 6
"""Equilibria that are looked at."""


def goes_on_for_ever(question: Question, H: Node, region: Region) -> bool:
    """Whether the motion of H through every point of the region is shown to stay in it at all times."""
    if region.surface or any(r.kind not in ("positive", "nonzero") for r in region.requirements):
        return False
    space, tape = question.space, question.tape
    q, p, t = question.nodes(space.q), question.nodes(space.p), tape.symbol(space.t)
    moving = {x: tape.symbol_at(x) for x in (*q, *p, t)}
    if any(not declared(symbol).get("real") or declared(symbol).get("integer") for symbol in moving.values()):
        return False
    rates = [_rate(question, H, r) for r in _walls(question, region)]
    if rates and question.decide(rates, region).status != "proved":
        return False
    return _linear(question, H, (*q, *p), region) or _bounded_below(question, H, q, p, t, region)


def leaves_by(question: Question, H: Node, region: Region) -> Requirement | None:
    """A wall of the region that isn't shown to keep motions in; None where each does.

    Motions don't pass a wall that is a constant of the motion, nor one at which H itself has no value. Where all
    motions may leave, what is said of those that stay says nothing: with H = p none stays where q < 1.
    """
    tape = question.tape
    own = Region.of(tape, replace(question.subject.domain, conditions=question.hamiltonian().conditions, surface=()))
    walls = [
        r
        for r in _walls(question, region)
        if r.kind not in ("positive", "nonzero", "slit") or not has_no_zero(tape, r.nodes[0], own, question.budget)
    ]
    for r in walls:
        if r.kind == "regular" and is_regular(tape, r.nodes[0], intervals_of(tape, own), question.budget):
            continue
        if r.kind not in ("positive", "nonzero") or question.decide([_rate(question, H, r)], region).status != "proved":
            return r
    return None


def some_motion_lasts(question: Question, H: Node, region: Region) -> bool:
    """Whether there is a motion in the region that goes on for ever: all of them do, or one rests at an equilibrium.

    Where none does, what is said of those that do says nothing: with H = p cosh² q all are at infinity within a time 2.
    """
    return goes_on_for_ever(question, H, region) or any(
        _is_equilibrium(question, H, region, place) for place in _places_of_rest(question)
    )


def _places_of_rest(question: Question) -> list[dict[sp.Symbol, sp.Expr]]:
    """Where the gradient of H may vanish: the origin, and what sympy finds. A guess, that is verified."""
    variables, H = question.space.old, question.hamiltonian().expr
    origin: dict[sp.Symbol, sp.Expr] = dict.fromkeys(variables, sp.S.Zero)
    found: Any = []
    with suppress(ArithmeticError, BudgetExceeded, NotImplementedError, TypeError, ValueError):
        slopes = [sp.diff(H, x) for x in variables]
        found = within(question.budget.share(0.2), lambda: sp.solve(slopes, variables, dict=True))
    return [origin, *(place for place in found[:MOST] if set(place) == {*variables})]


def _is_equilibrium(question: Question, H: Node, region: Region, place: dict[sp.Symbol, sp.Expr]) -> bool:
    tape, t = question.tape, question.tape.symbol(question.space.t)
    try:
        images = {tape.symbol(x): tape.load(value) for x, value in place.items()}
        slopes = [substitute(tape, derivative(tape, H, x), images) for x in images]
        asked = [replace(r, nodes=tuple(substitute(tape, n, images) for n in r.nodes)) for r in region.requirements]
        asked += [r for x, y in images.items() for r in required_of(tape, tape.symbol_at(x), y)]
    except (ArithmeticError, InputError, Unsupported):
        return False
    own = [r for r in region.requirements if not any(tape.support(n) & {*images, t} for n in r.nodes)]
    constants = Region(tuple(own), (), ())
    if region.surface or not all(r in own or holds(question, r, constants) for r in asked):
        return False
    return question.decide([Residual("slope of H", slope) for slope in slopes], constants).status == "proved"


def _walls(question: Question, region: Region) -> list[Requirement]:
    """What the region demands of what moves, and what is assumed of it."""
    tape, space = question.tape, question.space
    moving = {tape.symbol(x): x for x in (*space.old, space.t)}
    walls = [r for r in region.requirements if any(tape.support(n) & {*moving} for n in r.nodes)]
    return walls + [r for x, symbol in moving.items() for r in required_of(tape, symbol, x)]


def _rate(question: Question, H: Node, r: Requirement) -> Residual:
    """dg/dt along the motion, for a wall g."""
    tape, space, (g, *_) = question.tape, question.space, r.nodes
    q, p = question.nodes(space.q), question.nodes(space.p)
    return Residual(r.text, tape.plus(poisson_bracket(tape, g, H, q, p), derivative(tape, g, tape.symbol(space.t))))


def _linear(question: Question, H: Node, z: Sequence[Node], region: Region) -> bool:
    """Whether H is of second degree in q and p, with coefficients that depend on time at most."""
    tape = question.tape
    second = [derivative(tape, derivative(tape, H, x), y) for i, x in enumerate(z) for y in z[i:]]
    if all(tape.support(node).isdisjoint(z) for node in second):
        return True
    third = [Residual("third derivative of H", derivative(tape, node, x)) for node in second for x in z]
    return question.decide(third, region).status == "proved"


def _bounded_below(question: Question, H: Node, q: Sequence[Node], p: Sequence[Node], t: Node, region: Region) -> bool:
    """Whether H is Σ a p²/2 + V(q), a > 0, and V has a lower bound on the region."""
    tape = question.tape
    if t in tape.support(H):
        return False
    potential = substitute(tape, H, dict.fromkeys(p, tape.zero))
    inertias = [derivative(tape, derivative(tape, H, x), x) for x in p]
    if any(tape.support(a) & {*q, *p} or not is_positive(question, a, region) for a in inertias):
        return False
    squares = [tape.times(a, x, x) for a, x in zip(inertias, p, strict=True)]
    kinetic = tape.add([(square, 1) for square in squares])
    rest = tape.minus(tape.scaled(tape.minus(H, potential), 2), kinetic)
    if question.decide([Residual("kinetic energy", rest)], region).status != "proved":
        return False
    return any(is_positive(question, tape.add([(potential, 1)], depth), region, strict=False) for depth in DEPTHS)
