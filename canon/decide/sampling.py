"""Numerical evidence: residuals at many certified points, each beside the ball that bounds its rounding."""

from __future__ import annotations

import random
from collections.abc import Sequence

from canon.budget import Budget, BudgetExceeded
from canon.decide.answer import Answer, Witness, largest
from canon.decide.enclosure import excludes_zero
from canon.decide.region import Region
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.verdict import Evidence


def sample(
    tape: Tape,
    nodes: Sequence[Node],
    region: Region,
    *,
    points: int,
    budget: Budget,
    seed: int = 0,
    bits: int = 53,
) -> tuple[Evidence | None, Answer | None]:
    """The largest residual over random points of the region, and a refutation if a ball excludes 0.

    Returns: (evidence, refutation). The evidence's `bound` is the radius of the largest residual's ball, which is
    its rigorous rounding bound; None where no point could be evaluated. The refutation's `index` says which node.
    """
    worst = (0.0, 0.0)
    found = 0
    try:
        for point in samples(tape, nodes, region, random.Random(seed), count=points, bits=bits, tries=8, budget=budget):
            found += 1
            for index, node in enumerate(nodes):
                ball = point.balls[node]
                if excludes_zero(ball):
                    witness = Witness.of(tape, point, ball)
                    return None, Answer(
                        "refuted", f"ball at {bits} bits", witness=witness, index=index, balls=(ball,), bits=bits
                    )
                worst = max(worst, largest((ball,)))
    except (Unsupported, BudgetExceeded):
        pass
    return (Evidence(found, *worst, bits) if found else None), None
