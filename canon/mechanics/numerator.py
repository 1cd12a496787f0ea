"""Numerators of expressions modulo the relations of their roots, sines and other generators.

Roots are generators t with t^n = a polynomial in those below, i with i² = −1, sines with sin² = 1 − cos²; all else that
isn't rational is a free generator. An expression whose numerator is 0 modulo these relations vanishes wherever it is
defined, for every branch of its roots. A number that isn't so reduced is a root of the characteristic polynomial of its
multiplication on the algebra of its roots, so that a ball within Cauchy's bound on the others proves 0.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import product
from typing import Any, Final

import sympy as sp
from flint import acb, arb, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx

from canon.ball_precision import precision
from canon.mechanics.multiplied import terms_of_power
from canon.mechanics.principal_values import Unknown, ball, power

LARGEST: Final = 96
"""The highest dimension of an algebra of roots whose characteristic polynomial is taken."""
MOST: Final = 100_000
"""The most terms of a polynomial."""
LONGEST: Final = 20000
"""The most operations of an expression that is brought to normal form."""


class Numerator:
    """The numerator of an expression in generators, reduced modulo their relations, the last generators first."""

    def __init__(self, expression: Any) -> None:
        self.atoms: list[Any] = []
        self.orders: dict[Any, int] = {}
        self._collect(expression)
        count = len(self.atoms)
        self.ring = fmpq_mpoly_ctx.get([f"x{k}" for k in range(count)] or ["x0"], "lex")
        gens = self.ring.gens()
        # of a lexicographic order the first generator is the highest: the last atoms come first
        self.generator = {atom: gens[count - 1 - k] for k, atom in enumerate(self.atoms)}
        self.place = {str(g): k for k, g in enumerate(gens)}
        self.roots: dict[Any, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        self.relations: list[tuple[fmpq_mpoly, int, fmpq_mpoly]] = []
        for atom in self.atoms:
            self._relate(atom)
        self.value = self.reduced(self.fraction(expression)[0])

    @staticmethod
    def of(expression: Any) -> Numerator | None:
        """The normal form; None where the expression is too long or has a denominator that is 0."""
        if sp.count_ops(expression) > LONGEST:
            return None
        try:
            return Numerator(expression)
        except (Unknown, ZeroDivisionError):
            return None

    def _collect(self, e: Any) -> None:
        """The generators of an expression, each after those that it is made of."""
        if e.is_Rational or ("atom", e) in self.atoms:
            return
        if e.is_Add or e.is_Mul:
            for part in e.args:
                self._collect(part)
        elif e.is_Pow and e.exp.is_Rational:
            self._collect(e.base)
            if not e.exp.is_Integer:
                if e.base not in self.orders:
                    self.orders[e.base] = 1
                    self.atoms.append(("root", e.base))
                self.orders[e.base] = math.lcm(self.orders[e.base], int(e.exp.q))
        else:
            for odd, even in ((sp.sin, sp.cos), (sp.sinh, sp.cosh)):
                if isinstance(e, odd):
                    self._collect(even(e.args[0]))
            self.atoms.append(("atom", e))

    def _relate(self, atom: Any) -> None:
        """The relation of a generator, with leading coefficient 1."""
        kind, e = atom
        t, one = self.generator[atom], self.ring.constant(1)
        if kind == "root":
            above, below = self.fraction(e)
            n = self.orders[e]
            self.roots[e] = (t, below)  # base^(1/n) = t/below with t^n = above · below^(n − 1)
            self.relations.append((t, n, t**n - self.reduced(above * below ** (n - 1))))
        elif e is sp.I:
            self.relations.append((t, 2, t**2 + one))
        elif isinstance(e, (sp.sin, sp.sinh)):
            even = sp.cos(e.args[0]) if isinstance(e, sp.sin) else sp.cosh(e.args[0])
            c = self.fraction(even)[0]
            self.relations.append((t, 2, t**2 - self.reduced(one - c**2 if isinstance(e, sp.sin) else c**2 - one)))
        elif isinstance(e, sp.CRootOf):
            coefficients = [self.ring.constant(fmpq(int(c.p), int(c.q))) for c in e.poly.monic().all_coeffs()]
            degree = len(coefficients) - 1
            polynomial = sum((c * t ** (degree - k) for k, c in enumerate(coefficients)), start=self.ring.constant(0))
            self.relations.append((t, degree, polynomial))

    def fraction(self, e: Any) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """The expression as a quotient of polynomials in the generators."""
        one = self.ring.constant(1)
        if e.is_Rational:
            return self.ring.constant(fmpq(int(e.p), int(e.q))), one
        if ("atom", e) in self.generator:
            return self.generator["atom", e], one
        if e.is_Add:
            above, below = self.ring.constant(0), one
            for part in e.args:
                a, b = self.fraction(part)
                if b == below:
                    above = above + a
                else:
                    above, below = self._product(above, b) + self._product(a, below), self._product(below, b)
            return self.reduced(above), self.reduced(below)
        if e.is_Mul:
            above, below = one, one
            for part in e.args:
                a, b = self.fraction(part)
                above, below = self.reduced(self._product(above, a)), self.reduced(self._product(below, b))
            return above, below
        if e.is_Pow and e.exp.is_Integer:
            return self._to_a_power(*self.fraction(e.base), int(e.exp))
        if e.is_Pow and e.exp.is_Rational:
            t, below = self.roots[e.base]
            return self._to_a_power(t, below, int(e.exp * self.orders[e.base]))
        raise Unknown

    def _to_a_power(self, above: fmpq_mpoly, below: fmpq_mpoly, n: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        if abs(n) > 64:
            raise Unknown
        if n < 0:
            above, below, n = below, above, -n
        if below == 0:
            raise Unknown
        for polynomial in (above, below):
            self._admit(terms_of_power(len(polynomial), n), n * int(polynomial.total_degree()))
        return self.reduced(above**n), self.reduced(below**n)

    def _admit(self, terms: int, degree: int) -> None:
        """Raises `Unknown` where a polynomial would have too many terms: as many as that, or all of its degree."""
        if terms > MOST and math.comb(degree + len(self.atoms), degree) > MOST:
            raise Unknown

    def _product(self, a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
        """a b. Raises `Unknown` where that is too long."""
        if a and b:
            self._admit(len(a) * len(b), int(a.total_degree() + b.total_degree()))
        return a * b

    def reduced(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        """Its remainder by the relations, the highest generator first."""
        for t, order, relation in reversed(self.relations):
            times = int(polynomial.degrees()[self.place[str(t)]]) // order
            if times > 1 and polynomial:
                self._admit(terms_of_power(len(relation) - 1, times) * len(polynomial), times * relation.total_degree())
            _, polynomial = divmod(polynomial, relation)
        return polynomial

    def bound(self) -> arb | None:
        """A lower bound on the modulus of the number, if it isn't 0; None where a generator has no relation."""
        sizes = {str(t): n for t, n, _ in self.relations}
        names = [str(g) for g in self.ring.gens()]
        if not self.relations or set(names) - set(sizes) or math.prod(sizes.values()) > LARGEST:
            return None
        gens = self.ring.gens()
        basis = list(product(*(range(sizes[name]) for name in names)))
        place = {exponents: k for k, exponents in enumerate(basis)}
        matrix = fmpq_mat(len(basis), len(basis))
        for row, exponents in enumerate(basis):
            monomial = math.prod((g**n for g, n in zip(gens, exponents, strict=True)), start=self.ring.constant(1))
            for powers, c in self.reduced(self.value * monomial).to_dict().items():
                matrix[row, place[tuple(int(n) for n in powers)]] = c
        polynomial = matrix.charpoly()
        coefficients = [polynomial[k] for k in range(polynomial.degree() + 1)]
        while coefficients[0] == 0:
            coefficients.pop(0)
        first, largest = abs(coefficients[0]), max((abs(c) for c in coefficients[1:]), default=fmpq(0))
        with precision(256):
            return arb(first / (first + largest)) / 2

    def ball(self, bits: int) -> acb | None:
        """The value of the reduced numerator, of a number."""
        with precision(bits):
            try:
                points = {}
                for atom in self.atoms:
                    kind, e = atom
                    value = ball(e, {}, bits)
                    if kind == "root":
                        below = self.roots[e][1]
                        value = power(value, sp.Rational(1, self.orders[e]), acb(fmpq(1, self.orders[e])))
                        value = value * self._at(below, points)
                    points[str(self.generator[atom])] = value
                return self._at(self.value, points)
            except (Unknown, ZeroDivisionError, OverflowError):
                return None

    def _at(self, polynomial: fmpq_mpoly, points: Mapping[str, acb]) -> acb:
        names, total = [str(g) for g in self.ring.gens()], acb(0)
        for powers, c in polynomial.to_dict().items():
            term = acb(c)
            for name, n in zip(names, powers, strict=True):
                if n:
                    term = term * points[name] ** int(n)
            total = total + term
        return total
