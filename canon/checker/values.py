"""The values of functions, followed by rules through a tower of roots over random numbers modulo a prime.

- (R^(1/n))^n = R; R^(m/n) is a quantity v with v^n = R^m that is nowhere negative; |A| and sign A likewise.
- sin² + cos² = 1, and both of sums Σ n_i A_i of angles; exp of sums of exponents, of n log X and of i times an angle;
  a^b = exp(b log a); hyperbolic ones by exp.
- An angle may be asin X, acos X, atan X or atan2(y, x), or half of it (`inverses`).
- Jacobi's cn² = 1 − sn², dn² = 1 − m sn². The elliptic K and E of m by those of m/(m − 1).
- Odd functions of −A. Any other function is a quantity of which nothing is known: equal where its arguments are.

What a certificate says of a function is compared with this. A wrong answer has a probability of about degree / 2^126.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import combinations, product
from typing import Any

from canon.checker import core
from canon.checker.formulas import ONE
from canon.checker.functions import Unknown
from canon.checker.inverses import Inverses
from canon.checker.roots import Fraction_, Roots
from canon.checker.statement import Statement
from canon.checker.tower import Element, Tower

ODD = {"asin", "atan", "asinh", "atanh", "elliptic_f", "elliptic_e", "jacobi_epsilon", "sign"}
CIRCULAR = {"sin": (1, 0), "cos": (0, 1), "tan": (1, -1), "cot": (-1, 1), "sec": (0, -1), "csc": (-1, 0)}
"""The powers of the sine and of the cosine."""
HYPERBOLIC = {"sinh": (1, 0), "cosh": (0, 1), "tanh": (1, -1), "coth": (-1, 1)}
MULTIPLES = (range(-24, 25), range(-4, 5), range(-2, 3))
"""The integers n_i that are tried for one angle, for two, for three."""
FEW = {1: 100, 2: 24, 3: 9}
"""Sums of so many are looked for among so many angles."""
Key = tuple[Any, ...]


class Values:
    """Values of formulas in a tower, at one choice of its random numbers."""

    def __init__(self, s: Statement, prime: int, rng: random.Random, *, real: bool) -> None:
        self.s, self.f, self.real = s, s.f, real
        self.t = Tower(prime, rng)
        self.roots = Roots(s, self.t, self.value, real=real)
        self.one, self.minus_one = (self.t.constant(core.Fraction(n)) for n in (1, -1))
        self.zero: Element = {}
        self._of: dict[int, Element] = {}
        self._degrees: dict[int, int] = {}
        self._functions: dict[Key, Element] = {}
        turn = self.t.mul(self.roots.named("pi"), self.t.constant(core.Fraction(1, 2)))
        self._angles = [(turn, self.one, self.zero)]  # an angle, its sine, its cosine
        self._exponents: list[tuple[Element, Element]] = []  # an exponent, and its exponential
        self._marks: dict[Any, int] = {}
        self.inverses = Inverses(self, turn)

    def kernel(self, name: str, meaning: int) -> None:
        """A name for the value of a formula."""
        self.roots.names[name] = self.value(meaning)
        self.roots.meanings[name] = self.f.substitute(meaning, self.roots.meanings)
        op = self.f.ops[meaning]
        if self.real and op[0] == "f":
            even = op[1] == "power" and (self.f.value(op[3][1]) or 1).denominator % 2 == 0
            word = {"exp": "positive", "abs": "nonnegative", "cosh": "positive"}.get(op[1])
            words = ("nonnegative",) if even else (word,) if word else ()
            if op[1] in ("sin", "cos"):
                words = self.roots.sign_of_circular(op[1], self.value(op[3][0]))
            if op[1] == "jacobi_dn" and self.roots.is_above(self.f.sub(ONE, op[3][1])):
                words = ("positive",)  # dn is 0 for no real argument where the parameter is below 1
            said = (self.f.ops[a] for a, kind in self.s.conditions if kind == "positive")
            words = words or (("positive",) if any(self._is_same(op, other) for other in said) else ())
            self.roots.words[name] = words
            if {"positive", "nonnegative", "nonpositive"} & {*words} and op[1] != "power":
                self.roots.is_root(self.roots.names[name], positive="nonpositive" not in words)

    def _is_same(self, op: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
        """Whether two functions are the same of the same arguments."""
        same = other[:3] == op[:3] and op[0] == "f" and len(op[3]) == len(other[3])
        return same and all(self.value(a) == self.value(b) for a, b in zip(op[3], other[3], strict=True))

    def value(self, target: int) -> Element:
        """The value of a formula; those `claimed` of functions may be taken where the rules confirm them.

        Raises Undecided, ZeroDivisionError, Unknown.
        """
        f, t = self.f, self.t
        for a in f.reach(target):
            if a in self._of:
                continue
            op, x = f.ops[a], [self._of[b] for b in f.parts(a)]
            degrees = [self._degrees[b] for b in f.parts(a)]
            self._degrees[a] = degrees[0] * abs(op[2]) if op[0] == "^" else sum(degrees) + (op[0] in "sf")
            if op[:2] == ("f", "power") and (r := f.value(op[3][1])) is not None:
                self._degrees[a] *= max(1, abs(r.numerator))
            if self._degrees[a] > core.STEEPEST:
                raise Unknown("a formula of too high a degree")
            if op[0] == "n":
                self._of[a] = t.constant(op[1])
            elif op[0] == "s":
                self._of[a] = self.roots.named(op[1])
            elif op[0] == "+":
                self._of[a] = t.add(x[0], x[1])
            elif op[0] == "*":
                self._of[a] = t.mul(x[0], x[1])
            elif op[0] == "^":
                self._of[a] = t.power(x[0], op[2])
            else:
                self._of[a] = self._function(op, x, self.roots.claimed.get(a))
        return self._of[target]

    # -- functions ----------------------------------------------------------------------------------

    def function(self, op: tuple[Any, ...], x: Sequence[Element]) -> Element:
        """The value of a function that no formula has to contain."""
        return self._function(op, [*x], None)

    def _function(self, op: tuple[Any, ...], x: list[Element], claimed: Fraction_ | None) -> Element:
        name, t = str(op[1]), self.t
        key = (name, op[2], *map(_frozen, x))
        if key not in self._functions:
            if name in self.f.functions:
                found = t.free()
            elif name == "power":
                r = self.f.value(op[3][1])
                if r is None:  # a^b = exp(b log a)
                    found = self._exp(t.mul(x[1], self._log(x[0])), op[3][1])
                else:
                    self.roots.note_divisors(op[3][0] if r.denominator == 2 else 0, x[0])
                    found = self.roots.power(x[0], r, claimed, self.real or self.roots.is_positive(op[3][0]))
            elif name in ("abs", "sign") and self.real:
                size = self.roots.root(
                    t.mul(x[0], x[0]), 2, claimed if name == "abs" else self.times(claimed, op[3][0])
                )
                found = size if name == "abs" else t.mul(size, t.inverse(x[0]))
            elif name in CIRCULAR:
                powers = zip(self._circle(x[0], name, claimed, op[3][0]), CIRCULAR[name], strict=True)
                found = t.mul(*(t.power(part, n) for part, n in powers))
            elif name in HYPERBOLIC:
                e = self._exp(x[0], op[3][0])
                inverse, half = t.inverse(e), t.constant(core.Fraction(1, 2))
                parts = (t.mul(half, t.add(e, inverse, sign)) for sign in (-1, 1))
                found = t.mul(*(t.power(part, n) for part, n in zip(parts, HYPERBOLIC[name], strict=True)))
            elif name == "exp":
                found = self._exp(x[0], op[3][0])
            elif name in ("jacobi_sn", "jacobi_cn", "jacobi_dn"):
                found = self._jacobi(name, x)
                if self.real and self.roots.is_above(self.f.sub(ONE, op[3][1])):  # dn is 0 nowhere where m is below 1
                    self.roots.is_root(self._functions["jacobi_dn", (), *map(_frozen, x)], positive=True)
            else:
                found = self._other(op, x, claimed)
            self._functions[key] = found
        return self._functions[key]

    def _other(self, op: tuple[Any, ...], x: list[Element], claimed: Fraction_ | None) -> Element:
        t, name = self.t, str(op[1])
        turned = [t.mul(self.minus_one, x[0]), *x[1:]]
        opposite = (name, (), *map(_frozen, turned))
        if name in ODD and (len(x) > 1 or not name.startswith("elliptic_e")) and opposite in self._functions:
            return t.mul(self.minus_one, self._functions[opposite])
        if name in ("elliptic_k", "elliptic_e") and len(x) == 1 and claimed is not None and self.real:
            rest = t.add(self.one, x[0], -1)  # E(m) = √(1 − m) E(m/(m − 1)), K(m) = K(m/(m − 1))/√(1 − m)
            other = self._functions.get((name, (), _frozen(t.mul(turned[0], t.inverse(rest)))))
            for kernel, value in self.roots.names.items():
                if other is not None and value == other:
                    over, under = claimed[0], core.combined({}, claimed[1], {((kernel, 1),): core.Fraction(1)})
                    ratio = (over, under) if name == "elliptic_e" else (under, over)
                    root = self.roots.root(rest, 2, _reduced(ratio))
                    return t.mul(other, root if name == "elliptic_e" else t.inverse(root))
        if not x[0] and name in ODD and not (name == "elliptic_e" and len(x) == 1):
            return self.zero
        if (angle := self.inverses.angle(name, op, x)) is not None:
            return angle
        return self._log(x[0]) if name == "log" else t.free()

    def times(self, claimed: Fraction_ | None, factor: int) -> Fraction_ | None:
        """A fraction times a formula that is a polynomial in names and kernels; None where it is none."""
        own = self.polynomial(factor)
        return None if claimed is None or own is None else (core.combined({}, claimed[0], own), claimed[1])

    def polynomial(self, a: int) -> core.Polynomial | None:
        """The polynomial in names that sums and products make; None for anything else."""
        op = self.f.ops[a]
        if op[0] == "n":
            return {(): op[1]} if op[1] else {}
        if op[0] == "s":
            return {((op[1], 1),): core.Fraction(1)}
        if op[0] == "^" and 1 < op[2] < 9:
            return self.polynomial(self.f.mul(*[op[1]] * op[2]))
        parts = [self.polynomial(b) for b in self.f.parts(a)] if op[0] in "+*" else [None]
        if any(p is None for p in parts):
            return None
        first, second = (p or {} for p in parts)
        return core.combined(first, second, core.ONE) if op[0] == "+" else core.combined({}, first, second)

    def _circle(self, angle: Element, name: str, claimed: Fraction_ | None, node: int) -> tuple[Element, Element]:
        """The sine and the cosine of an angle."""
        t = self.t
        self._angles += self.inverses.angles(angle, name, claimed, node, self._angles)
        found = self._combination(angle, [a for a, _, _ in self._angles])
        if found is not None:
            sine, cosine = self.zero, self.one
            for n, k in found:
                s, c = self._multiple(k, n)
                sine, cosine = t.add(t.mul(sine, c), t.mul(cosine, s)), t.add(t.mul(cosine, c), t.mul(sine, s), -1)
            return sine, cosine
        cosine = t.free()
        sine = t.root(t.add(self.one, t.mul(cosine, cosine), -1), 2)
        self._angles.append((angle, sine, cosine))
        return sine, cosine

    def _multiple(self, k: int, n: int) -> tuple[Element, Element]:
        """The sine and the cosine of n times an angle."""
        t, (_, s, c) = self.t, self._angles[k]
        sine, cosine = self.zero, self.one
        for _ in range(abs(n)):
            sine, cosine = t.add(t.mul(sine, c), t.mul(cosine, s)), t.add(t.mul(cosine, c), t.mul(sine, s), -1)
        return (sine if n >= 0 else t.mul(self.minus_one, sine)), cosine

    def _combination(self, target: Element, known: Sequence[Element]) -> list[tuple[int, int]] | None:
        """(n, k) with target = Σ n · known[k], for few and small n; None where there is none."""
        if not target:
            return []
        wanted, marks = self._mark(target), [self._mark(x) for x in known]
        for size, ns in zip((1, 2, 3), MULTIPLES, strict=True):
            for chosen in combinations(range(len(known)), size) if len(known) <= FEW[size] else ():
                for factors in product(ns, repeat=size):
                    left = wanted - sum(n * marks[k] for n, k in zip(factors, chosen, strict=True))
                    if left % self.t.prime == 0:
                        return list(zip(factors, chosen, strict=True))
        return None

    def _mark(self, x: Element) -> int:
        """A random linear function of an element: 0 for 0, and for hardly anything else."""
        for m in x:
            if m not in self._marks:
                self._marks[m] = self.t.rng.randrange(self.t.prime)
        return sum(c * self._marks[m] for m, c in x.items()) % self.t.prime

    def _exp(self, exponent: Element, node: int) -> Element:
        t = self.t
        for b in self.f.reach(node):
            if self.f.ops[b][:2] == ("f", "asinh") and all(a != self._of[b] for a, _ in self._exponents):
                x = self._of[self.f.ops[b][3][0]]  # exp(asinh X) = X + √(X² + 1)
                root = self.roots.root(t.add(t.mul(x, x), self.one), 2, None)
                self._exponents.append((self._of[b], t.add(x, root)))
        known = [*self._exponents]
        if not self.real:
            i = self.roots.named("1j")  # exp(iA) = cos A + i sin A
            known += [(t.mul(i, a), t.add(c, t.mul(i, s))) for a, s, c in self._angles]
        found = self._combination(exponent, [a for a, _ in known])
        if found is None:
            self._exponents.append((exponent, t.free()))
            return self._exponents[-1][1]
        total = self.one
        for n, k in found:
            total = t.mul(total, t.power(known[k][1], n))
        return total

    def _log(self, a: Element) -> Element:
        """The logarithm, of which the exponential is known."""
        key = ("log", (), _frozen(a))
        if key not in self._functions:
            self._functions[key] = self.t.free()
            self._exponents.append((self._functions[key], a))
        return self._functions[key]

    def _jacobi(self, name: str, x: list[Element]) -> Element:
        """sn, cn and dn of the same arguments are made together."""
        t, rest = self.t, tuple(map(_frozen, x))
        if ("jacobi_sn", (), *rest) not in self._functions:
            sn = t.free()
            square = t.mul(sn, sn)
            cn = t.root(t.add(self.one, square, -1), 2)
            dn = t.root(t.add(self.one, t.mul(x[1], square), -1), 2)
            for word, value in (("sn", sn), ("cn", cn), ("dn", dn)):
                self._functions[f"jacobi_{word}", (), *rest] = value
        return self._functions[name, (), *rest]


def _frozen(x: Element) -> Any:
    return tuple(sorted(x.items()))


def _reduced(x: Fraction_) -> Fraction_:
    """Numerator and denominator without a power of a name that is in every term of both."""
    everything = [dict(m) for p in x for m in p]
    common = {n: min(m.get(n, 0) for m in everything) for n in everything[0]} if everything else {}
    over, under = (
        {tuple((n, e - common.get(n, 0)) for n, e in m if e > common.get(n, 0)): c for m, c in p.items()} for p in x
    )
    return over, under
