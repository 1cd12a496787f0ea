"""Parameters turned into numbers by a change of units.

If coordinates and momenta, multiplied by powers of a positive parameter θ, turn every function g(z; θ) of a family into
a power of θ times g(z; 1), and every condition and surface of the domain likewise, then what is linearly independent at
θ = 1 is so at every θ: the scaling is a bijection of the two domains.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

from flint import arb

from canon.claims.fixed_parameters import fixed_region
from canon.claims.outcome import Residual
from canon.claims.structure_search import Values
from canon.decide.derivative import substitute
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.region import Region
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported
from canon.sign import declared

if TYPE_CHECKING:
    from canon.claims.question import Question

POWERS = tuple(Fraction(n, 2) for n in (0, 1, 2, -1, -2, 3, 4, -3, -4))
SIZES = (2, 3)
CLOSE = 1e-12

Powers = Sequence[Fraction]


def same_in_other_units(
    question: Question, region: Region, functions: Sequence[Node], variables: Sequence[Node], unit: Values
) -> bool:
    """Whether such a scaling exists, proved; `unit` gives 1 (−1 for a negative one) for each parameter."""
    tape = question.tape
    kinds = {r.kind for r in region.requirements}
    signed = all(declared(tape.symbol_at(x)).get("positive" if v > 0 else "negative") for x, v in unit.items())
    if not signed or not kinds <= {"positive", "nonzero"}:
        return False
    open_part = Region(region.requirements, (), region.symbols)
    fixed = fixed_region(tape, open_part, {x: tape.number(v) for x, v in unit.items()})
    if fixed is None:
        return False
    conditions = [r.nodes[0] for r in region.requirements]
    growing = [*conditions, *region.surface, *functions]
    half = len(variables) // 2
    groups = [variables[:half], variables[half:]] if 2 * half == len(variables) else [variables]
    factors = [tape.one] * len(growing)
    images: dict[Node, Node] = {}
    place = _place(question, fixed, growing, unit)
    if place is None:
        return False
    for x, sign in unit.items():
        found = _powers(question, growing, place, groups, x)
        if found is None:
            return False
        weights, growth = found
        size = tape.scaled(x, int(sign))
        for group, power in zip(groups, weights, strict=True):
            images |= {z: tape.times(images.get(z, z), tape.root(size, power)) for z in group}
        factors = [tape.times(f, tape.root(size, power)) for f, power in zip(factors, growth, strict=True)]
    return _proved(question, region, growing, images, factors, unit)


def _proved(
    question: Question,
    region: Region,
    growing: Sequence[Node],
    images: Mapping[Node, Node],
    factors: Sequence[Node],
    unit: Values,
) -> bool:
    """Each condition scales where those before it hold, and then the functions do."""
    tape = question.tape
    numbers = {x: tape.number(v) for x, v in unit.items()}
    known = Region((), (), region.symbols)
    count = len(region.requirements)
    for k in range(count + 1):
        group = range(k, k + 1) if k < count else range(count, len(growing))
        residuals = [
            Residual(
                "the change of units",
                tape.minus(
                    substitute(tape, growing[i], images), tape.times(factors[i], substitute(tape, growing[i], numbers))
                ),
            )
            for i in group
        ]
        if question.decide(residuals, known).status != "proved":
            return False
        if k < count:
            single = Region((region.requirements[k],), (), ())
            for table in (numbers, images):
                moved = fixed_region(tape, single, table)
                known = known.also(*(moved.requirements if moved is not None else ()))
    return True


def _place(question: Question, fixed: Region, nodes: Sequence[Node], unit: Values) -> dict[Node, Fraction] | None:
    """A point of the domain at unit parameters at which no function is 0."""
    tape = question.tape
    there = [substitute(tape, node, {x: tape.number(v) for x, v in unit.items()}) for node in nodes]
    region = Region(fixed.requirements, (), tuple(x for x in fixed.symbols if x not in unit))
    for place in samples(tape, there, region, random.Random(question.seed), count=1, budget=question.budget):
        if all(isinstance(value, Fraction) for value in place.point.values()):
            return {**{x: v for x, v in place.point.items() if isinstance(v, Fraction)}, **unit}
    return None


def _powers(
    question: Question, nodes: Sequence[Node], place: Mapping[Node, Fraction], groups: Sequence[Sequence[Node]], x: Node
) -> tuple[Powers, Powers] | None:
    """Powers of one parameter for each group of variables, and those by which the functions then grow; a guess."""
    start = _values(question, nodes, {z: arb(v.numerator) / v.denominator for z, v in place.items()})
    if start is None:
        return None
    for weights in product(POWERS, repeat=len(groups)):
        growths = []
        for size in SIZES:
            moved = {z: arb(v.numerator) / v.denominator for z, v in place.items()}
            moved[x] *= size
            for group, power in zip(groups, weights, strict=True):
                for z in group:
                    if z in moved:
                        moved[z] *= arb(size) ** (arb(power.numerator) / power.denominator)
            there = _values(question, nodes, moved)
            growths.append(None if there is None else [_growth(a, b, size) for a, b in zip(start, there, strict=True)])
        first, second = growths
        if first is not None and first == second and None not in first:
            return weights, [power for power in first if power is not None]
    return None


def _values(question: Question, nodes: Sequence[Node], point: Mapping[Node, arb]) -> list[float] | None:
    tape = question.tape
    try:
        with precision(128):
            balls = evaluate(tape, tape.reach(nodes), dict(point))
            values = [balls[node] for node in nodes]
            return [float(value.mid()) for value in values] if all(isinstance(v, arb) for v in values) else None
    except (OutOfDomain, Unsupported, ZeroDivisionError, AttributeError, KeyError):
        return None


def _growth(here: float, there: float, size: int) -> Fraction | None:
    if not here or there / here <= 0:
        return Fraction(0) if here == there else None
    exponent = math.log(there / here) / math.log(size)
    near = Fraction(round(2 * exponent), 2)
    return near if abs(float(near) - exponent) < CLOSE * 100 else None
