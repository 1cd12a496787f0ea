"""A generating function's first and second derivatives at many points in double precision, and at one point in more."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from canon.decide.arbitrary import ChosenFunction
from canon.decide.cloud import satisfied
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, evaluate, precision
from canon.decide.floating import Rounded, evaluate_many
from canon.decide.region import Region
from canon.decide.tape import Node, Tape
from canon.numeric.implicit import MixedDerivatives
from canon.numeric.mixed_variables import Pattern

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.mechanics import GeneratingFunction

Array = Any  # numpy arrays


@dataclass(frozen=True)
class OnTape:
    """F on a tape: the mixed coordinates `u`, the nodes of ∂F/∂u and ∂²F/∂u², and the region where F defines a map.

    `others` are arrays of values, one for each point, of the symbols that are no coordinates; `functions` those chosen
    for arbitrary ones.
    """

    tape: Tape
    pattern: Pattern
    u: tuple[Node, ...]
    gradient: tuple[Node, ...]
    hessian: tuple[tuple[Node, ...], ...]
    region: Region
    others: Mapping[Node, Array]
    functions: Mapping[str, ChosenFunction]

    @staticmethod
    def of(question: Question, generating: GeneratingFunction, values: Mapping[Node, Node] | None = None) -> OnTape:
        """F of a question about its map; `values` stand in place of parameters."""
        tape = question.tape
        F = tape.load(generating.F.expr)
        if values:
            F = substitute(tape, F, values)
        u = tuple(tape.symbol(symbol) for symbol in generating.mixed)
        gradient = tuple(derivative(tape, F, a) for a in u)
        hessian = tuple(tuple(derivative(tape, slope, b) for b in u) for slope in gradient)
        region = question.region(images=values)
        return OnTape(tape, Pattern(generating.types), u, gradient, hessian, region, {}, {})

    @property
    def nodes(self) -> list[Node]:
        """The derivatives' nodes."""
        return [*self.gradient, *(node for row in self.hessian for node in row)]

    def __call__(self, u: Array, rows: Array) -> MixedDerivatives:
        """The derivatives at mixed points u (N, 2n) that belong to the points `rows` of `others`.

        **Raises:** `Unsupported` for functions without a rule in double precision.
        """
        count = len(u)
        place = {node: u[:, k] for k, node in enumerate(self.u)}
        place |= {node: values[rows] for node, values in self.others.items()}
        order = self.tape.reach([*self.region.nodes(), *self.nodes])
        found = evaluate_many(self.tape, order, place, self.functions)
        inside = np.ones(count, dtype=bool)
        for requirement in self.region.requirements:
            inside &= satisfied(requirement, [found[node] for node in requirement.nodes])

        def stacked(nodes: Sequence[Node]) -> tuple[Array, Array]:
            pairs = [_column(found[node], count) for node in nodes]
            return np.stack([v for v, _ in pairs], axis=1), np.stack([b for _, b in pairs], axis=1)

        slopes, slope_bounds = stacked(self.gradient)
        size = len(self.u)
        curvature, curvature_bounds = stacked([node for row in self.hessian for node in row])
        shape = (count, size, size)
        return MixedDerivatives(slopes, curvature.reshape(shape), slope_bounds, curvature_bounds.reshape(shape), inside)

    def deeply(self, u: Sequence[Ball], row: int, bits: int) -> tuple[list[Ball], list[list[Ball]]]:
        """∂F/∂u and ∂²F/∂u² at one mixed point in this precision.

        **Raises:** `OutOfDomain` where F isn't certified to be defined there.
        """
        place: dict[Node, Ball] = dict(zip(self.u, u, strict=True))
        place |= {node: _exact(values[row]) for node, values in self.others.items()}
        with precision(bits):
            balls = evaluate(self.tape, self.tape.reach(self.nodes), place, self.functions)
        return [balls[node] for node in self.gradient], [[balls[node] for node in row] for row in self.hessian]


def _column(pair: Rounded, count: int) -> Rounded:
    return np.broadcast_to(pair[0], count), np.broadcast_to(pair[1], count)


def _exact(value: float) -> Ball:
    fraction = Fraction(float(value))
    return arb(fraction.numerator) / arb(fraction.denominator)
