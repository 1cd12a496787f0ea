"""Exact zeros among numbers: algebraic numbers, logarithms and inverse functions of them."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

from flint import arb, fmpq, fmpq_mat

from canon.budget import Budget
from canon.decide.derivative import substitute
from canon.decide.enclosure import OutOfDomain, evaluate, excludes_zero, precision
from canon.decide.fraction_field import FractionField
from canon.decide.generator_values import GeneratorBalls
from canon.decide.normal_form import reduce_to_zero
from canon.decide.ring import Polynomial, TooCostly
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import NeedSlots, Tower

MOST_DIMENSIONS = 96
BITS = (128, 1024, 8192)
SIMPLEST = 60
"""The largest denominator of a fraction of π that is looked for."""


def number_is_zero(tape: Tape, node: Node, budget: Budget) -> bool | None:
    """Is this node without symbols exactly 0?  True and False are proofs; None says that it isn't known."""
    if tape.support(node) or tape.functions_of([node]):
        return None
    value = tape.value(node)
    if value is not None:
        return value == 0
    if _excluded(tape, node, BITS[0]):
        return False
    node = _with_known_angles(tape, node, budget)
    if tape.value(node) == 0:
        return True
    for argument in (_algebraic, _by_exponential, _by_turning):
        known = argument(tape, node, budget)
        if known is not None:
            return known
    return False if any(_excluded(tape, node, bits) for bits in BITS[1:]) else None


def _excluded(tape: Tape, node: Node, bits: int) -> bool:
    with precision(bits):
        try:
            return excludes_zero(evaluate(tape, tape.reach([node]), {})[node])
        except (OutOfDomain, Unsupported, ZeroDivisionError):
            return False


def _smaller_than(tape: Tape, node: Node, bound: arb, bits: int) -> bool:
    with precision(bits):
        try:
            ball = evaluate(tape, tape.reach([node]), {})[node]
        except (OutOfDomain, Unsupported, ZeroDivisionError):
            return False
        return bool(abs(ball) < bound)


def _algebraic(tape: Tape, node: Node, budget: Budget) -> bool | None:
    """Normal form, else the characteristic polynomial of the number in the algebra of its kernels.

    The number is a root of χ(t) = t^k h(t), h(0) ≠ 0. Every root of h has modulus at least
    |h₀|/(|h₀| + max|h_i|) (Cauchy), so a ball within that bound proves 0.
    """
    try:
        tower = Tower(tape, [node], budget=budget)
        zero, nonzero, field = reduce_to_zero(tower, [node], budget)
    except (Unsupported, TooCostly, ZeroDivisionError, NeedSlots):
        return None
    if node in zero:
        return True
    if node not in nonzero:
        return None
    bound = _root_bound(field, nonzero[node][0], budget)
    if bound is None:
        return None
    terms = field.ring.terms(nonzero[node][0])
    for bits in BITS:
        with precision(bits):
            try:
                ball = GeneratorBalls(tower, {}).value_of_terms(terms)
            except (OutOfDomain, Unsupported, ZeroDivisionError):
                return None
            if excludes_zero(ball):
                return False
            if ball.abs_upper() < bound:
                return True
    return None


def _root_bound(field: FractionField, p: Polynomial, budget: Budget) -> arb | None:
    """A lower bound of the modulus of the number p, if it isn't 0; None where p isn't algebraic by its relations."""
    ring = field.ring
    degrees = {g: d for g, d, _, _ in field.relations}
    used: set[int] = set()
    pending = [k for k, e in enumerate(ring.degrees(p)) if e > 0]
    lowers = {g: lower for g, _, lower, _ in field.relations}
    while pending:
        k = pending.pop()
        if k in used:
            continue
        used.add(k)
        if k not in degrees:
            return None
        pending += [j for j, e in enumerate(ring.degrees(lowers[k])) if e > 0]
    generators = sorted(used)
    size = 1
    for g in generators:
        size *= degrees[g]
    if size > MOST_DIMENSIONS:
        return None
    basis = list(itertools.product(*(range(degrees[g]) for g in generators)))
    place = {exponents: k for k, exponents in enumerate(basis)}
    matrix = fmpq_mat(size, size)
    for row, exponents in enumerate(basis):
        budget.check()
        monomial = ring.one
        for g, e in zip(generators, exponents, strict=True):
            monomial = monomial * ring.generators[g] ** e
        for m, c in ring.terms(field.normal(p * monomial)).items():
            matrix[row, place[tuple(m[g] for g in generators)]] = fmpq(c.numerator, c.denominator)
    polynomial = matrix.charpoly()
    coefficients = [polynomial[k] for k in range(polynomial.degree() + 1)]
    while coefficients and coefficients[0] == 0:
        coefficients.pop(0)
    first, largest = abs(coefficients[0]), max((abs(c) for c in coefficients[1:]), default=fmpq(0))
    with precision(256):
        return arb(first / (first + largest)) / 2


def _by_exponential(tape: Tape, node: Node, budget: Budget) -> bool | None:
    """x = 0 where exp(x) = 1 and x is real: it turns logarithms of algebraic numbers into algebraic numbers."""
    if tape.is_complex(node) or not _contains(tape, node, ("log",)):
        return None
    return True if _algebraic(tape, _exponential_minus_one(tape, node, 1), budget) else None


def _by_turning(tape: Tape, node: Node, budget: Budget) -> bool | None:
    """x = 0 where cos(kx) = 1 and |kx| < 2π: it turns inverse functions of algebraic numbers into algebraic numbers."""
    if tape.is_complex(node) or not _contains(tape, node, ("atan", "asin", "acos", "atan2")):
        return None
    for k in multiples(tape, node):
        turned = tape.add(((tape.call("cos", tape.scaled(node, k)), 1),), -1)
        with precision(64):
            circle = 2 * arb.pi()
        if _algebraic(tape, turned, budget) and _smaller_than(tape, tape.scaled(node, k), circle, 128):
            return True
    return None


def _with_known_angles(tape: Tape, node: Node, budget: Budget) -> Node:
    """The number with rational multiples of π in place of the inverse functions that are such, as atan(√3/3) is π/6.

    What is within the principal branch, and has that tangent, sine or cosine, is the angle.
    """
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[:2] not in (("f", "atan"), ("f", "asin"), ("f", "acos")) or tape.value(op[2][0]) is not None:
            continue
        part = _part_of_pi(tape, i)
        low, high = (Fraction(0), Fraction(1)) if op[1] == "acos" else (Fraction(-1, 2), Fraction(1, 2))
        if part is None or not low < part < high:
            continue
        angle = tape.scaled(tape.constant("pi"), part)
        sine, cosine = tape.call("sin", angle), tape.call("cos", angle)
        back = {"atan": tape.minus(sine, tape.times(op[2][0], cosine)), "asin": tape.minus(sine, op[2][0]),
                "acos": tape.minus(cosine, op[2][0])}[op[1]]  # fmt: skip
        if _algebraic(tape, back, budget):
            return _with_known_angles(tape, substitute(tape, node, {i: angle}), budget)
    return node


def _part_of_pi(tape: Tape, node: Node) -> Fraction | None:
    """The simple fraction of π that a number seems to be."""
    with precision(128):
        try:
            ratio = evaluate(tape, tape.reach([node]), {})[node] / arb.pi()
        except (OutOfDomain, Unsupported, ZeroDivisionError):
            return None
        if not isinstance(ratio, arb) or not ratio.is_finite():
            return None
        part = Fraction(float(ratio.mid())).limit_denominator(SIMPLEST)
        return part if bool(abs(ratio - arb(fmpq(part.numerator, part.denominator))) < arb(2) ** -80) else None


def multiples(tape: Tape, node: Node) -> tuple[Fraction, ...]:
    """Factors k for which k·x may be a sum of whole or half inverse functions: 1, 2, and what clears coefficients."""
    op = tape.ops[node]
    if op[0] != "+":
        return Fraction(1), Fraction(2)
    cleared = Fraction(math.lcm(*(c.denominator for _, c in op[2])), math.gcd(*(c.numerator for _, c in op[2])))
    return tuple(dict.fromkeys((Fraction(1), Fraction(2), cleared, 2 * cleared)))


def _exponential_minus_one(tape: Tape, node: Node, k: int) -> Node:
    return tape.add(((tape.call("exp", tape.scaled(node, k)), 1),), -1)


def _contains(tape: Tape, node: Node, names: tuple[str, ...]) -> bool:
    return any(tape.ops[i][0] == "f" and tape.ops[i][1] in names for i in tape.reach([node]))
