"""Velocities that constraints allow, where a formula or a name's assumption leaves some velocities out.

A constraint a·v + b = 0 is one at each state of the domain. With log(v) in it, or a v that is declared positive, there
may be no state at which it holds: what is claimed of the motions that it allows is said of none then. And velocities
that a claim names are in the domain, or aren't allowed either.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from canon.claims.chart import required_of
from canon.claims.outcome import Residual
from canon.decide.derivative import substitute
from canon.decide.region import Requirement
from canon.decide.tape import Node
from canon.granted import is_limited

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.claims.velocities import Motion
    from canon.decide.region import Region


def are_some(question: Question, jets: Motion, lines: Sequence[Node], region: Region) -> None:
    """**Raises** `EmptyDomain` where velocities are left out, and none is found at which all `lines` are 0."""
    tape, v = question.tape, {*jets.v}
    demanded = any(v & tape.support(node) for requirement in region.requirements for node in requirement.nodes)
    if demanded or any(is_limited(tape.symbol_at(x)) for x in v):
        question.decide([Residual("0", tape.zero)], replace(region, surface=(*region.surface, *lines)))


def at_velocities(question: Question, jets: Motion, steps: Sequence[Node], region: Region) -> Region:
    """The region where these velocities are in the domain, too."""
    return region.also(*_demanded(question, jets, steps, region))


def _demanded(question: Question, jets: Motion, steps: Sequence[Node], region: Region) -> Iterator[Requirement]:
    tape, images = question.tape, dict(zip(jets.v, steps, strict=True))
    for requirement in region.requirements:
        nodes = tuple(substitute(tape, node, images) for node in requirement.nodes)
        if nodes != requirement.nodes:
            yield Requirement(requirement.kind, nodes, requirement.said, " (at these velocities)")
    for x, step in images.items():
        if step != x:
            yield from required_of(tape, tape.symbol_at(x), step)
