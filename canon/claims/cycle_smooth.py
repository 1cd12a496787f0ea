"""Does a cycle stay where H is smooth?

A cycle is followed by the map's formulas, on and on, even where it leaves the domain for a while. That does no harm
where H goes on with it: K(J) then holds all along. A kink of H, though, as in |q − 1|, parts the H of the domain from
another one, whose orbits are others; there nothing is known of the cycle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.outcome import Outcome
from canon.decide.implied import follows
from canon.decide.region import Region, Requirement

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.domain import Condition


def stays_smooth(question: Question, region: Region, also: Iterable[Condition] = ()) -> Outcome | None:
    """None where H has no kink on any cycle of the angles, and the map is defined all along them; else, or where that
    isn't seen, a mere `supported`.

    **Arguments:** `question`, about a map given as old variables in new ones; `region`, its domain; `also`, what else
    is to hold along the cycles.
    """
    tape, chart = question.tape, question.chart
    angles = {tape.symbol(angle) for angle in question.space.Q}
    alike = tuple(r for r in region.requirements if not any(angles & tape.support(node) for node in r.nodes))
    cycles = replace(region, requirements=alike)
    for kink in (*_kinks(question), *also):
        nodes = tuple(chart.pull(tape.load(term)) for term in kink.terms)
        if not any(angles & tape.support(node) for node in nodes):
            continue
        if not follows(tape, Requirement(kink.kind, nodes, kink), cycles, question.budget):
            note = f"whether the cycles stay in the part of the domain where {kink} isn't shown"
            return Outcome("supported", "periods", note=note)
    return None


def _kinks(question: Question) -> Iterator[Condition]:
    """Where H has branches: what its conditions say, but for poles, through which no orbit passes."""
    H = question.hamiltonian()
    bent = H.expr.has(sp.Abs, sp.sign)
    yield from (c for c in H.conditions if bent or c.kind != "nonzero")
