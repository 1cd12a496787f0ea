"""A case's kernels, relations, values and denominators, as far as the rules for functions can follow them."""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import chain
from typing import Any

from canon.checker import core
from canon.checker.formulas import ZERO
from canon.checker.functions import Unknown
from canon.checker.points import domain_of
from canon.checker.polynomials import divided, parted
from canon.checker.ratios import multiple
from canon.checker.roots import Undecided
from canon.checker.signs import Signs
from canon.checker.statement import Statement
from canon.checker.terms import sign_of
from canon.checker.values import Values

FAILURES = (Undecided, Unknown, ZeroDivisionError, RecursionError)


class Followed:
    """What the rules say of kernels and of functions' values in them; False stands for what they don't reach."""

    def __init__(self, s: Statement, kernels: Mapping[str, int], atoms: Mapping[int, Any], values: Values) -> None:
        self.s, self.atoms, self.values, self.kernels = s, atoms, values, kernels
        self.lost = set[str]()
        for name, a in kernels.items():
            try:
                values.kernel(name, a)
            except FAILURES:
                self.lost.add(name)
        values.roots.claimed = {a: x for a, x in atoms.items() if not self._is_lost(*x)}

    def _is_lost(self, *polynomials: core.Polynomial) -> bool:
        return any(self.lost & core.names(p) for p in polynomials)

    def vanishes(self, relation: core.Polynomial) -> bool:
        """Whether a polynomial in the kernels is 0."""
        try:
            return not self._is_lost(relation) and not self.values.roots.fraction((relation, core.ONE))
        except FAILURES:
            return False

    def has_inverse(self, under: core.Polynomial) -> bool:
        """Whether a polynomial in the kernels is no divisor of 0: so it is identically 0 for no choice of roots."""
        try:
            return not self._is_lost(under) and bool(self.values.roots.fraction((core.ONE, under)))
        except FAILURES:
            return False

    def is_value(self, a: int) -> bool:
        """Whether a function, a constant or a name has the value that is stated."""
        over, under = self.atoms[a]
        try:
            if self._is_lost(over, under):
                return False
            return self.values.value(a) == self.values.roots.fraction((over, under))
        except FAILURES:
            return False

    def is_zero(self, a: int) -> bool:
        """Whether a residual that isn't written as an identity is 0 all the same, by the kernels or without them."""
        if self.s.surface:
            return (on := without_surface(self.s, a)) is not None and is_identity(at_random(self.s), on)
        return any(is_identity(values, a) for values in (self.values, at_random(self.s)))

    def is_not_zero(self, a: int) -> bool:
        """Whether a function of roots alone is 0 for no choice of them."""
        try:
            return bool(self.values.t.inverse(self.values.value(a)))
        except FAILURES:
            return False

    def is_number(self, a: int) -> bool:
        """Whether a formula is a rational number other than 0."""
        try:
            return bool(multiple(self.values.value(a), self.values.one, self.values.t.prime))
        except FAILURES:
            return False

    def is_nowhere_zero(self, data: Any) -> bool:
        """Whether a polynomial is seen to vanish nowhere: but for factors that the claim's formulas divide by, its
        terms have one sign, and one of them is never 0."""
        p, words, divisors = core.read(data), {**self.values.roots.words}, self._divisors()
        for name, a in self.kernels.items():
            op = self.s.f.ops[a]
            if op[:2] == ("f", "power") and self.values.polynomial(op[3][0]) in divisors:
                words[name] = (*words.get(name, ()), "nonzero")
        for factor in divisors:
            while len(p) > 1 and (quotient := divided(p, factor)) is not None:
                p = quotient
        monomial, rest = parted(p)
        nonzero = all({*words.get(name, ())} & {"positive", "negative", "nonzero"} for name in core.names(monomial))
        sign, never = sign_of(words, rest)
        return bool(p) and nonzero and sign != 0 and never

    def _divisors(self) -> list[core.Polynomial]:
        """What the claim's formulas divide by, as it stands or under a root."""
        f, found = self.s.f, list[core.Polynomial]()
        for a in f.reach(*domain_of(self.s)):
            if f.ops[a][0] == "^" and f.ops[a][2] < 0:
                below = f.ops[f.ops[a][1]]
                p = self.values.polynomial(below[3][0] if below[:2] == ("f", "power") else f.ops[a][1])
                found += [p] if p is not None and len(p) > 1 else []
        return found


def without_surface(s: Statement, a: int) -> int | None:
    """A formula on a surface that gives one name by the others, c n + d = 0 with a c that is 0 nowhere."""
    f = s.f
    (e, *more) = s.surface
    for n in sorted({op[1] for b in f.reach(e) if (op := f.ops[b])[0] == "s"} - s.fixed) if not more else ():
        c, d = f.slope(e, n), f.substitute(e, {n: ZERO})
        if all(f.ops[b] != ("s", n) for b in f.reach(c)) and Signs(s).is_nowhere_zero(c):
            return f.substitute(a, {n: f.mul(f.number(-1), f.over(d, c))})
    return None


def is_identity(values: Values, a: int) -> bool:
    """Whether a formula is seen to be 0 by the rules for its functions."""
    try:
        return not values.value(a)
    except FAILURES:
        return False


def at_random(s: Statement) -> Values:
    """Values at random numbers of their own: what is 0 there is 0, but for a chance of degree / 2^126."""
    rng, words = random.SystemRandom(), chain.from_iterable(s.words.values())
    real = "complex" not in words and ("s", "1j") not in s.f.ops
    values = Values(s, core.random_prime(rng), rng, real=real)
    values.roots.has_kernels = False
    return values
