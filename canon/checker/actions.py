"""What claims about actions, frequencies and angles ask for: integrals round an orbit, measured at points.

For a Hamiltonian that is quadratic in the momentum, a p² + b p + c = E, the two branches p± differ by √D/|a| with
D = b² − 4 a (c − E): the action is the integral of that between two zeros of D, or of p₊ over a period of the
coordinate; the period of the motion is that of 2/√D, or of 1/√D. What is measured is evidence, never a proof.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from canon.checker.case import Case
from canon.checker.functions import Unknown
from canon.checker.points import Numbers, Outside
from canon.checker.statement import Statement

OUT = [1e-6 * 1.08**k for k in range(330)]
GRID = [*(-x for x in reversed(OUT)), *OUT]
"""Where an orbit is looked for: finely about 0, and out to 100,000."""
DIGITS = 12
"""To so many digits an integral has to agree."""
ROUGH, PRECISE = 15, 32
"""Digits in which an orbit is looked for, and in which it is measured."""


def action(s: Statement) -> Case:
    """J = ∮ p dq, or ν = dE/dJ, is `equals`."""
    f, claim = s.f, s.claim
    x, E = str(claim["coordinate"]), str(claim["energy"])
    p = s.p[s.q.index(x)]
    fixed = {name: f.read(text, s.names) for name, text in claim.get("fixed", {}).items()}
    s.declared |= {E}
    H = f.substitute(s.H, {n: v for n, v in fixed.items() if n != E})
    curved = f.slope(f.slope(H, p), p)
    if any(f.ops[b] == ("s", p) for b in f.reach(curved)):
        raise Unknown("an action for a Hamiltonian that isn't quadratic in the momentum")
    at_rest = {p: f.number(0)}
    parts = [f.mul(f.read("1/2", {}), curved), f.substitute(f.slope(H, p), at_rest), f.substitute(H, at_rest)]
    level, equals = fixed.get(E, f.node("s", E)), s.key("equals")
    given = [f.read(claim[word], s.names) for word in ("period", "well") if word in claim]
    s.written += [level, *fixed.values(), *given]
    period = f.read(claim.get("period", "2*pi"), s.names)

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        found = numbers.values(f, [level, equals, period, *given], of)
        orbit = _Orbit(s, Numbers(PRECISE), {**of}, x, parts, found[level])
        well = found[given[-1]] if "well" in claim else None
        turn = found[period] if claim.get("branch") == "rotation" else None
        value = orbit.measure(turn, well, frequency=claim["kind"] == "frequency")
        return [value / found[equals] - 1]

    return Case([], measured=measured, digits=DIGITS)


class _Orbit:
    """The coordinate's motion at one energy, with numbers for all else."""

    def __init__(
        self, s: Statement, numbers: Numbers, of: dict[str, Any], x: str, parts: list[int], energy: Any
    ) -> None:
        self.s, self.numbers, self.of, self.x, self.parts, self.energy = s, numbers, of, x, parts, energy

    def discriminant(self, q: Any, numbers: Numbers | None = None) -> tuple[Any, Any, Any]:
        """D, a, b at a value of the coordinate; raises Outside where H isn't defined."""
        self.of[self.x] = q
        values = (numbers or self.numbers).values(self.s.f, self.parts, self.of)
        a, b, c = (values[part] for part in self.parts)
        return b * b - 4 * a * (c - self.energy), a, b

    def is_open(self, q: Any, numbers: Numbers | None = None) -> bool:
        """Whether the motion can be there."""
        try:
            return bool(self.discriminant(q, numbers)[0] > 0)
        except Outside:
            return False

    def measure(self, turn: Any, well: Any, *, frequency: bool) -> Any:
        """The action, or the frequency. Raises Outside where there is no such orbit, or it can't be measured."""
        mp = self.numbers.mp
        if turn is not None:
            if not all(self.is_open(turn * k / 12) for k in range(12)):
                raise Outside
            total = self._integral(lambda q: self._speed(q, frequency, turning=True), [0, turn / 2, turn])
        else:
            low, high = self._turning_points(well)
            middle, half = (low + high) / 2, (high - low) / 2

            def slope(angle: Any) -> Any:
                return half * mp.cos(angle) * self._speed(middle + half * mp.sin(angle), frequency, turning=False)

            kink = [mp.asin(-middle / half)] if low < 0 < high else []
            total = self._integral(slope, [-mp.pi / 2, *kink, mp.pi / 2])
        return 1 / total if frequency else total

    def _speed(self, q: Any, frequency: bool, *, turning: bool) -> Any:
        mp = self.numbers.mp
        D, a, b = self.discriminant(q)
        if D <= 0:  # rounding at a turning point
            raise Outside
        if frequency:
            return (1 if turning else 2) / mp.sqrt(D)
        return (-b + mp.sqrt(D)) / (2 * a) if turning else mp.sqrt(D) / abs(a)

    def _integral(self, function: Callable[[Any], Any], places: list[Any]) -> Any:
        mp = self.numbers.mp

        def safe(x: Any) -> Any:
            try:
                return function(x)
            except Outside:
                return mp.mpf(0)

        value, error = mp.quad(safe, places, error=True, maxdegree=6)
        if not error < abs(value) * mp.mpf(10) ** (-DIGITS - 3):
            raise Outside
        return value

    def _turning_points(self, well: Any) -> tuple[Any, Any]:
        """The ends of the interval of the motion about the well; without one, of any: a claim has none that matters."""
        rough = Numbers(ROUGH)
        here = [self.is_open(rough.mp.mpf(q), rough) for q in GRID]
        runs, k = list[tuple[int, int]](), 0
        while k < len(GRID):
            if here[k]:
                start = k
                while k + 1 < len(GRID) and here[k + 1]:
                    k += 1
                runs.append((start, k))
            k += 1
        last = len(GRID) - 1
        runs = [(i, j) for i, j in runs if i > 0 and j < last and (well is None or GRID[i - 1] <= well <= GRID[j + 1])]
        if not runs:
            raise Outside
        i, j = min(runs, key=lambda run: (abs(GRID[run[0]] + GRID[run[1]]), -run[0]))
        self._check_one_loop(i, j, rough)
        return self._edge(GRID[i], GRID[i - 1]), self._edge(GRID[j], GRID[j + 1])

    def _check_one_loop(self, i: int, j: int, rough: Numbers) -> None:
        """Raises Outside where D seems to touch 0 between the ends: two loops meet there, at a separatrix."""
        D = [self.discriminant(rough.mp.mpf(q), rough)[0] for q in GRID[i : j + 1]]
        for k in range(1, len(D) - 1):
            if not D[k - 1] > D[k] <= D[k + 1]:
                continue
            low, high = rough.mp.mpf(GRID[i + k - 1]), rough.mp.mpf(GRID[i + k + 1])
            for _ in range(60):
                third = (high - low) / 3
                left, right = (self.discriminant(q, rough)[0] for q in (low + third, high - third))
                low, high = (low, high - third) if left < right else (low + third, high)
            if self.discriminant((low + high) / 2, rough)[0] < min(D[k - 1], D[k + 1]) / 10**6:
                raise Outside

    def _edge(self, inside: float, outside: float) -> Any:
        """Where the motion ends, by halving."""
        mp = self.numbers.mp
        a, b = mp.mpf(inside), mp.mpf(outside)
        for _ in range(int(3.4 * mp.dps)):
            middle = (a + b) / 2
            a, b = (middle, b) if self.is_open(middle) else (a, middle)
        return a


def action_angle(s: Statement) -> Case:
    """Canonical, and K depends on the new momenta alone; each angle's period brings the old variables back."""
    f = s.f
    zeros, _ = s.brackets(f.number(1))
    period = f.read(s.claim.get("angle_period", "1"), s.names)
    s.written.append(period)
    once = "that each angle advances by its period once round its cycle"
    if s.direction == "forward":
        if s.verdict == "refuted":
            raise Unknown("a refutation of angles of a map that is given forward")
        momenta = s.new[len(s.q) :]
        return Case([*zeros, *(f.bracket(P, s.H, s.f.pairs) for P in momenta)], trusted=once)
    if s.direction != "backward":
        raise Unknown("angles of a map that is given by a generating function")
    K = s.pull(s.H)
    zeros += [f.slope(K, angle) for angle in s.Q]
    later = [[f.substitute(x, {Q: f.add(f.node("s", Q), period)}) for x in s.old] for Q in s.Q]

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        """The changes of the old variables, but for coordinates that H doesn't tell from themselves afterwards."""
        found = numbers.values(f, [*s.old, *(x for row in later for x in row)], of)
        residuals = []
        for row in later:
            for name, before, after in zip((*s.q, *s.p), s.old, row, strict=True):
                change = found[after] - found[before]
                if abs(change) > numbers.mp.mpf(10) ** -DIGITS and name in s.q and _same(s, numbers, of, name, change):
                    change = numbers.mp.mpf(0)
                residuals.append(change)
        return residuals

    return Case(zeros, measured=measured, digits=DIGITS, trusted=once)


def _same(s: Statement, numbers: Numbers, of: Mapping[str, Any], name: str, change: Any) -> bool:
    """Whether H is the same where a coordinate has moved by a full turn."""
    f = s.f
    here = {n: numbers.values(f, [x], of)[x] for n, x in zip((*s.q, *s.p), s.old, strict=True)}
    a, b = (numbers.values(f, [s.H], {**of, **here, name: here[name] + d})[s.H] for d in (0, change))
    turns = abs(change) / (2 * numbers.mp.pi)
    return bool(abs(a - b) < numbers.mp.mpf(10) ** -DIGITS and abs(turns - 1) < numbers.mp.mpf(10) ** -DIGITS)


KINDS: dict[str, Callable[[Statement], Case]] = {
    "action": action,
    "frequency": action,
    "action_angle": action_angle,
}
