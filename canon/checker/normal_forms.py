"""Birkhoff–Gustavson normal forms: is N reached from H by near-identity canonical maps? By linear algebra.

Numbers are those of a tower modulo a random prime, parameters random ones. Degree by degree, m = 3, 4, …: once H agrees
with N below degree m, the maps that keep this are exp{·, κ} of polynomials κ of degree 3 and more with {H, κ} = 0 below
degree m, for the near-identity maps up to an order are a unipotent group acting linearly, and these its stabiliser of a
vector (Humphreys, Linear Algebraic Groups, § 15). They add {H, κ} in degree m. So N is reached if what is missing is
one of these, and else it isn't.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations_with_replacement
from math import comb, factorial
from typing import Any

from canon.checker.case import Case, whole
from canon.checker.defined import bounding, shared, unseen
from canon.checker.followed import FAILURES, at_random
from canon.checker.functions import Unknown, Unreadable
from canon.checker.obligations import taylor
from canon.checker.positive import is_nowhere_zero
from canon.checker.ratios import multiple
from canon.checker.regular import is_regular
from canon.checker.statement import Statement
from canon.checker.values import Values

HIGHEST, MOST, LARGEST = 12, 400, 3_000_000
"""The highest order, the most monomials that κ may have, and the most products of terms."""
Powers = tuple[int, ...]
Parts = dict[Powers, int]
"""A polynomial in the variables: exponents = coefficient, modulo the prime."""


def normal_form(s: Statement) -> Case:
    """{H₂, N} = 0 in each degree, and N is reached from H; degrees that are left out are 0, and H₂ in degree 2."""
    f, order = s.f, whole(s.claim["order"], 2)
    if s.surface or order > HIGHEST:
        raise Unknown("a normal form on a surface, or of a high order")
    table = {whole(int(degree), 2): f.read(text, s.names) for degree, text in s.claim["N"].items()}
    if len(table) < len(s.claim["N"]):
        raise Unreadable("two parts of N of one degree")
    s.written += table.values()
    scale = f.node("s", "#scale")
    scaled = f.substitute(s.H, {x: f.mul(scale, f.node("s", x)) for x in (*s.q, *s.p)})
    written = [a for a, _ in s.conditions]
    if any(f.ops[b] == ("s", s.time) for b in f.reach(s.H, *table.values(), *written)):
        raise Unknown("a normal form that depends on time")
    at = {x: f.number(0) for x in (*s.q, *s.p)}
    if not is_regular(s, [s.H, *unseen(s), *shared(s)], at, own=False):
        raise Unknown("a Hamiltonian that isn't seen to be analytic at the origin")
    series = taylor(s, scaled, "#scale", range(order + 1))
    work = Algebra(s, order)
    try:
        H = {d: work.polynomial(series[d]) for d in range(order + 1)}
        N = {d: work.polynomial(a) for d, a in table.items()}
    except FAILURES:
        raise Unknown("coefficients that can't be followed") from None
    moving = {f.ops[b][1] for b in f.reach(*written)} & {*s.q, *s.p}
    if moving or any({*s.words.get(x, ())} - {"real"} for x in (*s.q, *s.p)) or bounding(s, (*s.q, *s.p)):
        raise Unknown("a normal form about an origin of which the domain says something")
    if not H[2]:
        raise Unreadable("H has no quadratic part at the origin")
    if H[1] or any(sum(m) != d for d, part in N.items() for m in part):
        raise Unreadable("no equilibrium, or a part of N that isn't of its degree")
    N.setdefault(2, H[2])
    if max(N) > order:
        raise Unreadable("a part of N above the order")
    names = {f.ops[b][1] for b in f.reach(s.H, *table.values()) if f.ops[b][0] == "s"} - {*s.q, *s.p, "pi"}
    found = N[2] == H[2] and not any(work.bracket(H[2], part) for part in N.values()) and work.reaches(H, N)
    if work.unsure and not found:  # log(4) and 2 log(2) would be two numbers
        raise Unknown("coefficients that may be related otherwise than by the rules for functions")
    if s.verdict == "refuted":  # at almost all values of the parameters
        if names & s.fixed:
            raise Unknown("a parameter that is a whole number")
        return Case([], found=found)
    frequency = s.determinant([[_second(s, x, y) for y in (*s.q, *s.p)] for x in (*s.q, *s.p)])
    sure = (not names and not work.unsure) or (
        len(s.q) == 1 and is_nowhere_zero(s, frequency)
    )  # with one frequency all divisors are its
    return Case([], found=found, trusted="" if sure else "that no small divisor vanishes at values of the parameters")


def _second(s: Statement, x: str, y: str) -> int:
    f = s.f
    return f.substitute(f.slope(f.slope(s.H, x), y), {name: f.number(0) for name in (*s.q, *s.p)})


class Algebra:
    """Polynomials in the variables up to an order, modulo a prime."""

    def __init__(self, s: Statement, order: int) -> None:
        self.s, self.order, self.n = s, order, len(s.q)
        self.values: Values = at_random(s)
        self.prime = self.values.t.prime
        self.variables, self.unsure, self.spent = [*s.q, *s.p], False, 0

    def polynomial(self, target: int) -> Parts:
        """A formula that is a polynomial in the variables. Raises Unknown for any other."""
        f, out = self.s.f, dict[int, Parts]()
        for a in f.reach(target):
            op, x = f.ops[a], [out[b] for b in f.parts(a)]
            if op[0] == "s" and op[1] in self.variables:
                out[a] = {tuple(int(op[1] == name) for name in self.variables): 1}
            elif op[0] in "+*":
                out[a] = self.sum(x[0], x[1]) if op[0] == "+" else self.product(x[0], x[1])
            elif op[0] == "^" and op[2] > 0:
                out[a] = {(0,) * 2 * self.n: 1}
                for _ in range(op[2]):
                    out[a] = self.product(out[a], x[0])
            else:
                out[a] = self._number(a)
        return out[target]

    def _number(self, a: int) -> Parts:
        """A formula without the variables, as a number."""
        f = self.s.f
        if any(f.ops[b][0] == "s" and f.ops[b][1] in self.variables for b in f.reach(a)):
            raise Unknown("a formula that isn't a polynomial in the variables")
        value = self.values.value(a)
        called = any(f.ops[b][0] == "f" for b in f.reach(a))
        if called and value and multiple(value, self.values.one, self.prime) is None:
            self.unsure = True
        if {*value} - {()}:
            raise Unknown("a coefficient with a root in it")
        return {(0,) * 2 * self.n: value[()]} if value else {}

    def _spend(self, steps: int) -> None:
        self.spent += steps
        if self.spent > LARGEST:
            raise Unknown("a normal form that is too large to be followed")

    def sum(self, a: Parts, b: Parts, factor: int = 1) -> Parts:
        """a + factor b."""
        self._spend(len(a) + len(b))
        out = dict(a)
        for m, c in b.items():
            out[m] = (out.get(m, 0) + factor * c) % self.prime
        return {m: c for m, c in out.items() if c}

    def product(self, a: Parts, b: Parts) -> Parts:
        """a b, up to twice the order."""
        self._spend(len(a) * len(b))
        out: Parts = {}
        for m, c in a.items():
            for k, d in b.items():
                power = tuple(map(sum, zip(m, k, strict=True)))
                if sum(power) <= 2 * self.order:
                    out[power] = (out.get(power, 0) + c * d) % self.prime
        return {m: c for m, c in out.items() if c}

    def bracket(self, a: Parts, b: Parts) -> Parts:
        """{a, b}, up to the order."""
        self._spend(len(a) * len(b) * self.n)
        out: Parts = {}
        for m, c in a.items():
            for k, d in b.items():
                whole_power = [x + y for x, y in zip(m, k, strict=True)]
                for i in range(self.n):
                    factor = m[i] * k[i + self.n] - m[i + self.n] * k[i]
                    if factor and sum(whole_power) - 2 <= self.order:
                        power = list(whole_power)
                        power[i], power[i + self.n] = power[i] - 1, power[i + self.n] - 1
                        out[tuple(power)] = (out.get(tuple(power), 0) + c * d * factor) % self.prime
        return {m: c for m, c in out.items() if c}

    def reaches(self, H: Mapping[int, Parts], N: Mapping[int, Parts]) -> bool:
        """Whether near-identity canonical maps lead from H to N."""
        moved = {m: c for d in H if d >= 2 for m, c in H[d].items()}
        for degree in range(3, self.order + 1):
            missing = self.sum(N.get(degree, {}), {m: c for m, c in moved.items() if sum(m) == degree}, -1)
            if not missing:
                continue
            kappa = self._solved(moved, missing, degree)
            if kappa is None:
                return False
            term, total = moved, moved
            for k in range(1, self.order):
                term = self.bracket(term, kappa)
                total = self.sum(total, term, pow(factorial(k), -1, self.prime))
            moved = total
        return True

    def _solved(self, H: Parts, missing: Parts, degree: int) -> Parts | None:
        """κ with {H, κ} = `missing` up to that degree; None where there is none."""
        echelon: dict[Powers, tuple[Parts, Parts]] = {}

        def reduced(row: Parts, kappa: Parts) -> tuple[Parts, Parts]:
            while found := row.keys() & echelon.keys():
                for lead in found:
                    if lead in row:
                        c = -row[lead]
                        row, kappa = (self.sum(x, y, c) for x, y in zip((row, kappa), echelon[lead], strict=True))
            return row, kappa

        low = {m: c for m, c in H.items() if sum(m) <= degree}
        for m in self._monomials(degree):
            image = {k: c for k, c in self.bracket(low, {m: 1}).items() if sum(k) <= degree}
            row, kappa = reduced(image, {m: 1})
            if row:
                lead = min(row)
                inverse = pow(row[lead], -1, self.prime)
                echelon[lead] = self.sum({}, row, inverse), self.sum({}, kappa, inverse)
        rest, kappa = reduced(missing, {})
        return None if rest else self.sum({}, kappa, -1)

    def _monomials(self, degree: int) -> Iterator[Powers]:
        size = 2 * self.n
        count = sum(comb(size + d - 1, d) for d in range(3, degree + 1))
        if count > MOST:
            raise Unknown(f"{count} unknown coefficients")
        yield from (
            tuple(chosen.count(i) for i in range(size))
            for d in range(3, degree + 1)
            for chosen in combinations_with_replacement(range(size), d)
        )


KINDS: dict[str, Any] = {"normal_form": normal_form}
