"""Functions that are identically zero for no values of their parameters.

A function made of rational functions, sin, cos and exp is meromorphic on the connected Cᴺ, so that vanishing on any
open set would be vanishing everywhere: one point at which it isn't 0, whatever the parameters, decides. Square roots
and absolute values of such expressions are let in as branches (see `canon.claims.independence`).
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product

import sympy as sp

from canon.claims.scale import never_zero
from canon.claims.show import SHORT, is_short
from canon.decide.derivative import substitute
from canon.decide.tape import Node, Tape, Unsupported
from canon.domain import Condition
from canon.errors import InputError

MOST_RADICALS = 3
MEROMORPHIC = ("sin", "cos", "exp")
PLACES = (
    tuple(Fraction(n) for n in (1, 2, 3, 5, 7, 11, 4, 9, 13, 6)),
    tuple(Fraction(n, 2) for n in (3, 1, 8, 3, 5, 7, 2, 11, 9, 4)),
    tuple(Fraction(n) for n in (3, 4, 0, 2, 1, 5, 6, 12, 0, 1)),
    tuple(Fraction(n) for n in (0, 0, 3, 4, 1, 0, 2, 5, 12, 13)),
    (Fraction(0),),
)


def not_zero_for_any_parameters(
    tape: Tape, node: Node, parameters: frozenset[Node], conditions: Sequence[Condition], *, quick: bool = False
) -> bool:
    """For all values of the parameters, the node is not identically zero on any open set of its other variables.

    `quick`: a long formula isn't expanded for it.
    """
    if tape.functions_of([node]):
        return False
    try:
        branches = list(_branches(tape, node, parameters))
    except Unsupported:
        return False
    variables, short = sorted(tape.support(node) - parameters), is_short(tape, node, SHORT)
    if short and len(branches) == 1 and _has_a_constant_coefficient(tape, node, variables, conditions):
        return True
    values = [_product_at(tape, branches, variables, place, conditions) for place in PLACES]
    if any(v is not None and never_zero(v, conditions) for v in values) or _without_common_zero(values, conditions):
        return True
    return (
        not (short or quick) and len(branches) == 1 and _has_a_constant_coefficient(tape, node, variables, conditions)
    )


def _without_common_zero(values: Sequence[sp.Expr | None], conditions: Sequence[Condition]) -> bool:
    """The values at several points, polynomials over Q in one parameter, have no common zero."""
    found: list[sp.Poly] = []
    for value in values:
        if value is None:
            continue
        above, below = sp.fraction(sp.together(value))
        names = sorted(above.free_symbols, key=str)
        if below.free_symbols or len(names) != 1 or (found and found[0].gens != tuple(names)):
            continue
        with contextlib.suppress(sp.PolynomialError, sp.CoercionFailed):
            found.append(sp.Poly(above, *names, domain=sp.QQ))
    if len(found) < 2:
        return False
    common = found[0]
    for value in found[1:]:
        common = sp.gcd(common, value)
    return never_zero(common.as_expr(), conditions)


def _has_a_constant_coefficient(
    tape: Tape, node: Node, variables: Sequence[Node], conditions: Sequence[Condition]
) -> bool:
    """A polynomial (or its numerator) in the variables, one coefficient of which is never zero."""
    if not variables or not is_short(tape, node):
        return False
    symbols = [tape.symbol_at(x) for x in variables]
    try:
        numerator = sp.fraction(sp.together(tape.to_sympy(node)))[0]
        coefficients = sp.Poly(sp.expand(numerator), *symbols).coeffs()
    except sp.PolynomialError:
        return False
    different = dict.fromkeys(c.as_coeff_Mul()[1] for c in coefficients)
    return any(never_zero(c, conditions) for c in different)


def _product_at(
    tape: Tape,
    branches: Sequence[Node],
    variables: Sequence[Node],
    place: Sequence[Fraction],
    conditions: Sequence[Condition],
) -> sp.Expr | None:
    """The product of all branches at a point as a formula in the parameters, or None where it is long or undefined.

    Which branch continues which from one point to another isn't known: √(x²) is x at one and −x at another. So they
    are taken together. No denominator may vanish there for any parameters: a/(a + x − 1) at x = 1 is 1, but for a = 0.
    """
    values = {x: tape.number(place[k % len(place)]) for k, x in enumerate(variables)}
    found: list[sp.Expr] = []
    try:
        for node in denominators(tape, branches, variables):
            below = substitute(tape, node, values)
            if not (is_short(tape, below) and never_zero(tape.to_sympy(below), conditions)):
                return None
        for branch in branches:
            value = substitute(tape, branch, values)
            if not is_short(tape, value):
                return None
            found.append(tape.to_sympy(value))
    except (InputError, ZeroDivisionError):
        return None
    return None if any(v.has(sp.zoo, sp.nan, sp.oo) for v in found) else sp.Mul(*found)


def denominators(tape: Tape, nodes: Sequence[Node], variables: Sequence[Node]) -> list[Node]:
    """What is divided by and contains one of the variables."""
    found: dict[Node, None] = {}
    for i in tape.reach(nodes):
        op = tape.ops[i]
        if op[0] == "*":
            found.update((factor, None) for factor, e in op[1] if e < 0)
        elif op[0] == "r" and op[2] < 0:
            found[op[1]] = None
    return [node for node in found if not tape.support(node).isdisjoint(variables)]


def _branches(tape: Tape, node: Node, parameters: frozenset[Node]) -> Iterator[Node]:
    """The node for each choice of the signs of its radicals and absolute values; **raises** Unsupported for others."""
    families: dict[tuple[str, Node], list[Node]] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if tape.support(i) <= parameters:
            continue
        if op[0] == "r":
            if op[3] != 2:
                raise Unsupported("a root other than a square root")
            families.setdefault(("r", op[1]), []).append(i)
        elif op[0] == "f" and op[1] == "abs":
            families.setdefault(("abs", op[2][0]), []).append(i)
        elif op[0] == "f" and op[1] not in MEROMORPHIC:
            raise Unsupported(f"{op[1]} has branches or poles that are not argued about")
        elif op[0] == "u":
            raise Unsupported("an arbitrary function")
    if len(families) > MOST_RADICALS:
        raise Unsupported("many radicals")
    inside = {i for group in families.values() for i in group}
    for kind, base in families:
        if any(j in inside for j in tape.reach([base])):
            raise Unsupported(f"nested radicals ({kind})")
    for signs in product((1, -1), repeat=len(families)):
        flipped = {
            i: tape.negative(i) for group, sign in zip(families.values(), signs, strict=True) if sign < 0 for i in group
        }
        yield substitute(tape, node, flipped) if flipped else node
