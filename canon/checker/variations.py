"""Extremals: Lagrange's equations along the path, and the second variation's sign.

It is ∫ (η' P η' + 2 η R η' + η Q η) dt, P = ∂²L/∂v², R = ∂²L/∂q∂v, Q = ∂²L/∂q² along the path. With P positive it is
positive where R is symmetric and S = Q − dR/dt nowhere negative; where solutions u of Jacobi's equations d/dt (P u' +
Rᵀ u) = R u' + Q u, as many as coordinates, are conjoined and independent between the ends; and it takes both signs
where one of them has two zeros there (Gelfand & Fomin, Calculus of Variations, §§ 25–29).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from typing import Any

from canon.checker.case import Case
from canon.checker.defined import keeps_inside, unseen
from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.formulas import ONE, ZERO
from canon.checker.functions import Unknown, Unreadable
from canon.checker.intervals import Intervals
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.ratios import multiple
from canon.checker.shapes import has_complex, is_smooth
from canon.checker.statement import Statement

Matrix = list[list[int]]
SIGNS = {"minimum": 1, "maximum": -1}
QUARTERS = range(-8, 8)
"""Right angles, between two of which the argument of a sine or a cosine may stay."""
WAVES, PIECES = 3, (32, 256)
"""Variations that are tried in a refutation, and into how many pieces their integrals are cut."""


def stationary(s: Statement) -> Case:
    """Lagrange's equations hold along the path; with an `extremum`, the second variation has that sign, or both."""
    f, t, v = s.f, s.time, list(s.claim["velocities"])
    texts, ends = s.claim["path"], [s.claim["from"], s.claim["to"]]
    path = [f.read(text, s.names) for text in (texts if isinstance(texts, list) else [texts])]
    s.written += path
    s.declared |= {*v, t}
    L = f.read(s.claim["L"], s.names)
    s.without(L, s.p)
    places = [None if str(end).strip("-") == "infinity" else f.read(end, s.names) for end in ends]
    for own, others in ((path, {*s.q, *s.p, *v}), ([x for x in places if x is not None], {*s.q, *s.p, *v, t})):
        for x in own:
            s.without(x, others)  # a path is a function of time alone, and its ends are numbers
    along = dict(zip((*s.q, *v), (*path, *(f.slope(x, t) for x in path)), strict=True))
    s.written += f.at(L, along)
    zeros = []
    for q, w in zip(s.q, v, strict=True):
        momentum = f.substitute(f.slope(L, w), along)
        zeros.append(f.sub(f.slope(momentum, t), f.substitute(f.slope(L, q), along)))
    hidden = [f.substitute(a, along) for a in unseen(s)]
    ends = [str(end) if x is None else x for end, x in zip(ends, places, strict=True)]
    asked = [*path, f.substitute(L, along), *hidden] if s.verdict == "refuted" else []  # else the claim isn't about it
    kept = keeps_inside(s, along, ends, asked)
    stays = "" if kept else "that the range runs upwards, and the path stays in the domain"
    smooth = all(is_smooth(s, a, t) for a in (*path, f.substitute(L, along), *f.at(L, along), *hidden))
    trusted = "" if smooth else "that the path, and L along it, are smooth between its ends"
    trusted = trusted or stays
    touched = _restricted(s, {*s.q, *v, t}, places[0])
    trusted = trusted or (f"that {touched[0]} stays along the path where it is said to be" if touched else "")
    if touched and s.verdict == "refuted":
        raise Unknown(f"a path along which {touched[0]} may not stay where it is said to be")
    word, written = s.claim.get("extremum"), s.conditions
    if s.verdict == "refuted":  # at a time between the ends
        s.conditions = Second(s, [], [], [], places).between
    if word is None:
        s.claim.unread -= {"field", "conjugate"} if s.verdict == "refuted" else set[str]()
        return Case(zeros, trusted=trusted, against=stays)
    if word not in (*SIGNS, "neither"):
        raise Unreadable(f"no kind of extremum: {str(word)[:40]!r}")
    if has_complex(s, L, *path):
        raise Unreadable("an extremum is one of real numbers")
    s.written += [end for end in places if end is not None]

    def second(first: Sequence[str], other: Sequence[str]) -> Matrix:
        return [[f.substitute(f.slope(f.slope(L, x), y), along) for y in other] for x in first]

    s.conditions, late = written, s.conditions
    found = Second(s, second(v, v), second(s.q, v), second(s.q, s.q), places)
    kinds, shown = found.kinds()
    if s.verdict == "proved":
        said = "" if word in kinds else "what is said of the second variation"
        return Case([*zeros, *(shown if word in kinds else [])], trusted=said or trusted)
    if kinds and word not in kinds:
        return Case(shown, found=False, against=stays)
    if word in SIGNS and None not in places:
        if not all(is_identity(at_random(s), a) for a in zeros):
            s.conditions = late  # Lagrange's equations may fail
            return Case(zeros, against=stays)
        return Case([], enclosed=found.against(SIGNS[word]), measured=_nothing, against=stays)
    raise Unknown("a second variation")


def _restricted(s: Statement, moving: set[str], low: int | None) -> list[str]:
    """Of what moves along a path the names of which something is said, be it that time is positive, as it begins."""
    f = s.f
    said = {f.ops[b][1] for a, _ in (*s.conditions, *((a, "") for a in s.surface)) for b in f.reach(a)} & moving
    late = low is not None and s.time not in said and is_positive(s, low, strict=False, real=True)
    for name in moving:
        words = {*s.words.get(name, ())} - {"real"}
        if words and not (late and name == s.time and words <= {"positive", "nonnegative"}):
            said.add(name)
    return sorted(said)


def _nothing(numbers: Any, of: Mapping[str, Any]) -> list[Any]:
    """A second variation is looked at in intervals alone."""
    return []


class Second:
    """The second variation between two ends (None: infinite ones)."""

    def __init__(self, s: Statement, P: Matrix, R: Matrix, Q: Matrix, ends: Sequence[int | None]) -> None:
        self.s, self.f, self.t, self.P, self.R, self.Q, self.ends = s, s.f, s.time, P, R, Q, ends
        f, t = self.f, self.f.node("s", s.time)
        walls = [f.sub(t, ends[0])] if ends[0] is not None else []
        walls += [f.sub(ends[1], t)] if ends[1] is not None else []
        self.between = [*s.conditions, *((wall, "positive") for wall in walls)]

    def kinds(self) -> tuple[set[str], list[int]]:
        """What the second variation is seen to be, and what must be 0 for it."""
        s, kept = self.s, self.s.conditions
        low, high = self.ends
        if low is not None and high is not None and not self._positive(self.f.sub(high, low), strict=True):
            return set(), []
        s.conditions = self.between
        try:
            for word, sign in SIGNS.items():
                P, R, Q = (self._times(sign, m) for m in (self.P, self.R, self.Q))
                if self._is_definite(P, strict=True):
                    return self._with_P(word, P, R, Q)
                if s.verdict == "refuted" and any(self._positive(P[i][i], strict=True) for i in range(len(P))):
                    other = "maximum" if word == "minimum" else "minimum"
                    return {word, "neither"} - {other}, []  # not the other one, by Legendre's condition
        finally:
            s.conditions = kept
        return set(), []

    def _is_smooth(self, *formulas: int) -> bool:
        """Whether formulas are smooth between the ends."""
        return all(is_smooth(self.s, a, self.t, anywhere=False) for a in formulas)

    def _with_P(self, word: str, P: Matrix, R: Matrix, Q: Matrix) -> tuple[set[str], list[int]]:
        f, t, n, claim = self.f, self.t, len(P), self.s.claim
        if not self._is_smooth(*(x for m in (P, R, Q) for row in m for x in row)):
            return set(), []
        values = at_random(self.s)
        even = all(is_identity(values, f.sub(R[i][j], R[j][i])) for i, j in combinations(range(n), 2))
        S = [[f.sub(Q[i][j], f.slope(R[i][j], t)) for j in range(n)] for i in range(n)]
        if "field" not in claim:
            return ({word}, []) if even and self._is_definite(S, strict=False) else (set(), [])
        fields, zeros, turned = self._fields(P, R, Q)
        if even and "conjugate" not in claim and self._is_definite(S, strict=False):
            return ({word}, [*zeros, *turned]) if fields else (set(), [])
        if not fields:
            return set(), []
        if "conjugate" in claim:
            return ({"neither"}, [*zeros, *self._two_zeros(fields)]) if len(fields) == 1 else (set(), [])
        frame = self.s.determinant(fields) if len(fields) == n else ZERO
        return ({word}, [*zeros, *turned]) if self._vanishes_nowhere(frame) else (set(), [])

    def _fields(self, P: Matrix, R: Matrix, Q: Matrix) -> tuple[list[list[int]], list[int], list[int]]:
        """The claim's fields (none if not seen smooth), what is 0 if they solve Jacobi's equations, if conjoined."""
        f, t, claim = self.f, self.t, self.s.claim
        rows = [claim["field"]] if isinstance(claim["field"], str) else claim["field"]
        fields = [[f.read(x, self.s.names) for x in ([row] if isinstance(row, str) else row)] for row in rows]
        if any(len(u) != len(P) for u in fields):
            raise Unreadable("a field has a component for each coordinate")
        for x in (x for u in fields for x in u):
            self.s.without(x, {*self.s.q, *self.s.p, *claim["velocities"]})
        if not self._is_smooth(*(x for u in fields for x in u)):  # |sin t| solves what sin t does, but at its zeros
            return [], [], []
        momenta, zeros = list[list[int]](), list[int]()
        for u in fields:
            slopes = [f.slope(x, t) for x in u]
            columns = [list(column) for column in zip(*R, strict=True)]
            momenta.append([f.add(self._dot(p, slopes), self._dot(r, u)) for p, r in zip(P, columns, strict=True)])
            push = [f.add(self._dot(r, slopes), self._dot(q, u)) for r, q in zip(R, Q, strict=True)]
            zeros += [f.sub(f.slope(m, t), x) for m, x in zip(momenta[-1], push, strict=True)]
        pairs = combinations(range(len(fields)), 2)
        turned = [f.sub(self._dot(fields[i], momenta[j]), self._dot(fields[j], momenta[i])) for i, j in pairs]
        return fields, zeros, turned

    def _two_zeros(self, fields: Sequence[Sequence[int]]) -> list[int]:
        """The field at two times between the ends, where it has a slope. Raises Unknown where that isn't seen."""
        f, claim, (u,) = self.f, self.s.claim, fields
        places = [self.ends[0], *(f.read(text, self.s.names) for text in claim["conjugate"]), self.ends[1]]
        if len(places) != 4 or not all(
            a is not None and b is not None and self._positive(f.sub(b, a), strict=True) for a, b in pairwise(places)
        ):
            raise Unknown("the order of conjugate points")
        at: list[int] = [place for place in places[1:3] if place is not None]
        steep = [self._plain(f.substitute(f.slope(x, self.t), {self.t: at[0]})) for x in u]
        if not any(is_nowhere_zero(self.s, x) for x in steep):
            raise Unknown("a field that may be 0")
        return [f.substitute(x, {self.t: place}) for x in u for place in at]

    def _plain(self, a: int) -> int:
        """A formula, with sines and cosines in it that are rational numbers written so."""
        f, values, new = self.f, at_random(self.s), dict[int, int]()
        for b in f.reach(a):
            new[b] = f.rebuilt(b, [new[x] for x in f.parts(b)])
            if f.ops[b][0] == "f" and f.ops[b][1] in ("sin", "cos"):
                try:
                    value = values.value(b)
                    number = multiple(value, values.one, values.t.prime) if value else 0
                except FAILURES:
                    continue
                new[b] = new[b] if number is None else f.number(number)
        return new[a]

    def _dot(self, x: Sequence[int], y: Sequence[int]) -> int:
        return self.f.add(*(self.f.mul(a, b) for a, b in zip(x, y, strict=True)))

    def _times(self, sign: int, m: Matrix) -> Matrix:
        return [[self.f.mul(self.f.number(sign), x) for x in row] for row in m]

    def _positive(self, a: int, *, strict: bool) -> bool:
        return is_positive(self.s, a, strict=strict, real=True)

    def _is_definite(self, m: Matrix, *, strict: bool) -> bool:
        """By its leading minors, or not strictly by all principal ones."""
        n, values = len(m), at_random(self.s)
        chosen = [tuple(range(k)) for k in range(1, n + 1)]
        if not strict:
            chosen = [c for k in range(1, n + 1) for c in combinations(range(n), k)]
        minors = [self.s.determinant([[m[i][j] for j in rows] for i in rows]) for rows in chosen]
        return all((not strict and is_identity(values, a)) or self._positive(a, strict=strict) for a in minors)

    def _vanishes_nowhere(self, a: int) -> bool:
        """Whether a function of time is seen to have no zero between the ends."""
        f, values, factors = self.f, at_random(self.s), [a]
        circles = [f.ops[b] for b in f.reach(a) if f.ops[b][0] == "f" and f.ops[b][1] == "cos"]
        for op in circles:  # c (1 - cos A)
            other = f.sub(ONE, f.node(*op))
            try:
                ratio = multiple(values.value(a), values.value(other), values.t.prime)
            except FAILURES:
                continue
            if ratio and self._stays(op[3][0], 0, 4):
                return True
        while factors:
            a = factors.pop()
            op = f.ops[a]
            if op[0] == "*" or (op[0] == "^" and op[2] > 0):
                factors += f.parts(a)
            elif op[0] == "f" and op[1] in ("sin", "cos"):
                start = 0 if op[1] == "sin" else -1
                if not any(self._stays(op[3][0], k, k + 2) for k in QUARTERS if (k - start) % 2 == 0):
                    return False
            elif not is_nowhere_zero(self.s, a):
                return False
        return True

    def _stays(self, angle: int, low: int, high: int) -> bool:
        """Whether an angle that is linear in time stays between so many right angles, inside of the ends."""
        f, t, turn = self.f, self.t, self.f.mul(self.f.number("1/2"), self.f.node("s", "pi"))
        slope = f.slope(angle, t)
        if None in self.ends or any(f.ops[b] == ("s", t) for b in f.reach(slope)):
            return False
        if not is_nowhere_zero(self.s, slope):
            return False
        at = [f.substitute(angle, {t: end}) for end in self.ends if end is not None]
        bounds = [f.mul(f.number(k), turn) for k in (low, high)]
        return all(
            self._positive(f.sub(x, bounds[0]), strict=False) and self._positive(f.sub(bounds[1], x), strict=False)
            for x in at
        )

    def against(self, sign: int) -> Callable[[Intervals, Mapping[str, Any]], Iterator[Any]]:
        """A wave between the ends whose second variation has the other sign, in intervals."""
        f, t = self.f, self.t
        a, b = (end if end is not None else ZERO for end in self.ends)
        phase = f.over(f.mul(f.node("s", "pi"), f.sub(f.node("s", t), a)), f.sub(b, a))
        forms = []
        for i, k in ((i, k) for k in range(1, WAVES + 1) for i in range(len(self.P))):
            wave = f.node("f", "sin", (), (f.mul(f.number(k), phase),))
            slope = f.slope(wave, t)
            mixed = f.mul(f.number(2), self.R[i][i], wave, slope)
            forms.append(f.add(f.mul(self.P[i][i], slope, slope), mixed, f.mul(self.Q[i][i], wave, wave)))

        def enclosed(own: Intervals, of: Mapping[str, Any]) -> Iterator[Any]:
            found = own.values(f, [a, b], of)
            low, length = found[a], found[b] - found[a]
            for n in PIECES:
                for form in forms:
                    total = own.iv.mpf(0)
                    for k in range(n):
                        at = low + length * own.iv.mpf([k, k + 1]) / n
                        total = total + own.values(f, [form], {**of, t: at})[form] * length / n
                    yield total if length.a > 0 and (total * sign).b < 0 else own.iv.mpf(0)

        return enclosed


KINDS: dict[str, Callable[[Statement], Case]] = {"stationary": stationary}
