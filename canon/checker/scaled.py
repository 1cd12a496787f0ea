"""Structure constants with parameters, made numbers: multiples of the basis' members, by powers of positive quantities.

Where each constant is a number times powers of names and of conditions' differences that are positive, [e_a, e_b] =
C u^m e_c, the basis u^(x_a) e_a has the constants C if x_a + x_b − x_c + m = 0 for each of them and each u: linear
equations with rational solutions, or none. The u are positive, so their powers are real and not 0, whatever the
parameters are: the real algebra is one and the same for all.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from canon.checker.lie import Algebra
from canon.checker.linear import reduced, solved
from canon.checker.positive import is_positive
from canon.checker.statement import Statement

Table = Mapping[tuple[int, int], Mapping[int, int]]
Powers = dict[int, int]


def scaled(s: Statement, table: Table, size: int) -> Algebra | None:
    """The algebra with numbers as its constants, or None where no such basis is seen."""
    found: dict[tuple[int, int, int], tuple[Fraction, Powers]] = {}
    for (a, b), row in table.items():
        for c, node in row.items():
            value = _powers(s, node)
            if value is None:
                return None
            if value[0]:
                found[a, b, c] = value
    for u in {u for _, powers in found.values() for u in powers}:
        columns = [[Fraction((k == a) + (k == b) - (k == c)) for a, b, c in found] for k in range(size)]
        wanted = [Fraction(-powers.get(u, 0)) for _, powers in found.values()]
        _, pivots = reduced([list(column) for column in zip(*columns, strict=True)])
        if solved([columns[k] for k in pivots], wanted) is None:
            return None
    numbers: dict[tuple[int, int], dict[int, Fraction]] = {}
    for (a, b, c), (number, _) in found.items():
        numbers.setdefault((a, b), {})[c] = number
    return Algebra(size, numbers)


def _powers(s: Statement, a: int) -> tuple[Fraction, Powers] | None:
    """A number times powers of positive quantities; None for anything else."""
    f, number, powers, left = s.f, Fraction(1), Powers(), [(a, 1)]
    while left:
        b, e = left.pop()
        op, value = f.ops[b], f.value(b)
        if value is not None and (value or e > 0):
            number *= value**e
        elif op[0] == "*":
            left += [(part, e) for part in f.parts(b)]
        elif op[0] == "^":
            left.append((op[1], e * op[2]))
        elif is_positive(s, b, strict=True, real=True):
            powers[b] = powers.get(b, 0) + e
        elif is_positive(s, minus := f.mul(f.number(-1), b), strict=True, real=True):
            number *= (-1) ** e
            powers[minus] = powers.get(minus, 0) + e
        else:
            return None
    return number, {u: e for u, e in powers.items() if e}
