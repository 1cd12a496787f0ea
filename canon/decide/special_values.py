"""Points at which a parameter is 0, 1 or −1: where a formula that holds for nearly all of its values may fail.

∫ cos nx dx over a turn is 0 but for n = 0, and (b − 1)² is positive but for b = 1. No random value is one of these.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from canon.budget import Budget
from canon.decide.region import Region
from canon.decide.sample import Sample
from canon.decide.search import samples
from canon.decide.tape import Node, Tape
from canon.sign import declared

VALUES = (Fraction(0), Fraction(1), Fraction(-1))
MOST_NAMES = 6
TRIES = 2


def at_special_values(
    tape: Tape, names: Sequence[Node], targets: Sequence[Node], region: Region, rng: random.Random, budget: Budget
) -> Iterator[Sample]:
    """Certified points of the region at which one of the names, or all of them, are 0, 1 or −1; none on a surface.

    The other names are random, and names that are complex are left so. **Raises:** as `samples`.
    """
    real = [n for n in names if declared(tape.symbol_at(n)).get("real")]
    if region.surface or len(real) > MOST_NAMES:
        return
    for table in _tables(real):
        for sample in samples(tape, targets, region, rng, count=1, tries=TRIES, budget=budget, nice=True, at=table):
            if all(sample.point[n] == value for n, value in table.items()):
                yield sample


def _tables(names: Sequence[Node]) -> Iterator[Mapping[Node, Fraction]]:
    for value in VALUES:
        yield from ({name: value} for name in names)
        if len(names) > 1:
            yield dict.fromkeys(names, value)
