"""Fractions over the tower, their denominators kept as powers of monic irreducible factors.

An element is (numerator, {factor number: exponent}). Every factor divides something that the claim's
formulas divide by, so none vanishes on the domain; a numerator that reduces to 0 by the relations
therefore proves that the element is the zero function there.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from canon.decide.ring import Polynomial, Ring
from canon.decide.tape import ONE, ZERO

Element = tuple[Polynomial, dict[int, int]]
MOST_REMEMBERED = 400
FEW, SHORT = 2, 10
"""Dividing a short polynomial in vain costs half of what a look at all its degrees does."""


class FractionField:
    """Arithmetic with fractions of polynomials modulo monic relations g**n = a (a of lower generators)."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.relations: list[tuple[int, int, Polynomial, Polynomial]] = []
        self.factors: list[Polynomial] = []
        self.root_of: list[tuple[Polynomial, int, int]] = []
        self._powers: dict[tuple[int, int], Polynomial] = {}
        self._split: dict[int, tuple[Polynomial, Fraction, dict[int, int]]] = {}
        self._free: dict[int, bool] = {}

    def relate(self, generator: int, degree: int, lower: Polynomial) -> None:
        """Add the relation generator ** degree = lower (which may contain the generator to lower powers)."""
        relation = self.ring.generators[generator] ** degree - lower
        self.relations.append((generator, degree, lower, relation))
        self.relations.sort(key=lambda entry: entry[0])

    def take_root(self, f: Polynomial, generator: int, degree: int) -> None:
        """From now on the factor f of a denominator is generator ** degree."""
        self.root_of = [*(entry for entry in self.root_of if entry[0] != f), (f, generator, degree)]
        self._split.clear()

    # -- numerators -------------------------------------------------------------------------------

    def normal(self, p: Polynomial) -> Polynomial:
        """The remainder of p by the relations, from the top of the tower down."""
        if not self.relations or not p:
            return p
        ring, degrees = self.ring, None
        left = len(self.relations)
        for generator, degree, _, relation in reversed(self.relations):
            if degrees is None and (left > FEW or len(p) > SHORT):
                degrees = ring.degrees(p)
            left -= 1
            if degrees is not None and degrees[generator] < degree:
                continue
            ring.charge(len(p) * len(relation))
            p = p % relation
            if not p:
                return p
            degrees = None
        return p

    def factor_number(self, f: Polynomial) -> int:
        """The number of a monic factor, new or old."""
        for k, known in enumerate(self.factors):
            if known == f:
                return k
        self.factors.append(f)
        return len(self.factors) - 1

    def factor_power(self, k: int, exponent: int) -> Polynomial:
        """factor ** exponent in normal form."""
        known = self._powers.get((k, exponent))
        if known is None:
            if exponent < 4:
                known = self.normal(self.ring.power(self.factors[k], exponent))
            else:
                half = exponent // 2
                known = self.normal(self.ring.times(self.factor_power(k, half), self.factor_power(k, exponent - half)))
            self._powers[k, exponent] = known
        return known

    def split_denominator(self, p: Polynomial) -> tuple[Fraction, dict[int, int]]:
        """p as constant · Π factor ** exponent, exactly (modulo the relations).

        The answer is remembered for this very polynomial (by its identity: polynomials have no hash).
        """
        if len(p) > MOST_REMEMBERED:
            return self._split_anew(p)
        known = self._split.get(id(p))
        if known is None:
            known = self._split[id(p)] = (p, *self._split_anew(p))
        return known[1], dict(known[2])

    def _split_anew(self, p: Polynomial) -> tuple[Fraction, dict[int, int]]:
        ring = self.ring
        if p.is_constant():
            return ring.leading(p), {}
        content, pieces = ring.factor(p) if len(p) <= 400 else (ONE, [(p, 1)])
        out: dict[int, int] = {}
        for f, e in pieces:
            lead = ring.leading(f)
            if lead != 1:
                f = ring.scaled(f, 1 / lead)
                content *= lead**e
            for radicand, generator, degree in self.root_of:
                if radicand == f:
                    f, e = ring.generators[generator], e * degree
                    break
            k = self.factor_number(f)
            out[k] = out.get(k, 0) + e
        return content, out

    # -- elements -----------------------------------------------------------------------------------

    def constant(self, value: Fraction | int) -> Element:
        """A rational number."""
        return self.ring.constant(value), {}

    def generator(self, k: int) -> Element:
        """The k-th generator."""
        return self.ring.generators[k], {}

    def inverse(self, x: Element) -> Element:
        """1 / x. Raises ZeroDivisionError where x is 0 by the relations."""
        numerator, denominator = x
        if not numerator:
            raise ZeroDivisionError("a denominator is zero by the relations of its kernels")
        ring = self.ring
        content, pieces = self.split_denominator(numerator)
        n = ring.constant(1 / content)
        out: dict[int, int] = {}
        for k, e in pieces.items():
            left = e - denominator.get(k, 0)
            if left > 0:
                out[k] = left
            elif left < 0:
                n = self.normal(ring.times(n, self.factor_power(k, -left)))
        for k, e in denominator.items():
            if k not in pieces:
                n = self.normal(ring.times(n, self.factor_power(k, e)))
        return n, out

    def product(self, elements: Sequence[Element]) -> Element:
        """The product of the elements."""
        denominator: dict[int, int] = {}
        for _, den in elements:
            for k, e in den.items():
                denominator[k] = denominator.get(k, 0) + e
        numerators = sorted((x[0] for x in elements), key=len)
        n = numerators[0]
        for m in numerators[1:]:
            n = self.normal(self.ring.times(n, m))
        return (n, denominator) if n else (n, {})

    def power(self, x: Element, exponent: int) -> Element:
        """x ** exponent, for any integer exponent."""
        if exponent == 0:
            return self.constant(1)
        if exponent < 0:
            x, exponent = self.inverse(x), -exponent
        if exponent == 1:
            return x
        numerator, denominator = x
        if not self._is_algebraic(numerator):
            n = self.ring.power(numerator, exponent)
        else:
            n, base, k = None, numerator, exponent
            while k:
                if k & 1:
                    n = base if n is None else self.normal(self.ring.times(n, base))
                k >>= 1
                if k:
                    base = self.normal(self.ring.times(base, base))
        return n, {k: e * exponent for k, e in denominator.items()}

    def _is_algebraic(self, p: Polynomial) -> bool:
        degrees = self.ring.degrees(p) if self.relations else ()
        return any(degrees[g] > 0 for g, *_ in self.relations)

    def combine(self, terms: Iterable[tuple[Fraction, Element]], constant: Fraction = ZERO) -> Element:
        """constant + Σ coefficient · element, over the least common denominator, with eager cancellation."""
        ring = self.ring
        groups: dict[tuple[tuple[int, int], ...], Polynomial] = {}
        if constant:
            groups[()] = ring.constant(constant)
        for coefficient, (n, den) in terms:
            if not n:
                continue
            key = tuple(sorted(den.items()))
            part = n if coefficient == 1 else (-n if coefficient == -1 else ring.scaled(n, coefficient))
            groups[key] = groups[key] + part if key in groups else part
        groups = {key: n for key, n in groups.items() if n}
        if not groups:
            return ring.zero, {}
        if len(groups) == 1:
            ((key, n),) = groups.items()
            return n, dict(key)
        least: dict[int, int] = {}
        for key in groups:
            for k, e in key:
                least[k] = max(least.get(k, 0), e)
        total = ring.zero
        for key, n in groups.items():
            have = dict(key)
            for k, e in least.items():
                if e > have.get(k, 0):
                    n = self.normal(ring.times(n, self.factor_power(k, e - have.get(k, 0))))
            total = total + n
        return self._cancel(total, least) if total else (ring.zero, {})

    def _cancel(self, n: Polynomial, denominator: dict[int, int]) -> Element:
        """Divide out denominator factors that contain no algebraic generator, as often as they divide exactly."""
        out: dict[int, int] = {}
        for k, e in denominator.items():
            if self.is_free(k):
                while e:
                    q = self.ring.quotient(n, self.factors[k])
                    if q is None:
                        break
                    n, e = q, e - 1
            if e:
                out[k] = e
        return n, out

    def is_free(self, k: int) -> bool:
        """True when the factor contains no generator that has a relation."""
        known = self._free.get(k)
        if known is None:
            known = self._free[k] = not self._is_algebraic(self.factors[k])
        return known

    def negative(self, x: Element) -> Element:
        """−x."""
        return -x[0], x[1]

    def minus(self, a: Element, b: Element) -> Element:
        """a − b."""
        return self.combine(((ONE, a), (-ONE, b)))

    def is_zero(self, x: Element) -> bool:
        """True when the numerator is in the ideal of the relations."""
        return not self.normal(x[0])

    def equal(self, a: Element, b: Element) -> bool:
        """True when a − b is zero by the relations."""
        return self.is_zero(self.minus(a, b))
