"""Which zeros of Δ are the ends of an orbit, for `alone_elliptic.py`.

Zeros are formulas: names of the claim and parts of what it says, zeros of linear factors, and the last one by the sum
of all. Each is seen to be a zero at every point that is tried; here which of them may lie in the range of u. The ends
of an orbit that exists are simple zeros in the range, or a place at which the line is folded. So two that may be there
are the ends; of three in a known order those between which Δ is positive.
"""

from __future__ import annotations

from itertools import combinations, permutations
from typing import Any

if __package__:
    from canon.checker import alone, alone_actions, alone_charts, alone_orbits, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_actions  # type: ignore
    import alone_charts  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop, U = alone.Formula, alone.Stop, alone_orbits.U
MOST_CANDIDATES, MOST_PAIRS = 60, 12


class Ends:
    """The zeros of Δ and what H divides by, and which of them are the ends of an orbit."""

    def __init__(self, level: Any) -> None:
        self.level, self.motion, self.flat = level, level.motion, level.flat
        self.chart, self.make = level.chart, level.motion.made
        found = [f for f in (self.chart.low, self.chart.high) if f]
        for p in (level.n2, level.d):
            found += self.linear(p)
        found = self.apart([*found, *self.candidates()])
        powers = of.by_powers(level.delta, U)
        least = min(powers)
        zeros = [f for f in found if self.is_zero(level.delta, f)]
        own = [f for f in zeros if least == 0 or self.flat.quotient(f)[0]]
        if len(own) == max(powers) - least - 1:  # the last one by the sum of all
            lead, next_one = (self.flat.written(powers.get(k, {})) for k in (max(powers), max(powers) - 1))
            last = self.make("*", alone.number(-1), self.make("/", next_one, lead))
            for f in own:
                last = self.make("+", last, alone_charts.times_minus(self.motion, f))
            zeros.append(last)
        self.zeros, level.zeros = zeros, self.apart([*found, *zeros])

    def linear(self, p: Any) -> list[Any]:
        """The zero of a linear polynomial."""
        powers = of.by_powers(p, U)
        if {*powers} != {0, 1}:
            return []
        one = self.make("/", self.flat.written(powers[0]), self.flat.written(powers[1]))
        return [self.make("*", alone.number(-1), one)]

    def candidates(self) -> list[Any]:
        """What the claim has names for, or is made of."""
        motion, found = self.motion, list[Any]()
        names = [*motion.words, *(n for n in motion.texts if n[0] != "_" and n not in motion.names)]
        left = [Formula(".", (n,)) for n in names if n != motion.energy and "function" not in motion.words.get(n, ())]
        left += [motion.known("_equals")]
        while left and len(found) < MOST_CANDIDATES:
            f = left.pop(0)
            left += [g for g in f.of if isinstance(g, Formula)]
            if f.kind in ("+", "*", "."):
                if not motion.inner(f) & {motion.q, motion.p} and not has_elliptic(f):
                    found.append(f)
        return found

    def apart(self, each: list[Any]) -> list[Any]:
        """Without those that are the same."""
        found = dict[Any, Any]()
        point = self.point()
        for f in each:
            found.setdefault(point.at(f), f)
        return [*found.values()]

    def point(self) -> alone_actions.Residues:
        """One point, at which places are compared that are tested later on."""
        if not hasattr(self, "first"):
            for _ in range(alone.MOST_TRIED):
                try:
                    self.first = alone_actions.Residues(self.level, alone.random_prime())
                    self.first.check_domain()
                    self.first.squared()
                    self.first.text("_equals")
                    for f in self.candidates():
                        self.first.at(f)
                    break
                except alone.Elsewhere:
                    continue
        return self.first

    def is_zero(self, p: Any, f: Any) -> bool:
        point = self.point()
        z = point.at(f)
        return sum(c * pow(z, k, point.p) for k, c in enumerate(point.listed(p))) % point.p == 0

    def sign(self, f: Any) -> int:
        """1, or −1, where a formula without u is seen to be positive, or negative; 0 else."""
        both = self.flat.reduced(self.flat.quotient(f))
        return self.side(both[0]) * self.side(both[1])

    def side(self, p: Any) -> int:
        """The same of a polynomial: by the domain's conditions, or by two that follow."""
        motion, where = self.motion, self.motion.domain.get("where", [])
        f = self.flat.written(p)
        pairs = chained(where)
        for a, b in pairs:
            n, d = self.flat.quotient(motion.read(f"({b}) - ({a})"))
            if d == of.ONE and n and {*n} == {*p}:
                ratios = {p[m] / c for m, c in n.items()}
                if len(ratios) == 1:
                    return 1 if ratios.pop() > 0 else -1
        try:
            for kept in (where, *([f"({a}) < ({b})" for a, b in two] for two in combinations(pairs, 2))):
                motion.domain = {"where": [*kept]}
                signs = alone_signs.Signs(motion)
                q = signs.quotient(f)[0]
                for sign, g in ((1, q), (-1, of.minus(q))):
                    if signs.shown(g, True):
                        return sign
        finally:
            motion.domain = {"where": where}
        return 0

    def minus(self, f: Any, g: Any) -> Any:
        return self.make("+", f, alone_charts.times_minus(self.motion, g))

    def is_outside(self, f: Any) -> bool:
        """Whether a zero is seen to be no end of an orbit."""
        low, high = self.chart.low, self.chart.high
        for end, side in ((low, 1), (high, -1)):
            if end is not None:
                n = self.flat.reduced(self.flat.quotient(self.minus(f, end)))[0]
                if not n or self.sign(self.minus(f, end)) == -side:
                    return True
        if self.level.allowed:
            top, bottom = self.level.allowed
            rest = self.make("/", self.flat.written(top), self.flat.written(bottom))
            return self.sign(put(self.motion, rest, f)) < 0
        return False

    def choose(self, rotates: bool) -> None:
        """Which places the ends are, how often the motion runs from one to the other, and what Δ does in between."""
        level, chart = self.level, self.chart
        inside = [f for f in self.zeros if not self.is_outside(f)]
        powers = of.by_powers(level.delta, U)
        if chart.kind == "circle":
            slope = self.sign(self.flat.written(powers.get(1, {}))) if {*powers} <= {0, 1} else 0
            if rotates and (level.allowed or level.n1):
                raise Stop("not shown", "a rotation with one positive momentum")
            if not slope or len(inside) != 1 or of.by_powers(level.n2, U).keys() - {0}:
                raise Stop("not shown", "a motion on the circle with one cosine")
            level.ends = [chart.low, chart.high] if rotates else [inside[0], chart.high if slope > 0 else chart.low]
            level.times, level.pattern = (2, "^[+]$") if rotates else (4, "-[+]$" if slope > 0 else "^[+]-")
        elif rotates:
            raise Stop("not shown", "a rotation of such an H")
        elif chart.kind == "even" and len(inside) == 1:
            level.ends, level.times, level.pattern = [chart.low, inside[0]], 4, "^[+]-"
        elif chart.kind != "even" and len(inside) == 2:
            level.ends, level.times, level.pattern = inside, 2, "-[+]-"
        elif chart.kind == "line" and len(inside) == 3 and max(powers) == 3 and not level.allowed:
            level.times, level.pattern = 2, "-[+]-"
            rows = [x for x in permutations(inside) if all(self.sign(self.minus(x[k + 1], x[k])) > 0 for k in (0, 1))]
            lead = self.sign(self.flat.written(powers[3]))
            if not rows or not lead:
                raise Stop("not shown", "the order of three zeros")
            level.ends = [*rows[0][:2]] if lead > 0 else [*rows[0][1:]]
        else:
            raise Stop("not shown", "which zeros are the ends of an orbit")


def chained(where: Any) -> list[tuple[str, str]]:
    """What is smaller than what by the domain's conditions, and so by two or more of them."""
    found = set[tuple[str, str]]()
    for words in (alone_orbits.re.split(r"(<=|>=|!=|<|>)", text) for text in where):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            if sign in "<>":
                found.add((a.strip(), b.strip()) if sign == "<" else (b.strip(), a.strip()))
    for _ in range(3):
        found |= {(a, c) for a, b in found for other, c in found if b == other}
    return sorted(found)[:MOST_PAIRS]


def has_elliptic(f: Any) -> bool:
    return f.kind in alone_orbits.ELLIPTIC or any(has_elliptic(g) for g in f.of if isinstance(g, Formula))


def put(motion: Any, f: Any, place: Any) -> Any:
    """A formula with a place for u."""
    if f.kind == ".":
        return place if f.of[0] == U else f
    return f if f.kind == "#" else motion.made(f.kind, *(put(motion, g, place) for g in f.of))
