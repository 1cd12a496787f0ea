"""Refutations of actions and frequencies, beside `counterexample.py`: by an orbit that is enclosed.

For H = A p² + B p + C and D = B² − 4 A (C − E) an orbit in q lies where D > 0. Round a libration, between two simple
zeros of D, ∮ p dq = ∫ √D/A dq and the period is T = ∫ 2/√D dq; a rotation has p = (−B + √D)/2A and T = ∫ dq/√D over
a period of H. The zeros lie in short intervals, where D changes its sign and its slope has one; ∫ 2/√D ≤ 4
√(δ/|D'|).
"""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker.alone import RANDOM, Formula, Stop
    from canon.checker.counterexample import Arithmetic, Interval, Open, check, fails, somewhere
    from canon.checker.counterexample_formulas import NOUGHT, Writer, degree, inner_names, put_names
    from canon.checker.counterexample_functions import More, Place, integral, piece
    from canon.checker.counterexample_integrals import claim_with, sides_of
else:  # as a program's part, beside the other files
    from alone import RANDOM, Formula, Stop  # type: ignore
    from counterexample import Arithmetic, Interval, Open, check, fails, somewhere  # type: ignore
    from counterexample_formulas import NOUGHT, Writer, degree, inner_names, put_names  # type: ignore
    from counterexample_functions import More, Place, integral, piece  # type: ignore
    from counterexample_integrals import claim_with, sides_of  # type: ignore

BITS, HALVINGS, STEPS, MOST_TERMS, FINE = 192, 400, 8, 1000, Fraction(1, 10**22)
SHARES = (Fraction(1, 3), *(Fraction(1, 10**k) for k in (2, 3, 5)))


class Orbits:
    """The motions of one coordinate at an energy, at a choice of everything else."""

    def __init__(self, asked: More, of: dict[str, Any], coordinate: str, energy: str, extent: list[Any]) -> None:
        """`extent` are conditions on the coordinate, as (formula, words)."""
        self.asked, self.of, self.q, self.extent, self.real = asked, of, coordinate, extent, Arithmetic(BITS)
        self.plain = True
        write, n = Writer(asked), len(asked.names) // 2
        self.p = asked.names[n + asked.names[:n].index(coordinate)]
        h = write.written(asked.known("_H"))
        if energy in inner_names(h, asked):
            raise Stop("not shown", "a Hamiltonian with its energy in it")
        for node in (x for x in terms(h) if x.kind == "^" and degree(x, self.p, asked) is None):
            rest = write.written(asked.read("e - r", {"e": Formula(".", (energy,)), "r": less(asked, h, node)}))
            if node.of[1].kind != "#" or node.of[1].of[0] != Fraction(1, 2):
                break
            self.extent = [*extent, (rest, ("positive",))]  # √X + V = E where E > V and X − (E − V)² = 0
            h = asked.read("x - r**2 + e", {"x": node.of[0], "r": rest, "e": Formula(".", (energy,))})
            self.plain = False
            break
        if write.under or degree(h, self.p, asked) not in (1, 2):
            raise Stop("not shown", "a Hamiltonian that isn't quadratic in the momentum")
        at_rest = {self.p: NOUGHT}
        first = write.slope(h, self.p)
        a, b, c = put_names(write.slope(first, self.p), at_rest), put_names(first, at_rest), put_names(h, at_rest)
        own = {"a": a, "b": b, "c": c, "x": Formula(".", (energy,))}  # a is 2A
        self.a, self.b, self.h = a, b, c
        self.d = write.written(asked.read("b**2 - 2*a*(c - x)", own))
        own |= {"d": self.d}
        self.action = asked.read("2*d**(1/2)/a", own)
        self.time = asked.read("2*d**(-1/2)", own)
        self.upper, self.product = asked.read("(-b + d**(1/2))/a", own), asked.read("2*(c - x)/a", own)

    def box(self, q: Interval) -> Place:
        """The coordinate in an interval; the formulas have values there, and the coordinate is in the domain."""
        box = Place(self.asked, {**self.of, self.q: q}, self.real)
        for formula, words in self.extent:
            check(box.at(formula), words)
        for f in (self.a, self.b, self.h):
            box.at(f)
        if not fails(box.at(self.a), ""):
            raise Open("that the Hamiltonian is quadratic in the momentum")
        return box

    def side(self, q: Fraction) -> int:
        """The sign of D; 0 where it isn't seen, or the coordinate isn't in the domain."""
        try:
            low, high = self.box((q, q)).at(self.d)
        except Open:
            return 0
        return 1 if low > 0 else -1 if high < 0 else 0

    def end(self, inside: Fraction, outside: Fraction) -> tuple[Fraction, Fraction]:
        """Two points (with D > 0, with D < 0) between which there is one zero of D, a simple one."""
        for _ in range(HALVINGS):
            if self.side(outside) < 0 and abs(outside - inside) < FINE * (abs(inside) + FINE):
                break
            middle = (inside + outside) / 2
            middle = self.real.below(middle) if inside < self.real.below(middle) < outside else middle
            inside, outside = (middle, outside) if self.side(middle) > 0 else (inside, middle)
        steep = self.box((min(inside, outside), max(inside, outside))).at(self.d, self.q)
        if self.side(inside) <= 0 or self.side(outside) >= 0 or not fails(steep, ""):
            raise Open("an end of the orbit")
        return inside, outside

    def reach(self, start: Fraction) -> list[tuple[Fraction, Fraction]]:
        """The ends of the orbit round a place with D > 0: (inside, outside) on the left and on the right."""
        found = list[tuple[Fraction, Fraction]]()
        for sign in (-1, 1):
            step, inside = max(abs(start), Fraction(1)) / 2**40, start
            while self.side(outside := inside + sign * step) > 0:
                inside, step = outside, min(step * 3 / 2, (abs(outside) + abs(start)) / 2 + step)
                if abs(inside) > 10**12:
                    raise Open("an orbit that ends")
            found.append(self.end(inside, outside))
        return found

    def places(self) -> list[Fraction]:
        """Places at which D > 0, nearer and nearer to 0 and farther and farther away, one for each run of them."""
        near = [Fraction(2) ** (k // STEPS) * (1 + Fraction(k % STEPS, STEPS)) for k in range(-30 * STEPS, 12 * STEPS)]
        line = [*(-x for x in reversed(near)), Fraction(0), *near]
        sides = [self.side(q) for q in line]
        return [q for q, s, before in zip(line, sides, [0, *sides], strict=False) if s > 0 and before <= 0]

    def left_out(self, inside: Fraction, outside: Fraction, inverse: bool) -> Interval:
        """What ∫ f is at most, and at least, between an end and a place up to which D grows. Raises Open."""
        box, width = self.box((min(inside, outside), max(inside, outside))), abs(inside - outside)
        steep = box.at(self.d, self.q)
        if not fails(steep, ""):
            raise Open("that the end is the only one")
        if inverse:  # D ≥ |D'| (distance)
            return Fraction(0), 4 * self.real.root(width / min(map(abs, steep)))[1]
        top = self.real.root(max(Fraction(0), box.at(self.d)[1]) + FINE**9)[1]
        most = self.real.times((Fraction(0), 2 * width * top), self.real.power(box.at(self.a), -1))
        return min(most[0], Fraction(0)), max(most[1], Fraction(0))

    def over(self, f: Formula, ends: list[tuple[Fraction, Fraction]], value: Interval, inverse: bool) -> Interval:
        """∫ f between the ends, exactly enough to leave out the value, or nearly so."""
        found = (value[0], value[1])
        for share in SHARES:
            small = (abs(value[0]) + abs(value[1])) * share
            found = self.nearly(f, ends, value, inverse, small)
            if apart(found, value):
                break
        return found

    def nearly(self, f: Formula, ends: Any, value: Interval, inverse: bool, small: Fraction) -> Interval:
        """The same, in an interval that is about so small; what is left out at the ends is as large as it may be."""
        places, low, high, far = list[Fraction](), Fraction(0), Fraction(0), abs(ends[1][0] - ends[0][0]) / 3
        for inside, outside in ends:
            width, sign, best = abs(inside - outside), 1 if inside > outside else -1, inside
            rest = self.left_out(inside, outside, inverse)
            while (width := 4 * width) < far:
                place = outside + sign * width
                with suppress(Open):
                    more = self.left_out(place, outside, inverse)
                    if more[1] - more[0] < small / 4:
                        best, rest = place, more
                        continue
                break
            places.append(best)
            low, high = low + rest[0], high + rest[1]

        def done(x: Interval) -> bool:
            return x[1] + high < value[0] or value[1] < x[0] + low or x[1] - x[0] < small

        coarse = small * 100 > abs(value[0]) + abs(value[1])
        of = (lambda x: self.coarse(f, x)) if coarse else (lambda x: self.part(f, x))
        found = integral(of, (places[0], places[1]), done)
        return found[0] + low, found[1] + high

    def coarse(self, f: Formula, x: Interval) -> Interval:
        """∫ f over such a piece, by its values there."""
        box = self.box(x)
        if box.at(self.d)[0] <= 0:
            raise Open("that the motion goes on")
        return self.real.times(box.at(f), (x[1] - x[0], x[1] - x[0]))

    def part(self, f: Formula, x: Interval) -> Interval:
        """∫ f over a piece that lies in the domain, where D > 0."""
        if self.box(x).at(self.d)[0] <= 0:
            raise Open("that the motion goes on")
        return piece(lambda y: Place(self.asked, {**self.of, self.q: y}, self.real), f, self.q, x)

    def turn(self, f: Formula, length: Interval, value: Interval, both: bool = False) -> Interval:
        """∫ f over a whole turn, from 0 on: what is left of it up to its irrational length is at most so large. With
        `both` the two momenta are seen to have two signs, and f to belong to the positive one."""
        small = (abs(value[0]) + abs(value[1])) / 10**5

        def part(x: Interval) -> Interval:
            box = self.box(x)
            if both and (box.at(self.product)[1] >= 0 or box.at(self.a)[0] <= 0):
                raise Open("one rotation with a positive momentum")
            return self.part(f, x)

        found = integral(part, (Fraction(0), length[0]), lambda x: x[1] - x[0] < small)
        last = self.real.times((Fraction(0), length[1] - length[0]), self.box(length).at(f))
        return found[0] + min(last[0], Fraction(0)), found[1] + max(last[1], Fraction(0))


def terms(f: Formula) -> list[Formula]:
    """What a formula is the sum of."""
    found, left = list[Formula](), [f]
    while left:
        x = left.pop()
        (left if x.kind == "+" else found).extend(x.of if x.kind == "+" else [x])
        if len(found) + len(left) > MOST_TERMS:
            raise Stop("not shown", "sums that are so long")
    return found


def less(asked: More, f: Formula, one: Formula) -> Formula:
    """A sum without one of its terms."""
    found = NOUGHT
    for x in terms(f):
        found = found if x is one else asked.made("+", found, x)
    return found


def apart(x: Interval, y: Interval) -> bool:
    """Whether two numbers differ."""
    return x[1] < y[0] or y[1] < x[0]


def multiples(x: Interval, y: Interval) -> bool:
    """Whether x may be y, 2 y, 3 y, …; both are positive."""
    if y[0] <= 0 or x[0] <= 0:
        return True
    return (x[1] / y[0]).__floor__() > (x[0] / y[1]).__ceil__() - 1 and (x[1] / y[0]).__floor__() >= 1


def circular(f: Formula, name: str) -> bool:
    """Whether a name stands in sines and cosines of itself alone, so that 2π is a period."""

    @cache
    def of(x: Formula) -> bool:
        if x.kind in ("sin", "cos") and x.of[0].kind == "." and x.of[0].of[0] == name:
            return True
        return x.of != (name,) if x.kind == "." else all(of(y) for y in x.of if isinstance(y, Formula))

    return of(f)


def of_action(tables: Any, witness: Any) -> bool:
    """∮ p dq, or a frequency, isn't `equals` for an orbit in the domain, about the well if there is one."""
    claim, space = tables["claim"], tables["phase_space"]
    if {"transformation", "generating_function"} & {*tables}:
        raise Stop("not shown", "an orbit beside a map")
    fixed, energy, q = claim.get("fixed", {}), claim["energy"], claim["coordinate"]
    texts = {f"_{key}": claim[key] for key in ("equals", "well", "period") if key in claim} | fixed
    asked = claim_with(tables, [energy], texts)
    p = space["p"][space["q"].index(q)]
    moving = {q, p, asked.names[-1]}
    conditions = [(asked.known(text), [word]) for text, word in sides_of(asked.domain.get("where", []))]
    if any(inner_names(f, asked) & (moving - {q}) for f, _ in conditions) or {*asked.words.get(p, ())} - {"real"}:
        raise Stop("not shown", "conditions on the momentum")
    h = inner_names(asked.known("_H"), asked)
    if h & ({*space["q"], asked.names[-1]} - {q}) or {*fixed} & moving:
        raise Stop("not shown", "a Hamiltonian of other coordinates, or of time")
    for key in ("equals", "well", "period", *fixed):
        text = fixed[key] if key in fixed else claim.get(key, "0")
        if inner_names(asked.known(text), asked) & {*space["q"], *moving}:
            raise Stop("not shown", "a value that moves")
    of = somewhere(asked, witness, 0)
    for name in (q, p):
        of.pop(name, None)
    point, mine = Place(asked, of, Arithmetic(BITS)), asked.words.get(q, ())
    for f, words in conditions:
        if q not in inner_names(f, asked):
            check(point.at(f), words)
    for name, words in asked.words.items():
        if "function" not in words and name not in (q, p):
            check(point.named(name), words)
    extent = [(f, words) for f, words in conditions if q in inner_names(f, asked)] + [(Formula(".", (q,)), mine)]
    orbits, value = Orbits(asked, of, q, energy, extent), point.text("_equals")
    if claim["kind"] == "frequency":
        value = orbits.real.power(value, -1)
    is_time = claim["kind"] == "frequency"
    if claim.get("branch") == "rotation":
        return rotates(orbits, claim, value, is_time)
    if "period" in claim:
        raise Stop("not shown", "a libration with a period")
    starts = [point.text("_well")[0]] if "well" in claim else orbits.places()
    if "well" not in claim and circular(orbits.d, q):  # images of a well under the period are one
        starts = [x for x in starts if abs(x) < Fraction(63, 20)]
    ends = list[Any]()
    for start in (x for x in starts if orbits.side(x) > 0):
        with suppress(Open):
            ends.append(orbits.reach(start))
    if len(ends) != 1 or (is_time and not orbits.plain):
        raise Stop("not shown", "one orbit at this energy")
    found = orbits.over(orbits.time if is_time else orbits.action, ends[0], value, is_time)
    return apart(found, value)


def turns(orbits: Orbits) -> bool:
    """Whether the period is a whole multiple of 2π: a number that is so for others in the place of π, too."""
    asked, found = orbits.asked, set[Fraction]()
    f = asked.known("_period")
    for x in (Fraction(RANDOM.getrandbits(64) + 1, 2**60) for _ in range(2)):
        low, high = Place(asked, {**orbits.of, "pi": (x, x)}, orbits.real).at(f)
        found |= {low / (2 * x), high / (2 * x)}
    return not inner_names(f, asked) - {"pi"} and len(found) == 1 and found.pop().denominator == 1


def rotates(orbits: Orbits, claim: Any, value: Interval, is_time: bool) -> bool:
    """The same of a rotation, the one with p > 0; without a `period` it may be any part of 2π."""
    point = Place(orbits.asked, orbits.of, orbits.real)
    length = point.text("_period" if "period" in claim else "2*pi")
    if not circular(orbits.h, orbits.q) or not circular(orbits.d, orbits.q):
        raise Stop("not shown", "a period")
    if is_time and not orbits.plain:
        raise Stop("not shown", "a Hamiltonian that isn't quadratic in the momentum")
    moves = orbits.q in inner_names(orbits.h, orbits.asked)  # else all lengths are periods
    if moves and "period" in claim and not turns(orbits):
        raise Stop("not shown", "that this is a period of H")
    if length[0] <= 0 or orbits.extent != [(orbits.extent[-1][0], ())]:
        raise Stop("not shown", "a rotation in a part of the circle")
    half = orbits.asked.read("a/2", {"a": orbits.time})
    found = orbits.turn(half if is_time else orbits.upper, length, value, both=True)
    return apart(found, value) if "period" in claim else not multiples(found, value)


RULES = {"action": of_action, "frequency": of_action}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    return ("shown", "") if rule(tables, witness) else ("not shown", "that something fails at the witness")
