"""Names, roots and signs in a tower: which root is meant where a formula has one.

R^(1/n) is a root that is there already, a product of such, a quantity v that is claimed, with v^n = R, and shown to be
nowhere negative, or else a new one. A sign is shown by terms of one sign each, or by the domain's inequalities.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import combinations, product
from math import isqrt
from typing import Any

from canon.checker import core
from canon.checker.functions import Unknown
from canon.checker.points import domain_of
from canon.checker.ratios import multiple, ratio, rational
from canon.checker.signs import Signs
from canon.checker.statement import Statement
from canon.checker.terms import sign_of
from canon.checker.tower import Element, Tower

MOST_ROOTS = 9
"""So many numbers' roots are tried in products of up to four."""
MAYBE_ROOTS = ("power", "cos", "sin", "cosh")
Fraction_ = tuple[core.Polynomial, core.Polynomial]


class Undecided(Exception):
    """A value that the rules neither confirm nor contradict."""


class Roots:
    """The values of names, the roots that are known, and what is nowhere negative."""

    def __init__(self, s: Statement, t: Tower, value: Callable[[int], Element], *, real: bool) -> None:
        self.s, self.f, self.t, self.real, self._value = s, s.f, t, real, value
        self.claimed: Mapping[int, Fraction_] = {}
        self.names: dict[str, Element] = {}
        self.words: dict[str, Sequence[str]] = {**s.words, "pi": ("positive",)}
        self._radicands: list[int] | None = None
        self.has_kernels = True
        self.meanings: dict[str, int] = {}  # of kernels, as formulas in the claim's names
        self._roots: list[tuple[Element, int, Element, bool]] = []  # radicand, degree, root, whether it is positive
        self._divisors: dict[int, Element] = {}  # what is divided by, and is nowhere negative, or nowhere positive
        self._said: list[Element] = []  # what the domain says to be positive
        self.nonnegative: list[Element] = []  # radicands of real roots, and what the domain says to be positive
        self._conditions = [a for a, kind in s.conditions if real and kind == "positive"]
        for op in (self.f.ops[a] for a in self._conditions):
            if op[0] == "s":
                self.words[op[1]] = (*self.words.get(op[1], ()), "nonnegative")

    def _read_conditions(self, *, plain: bool) -> None:
        """What the domain says to be positive; functions in it not before the kernels, whose roots are used."""
        for a in [*self._conditions]:
            if plain and any(self.f.ops[b][0] == "f" for b in self.f.reach(a)):
                continue
            self._conditions.remove(a)
            try:
                self._said.append(self._value(a))
                self.nonnegative.append(self._said[-1])
            except (Undecided, Unknown, ZeroDivisionError, ValueError):
                continue

    def sign_of_circular(self, name: str, angle: Element) -> Sequence[str]:
        """That a sine, or a cosine, has one sign, where the domain says so of its angle."""
        self._read_conditions(plain=True)
        turn = self.t.mul(self.named("pi"), self.t.constant(core.Fraction(1, 2)))
        if name == "sin":
            angle = self.t.add(angle, turn, -1)
        for half, word in ((0, "nonnegative"), (1, "nonpositive"), (-1, "nonpositive")):
            moved = self.t.add(angle, self.t.mul(turn, self.t.constant(core.Fraction(2 * half))), -1)
            if all(self._multiple_sign(self.t.add(turn, moved, sign)) > 0 for sign in (1, -1)):
                return (word,)
        return ()

    def fraction(self, x: Fraction_) -> Element:
        """The value of numerator / denominator. Raises ZeroDivisionError."""
        over, under = (self.t.polynomial(p, _Names(self)) for p in x)
        return self.t.mul(over, self.t.inverse(under)) if x[1] != core.ONE else over

    def named(self, name: str) -> Element:
        """The value of a name."""
        if name not in self.names:
            self.names[name] = self.t.root(self.t.constant(core.Fraction(-1)), 2) if name == "1j" else self.t.free()
        return self.names[name]

    def is_positive(self, node: int) -> bool:
        """Whether a formula is made of positive numbers and names alone."""
        ops = [self.f.ops[a] for a in self.f.reach(node)]
        return all(
            op[1] > 0 if op[0] == "n" else "positive" in self.words.get(op[1], ()) if op[0] == "s" else op[0] in "+*^"
            for op in ops
        )

    def power(self, base: Element, r: core.Fraction, claimed: Fraction_ | None, positive: bool) -> Element:
        """base^r = (base^(1/n))^m."""
        m, n, t = r.numerator, r.denominator, self.t
        if abs(m) == 1:
            own = claimed if m == 1 or claimed is None else (claimed[1], claimed[0])
            root = self.root(base, n, own, positive)
        elif (root := self.known_root(base, n, positive)) is None:
            power = t.power(base, m)
            if claimed is not None and self.real and t.power(self.fraction(claimed), n) == power:
                if n % 2 or self._sign(claimed) > 0:
                    return self.fraction(claimed)
            root = self.root(base, n, None, positive)
        return t.power(root, m)

    def root(self, power: Element, degree: int, claimed: Fraction_ | None, positive: bool = False) -> Element:
        """The root of a quantity: one that is claimed and nowhere negative, one that is known, or a new one."""
        positive = positive or self.real
        known = power if degree == 1 else self.known_root(power, degree, positive)
        if claimed is not None and degree > 1:
            value = self.fraction(claimed)
            if value == known:
                return value
            if self.real and self.t.power(value, degree) == power and (degree % 2 or self._sign(claimed) > 0):
                self.nonnegative += [power] if degree % 2 == 0 else []
                return value  # of a positive quantity there is one root that is real, or one that is positive
            if known is None:
                raise Undecided
        if known is not None:
            return known
        for candidate in self._candidates() if self.real and degree == 2 else ():
            if self.t.mul(*[self.fraction(candidate)] * 2) == power and self._sign(candidate) > 0:
                self.nonnegative.append(power)
                return self.fraction(candidate)
        root = self.t.root(power, degree)
        self._roots.append((power, degree, root, positive))
        if self.real and degree % 2 == 0:
            self.nonnegative.append(power)
        return root

    def _candidates(self) -> list[Fraction_]:
        """What is claimed of functions that may be roots, as far as their values can be told already."""
        ready = []
        for a, x in self.claimed.items():
            if self.f.ops[a][0] == "f" and self.f.ops[a][1] in MAYBE_ROOTS:
                if all(name in self.names or name in self.s.declared for p in x for name in core.names(p)):
                    ready.append(x)
        return ready

    def is_root(self, x: Element, *, positive: bool) -> None:
        """What is nowhere negative, or nowhere positive, is, but for its sign, the root of its square."""
        if x:
            root = x if positive else self.t.mul(x, self.t.constant(core.Fraction(-1)))
            self._roots.append((self.t.mul(x, x), 2, root, True))

    def note_divisors(self, node: int, power: Element) -> None:
        """Look for the signs of what is divided by in a radicand, if no root of it is known."""
        if not self.real or self.known_root(power, 2, True) is not None:
            return
        for op in (self.f.ops[b] for b in self.f.reach(node)):
            if op[0] == "^" and op[2] < 0 and op[1] not in self._divisors:
                self._divisors[op[1]] = {}
                for k in (1, -1):
                    if self.is_above(own := self.f.mul(self.f.number(k), op[1])):
                        self._divisors[op[1]] = self._value(own)

    def known_root(self, power: Element, degree: int, positive: bool) -> Element | None:
        """A root that is known, a product of such, or such a one over, or times, what is said to be positive."""
        found, t = self._product_of_roots(power, degree, positive, (1, 2, 3, 4)), self.t
        if found is not None or not positive or degree != 2 or not power or not self.real:
            return found
        self._read_conditions(plain=self.has_kernels)
        for x in (*self._said, *self._divisors.values()):
            for n in (1, -1) if set(x) == {()} else ():
                rest = self._product_of_roots(t.mul(power, t.power(x, -2 * n)), 2, True, (1, 2))
                if rest is not None:
                    return t.mul(rest, t.power(x, n))
            square = ratio(power, t.mul(x, x), t.prime)
            if square is not None and (number := self._rational_root({(): square})) is not None:
                return t.mul(x, t.constant(number))
        return None

    def _product_of_roots(self, power: Element, degree: int, positive: bool, sizes: Sequence[int]) -> Element | None:
        """A root that is known, or for square roots of numbers that aren't negative a product of such."""
        t = self.t
        for radicand, n, root, _ in self._roots:
            if radicand == power and n % degree == 0:
                return t.power(root, n // degree)
            if radicand == power and degree % n == 0:
                return self.root(root, degree // n, None, positive)
        if not positive or degree != 2 or not power:
            return None
        roots = [(r, root) for r, n, root, real in self._roots if n == 2 and real]
        if (number := self._rational_root(power)) is not None:
            return t.constant(number)
        for radicand, root in roots:
            found = ratio(power, radicand, t.prime)
            if found is not None and (number := self._rational_root({(): found})) is not None:
                return t.mul(root, t.constant(number))
        if set(power) != {()}:
            return None
        named = [self.named(n) for n, words in self.words.items() if {"positive", "nonnegative"} & {*words}]
        plain = [(r[()], root) for r, root in roots if set(r) == {()}]
        plain += [(pow(x[()], 2, t.prime), x) for x in named if set(x) == {()}]
        for size in [n for n in sizes if n < 3 or len(plain) <= MOST_ROOTS]:
            for chosen in combinations(plain, size):
                for signs in product((1, -1), repeat=size):
                    left = power[()]
                    for (r, _), sign in zip(chosen, signs, strict=True):
                        left = left * pow(r, -sign, t.prime) % t.prime
                    if (number := self._rational_root({(): left})) is not None:
                        found = t.constant(number)
                        for (_, root), sign in zip(chosen, signs, strict=True):
                            found = t.mul(found, t.power(root, sign))
                        return found
        return None

    def _rational_root(self, x: Element) -> core.Fraction | None:
        """The positive square root of a rational number that is a square."""
        value = rational(x[()], self.t.prime) if set(x) == {()} else None
        if value is None or value <= 0:
            return None
        root = core.Fraction(isqrt(value.numerator), isqrt(value.denominator))
        return root if root**2 == value else None

    # -- signs --------------------------------------------------------------------------------------

    def _sign(self, x: Fraction_) -> int:
        """1 or -1 where a fraction is shown to be nowhere negative, or nowhere positive; 0 where it isn't."""
        sign = self._sign_of(x[0]) * self._sign_of(x[1])
        if sign or not self.real:
            return sign
        parts = list[int]()
        for p in x:
            terms = []
            for monomial, c in p.items():
                powers = (self.f.power(self.f.node("s", n), self.f.number(e)) for n, e in monomial)
                terms.append(self.f.mul(self.f.number(c), *powers))
            parts.append(self.f.add(*terms))
        own = self.f.over(*parts)
        return next((k for k in (1, -1) if self.is_above(self.f.mul(self.f.number(k), own), strict=False)), 0)

    def is_above(self, a: int, *, strict: bool = True) -> bool:
        """Whether a formula is seen to be positive, or nowhere negative, what kernels stand for being put in.

        Where the claim's own formulas are real, their radicands aren't negative.
        """
        if self._radicands is None:
            own = self.f.reach(*domain_of(self.s))
            self._radicands = [b for b in own if self.f.ops[b][:2] == ("f", "power")]
        return self.real and Signs(self.s, self._radicands).is_positive(
            self.f.substitute(a, self.meanings), strict=strict
        )

    def _sign_of(self, p: core.Polynomial) -> int:
        """The sign of a product of names and of a sum: of terms of one sign, or a multiple of what has a sign."""
        sign = sign_of(self.words, p)[0]
        if sign or not p:
            return sign
        common = dict(min(p, key=len))
        for monomial in p:
            powers = dict(monomial)
            common = {n: min(e, powers[n]) for n, e in common.items() if n in powers}
        rest = {tuple((n, e - common.get(n, 0)) for n, e in m if e > common.get(n, 0)): c for m, c in p.items()}
        outer = 1
        for name, e in common.items():
            outer *= sign_of(self.words, {((name, e),): core.Fraction(1)})[0] or self._known_sign(self.named(name))
        return outer * (self._known_sign(self.t.polynomial(rest, _Names(self))) if rest != core.ONE else 1)

    def _known_sign(self, x: Element) -> int:
        """The sign of a rational multiple of what is nowhere negative; 0 for anything else."""
        self._read_conditions(plain=False)
        return self._multiple_sign(x)

    def _multiple_sign(self, x: Element) -> int:
        named = [
            self.named(n) for n, words in self.words.items() if self.real and {"positive", "nonnegative"} & {*words}
        ]
        for other in (*self.nonnegative, *named):
            if value := multiple(x, other, self.t.prime):
                return 1 if value > 0 else -1
        return 0


class _Names(Mapping[str, Element]):
    """Values of names, made when they are asked for."""

    def __init__(self, values: Roots) -> None:
        self._values = values

    def __getitem__(self, name: str) -> Element:
        return self._values.named(name)

    def __iter__(self) -> Any:
        return iter(self._values.names)

    def __len__(self) -> int:
        return len(self._values.names)
