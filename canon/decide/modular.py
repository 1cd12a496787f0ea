"""Random evaluation of the tower over a prime field: strong evidence, never a verdict of its own.

At a random point of the variety of the relations over GF(p), p a random prime of 159 bits or more, a
residual that isn't 0 in the tower vanishes with probability at most D·4^k/p (Schwartz–Zippel with k
radicals taken through norms), to which the chance that p divides the content is added.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import fmpz, fmpz_mod_ctx
from flint.utils.flint_exceptions import DomainError

from canon.decide.tape import Node
from canon.decide.tower import Tower

Terms = list[tuple[tuple[tuple[int, int], ...], Fraction]]


class NoPoint(Exception):
    """No point of the variety was found over the prime fields tried."""


def vanishing(
    tower: Tower, nodes: Sequence[Node], rng: random.Random, bits: int = 159
) -> tuple[dict[Node, bool], float]:
    """Which nodes vanish at a random point over GF(p), and log₂ of the error bound of a "yes".

    Raises NoPoint where the relations have no point that this file can find.
    """
    while True:
        evaluator = Evaluator(tower, rng, bits)
        log_error = evaluator.log2_error(nodes)
        if log_error <= -100 or bits > 4000:
            values = evaluator.values(nodes)
            return {node: values[node] == 0 for node in nodes}, log_error
        bits += int(log_error + 100) + 16


class Evaluator:
    """Evaluation of one tower over one random prime field."""

    def __init__(self, tower: Tower, rng: random.Random, bits: int) -> None:
        self.tower, self.rng, self.bits = tower, rng, bits
        special = [g for g in tower.generators if g.degree and g.kind not in ("root", "sin", "I", "abs")]
        if special:
            raise NoPoint("a relation without radicals")
        self.kernels = {n: (self._terms(x[0]), list(x[1].items())) for n, x in tower.kernels.items()}
        self.factors = [self._terms(f) for f in tower.field.factors]
        self.lower = {g.index: self._terms(g.lower) for g in tower.generators if g.degree}
        self.squares = any(g.kind == "I" for g in tower.generators)
        self.odd = {g.degree >> ((g.degree & -g.degree).bit_length() - 1) for g in tower.generators if g.degree > 2}
        self.radicals = sum(1 for g in tower.generators if g.degree and g.kind not in ("sin", "I"))
        self._take_prime()

    def _take_prime(self) -> None:
        self.p = self._prime()
        self.residues = fmpz_mod_ctx(self.p)

    def _terms(self, p: Any) -> Terms:
        return [
            (tuple((k, e) for k, e in enumerate(m) if e), c) for m, c in (self.tower.ring.terms(p) if p else {}).items()
        ]

    def _prime(self) -> int:
        """A random prime for which roots of odd order are unique, and −1 a square where I is used."""
        for _ in range(100_000):
            p = (self.rng.getrandbits(self.bits) | (1 << (self.bits - 1))) & ~7 | (1 if self.squares else 7)
            if all(math.gcd(q, p - 1) == 1 for q in self.odd) and fmpz(p).is_probable_prime():
                return p
        raise NoPoint("no prime of the kind that the roots need")

    def _polynomial(self, terms: Terms, point: Sequence[int]) -> int:
        p, total = self.p, 0
        for monomial, coefficient in terms:
            term = coefficient.numerator
            if coefficient.denominator != 1:
                term = term * pow(coefficient.denominator, -1, p) % p
            for k, e in monomial:
                term = term * (point[k] if e == 1 else pow(point[k], e, p)) % p
            total += term
        return total % p

    def _square_root(self, a: int) -> int | None:
        if a == 0:
            return 0
        try:
            root = int(self.residues(a).sqrt())
        except DomainError:
            return None
        return self.p - root if self.rng.getrandbits(1) else root

    def _root(self, a: int, degree: int) -> int | None:
        if degree == 2:
            return self._square_root(a)
        if degree % 2 == 0 or math.gcd(degree, self.p - 1) != 1:
            return None
        return pow(a, pow(degree, -1, self.p - 1), self.p)

    def point(self, tries: int = 3000) -> list[int]:
        """A random point of the variety, generator by generator."""
        sine = 0
        for _ in range(tries):
            point: list[int] = []
            for g in self.tower.generators:
                if g.kind == "cos":
                    t = self.rng.randrange(1, self.p)
                    inverse = pow(1 + t * t, -1, self.p) if (1 + t * t) % self.p else 0
                    point.append((1 - t * t) * inverse % self.p)
                    sine = 2 * t * inverse % self.p
                elif g.kind == "sin":
                    point.append(sine)
                elif g.degree:
                    root = self._root(self._polynomial(self.lower[g.index], point), g.degree)
                    if root is None:
                        if g.constant:
                            self._take_prime()
                        break
                    point.append(root)
                else:
                    point.append(self.rng.randrange(1, self.p))
            else:
                return point
        raise NoPoint("no point of the variety over the primes tried")

    def values(self, nodes: Sequence[Node]) -> dict[Node, int]:
        """The nodes' values at a random point."""
        for _ in range(20):
            try:
                return self._values(nodes, self.point())
            except ValueError:
                continue
        raise NoPoint("a denominator vanished at every point tried")

    def _values(self, nodes: Sequence[Node], point: Sequence[int]) -> dict[Node, int]:
        ops, p = self.tower.tape.ops, self.p
        factors = [self._polynomial(f, point) for f in self.factors]
        out: dict[Node, int] = {}
        for i in self.tower.tape.reach(nodes):
            kernel = self.kernels.get(i)
            op = ops[i]
            if kernel is not None:
                value = self._polynomial(kernel[0], point)
                for k, e in kernel[1]:
                    value = value * pow(factors[k], -e, p) % p
            elif op[0] == "*":
                value = 1
                for a, e in op[1]:
                    value = value * pow(out[a], e, p) % p
            elif op[0] == "+":
                value = self._rational(op[1]) + sum(self._rational(c) * out[a] for a, c in op[2])
            else:
                value = self._rational(op[1])
            out[i] = value % p
        return {node: out[node] for node in nodes}

    def _rational(self, value: Fraction) -> int:
        if value.denominator == 1:
            return value.numerator
        return value.numerator * pow(value.denominator, -1, self.p)

    def log2_error(self, nodes: Sequence[Node]) -> float:
        """log₂ of the probability that a residual that isn't 0 in the tower vanishes at a random point."""
        degree, height = self._degree_and_height(nodes)
        schwartz = math.log2(max(degree, 1)) + 2 * self.radicals - self.bits + 1
        primes = self.bits - 1 - math.log2(self.bits) - 3
        content = math.log2(max(height, 1.0)) + 2 * self.radicals - primes
        return max(schwartz, content) + 1

    def _degree_and_height(self, nodes: Sequence[Node]) -> tuple[float, float]:
        """Bounds of the numerator's degree and of log₂ of its coefficients, through norms of the radicals."""
        weight: dict[int, tuple[float, float]] = {}
        for g in self.tower.generators:
            if g.kind in ("cos", "sin"):
                weight[g.index] = (2, 2)
            elif g.degree:
                top, under = self._weights(self.lower[g.index], weight)
                weight[g.index] = (top / g.degree + 1, under / g.degree + 1)
            else:
                weight[g.index] = (1, 0)
        factors = [self._weights(f, weight) for f in self.factors]
        bound: dict[Node, tuple[float, float]] = {}
        height = 1.0
        ops = self.tower.tape.ops
        for i in self.tower.tape.reach(nodes):
            kernel, op = self.kernels.get(i), ops[i]
            if kernel is not None:
                top, under = self._weights(kernel[0], weight)
                top += under
                for k, e in kernel[1]:
                    top, under = top + e * factors[k][1], under + e * sum(factors[k])
                bound[i] = (top, under)
            elif op[0] == "*":
                top = sum(e * bound[a][0] if e > 0 else -e * bound[a][1] for a, e in op[1])
                under = sum(e * bound[a][1] if e > 0 else -e * bound[a][0] for a, e in op[1])
                bound[i] = (top, under)
            elif op[0] == "+":
                under = sum(bound[a][1] for a, _ in op[2])
                bound[i] = (max(bound[a][0] + under - bound[a][1] for a, _ in op[2]), under)
                height += sum(c.numerator.bit_length() + c.denominator.bit_length() for _, c in op[2])
            else:
                bound[i] = (0, 0)
        degree = max((max(bound[n]) for n in nodes), default=0)
        return degree, height * (degree + 1)

    def _weights(self, terms: Terms, weight: dict[int, tuple[float, float]]) -> tuple[float, float]:
        top = max((sum(e * weight[k][0] for k, e in m) for m, _ in terms), default=0)
        under = max((sum(e * weight[k][1] for k, e in m) for m, _ in terms), default=0)
        return top, under
