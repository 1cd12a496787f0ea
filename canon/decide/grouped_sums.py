"""Sums of fractions kept apart by denominator: {denominator: numerator}.

Nothing is put over a common denominator until the last test, which first splits the numerators by
parity in the quadratic generators: with many different radicals (the distances of n bodies) the common
denominator is what cannot be afforded.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from canon.decide.fraction_field import Element, FractionField
from canon.decide.ring import Polynomial, TooCostly
from canon.decide.tape import ZERO, Node

Key = tuple[tuple[int, int], ...]
Grouped = dict[Key, Polynomial]
MOST_GROUPS = 2000


class GroupedSums:
    """Arithmetic of grouped sums over a field of fractions."""

    def __init__(self, field: FractionField) -> None:
        self.field, self.ring = field, field.ring

    def lift(self, x: Element) -> Grouped:
        """A fraction as a grouped sum."""
        return {tuple(sorted(x[1].items())): x[0]} if x[0] else {}

    def collapse(self, x: Grouped) -> Element:
        """The grouped sum over one denominator."""
        return self.field.combine([(Fraction(1), (n, dict(key))) for key, n in x.items()])

    def combine(self, terms: Iterable[tuple[Fraction, Grouped]], constant: Fraction = ZERO) -> Grouped:
        """constant + Σ coefficient · grouped sum."""
        out: Grouped = {(): self.ring.constant(constant)} if constant else {}
        for coefficient, x in terms:
            for key, n in x.items():
                part = n if coefficient == 1 else (-n if coefficient == -1 else self.ring.scaled(n, coefficient))
                out[key] = out[key] + part if key in out else part
        return self._merged(out)

    def product(self, elements: Sequence[Grouped]) -> Grouped:
        """The product of grouped sums."""
        ordered = sorted(elements, key=len)
        total = ordered[0]
        for other in ordered[1:]:
            total = self._times(total, other)
        return total

    def power(self, x: Grouped, exponent: int) -> Grouped:
        """x ** exponent for any integer exponent."""
        if exponent == 0:
            return {(): self.ring.one}
        if exponent < 0:
            single = self._single(x) or self.collapse(x)
            x, exponent = self.lift(self.field.inverse(single)), -exponent
        single = self._single(x)
        if single is not None:
            return self.lift(self.field.power(single, exponent))
        total, base = None, x
        while exponent:
            if exponent & 1:
                total = base if total is None else self._times(total, base)
            exponent >>= 1
            if exponent:
                base = self._times(base, base)
        return total if total is not None else {(): self.ring.one}

    def node(self, op: tuple[Any, ...], values: Mapping[Node, Grouped]) -> Grouped:
        """A sum, product or number node from the values of its arguments."""
        if op[0] == "+":
            return self.combine([(c, values[a]) for a, c in op[2]], op[1])
        if op[0] == "*":
            return self.product([self.power(values[a], e) for a, e in op[1]])
        return {(): self.ring.constant(op[1])} if op[1] else {}

    def is_zero(self, x: Grouped) -> bool:
        """True when the sum reduces to 0 by the relations, class by class of parity."""
        x = {key: n for key, n in x.items() if n}
        if not x:
            return True
        if len(x) == 1:
            return not self.field.normal(next(iter(x.values())))
        quadratic = {g: lower for g, degree, lower, _ in self.field.relations if degree == 2}
        quadratic = {g: a for g, a in quadratic.items() if self.ring.degrees(a)[g] <= 0}
        radicals, parity = self._parity_generators(x, quadratic)
        classes: dict[tuple[int, ...], dict[tuple, Polynomial]] = {}
        for key, n in x.items():
            self._distribute(key, n, radicals, parity, classes)
        return all(self._class_vanishes(group, quadratic) for group in classes.values())

    # -- inside -----------------------------------------------------------------------------------

    def _single(self, x: Grouped) -> Element | None:
        if len(x) != 1:
            return None
        ((key, n),) = x.items()
        return n, dict(key)

    def _merged(self, x: Grouped) -> Grouped:
        """Put together the groups with the same set of denominator factors."""
        x = {key: n for key, n in x.items() if n}
        if len(x) < 2:
            return x
        by_factors: dict[tuple[int, ...], list[Key]] = {}
        for key in x:
            by_factors.setdefault(tuple(k for k, _ in key), []).append(key)
        out: Grouped = {}
        for factors, keys in by_factors.items():
            if len(keys) == 1:
                out[keys[0]] = x[keys[0]]
                continue
            least = tuple((k, max(dict(key)[k] for key in keys)) for k in factors)
            total = self.ring.zero
            for key in keys:
                total = total + self._raised(x[key], dict(key), least)
            if total:
                out[least] = total
        if len(out) > MOST_GROUPS:
            raise TooCostly(f"{len(out)} denominators")
        return out

    def _raised(self, n: Polynomial, have: Mapping[int, int], least: Key) -> Polynomial:
        for k, e in least:
            if e > have.get(k, 0):
                n = self.field.normal(self.ring.times(n, self.field.factor_power(k, e - have.get(k, 0))))
        return n

    def _times(self, a: Grouped, b: Grouped) -> Grouped:
        if len(a) * len(b) > 4 * MOST_GROUPS:
            raise TooCostly(f"{len(a)} by {len(b)} denominators")
        out: Grouped = {}
        for key_a, n_a in a.items():
            for key_b, n_b in b.items():
                merged = dict(key_a)
                for k, e in key_b:
                    merged[k] = merged.get(k, 0) + e
                n = self.field.normal(self.ring.times(n_a, n_b))
                if n:
                    key = tuple(sorted(merged.items()))
                    out[key] = out[key] + n if key in out else n
        return self._merged(out)

    def _parity_generators(self, x: Grouped, quadratic: Mapping[int, Polynomial]) -> tuple[dict[int, int], list[int]]:
        """Denominator factors that are bare quadratic generators, and the generators to split by."""
        radicals: dict[int, int] = {}
        blocked: set[int] = set()
        for k in {k for key in x for k, _ in key}:
            factor = self.field.factors[k]
            degrees = self.ring.degrees(factor)
            own = [g for g, e in enumerate(degrees) if e > 0]
            if len(factor) == 1 and sum(degrees) == 1 and own[0] in quadratic:
                radicals[k] = own[0]
            else:
                blocked.update(g for g in own if g in quadratic)
        for lower in quadratic.values():
            blocked.update(h for h, e in enumerate(self.ring.degrees(lower)) if e > 0 and h in quadratic)
        for _, degree, lower, _ in self.field.relations:
            if degree != 2:
                blocked.update(h for h, e in enumerate(self.ring.degrees(lower)) if e > 0 and h in quadratic)
        radicals = {k: g for k, g in radicals.items() if g not in blocked}
        return radicals, [g for g in quadratic if g not in blocked]

    def _distribute(
        self,
        key: Key,
        n: Polynomial,
        radicals: Mapping[int, int],
        parity: Sequence[int],
        classes: dict[tuple[int, ...], dict[tuple, Polynomial]],
    ) -> None:
        """Write 1/√a as √a/a, then sort the numerator's terms by their parity in the split generators."""
        under: list[tuple[tuple[str, int], int]] = []
        for k, e in key:
            g = radicals.get(k)
            if g is None:
                under.append((("factor", k), e))
                continue
            if e % 2:
                n = self.field.normal(self.ring.times(n, self.ring.generators[g]))
            under.append((("radicand", g), (e + 1) // 2))
        below = tuple(sorted(under))
        parts: dict[tuple[int, ...], dict] = {}
        for monomial, coefficient in self.ring.terms(n).items():
            parts.setdefault(tuple(monomial[g] & 1 for g in parity), {})[monomial] = coefficient
        for signature, terms in parts.items():
            group = classes.setdefault(signature, {})
            p = self.ring.polynomial(terms)
            group[below] = group[below] + p if below in group else p

    def _class_vanishes(self, group: Mapping[tuple, Polynomial], quadratic: Mapping[int, Polynomial]) -> bool:
        group = {below: n for below, n in group.items() if n}
        least: dict[tuple[str, int], int] = {}
        for below in group:
            for factor, e in below:
                least[factor] = max(least.get(factor, 0), e)
        total = self.ring.zero
        for below, n in group.items():
            have = dict(below)
            for factor, e in least.items():
                p = self.field.factors[factor[1]] if factor[0] == "factor" else quadratic[factor[1]]
                for _ in range(e - have.get(factor, 0)):
                    n = self.field.normal(self.ring.times(n, p))
            total = total + n
        return not self.field.normal(total)
