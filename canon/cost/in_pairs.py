"""The tape in pairs of doubles, at many points at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.decide.tape import Node, Tape, Unsupported
from canon.numeric import pairs
from canon.numeric.pairs import Pair

PI: Final = Pair(2 * pairs.PI_OVER_2[0], 2 * pairs.PI_OVER_2[1])


def evaluate_in_pairs(tape: Tape, order: Sequence[Node], points: Mapping[Node, Any]) -> dict[Node, Pair]:
    """The values of the nodes of `order`, at points given by their symbol nodes: arrays of doubles, taken as exact.

    Nothing is raised where a value isn't finite. **Raises:** `Unsupported` for complex numbers and special functions.
    """
    place: dict[Node, Pair] = {}
    with np.errstate(all="ignore"):
        for i in order:
            op = tape.ops[i]
            kind = op[0]
            if kind == "+":
                place[i] = _sum(op[1], [(place[node], coefficient) for node, coefficient in op[2]])
            elif kind == "*":
                place[i] = _product([pairs.power(place[node], exponent) for node, exponent in op[1]])
            elif kind == "n":
                place[i] = pairs.pair(op[1])
            elif kind == "s":
                place[i] = Pair(points[i], np.zeros(np.shape(points[i])))
            elif kind == "r":
                place[i] = _root(place[op[1]], Fraction(op[2], op[3]))
            elif kind == "f" and op[1] in FUNCTIONS:
                place[i] = FUNCTIONS[op[1]](*(place[a] for a in op[2]))
            elif op == ("c", "pi"):
                place[i] = PI
            else:
                raise Unsupported(f"{op[1]} has no rule in pairs of doubles")
    return place


def _sum(constant: Fraction, terms: Sequence[tuple[Pair, Fraction]]) -> Pair:
    total = pairs.pair(constant)
    for term, coefficient in terms:
        total = pairs.add(total, term if coefficient == 1 else pairs.multiply(pairs.pair(coefficient), term))
    return total


def _product(factors: Sequence[Pair]) -> Pair:
    product = factors[0]
    for factor in factors[1:]:
        product = pairs.multiply(product, factor)
    return product


def _root(base: Pair, exponent: Fraction) -> Pair:
    """base to a fraction of two, or of any other number by its logarithm."""
    if exponent.denominator == 2:
        return pairs.power(pairs.square_root(base), exponent.numerator)
    return pairs.exponential(pairs.multiply(pairs.pair(exponent), pairs.logarithm(base)))


def _asin(x: Pair) -> Pair:
    return pairs.angle(x, _beside(x))


def _acos(x: Pair) -> Pair:
    return pairs.angle(_beside(x), x)


def _beside(x: Pair) -> Pair:
    """√(1 − x²), its difference in factors."""
    return pairs.square_root(pairs.multiply(pairs.subtract(pairs.ONE, x), pairs.add(pairs.ONE, x)))


FUNCTIONS: Final[Mapping[str, Callable[..., Pair]]] = {
    "sin": lambda x: pairs.sine_and_cosine(x)[0],
    "cos": lambda x: pairs.sine_and_cosine(x)[1],
    "exp": pairs.exponential,
    "log": pairs.logarithm,
    "abs": pairs.absolute,
    "atan2": pairs.angle,
    "atan": lambda x: pairs.angle(x, pairs.ONE),
    "asin": _asin,
    "acos": _acos,
}
