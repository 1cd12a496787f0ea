"""A composition of shears is canonical if what remains without them is: structure in place of expansion.

(Q, P) → (Q + f(P), P) has the Jacobian S = [[1, ∂f/∂P], [0, 1]], which is symplectic wherever ∂f/∂P is symmetric,
and then M J Mᵀ = scale·J holds of the composition exactly where it holds of the inner map. Six degrees of freedom
with four cubic shears cannot be expanded; peeled, they are four symmetric matrices.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.scale import Brackets
from canon.decide.derivative import derivative, substitute
from canon.decide.region import Region
from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.claims.question import Question

ENTIRE = ("sin", "cos", "exp")
WORTHWHILE = 60
MOST_SHEARS = 64


@dataclass(frozen=True)
class Peeled:
    """One shear taken off: what is left of the functions that it moved, and its displacements f(y)."""

    remaining: tuple[Node, ...]
    displacements: tuple[Node, ...]
    arguments: tuple[Node, ...]


def by_shears(question: Question, scale: Node, region: Region) -> Outcome | None:
    """Canonical by peeling shears off, or None where nothing can be peeled or the rest isn't proved."""
    tape, chart = question.tape, question.chart
    functions = chart.new if chart.direction == "forward" else chart.old
    half = len(functions) // 2
    if not functions or len(functions) != len(chart.coordinates) or len(tape.reach(functions)) < WORTHWHILE:
        return None
    Q, P = functions[:half], functions[half:]
    outcomes: list[Outcome] = []
    for _ in range(MOST_SHEARS):
        step = None
        for moved, kept, name in ((Q, P, "Q"), (P, Q, "P")):
            step = peel(tape, moved, kept)
            if step is None:
                continue
            outcome = question.decide(_symmetry(tape, step, name), Region((), (), ()))
            if outcome.status != "proved":
                return None
            outcomes.append(replace(outcome, method="structure"))
            Q, P = (step.remaining, P) if name == "Q" else (Q, step.remaining)
            break
        if step is None:
            break
    if not outcomes:
        return None
    brackets = Brackets(question, _inner(question, (*Q, *P)))
    rest = question.decide(brackets.residuals(scale), region)
    if rest.status != "proved":
        return None
    theorem = {"theorem": "a shear with a symmetric Jacobian is symplectic", "shears": len(outcomes)}
    return replace(combined([*outcomes, rest]), arguments=(theorem, *rest.arguments)).with_detail(shears=len(outcomes))


def _inner(question: Question, functions: tuple[Node, ...]):
    chart = question.chart
    return replace(chart, new=functions) if chart.direction == "forward" else replace(chart, old=functions)


def peel(tape: Tape, moved: Sequence[Node], kept: Sequence[Node]) -> Peeled | None:
    """Write moved = remaining + f(kept) with entire displacements f, not all of them 0; None where that fails."""
    if any(tape.ops[node][0] not in "+*" for node in kept):
        return None
    fresh = tuple(tape.symbol(sp.Dummy(f"y{k}", real=True)) for k in range(len(kept)))
    mapping = dict(zip(kept, fresh, strict=True))
    names = frozenset(fresh)
    remaining, displacements = [], []
    for node in moved:
        op = tape.ops[substitute(tape, node, mapping)]
        constant, terms = (op[1], op[2]) if op[0] == "+" else (0, ((substitute(tape, node, mapping), 1),))
        inner = [(n, c) for n, c in terms if not tape.support(n) & names]
        outer = [(n, c) for n, c in terms if tape.support(n) & names]
        if any(not tape.support(n) <= names or not _entire(tape, n) for n, _ in outer):
            return None
        remaining.append(tape.add(inner, constant))
        displacements.append(tape.add(outer))
    if all(d == tape.zero for d in displacements):
        return None
    return Peeled(tuple(remaining), tuple(displacements), fresh)


def _entire(tape: Tape, node: Node) -> bool:
    """True when the node is smooth for all values of its symbols, as it is written."""
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "*" and any(e < 0 for _, e in op[1]):
            return False
        if op[0] == "r" or (op[0] == "f" and op[1] not in ENTIRE):
            return False
    return True


def _symmetry(tape: Tape, step: Peeled, name: str) -> list[Residual]:
    f, y = step.displacements, step.arguments
    out = []
    for i in range(len(f)):
        for j in range(i):
            node = tape.minus(derivative(tape, f[i], y[j]), derivative(tape, f[j], y[i]))
            out.append(Residual(f"the shear of {name}: entries {i + 1},{j + 1} and {j + 1},{i + 1}", node))
    return out or [Residual(f"the shear of {name} has one entry", tape.zero)]
