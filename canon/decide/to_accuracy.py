"""Residuals to an accuracy: in balls of as many bits as it is predicted to need, at certified points of the region."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import Final

from canon.budget import Budget, BudgetExceeded
from canon.decide.answer import Answer, Witness
from canon.decide.enclosure import excludes_zero
from canon.decide.region import Region
from canon.decide.sample import Sample
from canon.decide.sampling import sample
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.verdict import Evidence

POINTS: Final = 64
GUARD: Final = 40
"""Bits beyond those of the accuracy: for terms that cancel, and for how many they are."""
AGAIN: Final = 4
"""Times as many bits where those were not enough, once."""
TRIES: Final = 8
LEAST: Final = 1e-300
"""Of an accuracy that may be asked for: a double holds no less."""
DOUBLE: Final = 1e-12
"""Below this, double precision is not expected to bound the residuals: terms of the size of 1 leave some 1e-15 each."""


def bits_for(accuracy: float) -> int:
    """The bits that residuals of terms about as large as 1 are predicted to need, so that their balls are as small."""
    return max(math.ceil(-math.log2(accuracy)), 24) + GUARD


def sample_to(
    tape: Tape, nodes: Sequence[Node], region: Region, *, points: int, accuracy: float, budget: Budget, seed: int = 0
) -> tuple[Evidence | None, Answer | None]:
    """The residuals at points of the region, first at many in double precision, then enclosed at some.

    **Returns:** (evidence, refutation), as `canon.decide.sampling.sample`. The evidence is that of the enclosures: its
    `bound` is the largest that a residual could have there, and above the accuracy where more bits did not help.
    """
    evidence, refutation = sample(tape, nodes, region, points=points, budget=budget.share(0.5), seed=seed)
    if refutation is not None:
        return evidence, refutation
    for bits in (bits_for(accuracy), AGAIN * bits_for(accuracy)):
        found = list[Sample]()
        rng = random.Random(seed)
        try:
            for point in samples(tape, nodes, region, rng, count=POINTS, bits=bits, tries=TRIES, budget=budget):
                found.append(point)
                for index, node in enumerate(nodes):
                    ball = point.balls[node]
                    if excludes_zero(ball):
                        witness = Witness.of(tape, point, ball)
                        words = f"ball at {bits} bits"
                        return None, Answer("refuted", words, witness=witness, index=index, balls=(ball,), bits=bits)
        except (Unsupported, BudgetExceeded):
            pass
        if not found:
            break
        balls = [point.balls[node] for point in found for node in nodes]
        size = max(abs(complex(ball.mid())) for ball in balls)
        bound = max(float(ball.abs_upper()) for ball in balls)
        evidence = Evidence(len(found), size, bound, bits)
        if bound <= accuracy:
            break
    return evidence, None
