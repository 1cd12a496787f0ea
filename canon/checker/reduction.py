"""Hermite's reduction of abelian integrals by linear algebra, at random values of the parameters modulo a prime.

Y/√P is (N √P)' and a sum of basic ones, (N √P)' √P being N' P + N P'/2: the coefficients are those of one linear
system, whose equations are values at random places. Where there are several solutions, they differ by a relation
between the basic integrals, and each of them will do.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from canon.checker.rational import NoForm
from canon.checker.values import Values

SPARE = 6


class Reduction(NamedTuple):
    """Y = P^above Π (sign (x − c))^k, or without P, m being given, t^above (1 − t)^below (1 − m t)^third Π (1 − n t)^k
    and t (1 − t)(1 − m t) in place of P, for the `factors` (c, k, sign) or (n, k, 1). c, n, m and P are formulas."""

    P: tuple[int, ...]
    factors: Sequence[tuple[int, int, int]]
    above: int
    m: int = 0
    below: int = 0
    third: int = 0


class Found(NamedTuple):
    """Coefficients of 1/√P, of (1 − m t)/√P, and of the poles' 1/(x − c)√P, or 1/(1 − n t)√P, modulo the prime."""

    plain: int
    other: int
    poles: list[int]


def reduced(values: Values, form: Reduction) -> Found:
    """The coefficients of the basic integrals. Raises NoForm."""
    prime, rng = values.t.prime, values.t.rng

    def number(a: int) -> int:
        x = values.value(a)
        if x.keys() - {()}:
            raise NoForm
        return x.get((), 0)

    elliptic = not form.P
    marks = [number(c) for c, _, _ in form.factors]
    m = number(form.m) if elliptic else 0
    P = [0, 1, -1 - m, m] if elliptic else [number(c) for c in form.P]
    slope = [k * c for k, c in enumerate(P)][1:]
    lines: list[Callable[[int], int]] = [
        (lambda x, c=c: (1 - c * x) % prime) if elliptic else (lambda x, c=c: (x - c) % prime) for c in marks
    ]
    rates = [-c if elliptic else 1 for c in marks]
    lowest = [(line, rate, -k) for line, rate, (_, k, _) in zip(lines, rates, form.factors, strict=True)]
    if elliptic:
        lowest.append((lambda x: (1 - m * x) % prime, -m, 1 - form.third))
    height = 3 + sum(max(k, 0) for _, k, _ in form.factors) + 2 * max(form.above, 0) + form.below + max(form.third, 0)

    def row(x: int) -> list[int]:
        p, dp = (sum(c * pow(x, k, prime) for k, c in enumerate(q)) for q in (P, slope))
        half = pow(2, -1, prime)
        Y = pow(p, form.above, prime)
        if elliptic:
            Y = pow(x, form.above, prime) * pow(1 - x, form.below, prime) * pow((1 - m * x) % prime, form.third, prime)
        for line, (_, k, sign) in zip(lines, form.factors, strict=True):
            Y = Y * pow(sign * line(x), k, prime) % prime
        found = [1, (1 - m * x) if elliptic else 0, *(pow(line(x), -1, prime) for line in lines)]
        for j in range(height):  # N = x^j
            found.append((j * pow(x, j - 1, prime) if j else 0) * p + pow(x, j, prime) * dp * half)
        for line, rate, deep in lowest:
            for j in range(1, deep):  # N = line^-j
                over = pow(line(x), -j, prime)
                found.append(-j * rate * over * pow(line(x), -1, prime) * p + over * dp * half)
        return [c % prime for c in (*found, Y)]

    count = len(row(rng.randrange(2, prime))) - 1
    solution = _solved([row(rng.randrange(2, prime)) for _ in range(count + SPARE)], prime)
    return Found(solution[0], solution[1], solution[2 : 2 + len(marks)])


def _solved(rows: list[list[int]], prime: int) -> list[int]:
    """A solution of linear equations, coefficients and then what they add up to. Raises NoForm where there is none."""
    size, pivots = len(rows[0]) - 1, list[int]()
    for column in range(size):
        k = next((r for r in range(len(pivots), len(rows)) if rows[r][column]), None)
        if k is None:
            continue
        top = len(pivots)
        rows[top], rows[k] = rows[k], rows[top]
        scale = pow(rows[top][column], -1, prime)
        rows[top] = [x * scale % prime for x in rows[top]]
        for r, row in enumerate(rows):
            if r != top and (c := row[column]):
                rows[r] = [(x - c * y) % prime for x, y in zip(row, rows[top], strict=True)]
        pivots.append(column)
    if any(row[-1] for row in rows[len(pivots) :]):
        raise NoForm
    found = [0] * size
    for row, column in zip(rows, pivots, strict=False):
        found[column] = row[-1]
    return found
