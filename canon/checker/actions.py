"""What claims about actions, frequencies and angles ask for: integrals round an orbit, measured at points.

Where a Hamiltonian is quadratic in the momentum, a p² + b p + c = E, the momentum is −b/2a ± √D/2a with
D = b² − 4 a (c − E); where it is only even in p, the momentum is what H = E is solved by. The orbit runs between two
ends, at which D, or E − H(q, 0), changes its sign, or at a separatrix touches 0; its action is the integral of the
momentum's two branches, or of that with p > 0 over a period of the coordinate. What is measured is evidence, never a
proof; where two ways of measuring it don't agree, nothing is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from canon.checker.case import Case
from canon.checker.closed_actions import closed, constant
from canon.checker.defined import has_values, is_everywhere, is_unbound, unseen
from canon.checker.followed import at_random, is_identity
from canon.checker.formulas import ONE, ZERO
from canon.checker.forward_angles import advance, advances, unmeasured
from canon.checker.functions import Unknown, Unreadable
from canon.checker.intervals import Intervals, Open
from canon.checker.momentum import squared
from canon.checker.orbit_enclosures import enclosed_orbits
from canon.checker.orbits import Ends, Form, Momenta, Orbit
from canon.checker.periods import is_so
from canon.checker.points import Numbers, Outside
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.power_wells import is_action, well_action
from canon.checker.separatrices import separatrix
from canon.checker.shapes import has_complex, is_smooth
from canon.checker.statement import Statement

DIGITS = 12
"""To so many digits an integral has to agree."""
TURNS = (2, 3)
"""What an angle may turn instead of once, in a refutation."""
PRECISE, SOLVED = (32, 44), (20, 26)
"""Digits in which an orbit is measured, and again where it isn't as claimed: fewer where the momentum is solved for."""


def action(s: Statement) -> Case:
    """J = ∮ p dq, or ν = dE/dJ, is `equals`."""
    f, claim = s.f, s.claim
    x, E = str(claim["coordinate"]), str(claim["energy"])
    p = s.p[s.q.index(x)]
    if s.direction in ("implicit", "backward"):
        s.without_map()  # the domain's conditions are those on the coordinate, not on what it is given by
    if not E.isidentifier() or ("period" in claim and claim.get("branch") != "rotation"):
        raise Unreadable("an energy is a name, and a period is one of a rotation's coordinate")
    fixed = {name: f.read(text, s.names) for name, text in claim.get("fixed", {}).items()}
    if not all(_as_assumed(s, name, a) for name, a in fixed.items()):
        raise Unreadable("what is fixed has values that its name's assumptions exclude, or may exclude")
    s.declared |= {E}
    s.without(s.H, [E])
    H = f.substitute(s.H, {n: v for n, v in fixed.items() if n != E})
    s.written += f.at(s.H, fixed)
    if claim["kind"] == "frequency" and any(f.ops[b] == ("s", E) for a in fixed.values() for b in f.reach(a)):
        raise Unreadable(f"what is held fixed doesn't change with {E}")
    level, claimed = fixed.get(E, f.node("s", E)), s.key("equals")
    asked = [f.read(claim[word], s.names) for word in ("period", "well") if word in claim]
    s.written += [level, *fixed.values(), *asked]
    if claim["kind"] == "frequency" and "period" in claim and any(f.ops[b] == ("s", E) for b in f.reach(asked[0])):
        raise Unreadable(f"a period doesn't change with {E}")
    equals, *given = (f.substitute(a, fixed) for a in (claimed, *asked))  # what is held fixed is so everywhere
    s.written += [b for a in (claimed, *asked) for b in f.at(a, fixed)]
    period = given[0] if "period" in claim else f.read("2*pi", s.names)
    if has_complex(s, H) or any(f.ops[b] == ("s", s.time) for b in f.reach(H)):
        raise Unreadable("an action is one of a real Hamiltonian without time")
    s.without(H, {*s.q} - {x})  # else the coordinate alone has no action
    for a in (equals, *given):
        s.without(a, (x, p, s.time))  # an action is a function of energy and constants
    inside = is_everywhere(s, (x, p))
    free = inside and all(has_values(s, name, [H]) for name in (x, p))
    form = Form.of(s, H, x, p)
    rate, rotates = claim["kind"] == "frequency", claim.get("branch") == "rotation"
    if rotates and not form.quadratic:
        raise Unknown("a rotation with a Hamiltonian that isn't quadratic in the momentum")
    if rotates and "period" not in claim and not any(f.ops[b] == ("s", x) for b in f.reach(H)):
        raise Unreadable(f"H doesn't depend on {x}: a rotation needs a period")
    ahead = f.sub(f.substitute(H, {x: f.add(f.node("s", x), period)}), H) if rotates else ZERO
    if s.verdict == "refuted" and not is_identity(at_random(s), ahead):
        raise Unknown("a rotation over what isn't seen to be a period of H")

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        found = numbers.values(f, [level, equals, period, *given], of)
        well = found[given[-1]] if "well" in claim else None
        values = []
        for digits, fine in zip(PRECISE if form.quadratic else SOLVED, (1, 3), strict=True):
            momenta = Momenta(form, Numbers(digits), {**of}, found[level])
            orbit = Orbit(momenta, rate, DIGITS)
            values.append(orbit.turn(found[period]) if rotates else Ends(s, momenta, fine, orbit).measure(well))
            if abs(found[equals] / values[-1] - 1) <= numbers.mp.mpf(10) ** -DIGITS:
                return [numbers.mp.mpf(0)]
        if abs(values[0] / values[1] - 1) > numbers.mp.mpf(10) ** -DIGITS:
            raise Outside
        return [found[equals] / values[-1] - 1]

    def enclosed(own: Intervals, of: Mapping[str, Any]) -> Iterator[Any]:
        """Intervals that hold the action, or the frequency, less what is claimed, of an orbit that may be meant."""
        said = {*s.words.get(p, ())} - {"real"}
        if said or any(f.ops[b] == ("s", p) for a, _ in s.conditions for b in f.reach(a)):
            raise Open  # what is said of the momentum may cut the orbit
        found = own.values(f, [level, equals, period, *given], of)
        if rotates and not found[period].a > 0:
            raise Open
        well = found[given[-1]] if "well" in claim else None
        turn = found[period] if rotates else None
        for several in enclosed_orbits(s, form, own, of, level, found[level], well, turn, rate=rate, square=solved):
            values = [(1 / value if rate else value) - found[equals] for value in several]
            yield next((value for value in values if 0 in value), values[0])

    if s.verdict == "proved" and form.quadratic and "well" not in claim and free:
        g, signs = form.integrand(level, rate=rate, rotates=rotates)
        known = constant(s, g, [a for a, _ in signs], period) if rotates else None
        zeros, there = (None if rotates else closed(s, g, equals, rate=rate)) or (None, [])
        if known is not None:
            zeros = [f.sub(f.mul(equals, known), ONE) if rate else f.sub(known, equals)]
        if zeros is not None:
            return Case(zeros, somewhere=there)
    square = squared(s, form, H, level) if free else None
    if square is not None and not rate:
        turn, well = period if rotates else None, given[-1] if "well" in claim else None
        known = separatrix(s, x, square, turn, well)
        if known is not None:
            case = Case([f.sub(known, equals)])
            return replace(case, measured=measured, digits=DIGITS, found=True) if s.verdict == "proved" else case
    if s.verdict == "refuted" and inside and not (rate or rotates or "well" in claim or s.surface):
        if (power := well_action(s, form, level)) is not None:
            return Case([f.sub(power[0], equals)])
    solved = None if form.quadratic else square
    seen = free and (form.quadratic or square is not None)
    case = Case([], measured=measured, digits=DIGITS, enclosed=enclosed if seen else None)
    stated = s.verdict == "proved" and "well" not in claim and not s.surface and inside
    if stated and free and square is not None and is_so(s, x, square, equals, period if rotates else None, rate=rate):
        case.found = True
    if stated and not rate and not rotates and is_action(s, form, level, equals):
        case.found = True
    return case


def _as_assumed(s: Statement, name: str, a: int) -> bool:
    """Whether the value at which a name is fixed is seen to be as the name is assumed to be."""
    value, minus = s.f.value(a), s.f.mul(s.f.number(-1), a)
    for word in {*s.words.get(name, ())} - {"real"}:
        if word == "integer":
            holds = value is not None and value.denominator == 1
        elif word == "nonzero":
            holds = is_nowhere_zero(s, a)
        elif word in ("positive", "nonnegative", "negative"):
            holds = is_positive(s, minus if word == "negative" else a, strict=word != "nonnegative", real=True)
        else:
            holds = False
        if not holds:
            return False
    return True


def action_angle(s: Statement) -> Case:
    """Canonical, and K depends on the new momenta alone; each angle's period brings the old variables back."""
    f = s.f
    zeros, _ = s.brackets(f.number(1))
    for a in (s.H, *s.images.values()):
        s.without(a, [s.time])
    period = f.read(s.claim.get("angle_period", "1"), s.names)
    s.written.append(period)
    once = "that each angle advances by its period once round its cycle"
    if s.direction == "forward":
        free = is_unbound(s, (*s.q, *s.p)) and all(has_values(s, name, [s.H]) for name in (*s.q, *s.p))
        if s.verdict == "refuted" and (len(s.q) > 1 or not free):
            raise Unknown("a refutation of several angles of a map that is given forward, or of orbits with bounds")
        if s.verdict == "refuted":
            return Case([], measured=unmeasured, enclosed=advance(s, period))
        shown = len(s.q) == 1 and not s.surface and free and advances(s, period)
        momenta = s.new[len(s.q) :]
        return Case([*zeros, *(f.bracket(P, s.H, s.f.pairs) for P in momenta)], trusted="" if shown else once)
    if s.direction != "backward":
        raise Unknown("angles of a map that is given by a generating function")
    K = s.pull(s.H)
    zeros += [f.slope(K, angle) for angle in s.Q]
    if s.verdict == "refuted":
        return _not_closed(s, zeros, period)
    values, shown = at_random(s), _is_whole(s, K)
    for k, angle in enumerate(s.Q):
        kinds = list[bool]()
        for name, change in zip((*s.q, *s.p), _changes(s, angle, period), strict=True):
            kinds.append(name in s.p or is_identity(values, change))
            if kinds[-1]:
                zeros.append(change)
                continue
            turn = f.mul(f.number(4), f.power(f.node("s", "pi"), f.number(2)))  # a full turn, of which H knows nothing
            moved = f.substitute(s.H, {name: f.add(f.node("s", name), change)})
            zeros += [f.sub(f.mul(change, change), turn), s.pull(f.sub(moved, s.H))]
        rotates = all(kind == (i != k) for i, kind in enumerate(kinds))
        shown = shown and _apart(s, k) and (rotates or (all(kinds) and _swings(s, k, period)))
    return Case(zeros, trusted="" if shown else once)


def _is_whole(s: Statement, K: int) -> bool:
    """Whether all of each angle's cycle is seen to lie where H and the map are smooth, with no bounds on angles."""
    f, angles = s.f, {*s.Q}
    bound = any(f.ops[b][0] == "s" and f.ops[b][1] in angles for a, _ in s.conditions for b in f.reach(a))
    for name, a in zip((*s.q, *s.p), s.old, strict=True):
        for word in {*s.words.get(name, ())} - {"real"}:  # what is said of the old variables cuts the cycle, too
            strict = word == "positive"
            bound = bound or word not in ("positive", "nonnegative") or not is_positive(s, a, strict=strict, real=True)
    return not bound and all(is_smooth(s, a, angle) for a in (K, *s.old, *unseen(s)) for angle in s.Q)


def _changes(s: Statement, angle: str, period: int) -> list[int]:
    """What the old variables change by where an angle advances by a period."""
    f = s.f
    ahead = {angle: f.add(f.node("s", angle), period)}
    return [f.sub(f.substitute(x, ahead), x) for x in s.old]


def _apart(s: Statement, k: int) -> bool:
    """Whether no other angle moves the k-th coordinate and its momentum: each of the angles has a cycle of its own."""
    f, n = s.f, len(s.q)
    return all(f.slope(s.old[i], angle) == ZERO for j, angle in enumerate(s.Q) if j != k for i in (k, k + n))


def _swings(s: Statement, k: int, period: int) -> bool:
    """Whether p = g cos(2π w/period + b), g being 0 nowhere: then no part of the period brings p back.

    Its zeros are half a period apart, across which it changes its sign.
    """
    f, values, factors, cosines = s.f, at_random(s), [s.old[k + len(s.q)]], 0
    while factors:
        a = factors.pop()
        op = f.ops[a]
        if op[0] == "*":
            factors += f.parts(a)
        elif op[:2] == ("f", "cos"):
            once = f.sub(f.mul(f.slope(op[3][0], s.Q[k]), period), f.mul(f.number(2), f.node("s", "pi")))
            cosines += is_identity(values, once)
            if not is_identity(values, once):
                return False
        elif not is_nowhere_zero(s, a):
            return False
    return cosines == 1


def _not_closed(s: Statement, zeros: list[int], period: int) -> Case:
    """Against the claim speaks what doesn't come back, by no number of turns; or what is back after a part of it."""
    f, values = s.f, at_random(s)
    for n in TURNS if len(s.q) == 1 else ():
        part = _changes(s, s.Q[0], f.mul(f.number(Fraction(1, n)), period))
        if all(is_identity(values, x) for x in part):
            return Case(part, found=False)
    for angle in s.Q:
        for change in _changes(s, angle, period):
            half = f.mul(f.number(Fraction(1, 2)), change)  # whole turns may be none, of what H is periodic in
            zeros.append(f.node("f", "sin", (), (half,)) if half != ZERO else half)
    return Case(zeros)


KINDS: dict[str, Callable[[Statement], Case]] = {
    "action": action,
    "frequency": action,
    "action_angle": action_angle,
}
