"""Orbits H(q, p) = E of one coordinate, in numbers: their momenta, their ends, and integrals round them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from canon.checker.enclosures import Integrand
from canon.checker.points import Numbers, Outside, allowed
from canon.checker.statement import Statement

ROUGH = 15
"""Digits in which an orbit is looked for."""
NARROWEST, STEP, STEPS = 1e-9, 1.08, 420
"""Where an orbit is looked for: finely about 0, and out to 100,000."""
NEAREST = 8
"""So many of the places where an orbit may be are looked at, those next to 0 first: farther out the grid is coarse."""
BRANCHES = 48
"""The momentum of a Hamiltonian that isn't quadratic is looked for at so many places, each twice as far as the last."""


@dataclass(frozen=True)
class Form:
    """A Hamiltonian in one coordinate and its momentum, with all else constant: `parts` are a, b, c of a p² + b p + c,
    or where it isn't `quadratic`, but even in p, H(q, 0), H, ∂H/∂p and H(q, −p)."""

    s: Statement
    x: str
    p: str
    quadratic: bool
    parts: tuple[int, ...]

    @staticmethod
    def of(s: Statement, H: int, x: str, p: str) -> Form:
        """The form of H."""
        f = s.f
        slope, at_rest = f.slope(H, p), {p: f.number(0)}
        curved = f.slope(slope, p)
        if not any(f.ops[b] == ("s", p) for b in f.reach(curved)):
            parts = f.mul(f.read("1/2", {}), curved), f.substitute(slope, at_rest), f.substitute(H, at_rest)
            return Form(s, x, p, True, parts)
        turned = f.substitute(H, {p: f.mul(f.number(-1), f.node("s", p))})
        return Form(s, x, p, False, (f.substitute(H, at_rest), H, slope, turned))

    def integrand(self, level: int, *, rate: bool, rotates: bool) -> tuple[Integrand, list[tuple[int, str]]]:
        """Of a quadratic form what is integrated for its action, or with `rate` its period; and what must be positive.

        D = b² - 4 a (c - E): ∮ p dq = ∫ √D/a dq and ∮ dt = 2 ∫ dq/√D round a libration; a rotation has p > 0 alone.
        """
        f, (a, b, c) = self.s.f, self.parts
        room = f.sub(level, c)
        D = f.add(f.mul(b, b), f.mul(f.number(4), a, room))
        over, none = f.power(a, f.number(-1)), f.number(0)
        r = Fraction(-1 if rate else 1, 2)
        if not rotates:
            return Integrand(f, self.x, none, f.number(2) if rate else over, D, r), []
        half = f.mul(f.number(Fraction(1, 2)), over)
        e, u = (none, f.number(1)) if rate else (f.mul(f.number(-1), b, half), half)
        return Integrand(f, self.x, e, u, D, r), [(a, "positive"), (room, "positive")]


class Momenta:
    """The momenta at places of one orbit, with numbers for all constants."""

    def __init__(self, form: Form, numbers: Numbers, of: dict[str, Any], energy: Any) -> None:
        self.form, self.numbers, self.of, self.energy = form, numbers, of, energy
        self.last: Any = None  # the momentum that was found last: the next one isn't far

    def _values(self, q: Any, p: Any = None, numbers: Numbers | None = None) -> list[Any]:
        form = self.form
        self.of[form.x] = q
        if p is not None:
            self.of[form.p] = p
        parts = form.parts if form.quadratic else form.parts[:1] if p is None else form.parts[1:]
        found = (numbers or self.numbers).values(form.s.f, parts, self.of)
        return [found[part] for part in parts]

    def room(self, q: Any, numbers: Numbers | None = None) -> Any:
        """Positive where the orbit can be: D, or E − H(q, 0). Raises Outside where H isn't defined."""
        if self.form.quadratic:
            a, b, c = self._values(q, None, numbers)
            return b * b - 4 * a * (c - self.energy)
        return self.energy - self._values(q, None, numbers)[0]

    def branches(self, q: Any) -> tuple[Any, Any, Any, Any]:
        """Half the sum and half the difference of the two momenta, |dH/dp| and the sign of d²H/dp²."""
        mp = self.numbers.mp
        if self.form.quadratic:
            a, b, c = self._values(q)
            D = b * b - 4 * a * (c - self.energy)
            if D <= 0 or a == 0:
                raise Outside
            return -b / (2 * a), mp.sqrt(D) / (2 * abs(a)), mp.sqrt(D), mp.sign(a)
        p = self._solved(q)
        rate = self._values(q, p)[1]
        if rate <= 0:
            raise Outside
        return mp.mpf(0), p, rate, mp.mpf(1)

    def _solved(self, q: Any) -> Any:
        """p > 0 with H(q, p) = E, where H grows with p. Raises Outside where it doesn't, or p isn't found."""
        mp = self.numbers.mp
        low, high = mp.mpf(0), self.last or mp.mpf(2) ** -BRANCHES
        if self.room(q) <= 0:
            raise Outside
        for _ in range(2 * BRANCHES):
            value, rate, turned = self._values(q, high)
            if rate <= 0 or abs(turned - value) > abs(value) * mp.mpf(10) ** (4 - mp.dps):
                raise Outside
            if value > self.energy:
                break
            low, high = high, 2 * high
        else:
            raise Outside
        p = high
        for _ in range(200):  # Newton's steps, within a bracket
            value, rate, _ = self._values(q, p)
            low, high = (low, p) if value > self.energy else (p, high)
            better = p - (value - self.energy) / rate
            better = better if low < better < high else (low + high) / 2
            if abs(better - p) <= abs(p) * mp.eps * 8:
                self.last = better
                return better
            p = better
        raise Outside


class Orbit:
    """Integrals along an orbit: of its action, or with `rate`, its frequency; to so many `digits`."""

    def __init__(self, momenta: Momenta, rate: bool, digits: int) -> None:
        self.momenta, self.rate, self.digits, self.mp = momenta, rate, digits, momenta.numbers.mp

    def turn(self, period: Any) -> Any:
        """Over a period of the coordinate, with p > 0."""

        def value(q: Any) -> Any:
            mean, half, speed, _ = self.momenta.branches(q)
            if mean + half <= 0 or mean - half > 0:
                raise Outside
            return 1 / speed if self.rate else mean + half

        return self._finished(self._integral(value, [0, period / 2, period], None))

    def libration(self, low: Any, high: Any) -> Any:
        """There and back between two ends. The sense is that of the motion."""
        mp = self.mp
        middle, half = (low + high) / 2, (high - low) / 2
        signs = set[int]()

        def value(angle: Any) -> Any:
            _, size, speed, sign = self.momenta.branches(middle + half * mp.sin(angle))
            signs.add(int(sign))
            return half * mp.cos(angle) * 2 * (1 / speed if self.rate else size)

        kink = [mp.asin(-middle / half)] if low < 0 < high else []
        total = self._integral(value, [-mp.pi / 2, *kink, mp.pi / 2], mp.pi / 2)
        if len(signs) != 1:
            raise Outside
        return self._finished(total * (1 if self.rate else signs.pop()))

    def _finished(self, total: Any) -> Any:
        if total == 0:
            raise Outside
        return 1 / total if self.rate else total

    def _integral(self, function: Callable[[Any], Any], places: list[Any], edge: Any) -> Any:
        mp = self.mp

        def safe(x: Any) -> Any:
            try:
                return function(x)
            except Outside:
                if edge is None or edge - abs(x) > mp.mpf(10) ** (4 - mp.dps // 2):
                    raise
                return mp.mpf(0)  # rounding at a turning point

        value, error = mp.quad(safe, places, error=True, maxdegree=7)
        if not error < abs(value) * mp.mpf(10) ** (-self.digits - 3):
            raise Outside
        return value


class Ends:
    """Where the orbits of an energy end: `fine` is how many times finer than usual they are looked for."""

    def __init__(self, s: Statement, momenta: Momenta, fine: int, orbit: Orbit) -> None:
        self.s, self.momenta, self.orbit = s, momenta, orbit
        self.rough = Numbers(ROUGH)
        out = [NARROWEST * STEP ** (k / fine) for k in range(STEPS * fine)]
        self.grid = [*(-x for x in reversed(out)), *out]
        self.last, x = len(self.grid) - 1, momenta.form.x
        names = {a: {s.f.ops[b][1] for b in s.f.reach(a) if s.f.ops[b][0] == "s"} for a, _ in s.conditions}
        self.conditions = [(a, kind) for a, kind in s.conditions if x in names[a] and names[a] <= {x, *momenta.of}]
        self.conditions = [(a, kind) for a, kind in self.conditions if momenta.form.p not in names[a]]

    def measure(self, well: Any) -> Any:
        """The orbit about the well, or without one the one that there is. Raises Outside where there are several that
        differ, none, or none that can be measured."""
        values = [self.orbit.libration(low, high) for low, high in self.loops(well)]
        if any(abs(value / values[0] - 1) > 10.0**-self.orbit.digits for value in values):
            raise Outside
        return values[0]

    def loops(self, well: Any) -> list[tuple[Any, Any]]:
        """The ends of one orbit, or of two: about the well, or next to 0. Raises Outside where there is none."""
        runs = sorted(self._runs(), key=lambda run: abs(self.grid[run[0]] + self.grid[run[1]]))
        loops = list[tuple[Any, Any]]()
        for run in runs[:NEAREST]:
            if well is not None and not self.grid[max(run[0] - 1, 0)] <= well <= self.grid[min(run[1] + 1, self.last)]:
                continue
            found = self._loops(*run)
            loops += [(low, high) for low, high in found if self._in_domain(low, high)]
            if len(loops) > 1:
                break
        if well is not None:
            loops = [(low, high) for low, high in loops if low < well < high]
        loops = sorted(loops, key=lambda loop: (abs(loop[0] + loop[1]), -loop[0]))[:2]
        if not loops:
            raise Outside
        return loops

    def _is_open(self, q: Any, numbers: Numbers | None = None) -> bool:
        try:
            return bool(self.momenta.room(q, numbers) > 0)
        except Outside:
            return False

    def _runs(self) -> list[tuple[int, int]]:
        here = [self._is_open(self.rough.mp.mpf(q), self.rough) for q in self.grid]
        runs, start = list[tuple[int, int]](), None
        for k, is_open in enumerate([*here, False]):
            if is_open and start is None:
                start = k
            elif not is_open and start is not None:
                runs.append((start, k - 1))
                start = None
        return runs

    def _loops(self, i: int, j: int) -> list[tuple[Any, Any]]:
        """The loops of a run of the grid: it is parted where the orbit's room touches 0, at a separatrix."""
        marks: list[Any] = [None if i == 0 else self._edge(self.grid[i], self.grid[i - 1])]
        try:
            room = [self.momenta.room(self.rough.mp.mpf(q), self.rough) for q in self.grid[i : j + 1]]
            for k in range(1, len(room) - 1):
                if room[k - 1] > room[k] <= room[k + 1]:
                    place = self._touched(self.grid[i + k - 1], self.grid[i + k + 1], min(room[k - 1], room[k + 1]))
                    marks += [place] if place is not None else []
        except Outside:
            return []
        marks.append(None if j == len(self.grid) - 1 else self._edge(self.grid[j], self.grid[j + 1]))
        return [(a, b) for a, b in pairwise(marks) if a is not None and b is not None]

    def _touched(self, left: float, right: float, size: Any) -> Any:
        """Where the room is 0 between; None where it clearly isn't. Raises Outside where it nearly is."""
        mp = self.momenta.numbers.mp
        low, high = mp.mpf(left), mp.mpf(right)
        for step in range(9 * mp.dps):
            third = (high - low) / 3
            a, b = (self.momenta.room(q) for q in (low + third, high - third))
            low, high = (low, high - third) if a < b else (low + third, high)
            if step == 60 and min(a, b) > size / 10**6:
                return None
        least = self.momenta.room((low + high) / 2)
        if abs(least) > size * mp.mpf(10) ** (8 - mp.dps):
            raise Outside
        return (low + high) / 2

    def _in_domain(self, low: Any, high: Any) -> bool:
        """Whether the domain has the whole loop in it, as far as it is seen at some places."""
        mp, form = self.momenta.numbers.mp, self.momenta.form
        words = self.s.words.get(form.x, ())
        for k in range(1, 16):
            q = low + (high - low) * mp.mpf(k) / 16
            if not allowed(words, q, self.momenta.numbers):
                return False
            try:
                found = self.momenta.numbers.values(
                    self.s.f, [a for a, _ in self.conditions], {**self.momenta.of, form.x: q}
                )
            except Outside:
                return False
            if any(not (found[a] > 0 or (kind == "nonzero" and found[a] != 0)) for a, kind in self.conditions):
                return False
        return True

    def _edge(self, inside: float, outside: float) -> Any:
        """Where the motion ends, by halving."""
        mp = self.momenta.numbers.mp
        a, b = mp.mpf(inside), mp.mpf(outside)
        for _ in range(int(3.4 * mp.dps)):
            middle = (a + b) / 2
            a, b = (middle, b) if self._is_open(middle) else (a, middle)
        return a
