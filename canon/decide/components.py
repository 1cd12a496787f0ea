"""A surface's equations as polynomials over Q, and the irreducible pieces that they fall into.

An equation vanishes where one of its irreducible factors does; a repeated factor has the same zeros as a simple one,
and a factor of the denominator has none in the region. With i and real names an equation stands for two, its real and
its imaginary part. What isn't polynomial over Q, or over Q(i) in real names, stays as it is written.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import flint

from canon.decide.arbitrary import rational
from canon.decide.tape import Node, Tape

Polynomial = Any  # flint.fmpq_mpoly; the package has no type stubs
Parts = tuple[Polynomial, Polynomial]
MOST_TERMS = 400


@dataclass(frozen=True)
class Piece:
    """One way for an equation to vanish: a node, and the polynomial that it is, where it is one."""

    node: Node
    polynomial: Polynomial | None = field(default=None, compare=False)


def pieces(tape: Tape, equations: Sequence[Node]) -> list[tuple[Piece, ...]]:
    """For each equation, or part of one, the pieces of which at least one vanishes where it does.

    An equation that vanishes identically is left out; one that vanishes nowhere has no pieces.
    """
    symbols = sorted(set().union(*(tape.support(e) for e in equations)))
    context = flint.fmpq_mpoly_ctx.get(tuple(f"x{n}" for n in symbols), flint.Ordering.lex)
    out: list[tuple[Piece, ...]] = []
    for equation in equations:
        found = _numerators(tape, equation, symbols, context)
        if found is None:
            out.append(tuple(dict.fromkeys(_by_product(tape, equation))))
            continue
        numerators, below = found
        for numerator in numerators:
            if numerator:
                out += _pieces_of(tape, numerator, below, symbols)
    return list(dict.fromkeys(out))


def without_powers(tape: Tape, equations: Sequence[Node]) -> list[Node]:
    """Equations with the same real zeros in the region, each a product of different irreducible pieces."""
    return [tape.times(*(piece.node for piece in found)) for found in pieces(tape, equations)]


def _by_product(tape: Tape, node: Node) -> list[Piece]:
    """The factors of a product: those that are raised to a positive power can vanish."""
    op = tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        return _by_product(tape, op[2][0][0])
    if op[0] == "*":
        return [piece for factor, e in op[1] if e > 0 for piece in _by_product(tape, factor)]
    return [Piece(node)]


def _pieces_of(tape: Tape, p: Polynomial, below: Polynomial, symbols: Sequence[Node]) -> list[tuple[Piece, ...]]:
    """The factors of one equation; several equations for a sum of squares, which vanish where it does."""
    found = _factors(tape, p, below, symbols)
    if len(found) == 1 and found[0].polynomial is not None:
        forms = _squares(tape, found[0].polynomial, symbols)
        if forms:
            return [(Piece(_node(tape, f, symbols), f),) for f in forms]
    return [found]


def _squares(tape: Tape, p: Polynomial, symbols: Sequence[Node]) -> list[Polynomial]:
    """The linear forms of Lagrange's reduction where a monic p is Σ c·l² with all c > 0 in real names; else none."""
    if p.total_degree() != 2 or not all(
        tape.symbol_at(n).is_real for n, d in zip(symbols, p.degrees(), strict=True) if d
    ):
        return []
    context = p.context()
    forms: list[Polynomial] = []
    rest = p
    for k in range(len(symbols)):
        if rest.degrees()[k] == 0:
            continue
        if rest.degrees()[k] == 1:
            return []
        slope = rest.derivative(k)
        lead = slope.derivative(k).leading_coefficient() / 2
        if lead < 0:
            return []
        forms.append(slope / (2 * lead))
        rest = rest - forms[-1] ** 2 * lead
    if rest.is_constant() and rest:
        return [] if rest.leading_coefficient() < 0 else [context.constant(1)]
    return forms if len(forms) > 1 else []


def _factors(tape: Tape, p: Polynomial, below: Polynomial, symbols: Sequence[Node]) -> tuple[Piece, ...]:
    """The irreducible factors of p that don't divide the denominator, made monic, each once."""
    found: dict[Node, Piece] = {}
    for f, _ in p.factor()[1]:
        if not divmod(below, f)[1]:
            continue
        f = f / f.leading_coefficient()
        node = _node(tape, f, symbols)
        found[node] = Piece(node, f)
    return tuple(found.values())


def _node(tape: Tape, p: Polynomial, symbols: Sequence[Node]) -> Node:
    """The polynomial as a node."""
    terms = []
    for monomial, c in p.to_dict().items():
        factors = [(n, int(e)) for n, e in zip(symbols, monomial, strict=True) if e]
        terms.append((tape.mul(factors), Fraction(int(c.p), int(c.q))))
    return tape.add(terms)


def _numerators(
    tape: Tape, equation: Node, symbols: Sequence[Node], context: Any
) -> tuple[list[Polynomial], Polynomial] | None:
    """([real part, imaginary part] of the numerator, denominator), or None for what isn't a rational function."""
    one, zero = context.constant(1), context.constant(0)
    variables = dict(zip(symbols, context.gens(), strict=True))
    values: dict[Node, tuple[Parts, Polynomial]] = {}
    for i in tape.reach([equation]):
        op = tape.ops[i]
        if op[0] == "n":
            values[i] = (context.constant(rational(op[1])), zero), one
        elif op[0] == "s":
            values[i] = (variables[i], zero), one
        elif op == ("c", "I"):
            values[i] = (zero, one), one
        elif op[0] == "+":
            values[i] = _sum([(context.constant(rational(c)), values[a]) for a, c in op[2]], op[1], context)
        elif op[0] == "*":
            made = _product([(values[a], e) for a, e in op[1]], one, zero)
            if made is None:
                return None
            values[i] = made
        else:
            return None
        if max(len(part) for part in (*values[i][0], values[i][1])) > MOST_TERMS:
            return None
    (real, imaginary), below = values[equation]
    if imaginary and not all(tape.symbol_at(n).is_real for n in tape.support(equation)):
        return None
    return [real, imaginary], below


def _sum(terms: Sequence[tuple[Any, tuple[Parts, Polynomial]]], constant: Fraction, context: Any) -> Any:
    (real, imaginary), below = (context.constant(rational(constant)), context.constant(0)), context.constant(1)
    for c, ((a, b), d) in terms:
        if d == below:
            real, imaginary = real + c * a, imaginary + c * b
        else:
            real, imaginary, below = real * d + c * a * below, imaginary * d + c * b * below, below * d
    return (real, imaginary), below


def _product(factors: Sequence[tuple[tuple[Parts, Polynomial], int]], one: Any, zero: Any) -> Any:
    real, imaginary, below = one, zero, one
    for ((a, b), d), e in factors:
        if abs(e) > 40:
            return None
        if e < 0:
            size = a * a + b * b if b else a
            if not size:
                return None
            (a, b), d = ((a * d, -b * d) if b else (d, zero)), size
        for _ in range(abs(e)):
            real, imaginary, below = real * a - imaginary * b, real * b + imaginary * a, below * d
            if len(real) + len(imaginary) > 2 * MOST_TERMS:
                return None
    return (real, imaginary), below
