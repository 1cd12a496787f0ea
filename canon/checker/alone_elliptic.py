"""Actions and frequencies by complete elliptic integrals: `python alone_elliptic.py CERTIFICATE.json …`

R of `alone_orbits.py` has odd powers of four factors u − z, one with z = ∞ where these are three: of the two ends of
the motion, e and o, and two others that lie outside. t = (u − e)(o − g)/((u − g)(o − e)), g being one of the others, is
0 and 1 at the ends and infinite at g, and with 1/m for the other one

    √R du = √ρ tᵃ (1 − t)ᵇ (1 − m t)ᶜ Π (1 − n t)ᵏ dt/√Y, Y = t (1 − t)(1 − m t), ρ > 0,

where all factors are positive between. The claim is Σ c K(m), c E(m), c Π(n, m), with 2K = ∫ dt/√Y, 2E = ∫ (1 − m t)
dt/√Y, 2Π = ∫ dt/(1 − n t)√Y. The difference is d(F √Y) with a rational F without poles at 0 and 1: F's series at 0
follows from F Y'/2 + F' Y, and that F is right is seen at random t, all at random points modulo random primes.

Which zeros of Δ are the ends is seen by signs of all others (`alone_signs.py`); that there is such an orbit for some
values in the domain in intervals.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import permutations, zip_longest
from typing import Any

if __package__:
    from canon.checker import alone, alone_actions, alone_charts, alone_ends, alone_orbits, alone_somewhere
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_actions  # type: ignore
    import alone_charts  # type: ignore
    import alone_ends  # type: ignore
    import alone_orbits  # type: ignore
    import alone_somewhere  # type: ignore

Stop, RANDOM = alone.Stop, alone.RANDOM
LONGEST = 24


class Curve(alone_actions.Residues):
    """A random point modulo a prime."""

    def value(self, f: Any) -> int:
        if f.kind in alone_orbits.ELLIPTIC:
            return self.any(f.kind, *map(self.at, f.of))
        return super().value(f)

    def claimed(self) -> dict[Any, int]:
        """{an elliptic integral: its coefficient} of the action that is claimed, or of the period."""
        total = self.equals()
        keys = [key for key in self.free if key[0] in alone_orbits.ELLIPTIC]
        found = dict[Any, int]()
        for key in keys:
            other = type(self)(self.level, self.p)
            other.free = {**self.free, **{k: int(k == key) for k in keys}}
            found[key] = other.equals()
        if not keys or (sum(self.free[key] * c for key, c in found.items()) - total) % self.p:
            raise Stop("not shown", "a sum of elliptic integrals")
        return found

    def equals(self) -> int:
        value = self.text("_equals")
        return pow(value, -1, self.p) if self.level.is_time else value

    def factors(self) -> tuple[dict[Any, int], int]:
        """{z: k} where R = c Π (u − z)ᵏ, and c."""
        top, bottom = self.squared()
        found = dict[Any, int]()
        for f in self.level.zeros:
            z = self.at(f)
            (top, up), (bottom, down) = self.without(top, z), self.without(bottom, z)
            if up != down:
                found[z] = up - down
        if len(top) != 1 or len(bottom) != 1:
            raise Stop("not shown", "all zeros and poles")
        return found, top[0] * pow(bottom[0], -1, self.p) % self.p

    def compare(self) -> None:
        """See that the integral over the orbit is what is claimed. Raises Stop."""
        found, lead = self.factors()
        claimed, level = self.claimed(), self.level
        total = sum(found.values())
        odd = [z for z, k in found.items() if k % 2] + ([None] if total % 2 else [])
        ends = [self.at(f) for f in level.ends]
        left = [z for z in odd if z not in ends]
        if len({*ends}) != 2 or not {*ends} <= {*odd} or len(left) != 2 or any(found[z] not in (1, -1) for z in ends):
            raise Stop("not shown", "two ends of an orbit and two other places")
        walls = [(self.at(end), side) for end, side in ((level.chart.low, 1), (level.chart.high, -1)) if end]
        for z in (z for z in ends if all(z != wall for wall, _ in walls)):  # in the range, where the orbit exists
            for wall, side in walls:
                self.square(side * (z - wall) % self.p)
        for (e, o), (g, third) in ((a, b) for a in permutations(ends) for b in permutations(left)):
            if self.is_so(found, lead, (e, o, g, third), claimed):
                return
        raise Stop("not shown", "that this is the value")

    def is_so(self, found: dict[Any, int], lead: int, odd: Any, claimed: dict[Any, int]) -> bool:
        """Whether it is so with these places of t = 0, 1, ∞ and 1/m."""
        p, (e, o, g, third) = self.p, odd
        inverse = lambda x: pow(x, -1, p)
        if g is None:
            place, at = (lambda z: (z - e) * inverse(o - e) % p), (lambda t: (e + t * (o - e)) % p)
            rate = lambda t: (o - e) % p
            infinite = None  # u = ∞ is where t is
        else:
            place = lambda z: (z - e) * (o - g) * inverse((z - g) * (o - e)) % p
            at = lambda t: (t * g * (o - e) - e * (o - g)) * inverse(t * (o - e) - (o - g)) % p
            rate = lambda t: (o - e) * (o - g) * (e - g) * inverse(t * (o - e) - (o - g)) ** 2 % p
            infinite = (o - g) * inverse(o - e) % p
        m = inverse(infinite if third is None else place(third))
        if any(key[-1] != m for key in claimed):
            return False
        halves, total = dict[int, int](), sum(found.values())  # (1 − n t)^(k/2)
        for z, k in found.items():
            if z not in odd and (n := inverse(place(z))):
                halves[n] = halves.get(n, 0) + k // 2
        powers = {x: found.get(x, -total - 4 if x is None else 0) for x in (e, o, third)}
        if g is not None and third is not None:  # ∞ is no odd place
            n = inverse(infinite)
            halves[n] = halves.get(n, 0) + (-total - 4) // 2
        t = RANDOM.randrange(2, p)
        product = pow(t, powers[e], p) * pow(1 - t, powers[o], p) * pow(1 - m * t, powers[third], p)
        for n, k in halves.items():
            product = product * pow(1 - n * t, 2 * k, p) % p
        u = at(t)
        r = lead * rate(t) ** 2 % p
        for z, k in found.items():
            r = r * pow(u - z, k, p) % p
        root = self.own_root(r * inverse(product) % p)
        first = [(powers[x] + 1) // 2 for x in (e, o, third)]
        if min(first) < 0:
            return False
        poles = {n: max(0, -k) for n, k in halves.items() if k}
        for key in claimed:
            if key[0] == "elliptic_pi":
                poles[key[1]] = max(1, poles.get(key[1], 0))
        many = self.level.times
        both = [1]  # the product of (1 − n t)^order
        for n, k in poles.items():
            both = self.times(both, *[[1, -n]] * k)
        main = self.times([many * root % p], *[[0, 1]] * first[0], *[[1, -1]] * first[1], *[[1, -m]] * first[2])
        for n, k in halves.items():
            main = self.times(main, *[[1, -n]] * (k + poles.get(n, 0)))
        for n, k in poles.items():
            if n not in halves:
                main = self.times(main, *[[1, -n]] * k)
        for (kind, *of_it), c in claimed.items():
            rest = both if kind != "elliptic_pi" else self.divided(both, [1, -of_it[0]])[0]
            one = self.times([-c * inverse(2) % p], rest, *[[1, -m]] * (kind == "elliptic_e"))
            main = [(a + b) % p for a, b in zip_longest(main, one, fillvalue=0)]
        return self.is_exact(self.trimmed(main), m, both, poles)

    def is_exact(self, top: list[int], m: int, both: list[int], poles: dict[int, int]) -> bool:
        """Whether top/both = F Y'/2 + F' Y, for a rational F with these poles, of orders that are lower by one."""
        p, below = self.p, [1]
        for n, k in poles.items():
            below = self.times(below, *[[1, -n]] * (k - 1))
        highest = len(top) - len(both) - 2 + len(below) - 1
        if highest > LONGEST:
            raise Stop("not shown", "polynomials of so high a degree")
        y, count = [0, 1, -(1 + m) % p, m], max(highest + 1, 0)
        slope = [1, -2 * (1 + m) % p, 3 * m % p]
        inverse, series = pow(2, -1, p), list[int]()
        orders, self.orders = self.orders, count + 1
        given = self.times(top, self.powers([*both, 0], Fraction(-1), 1))[:count] + [0] * count
        self.orders = orders
        for k in range(count):  # (k + 1/2) f_k + what is before it
            known = sum(series[j] * (slope[k - j] * inverse + j * y[k - j + 1]) for j in range(max(0, k - 2), k))
            series.append((given[k] - known) * pow(k + inverse, -1, p) % p)
        n = self.times(series, below)[:count] if count else []
        t = RANDOM.randrange(2, p)
        value = lambda a: sum(c * pow(t, k, p) for k, c in enumerate(a)) % p
        turned = lambda a: sum(k * c * pow(t, k - 1, p) for k, c in enumerate(a) if k) % p
        b, over = value(below), pow(value(below), -1, p)
        f = value(n) * over
        steep = (turned(n) * b - value(n) * turned(below)) * over * over
        return (f * value(slope) * inverse + steep * value(y) - value(top) * pow(value(both), -1, p)) % p == 0


def sample(level: Any, prime: int) -> int:
    """Compare at one point."""
    point = Curve(level, prime)
    point.check_domain()
    point.compare()
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    if (kind := tables["claim"]["kind"]) not in ("action", "frequency") or "elliptic" not in str(tables):
        raise Stop("not shown", "no action and no frequency by elliptic integrals")
    motion, reasons = alone_orbits.Motion(tables), ["an orbit"]
    if motion.branch not in (None, "libration", "rotation") or {*motion.said} & {"well", "period"}:
        raise Stop("not shown", "one of several wells")
    for chart in (*alone_charts.mirrors(motion), *alone_charts.charts(motion)):
        try:
            if (chart.kind == "circle") != (motion.branch is not None):
                raise Stop("not shown", "a branch of another motion, or none")
            level = alone_charts.Level(motion, chart)
            level.is_time = kind == "frequency"
            if level.is_time and not level.plain:
                raise Stop("not shown", "a period where the momentum is in a root")
            level.check()
            alone_ends.Ends(level).choose(motion.branch == "rotation")
            answer = alone.tried(sample, level)
            if not alone_somewhere.is_somewhere(level):
                raise Stop("not shown", "that there is such an orbit")
            return answer
        except Stop as stop:
            reasons.append(f"{stop.args[1]} ({chart.kind})")
    return "not shown", "; ".join(reasons[1:])[:300]


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
