"""The tape in double precision at many points at once, each value beside a bound on its rounding.

A node's value is an array with one entry a point, and its bound an array of the same shape: what the operands' bounds
become under the operation, plus the operation's own rounding (Higham, Accuracy and Stability of Numerical Algorithms,
section 3.3). A bound is infinite where the operands' bounds leave the function's domain. An elementary function of the
library is granted `ULPS` units of roundoff; so these bounds guide, and balls at exact points decide.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.decide.arbitrary import ChosenFunction
from canon.decide.tape import Node, Tape, Unsupported

Array = Any  # numpy arrays of floats or complex numbers
Rounded = tuple[Array, Array]

UNIT: Final = 2.0**-53
ULPS: Final = 4.0
LARGEST_EXPONENT: Final = 64


def evaluate_many(
    tape: Tape,
    order: Sequence[Node],
    points: Mapping[Node, Array],
    functions: Mapping[str, ChosenFunction] | None = None,
) -> dict[Node, Rounded]:
    """(values, bounds) for the nodes of `order` at points given by their symbol nodes: arrays of one length.

    Nothing is raised for a point outside of a function's domain: its value or its bound isn't finite.

    **Raises:** `Unsupported` for a function that has no rule here.
    """
    place: dict[Node, Rounded] = {}
    with np.errstate(all="ignore"):
        for i in order:
            op = tape.ops[i]
            kind = op[0]
            if kind == "*":
                place[i] = _product([_power(place[node], exponent) for node, exponent in op[1]])
            elif kind == "+":
                place[i] = _sum(op[1], [(place[node], coefficient) for node, coefficient in op[2]])
            elif kind == "n":
                place[i] = _number(op[1])
            elif kind == "s":
                place[i] = points[i], np.zeros(np.shape(points[i]))
            elif kind == "r":
                place[i] = _root(place[op[1]], Fraction(op[2], op[3]))
            elif kind == "f":
                place[i] = _function(op[1], [place[a] for a in op[2]])
            elif kind == "c":
                place[i] = (np.float64(np.pi), np.float64(2 * UNIT)) if op[1] == "pi" else (np.complex128(1j), 0.0)
            else:
                if not functions or op[1] not in functions:
                    raise Unsupported(f"no value of the arbitrary function {op[1]}")
                place[i] = _chosen(functions[op[1]], op[2], [place[a] for a in op[3]])
    return place


def _number(value: Fraction) -> Rounded:
    try:
        nearest = float(value)
    except OverflowError:
        return np.float64(np.inf), np.float64(np.inf)
    return np.float64(nearest), np.float64(0.0 if Fraction(nearest) == value else UNIT * abs(nearest))


def _unit(value: Array) -> float:
    """The relative rounding of one product or quotient: complex ones take several operations."""
    return 4 * UNIT if np.iscomplexobj(value) else UNIT


def _scaled(term: Rounded, coefficient: Fraction) -> Rounded:
    if coefficient == 1:
        return term
    if coefficient == -1:
        return -term[0], term[1]
    factor, off = _number(coefficient)
    value = factor * term[0]
    return value, abs(factor) * term[1] + off * (abs(term[0]) + term[1]) + UNIT * abs(value)


def _sum(constant: Fraction, terms: Sequence[tuple[Rounded, Fraction]]) -> Rounded:
    total, bound = _number(constant)
    first = not constant
    for term, coefficient in terms:
        value, off = _scaled(term, coefficient)
        if first:
            total, bound, first = value, off, False
            continue
        total = total + value
        bound = bound + off + UNIT * abs(total)
    return total, bound


def _times(a: Rounded, b: Rounded) -> Rounded:
    value = a[0] * b[0]
    return value, abs(a[0]) * b[1] + a[1] * (abs(b[0]) + b[1]) + _unit(value) * abs(value)


def _product(factors: Sequence[Rounded]) -> Rounded:
    value = factors[0]
    for factor in factors[1:]:
        value = _times(value, factor)
    return value


def _inverse(x: Rounded) -> Rounded:
    size = abs(x[0])
    value = 1 / x[0]
    bound = np.where(size > x[1], x[1] / (size * (size - x[1])), np.inf) + _unit(value) * abs(value)
    return value, bound


def _power(x: Rounded, exponent: int) -> Rounded:
    if exponent == 1:
        return x
    if exponent < 0:
        return _inverse(_power(x, -exponent))
    if exponent > LARGEST_EXPONENT and np.iscomplexobj(x[0]):
        raise Unsupported("a large power of a complex number")
    value = x[0] ** exponent
    slope = exponent * (abs(x[0]) + x[1]) ** (exponent - 1)
    rounding = exponent * 4 * UNIT if np.iscomplexobj(value) else ULPS * UNIT
    return value, slope * x[1] + rounding * abs(value)


def _off_the_slit(x: Rounded) -> Array:
    """Where the number is certainly not in (−∞, 0]."""
    if np.iscomplexobj(x[0]):
        return (x[0].real > x[1]) | (abs(x[0].imag) > x[1])
    return x[0] > x[1]


def _root(x: Rounded, exponent: Fraction) -> Rounded:
    r = exponent.numerator / exponent.denominator
    half = exponent == Fraction(1, 2)
    value = np.sqrt(x[0]) if half else np.power(x[0], r)
    inside = _off_the_slit(x)
    relative = np.where(inside, x[1] / abs(x[0]), 1.0)
    spread = np.expm1(-abs(r) * np.log1p(-np.where(relative < 1, relative, 1.0)))
    own = ULPS + (0.0 if half and not np.iscomplexobj(x[0]) else 4 * abs(r * np.log(abs(x[0]))))
    bound = abs(value) * (spread + own * _unit(value))
    return value, np.where(inside & (relative < 1), bound, np.inf)


def _function(name: str, arguments: list[Rounded]) -> Rounded:
    x = arguments[0]
    complex_one = any(np.iscomplexobj(a[0]) for a in arguments)
    if name in COMPLEX:
        return COMPLEX[name](x)
    if complex_one:
        raise Unsupported(f"{name} of a complex argument")
    if name == "atan2":
        return _atan2(x, arguments[1])
    if name not in REAL:
        raise Unsupported(f"{name} has no rule in double precision")
    return REAL[name](x)


def _own(value: Array) -> Array:
    return ULPS * _unit(value) * abs(value)


def _exp(x: Rounded) -> Rounded:
    value = np.exp(x[0])
    return value, abs(value) * np.expm1(x[1]) + _own(value)


def _log(x: Rounded) -> Rounded:
    value = np.log(x[0])
    relative = x[1] / abs(x[0])
    spread = -np.log1p(-np.where(relative < 1, relative, 1.0))
    absolute = 4 * UNIT if np.iscomplexobj(value) else 0.0
    return value, np.where(_off_the_slit(x) & (relative < 1), spread + _own(value) + absolute, np.inf)


def _circular(function: Callable[[Array], Array]) -> Callable[[Rounded], Rounded]:
    def rule(x: Rounded) -> Rounded:
        value = function(x[0])
        steep = np.cosh(abs(np.imag(x[0])) + x[1]) if np.iscomplexobj(x[0]) else 1.0
        # the two parts of a complex value round apart, and the smaller one may be lost in the larger
        own = ULPS * _unit(value) * steep if np.iscomplexobj(value) else _own(value)
        return value, x[1] * steep + own

    return rule


def _abs(x: Rounded) -> Rounded:
    return abs(x[0]), np.where(abs(x[0]) > x[1], x[1], np.inf)


def _atan(x: Rounded) -> Rounded:
    value = np.arctan(x[0])
    return value, x[1] / (1 + np.maximum(abs(x[0]) - x[1], 0) ** 2) + _own(value)


def _within(function: Callable[[Array], Array]) -> Callable[[Rounded], Rounded]:
    def rule(x: Rounded) -> Rounded:
        value, reach = function(x[0]), abs(x[0]) + x[1]
        return value, np.where(reach < 1, x[1] / np.sqrt(1 - np.minimum(reach, 1) ** 2) + _own(value), np.inf)

    return rule


def _atan2(y: Rounded, x: Rounded) -> Rounded:
    value = np.arctan2(y[0], x[0])
    away = np.hypot(y[1], x[1]) / np.hypot(y[0], x[0])
    uncut = (x[0] > x[1]) | (abs(y[0]) > y[1])
    bound = np.arcsin(np.where(away < 1, away, 1.0)) + _own(value)
    return value, np.where(uncut & (away < 1), bound, np.inf)


COMPLEX: Final[Mapping[str, Callable[[Rounded], Rounded]]] = {
    "exp": _exp,
    "log": _log,
    "sin": _circular(np.sin),
    "cos": _circular(np.cos),
}
REAL: Final[Mapping[str, Callable[[Rounded], Rounded]]] = {
    "abs": _abs,
    "atan": _atan,
    "asin": _within(np.arcsin),
    "acos": _within(np.arccos),
}


def _chosen(function: ChosenFunction, orders: Sequence[int], arguments: Sequence[Rounded]) -> Rounded:
    """A partial derivative of a function that was chosen for an arbitrary one: a sum of powers of affine forms."""
    terms: list[tuple[Rounded, Fraction]] = []
    drop = sum(orders)
    for coefficient, shift, slopes, power in function.terms:
        if drop > power:
            continue
        factor = coefficient * math.perm(power, drop)
        for slope, order in zip(slopes, orders, strict=True):
            factor *= slope**order
        form = _sum(shift, [(a, slope) for a, slope in zip(arguments, slopes, strict=True) if slope])
        terms.append((_power(form, power - drop) if power > drop else _number(Fraction(1)), factor))
    return _sum(Fraction(0), terms)
