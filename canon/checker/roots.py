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
        self._roots: list[tuple[Element, int, Element, bool]] = []  # radicand, degree, root, whether it is positive
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
                self.nonnegative.append(self._value(a))
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
        elif (root := self._known_root(base, n, positive)) is None:
            power = t.power(base, m)
            if claimed is not None and self.real and t.power(self.fraction(claimed), n) == power:
                if n % 2 or self._sign(claimed) > 0:
                    return self.fraction(claimed)
            root = self.root(base, n, None, positive)
        return t.power(root, m)

    def root(self, power: Element, degree: int, claimed: Fraction_ | None, positive: bool = False) -> Element:
        """The root of a quantity: one that is claimed and nowhere negative, one that is known, or a new one."""
        positive = positive or self.real
        known = power if degree == 1 else self._known_root(power, degree, positive)
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

    def _known_root(self, power: Element, degree: int, positive: bool) -> Element | None:
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
            ratio = _ratio(power, radicand, t.prime)
            if ratio is not None and (number := self._rational_root({(): ratio})) is not None:
                return t.mul(root, t.constant(number))
        if set(power) != {()}:
            return None
        named = [self.named(n) for n, words in self.words.items() if {"positive", "nonnegative"} & {*words}]
        plain = [(r[()], root) for r, root in roots if set(r) == {()}]
        plain += [(pow(x[()], 2, t.prime), x) for x in named if set(x) == {()}]
        for size in (2, 3, 4) if len(plain) <= MOST_ROOTS else (2,):
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
        value = _rational(x[()], self.t.prime) if set(x) == {()} else None
        if value is None or value <= 0:
            return None
        root = core.Fraction(isqrt(value.numerator), isqrt(value.denominator))
        return root if root**2 == value else None

    # -- signs --------------------------------------------------------------------------------------

    def _sign(self, x: Fraction_) -> int:
        """1 or -1 where a fraction is shown to be nowhere negative, or nowhere positive; 0 where it isn't."""
        return self._sign_of(x[0]) * self._sign_of(x[1])

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
        outer = sign_of(self.words, {tuple(common.items()): core.Fraction(1)})[0]
        return outer * self._known_sign(self.t.polynomial(rest, _Names(self)))

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


def _ratio(x: Element, y: Element, prime: int) -> int | None:
    """The number c with x = c y; None where there is none."""
    if not x or x.keys() != y.keys():
        return None
    m = next(iter(x))
    ratio = x[m] * pow(y[m], -1, prime) % prime
    return ratio if all((ratio * y[k] - c) % prime == 0 for k, c in x.items()) else None


def multiple(x: Element, y: Element, prime: int) -> core.Fraction | None:
    """The rational number c with x = c y; None where there is none."""
    ratio = _ratio(x, y, prime)
    return None if ratio is None else _rational(ratio, prime)


def _rational(x: int, prime: int) -> core.Fraction | None:
    """The rational number that stands for a residue, if there is one with a numerator and a denominator below 2^40."""
    a, b, u, v = prime, x, 0, 1
    while b >> 40:
        q = a // b
        a, b, u, v = b, a - q * b, v, u - q * v
    return core.Fraction(b, v) if v and not abs(v) >> 40 else None
