"""Actions and frequencies by residues: `python alone_actions.py CERTIFICATE.json …`

Where Δ has two zeros in the range of u (`alone_charts.py`) and R = κ P Π (u − c)²ᵏ with P = −(u² + β u + γ), the
places c being ends of the range, an orbit that exists runs from one zero of P to the other: it is the only one, κ > 0,
and W² = −P is positive at all c. With W ~ u at infinity, S = Π (±(u − c))ᵏ, positive in the range, Cauchy's theorem
says

    ∫ S √P du = π (Σ Res_c S W − [u⁻¹] S W),  ∫ S/√P du = π ([u⁻¹] S/W − Σ Res_c S/W),

where W(c) is −√W² below the range and √W² above it, and [u⁻¹] is the coefficient at infinity. This is compared with
the claim at random points modulo random primes (`alone.py`), at which κ and W² are squares, as they are positive.
Where H doesn't contain the coordinate a rotation's momentum is the same at all places.
That there is such an orbit for some values in the domain is seen in intervals (`counterexample.py`).
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_charts, alone_orbits, alone_signs, alone_somewhere
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_charts  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    import alone_somewhere  # type: ignore

Stop, RANDOM, U = alone.Stop, alone.RANDOM, alone_orbits.U
HALF, HIGHEST = Fraction(1, 2), 12


class Residues(alone.Point):
    """A random point modulo a prime, and polynomials in u there, as lists of coefficients."""

    def __init__(self, level: Any, prime: int) -> None:
        super().__init__(level.motion, prime)
        self.level, self.held, self.orders = level, dict[str, int](), 0

    def check_domain(self) -> None:
        """Choose names between the bounds that the domain gives them, and see that it is so."""
        claim = self.level.motion
        for words in (re.split(r"(<=|>=|<|>)", text) for text in claim.domain.get("where", [])):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                low, high = (x.strip() for x in ((a, b) if "<" in sign else (b, a)))
                for x, other, side in ((high, low, 1), (low, high, -1)):
                    if (x,) not in self.free and claim.words.get(x) == ["real"] and x not in claim.texts:
                        if x not in claim.inner(claim.known(other)):
                            distance = RANDOM.randrange(2, self.p) ** 2 % self.p
                            self.free[(x,)] = (self.text(other) + side * distance) % self.p
                            self.sure.add(distance)  # as a name that is positive
                        break
        super().check_domain()

    def name(self, name: str) -> int:
        """The value of what a polynomial has as a name."""
        flat = self.level.flat
        if name not in self.held:
            if name in flat.roots:
                up, down = (self.constant(p) for p in flat.roots[name])
                value = up * pow(down, -1, self.p) % self.p
                self.roots.add(value)
                self.held[name] = self.root(value, HALF)
            else:
                self.held[name] = self.at(flat.formulas.get(name) or alone.Formula(".", (name,)))
        return self.held[name]

    def constant(self, p: Any) -> int:
        total = 0
        for m, c in p.items():
            term = self.fraction(c, self.p)
            for name, k in m:
                term = term * pow(self.name(name), k, self.p) % self.p
            total += term
        return total % self.p

    def listed(self, p: Any) -> list[int]:
        """The coefficients of the powers of u."""
        powers = of.by_powers(p, U)
        return self.trimmed([self.constant(powers.get(k, {})) for k in range(max(powers, default=0) + 1)])

    def trimmed(self, a: list[int]) -> list[int]:
        while a and not a[-1] % self.p:
            a.pop()
        return a

    def times(self, *each: list[int]) -> list[int]:
        found = [1]
        for b in each:
            new = [0] * (len(found) + len(b) - 1)
            for i, x in enumerate(found):
                for j, y in enumerate(b):
                    new[i + j] = (new[i + j] + x * y) % self.p
            found = new
        return found

    def divided(self, a: list[int], b: list[int]) -> tuple[list[int], list[int]]:
        """(quotient, remainder) of polynomials."""
        a, found, inverse = [*a], [0] * max(len(a) - len(b) + 1, 0), pow(b[-1], -1, self.p)
        for k in reversed(range(len(found))):
            found[k] = a[k + len(b) - 1] * inverse % self.p
            for j, y in enumerate(b):
                a[k + j] = (a[k + j] - found[k] * y) % self.p
        return found, self.trimmed(a)

    def lowest(self, a: list[int], b: list[int]) -> tuple[list[int], list[int]]:
        """A fraction of polynomials in its lowest terms."""
        x, y = a, b
        while y:
            x, y = y, self.divided(x, y)[1]
        return self.divided(a, x)[0], self.divided(b, x)[0]

    def without(self, a: list[int], c: int) -> tuple[list[int], int]:
        """A polynomial without its zeros at a place, and how many these are."""
        n = 0
        while len(a) > 1 and not (found := self.divided(a, [-c % self.p, 1]))[1]:
            a, n = found[0], n + 1
        return a, n

    def powers(self, base: list[int], r: Fraction, first: int) -> list[int]:
        """The series of base^r, where the first coefficient is known."""
        found, over = [first], pow(base[0], -1, self.p)
        for n in range(1, self.orders):
            terms = (
                (self.fraction(r, self.p) * j - (n - j)) * base[j] * found[n - j]
                for j in range(1, min(n, len(base) - 1) + 1)
            )
            found.append(sum(terms) * over * pow(n, -1, self.p) % self.p)
        return found

    def squared(self) -> tuple[list[int], list[int]]:
        """R of the action, or of the period, as a fraction of polynomials."""
        level = self.level
        delta, n2, d, below, up, down = map(self.listed, (level.delta, level.n2, level.d, level.below, *level.steep))
        if level.is_time:
            return self.lowest(self.times(d, d, below, down), self.times(delta, up))
        return self.lowest(self.times(delta, down), self.times([4], n2, n2, below, up))

    def integral(self) -> int:
        """∮ p dq, or the period."""
        level, p = self.level, self.p
        top, bottom = self.squared()
        places = [(self.at(end), side) for end, side in ((level.chart.low, 1), (level.chart.high, -1)) if end]
        if level.chart.kind == "root":
            places.append((-places[0][0] % p, 1))
        found = list[tuple[int, int, int]]()
        for c, side in places:
            (top, up), (bottom, down) = self.without(top, c), self.without(bottom, c)
            if (up - down) % 2:
                raise Stop("not shown", "an orbit that has no residues")
            found += [(c, side, (up - down) // 2)] if up != down else []
        for c, k in level.others:
            c = self.at(c)
            (top, up), (bottom, down) = self.without(top, c), self.without(bottom, c)
            found += [(c, k, (up - down) // 2)] if up != down else []
            if (up - down) % 2:
                raise Stop("not shown", "an orbit that has no residues")
        two, one = (bottom, top) if level.is_time else (top, bottom)
        self.check_zeros(two)
        if len(two) != 3 or len(one) != 1:
            raise Stop("not shown", "an orbit between two zeros of a quadratic")
        beta, gamma = (two[k] * pow(two[2], -1, p) % p for k in (1, 0))
        kappa = -(one[0] * pow(two[2], -1, p) if level.is_time else two[2] * pow(one[0], -1, p)) % p
        r, total, at = (-HALF if level.is_time else HALF), 0, sum(k for *_, k in found) + (0 if level.is_time else 2)
        self.orders = max(1, at + 1, *(-k for *_, k in found))
        if self.orders > HIGHEST:
            raise Stop("not shown", "poles of so high an order")
        for c, side, k in found:
            if k < 0:
                square = (c * c + beta * c + gamma) % p
                first = -side * self.own_root(square)
                series = self.powers([square, 2 * c + beta, 1], r, pow(first, -1, p) if level.is_time else first)
                for other, its, n in found:
                    base = [its * (c - other) % p, its]
                    if other != c:
                        series = self.times(series, self.powers(base, Fraction(n), pow(base[0], n, p)))[: self.orders]
                total += side ** (k % 2) * series[-k - 1]
        series = self.powers([1, beta, gamma], r, 1)
        for c, side, k in found:
            first = pow(side % p, k, p)
            series = self.times(series, self.powers([side, -side * c % p], Fraction(k), first))[: self.orders]
        total -= series[at] if at >= 0 else 0
        return 2 * self.own_root(kappa) * self.text("pi") * total * (-1 if level.is_time else 1) % p

    def own_root(self, square: int) -> int:
        """The root of what is positive."""
        self.roots.add(square)
        return self.root(square, HALF)

    def check_zeros(self, two: list[int]) -> None:
        """See that Δ has no other zeros but the quadratic's and those at places outside the range."""
        delta = self.listed(self.level.delta)
        left, rest = self.divided(delta, two)
        for other in (self.listed(self.level.d), self.listed(self.level.n2)):  # which are 0 nowhere in the range
            while (less := self.lowest(left, other)[0]) and len(less) < len(left):
                left = less
        for c in [end for end in (self.level.chart.low, self.level.chart.high) if end] + [
            c for c, _ in self.level.others
        ]:
            left, _ = self.without(left, self.at(c))
        if self.level.chart.kind == "root":
            left, _ = self.without(left, -self.at(self.level.chart.low) % self.p)
        if rest or len(left) != 1:
            raise Stop("not shown", "that there is no other end of an orbit")

    def turn(self) -> int:
        """The same of a rotation over a period, where the momentum is √Δ/2n₂ at all places."""
        delta, n2, d, below = map(self.constant, (self.level.delta, self.level.n2, self.level.d, self.level.below))
        root = self.own_root(delta * pow(below, -1, self.p) % self.p)
        a, b = (d, root) if self.level.is_time else (root, 2 * n2)
        return self.text("_period") * a * pow(b, -1, self.p) % self.p


def turns(motion: Any, level: Any) -> bool:
    """Whether the claim is about a rotation of which H doesn't contain the coordinate, over a period."""
    if motion.branch != "rotation" or motion.q in motion.inner(motion.known("_H")):
        return False
    free = alone_charts.bounds(motion) == (None, None) and not motion.bounds and not level.allowed
    signs, period = alone_signs.Signs(motion), motion.known("_period")
    if not free or level.n1 or motion.energy in motion.inner(period) or motion.energy in motion.fixed:
        raise Stop("not shown", "a rotation all the way, with one positive momentum")
    if not signs.shown(signs.quotient(period)[0], True):
        raise Stop("not shown", "that a period is positive")
    level.pattern = "^[+]$"
    return True


def sample(level: Any, prime: int) -> int:
    """Compare at one point."""
    point = Residues(level, prime)
    point.check_domain()
    equals, found = point.text("_equals"), point.turn() if level.turns else point.integral()
    if (equals * found - 1 if level.is_time else equals - found) % prime:
        raise Stop("not shown", "that this is the value")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    if (kind := tables["claim"]["kind"]) not in ("action", "frequency"):
        raise Stop("not shown", "no action and no frequency")
    motion = alone_orbits.Motion(tables)
    if "well" in motion.said or (motion.branch == "rotation") != ("period" in motion.said):
        raise Stop("not shown", "one of several wells, or another rotation")
    reasons = list[str]()
    for chart in alone_charts.charts(motion):
        try:
            level = alone_charts.Level(motion, chart)
            level.is_time = kind == "frequency"
            if level.is_time and not level.plain:
                raise Stop("not shown", "a period where the momentum is in a root")
            level.check()
            level.turns = turns(motion, level)
            if motion.branch not in (None, "rotation" if level.turns else "libration"):
                raise Stop("not shown", "a motion of another branch")
            if level.allowed and not level.is_positive(*level.allowed):
                raise Stop("not shown", "that the energy is large enough throughout the range")
            level.others = [(alone.number(x), 1) for x in {"exp": (-1,), "root": (0,)}.get(chart.kind, ())]
            answer = alone.tried(sample, level)
            if not alone_somewhere.is_somewhere(level):
                raise Stop("not shown", "that there is such an orbit")
            return answer
        except Stop as stop:
            reasons.append(stop.args[1])
    return "not shown", reasons[-1] if reasons else "an orbit"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
