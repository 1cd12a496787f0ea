"""What claims about averages over time ask for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations_with_replacement

from canon.checker.calculus import by_antiderivative, moves
from canon.checker.case import Case
from canon.checker.defined import is_upward, unseen
from canon.checker.followed import at_random, is_identity
from canon.checker.functions import Unknown, Unreadable
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.shapes import is_smooth
from canon.checker.statement import Statement

DEPTHS = (0, 1, 10, 1000)
"""How far below 0 a potential may lie."""


def _is_linear(s: Statement) -> bool:
    """Whether Hamilton's equations are linear in variables of which nothing is assumed: their solutions never end."""
    f, z = s.f, [*s.q, *s.p]
    if any(word != "real" for name in (*z, s.time) for word in s.words.get(name, [])):
        return False
    second = [f.slope(f.slope(s.H, x), y) for x, y in combinations_with_replacement(z, 2)]
    names = {f.ops[b][1] for a in second for b in f.reach(a) if f.ops[b][0] == "s"}
    return names.isdisjoint((*z, s.time))


def _goes_on(s: Statement) -> bool:
    """Whether no motion ends: the equations are linear, or H is Σ a p²/2 + V with a > 0 and V bounded from below."""
    if _is_linear(s):
        return True
    f, rest = s.f, s.H
    for p in s.p:
        curved = f.slope(f.slope(s.H, p), p)
        if any(moves(s, curved, name) for name in (*s.q, *s.p, s.time)) or not _is_positive(s, curved, strict=True):
            return False
        rest = f.sub(rest, f.mul(f.number("1/2"), curved, f.node("s", p), f.node("s", p)))
    V = f.substitute(s.H, dict.fromkeys(s.p, f.number(0)))
    if moves(s, V, s.time) or not is_identity(at_random(s), f.sub(rest, V)):
        return False
    return any(_is_positive(s, f.add(V, f.number(depth)), strict=False) for depth in DEPTHS)


def _is_positive(s: Statement, a: int, *, strict: bool) -> bool:
    return is_positive(s, a, strict=strict, real=True)


def _has_no_walls(s: Statement, formulas: Sequence[int], rate: Callable[[int], int]) -> bool:
    """Whether no motion leaves the domain: what it demands is conserved, and the formulas are smooth everywhere."""
    moving = [*s.q, *s.p, s.time]
    if any({*s.words.get(name, ())} - {"real"} for name in moving):
        return False
    walls = [rate(a) for a, _ in s.conditions if any(moves(s, a, name) for name in moving)]
    if walls and not all(is_identity(at_random(s), a) for a in walls):
        return False
    jumps = [a for a, _ in s.conditions if not all(is_smooth(s, a, name) for name in moving)]
    return not jumps and all(is_smooth(s, a, name) for a in (*formulas, *unseen(s)) for name in moving)


def average(s: Statement) -> Case:
    """The average of f over time: by a virial, whose rate has none; or along a motion, by an antiderivative."""
    f, claim = s.f, s.claim
    if s.direction != "none":
        raise Unknown("an average beside a map")
    value, equals = s.key("f"), s.key("equals")
    if "virial" in claim:
        G, bound = s.key("virial"), s.key("bound")

        def rate(a: int) -> int:
            return f.add(f.bracket(a, s.H, f.pairs), f.slope(a, s.time))

        mean = f.sub(value, rate(G))
        if s.verdict == "refuted":  # motions that leave the domain are none that the claim is about
            zeros = [rate(a) for a in (mean, bound, *(a for a, _ in s.conditions))]
            bounded = all(is_positive(s, a, strict=False, real=True) for a in (f.sub(bound, G), f.add(bound, G)))
            on = _is_linear(s) or (_goes_on(s) and _has_no_walls(s, [value, G, bound, equals, s.H], rate))
            against = "" if bounded else "that the virial is bounded as it says"
            against = against or ("" if on else "that some of its motions go on for ever")
            return Case([f.sub(mean, equals)], granted=zeros, against=against)
        zeros = [rate(mean), rate(bound), f.sub(mean, equals)]
        stays = _has_no_walls(s, [value, G, bound, equals, s.H], rate)
        trusted = "" if stays and _goes_on(s) else "that there are motions that stay in the domain, and go on for ever"
        return Case(zeros, positive=[(f.sub(bound, G), False), (f.add(bound, G), False)], trusted=trusted)
    if "coordinate" in claim:
        raise Unknown("an average over an orbit")
    u = str(claim["parameter"])
    if any(f.ops[b] == ("s", u) for b in f.reach(equals)):
        raise Unreadable("an average over a stretch doesn't depend on what runs through it")
    s.declared |= {u}
    moved = {name: f.read(text, s.names) for name, text in claim["motion"].items()}
    if not moved.keys() <= {*s.q, *s.p, s.time}:
        raise Unreadable("what moves along a motion are coordinates, momenta and time")
    there = [b for a in (*s.written, *unseen(s)) for b in f.at(a, moved)]
    stays = _stays(s, moved, s.written) and all(is_smooth(s, a, u) for a in there)
    clock = moved.get(s.time, f.node("s", s.time))
    s.written[:] = there  # its formulas have values along the motion, for all of the stretch
    ends = [f.read(claim[word], s.names) for word in ("from", "to")]
    still = {*s.q, *s.p} - moved.keys()
    if s._H is not None and still:
        raise Unreadable(f"the motion of {min(still)[:40]!r} is missing")
    for a, closed in ((value, still), *((a, {*s.q, *s.p, s.time} - {u}) for a in (equals, *ends, *moved.values()))):
        s.without(a, closed)
    pace = f.slope(clock, u)
    stretch = f.sub(f.substitute(clock, {u: ends[1]}), f.substitute(clock, {u: ends[0]}))
    case = by_antiderivative(s, f.mul(f.substitute(value, moved), pace), u, ends, f.mul(equals, stretch))
    if case is None:
        raise Unknown("an average without an antiderivative that is seen to be smooth")
    zeros = [*case.zeros]
    grows = is_positive(s, pace, strict=True, real=True)
    for q, p in zip(s.q, s.p, strict=True) if s._H is not None else ():
        for x, other, sign in ((q, p, 1), (p, q, -1)):
            slope = f.mul(f.number(sign), f.substitute(f.slope(s.H, other), moved), pace)
            zeros.append(f.sub(f.slope(moved[x], u), slope))
    smooth = all(is_smooth(s, a, u) for a in moved.values())
    against = "" if grows and is_upward(s, ends) else "that time grows along the motion"
    against = against or ("" if stays else "that the motion stays in the domain")
    if s.verdict == "refuted":  # what is no motion says nothing of an average
        return replace(case, granted=[*case.granted, *zeros[len(case.zeros) :]], against=against)
    trusted = "that the motion stays in the domain" if not stays else "" if smooth else "that the motion has no pole"
    trusted = trusted or ("" if is_upward(s, ends) else "that the stretch of time runs upwards")
    trusted = trusted or ("" if is_nowhere_zero(s, stretch) else "that the stretch of time isn't empty")
    return replace(case, zeros=zeros, nonzeros=[[stretch]], positive=[(pace, True)], trusted=trusted)


def _stays(s: Statement, moved: Mapping[str, int], written: Sequence[int]) -> bool:
    """Whether what is said of the variables, and what the formulas demand of them, holds all along a motion.

    A root, or a denominator, is asked of the parameter as a function of it is, whose value matters everywhere.
    """
    f = s.f
    for name, a in moved.items():
        for word in {*s.words.get(name, ())} - {"real"}:
            if word not in ("positive", "nonnegative") or not is_positive(s, a, strict=word == "positive", real=True):
                return False
    touched = [(a, kind) for a, kind in s.conditions if any(moves(s, a, name) for name in moved)]
    if any(kind != "positive" for _, kind in touched) or (touched and s.surface):
        return False
    along = [f.substitute(a, moved) for a, _ in touched]
    own = [f.substitute(a, moved) for a in (*written, *unseen(s), *([s.H] if s._H is not None else []))]
    u = str(s.claim["parameter"])
    return all(is_positive(s, a, strict=True, real=True) for a in along) and all(is_smooth(s, a, u) for a in own)


KINDS: dict[str, Callable[[Statement], Case]] = {"average": average}
