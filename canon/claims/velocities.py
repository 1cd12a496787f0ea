"""Claims about functions of coordinates and velocities: their domain, and total derivatives by time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from canon.claims.bracket import names
from canon.claims.chart import chart_of
from canon.decide.derivative import derivative
from canon.decide.tape import Node, Tape
from canon.domain import Domain
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    import sympy as sp

    from canon.claims.question import Question
    from canon.decide.region import Region


@dataclass(frozen=True)
class Motion:
    """Coordinates, velocities, accelerations and time as nodes: the jets of a motion q(t)."""

    tape: Tape
    q: tuple[Node, ...]
    v: tuple[Node, ...]
    a: tuple[Node, ...]
    t: Node

    def rate(self, f: Node) -> Node:
        """df/dt along any motion: ∂f/∂t + Σ v ∂f/∂q + Σ a ∂f/∂v."""
        tape = self.tape
        steps = (*zip(self.q, self.v, strict=True), *zip(self.v, self.a, strict=True))
        terms = [tape.times(derivative(tape, f, x), dx) for x, dx in steps]
        return tape.plus(derivative(tape, f, self.t), *terms)

    def expression(self, L: Node, i: int) -> Node:
        """The Euler–Lagrange expression d/dt ∂L/∂vᵢ − ∂L/∂qᵢ."""
        momentum = derivative(self.tape, L, self.v[i])
        return self.tape.minus(self.rate(momentum), derivative(self.tape, L, self.q[i]))


def motion(question: Question) -> Motion:
    """The jets named by the keys `velocities` and `accelerations` (names of their own where that isn't given)."""
    space = question.space
    v = velocity_names(question, "velocities")
    a = velocity_names(question, "accelerations") if question.key("accelerations") is not None else None
    if a is not None and set(a) & set(v):
        raise InputError("accelerations are names of their own, other than the velocities", "key 'accelerations'")
    taken = {str(s) for s in (*space.vocabulary.values(), *v)}
    if a is None:
        a = tuple(_unused(f"{x}_tt", taken) for x in space.q)
    tape = question.tape
    q, v_nodes, a_nodes = (tuple(question.nodes(group)) for group in (space.q, v, a))
    return Motion(tape, q, v_nodes, a_nodes, tape.symbol(space.t))


def velocity_names(question: Question, word: str) -> tuple[sp.Symbol, ...]:
    """The names of a key, one for each coordinate and none of them a variable of the phase space."""
    space, where = question.space, f"key {word!r}"
    found = names(question.key(word))
    if len(found) != space.n:
        raise InputError(f"{space.n} names are expected", where)
    if len({*found, *space.old, space.t}) != 3 * space.n + 1:
        raise InputError(f"{word} are names of their own, each once", where)
    return found


def _unused(name: str, taken: set[str]) -> sp.Symbol:
    from canon.mechanics.assumptions import symbol_with

    while name in taken:
        name += "_"
    return symbol_with(name)


def region_in_velocities(
    question: Question, *formulas: Formula, carried: Sequence[Formula] = (), images: Mapping[Node, Node] | None = None
) -> Region:
    """The domain in coordinates and velocities: a map of the file is left out unless it is one of the old variables.

    **Arguments:** `formulas` of the claim; `carried`, those of the file's sections that matter here; `images`, put in
    place of the momenta.
    """
    if question.chart.direction in ("forward", "none"):
        return question.region(*formulas, images=images)
    new = set(question.space.new)
    asked = question.subject.domain
    kept = tuple(c for c in asked.conditions if not any(term.free_symbols & new for term in c.terms))
    conditions = [condition for formula in (*carried, *formulas) for condition in formula.conditions]
    domain = Domain((*kept, *conditions), asked.surface)
    return question.region(domain=domain, images=images, chart=chart_of(question.tape, question.space, None))
