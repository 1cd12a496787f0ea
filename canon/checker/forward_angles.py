"""Angles of a map that is given forward, in one degree of freedom: by the frequency of the orbit through each point.

Where the map is canonical and P is a function of H, the angle's rate dH/dP is a constant along an orbit. So it advances
by T once round its cycle where T dP/dH is the orbit's period.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from canon.checker.followed import at_random, is_identity
from canon.checker.intervals import Intervals, Open
from canon.checker.momentum import squared
from canon.checker.orbit_enclosures import enclosed_orbits
from canon.checker.orbits import Form
from canon.checker.periods import is_so
from canon.checker.statement import Statement


def _pace(s: Statement, period: int) -> int:
    """The frequency with which an angle has to advance by its period, P being a function of H: ∂H/∂p over T ∂P/∂p."""
    f, p = s.f, s.p[0]
    return f.over(f.slope(s.H, p), f.mul(period, f.slope(s.new[1], p)))


def _marked(s: Statement) -> dict[str, int]:
    """Other names for the coordinate and the momentum of a point, those of its orbit being variables."""
    names = {name: f"at {name}" for name in (*s.q, *s.p)}
    s.declared |= {*names.values()}
    return {name: s.f.node("s", other) for name, other in names.items()}


def advance(s: Statement, period: int) -> Callable[[Intervals, Mapping[str, Any]], Iterator[Any]]:
    """Intervals of the frequency of a point's orbit, less the one that its angle has."""
    f, (x,), (p,), at = s.f, s.q, s.p, _marked(s)
    level, claimed = (f.substitute(a, at) for a in (s.H, _pace(s, period)))
    form, whole = Form.of(s, s.H, x, p), f.mul(f.number(2), f.node("s", "pi"))
    turned = f.sub(f.substitute(s.H, {x: f.add(f.node("s", x), whole)}), s.H)

    def enclosed(own: Intervals, of: Mapping[str, Any]) -> Iterator[Any]:
        if not form.quadratic:
            raise Open
        here = {**of, **{f.ops[a][1]: of[name] for name, a in at.items()}}
        found = own.values(f, [level, claimed, whole], here)
        turns = [None, *([found[whole]] if is_identity(at_random(s), turned) else [])]
        for turn in turns:
            try:
                for several in enclosed_orbits(
                    s, form, own, here, level, found[level], of[x], turn, rate=True, bounded=False
                ):
                    pace = found[claimed] if found[claimed].a > 0 else -found[claimed]
                    values = [1 / value - pace for value in several]
                    yield next((value for value in values if 0 in value), values[0])
                return
            except Open:
                continue
        raise Open

    return enclosed


def unmeasured(numbers: Any, of: Mapping[str, Any]) -> list[Any]:
    """What is looked at in intervals alone."""
    return []


def advances(s: Statement, period: int) -> bool:
    """Whether the orbit through each point has the frequency that the angle has: the angle's rate is dH/dP, a constant.

    The point's coordinate and momentum get other names, as those of the orbit are variables. The domain bounds where
    the angle is looked at, and no orbit; so that the orbit closes isn't taken for granted.
    """
    f, (x,), (p,) = s.f, s.q, s.p
    at = _marked(s)
    level, equals = (f.substitute(a, at) for a in (s.H, _pace(s, period)))
    kept = s.conditions, s.words, s.names
    try:
        s.conditions = [(f.substitute(a, at), kind) for a, kind in s.conditions]
        s.words = {
            **s.words,
            **{f.ops[a][1]: s.words.get(name, ()) for name, a in at.items()},
            x: ["real"],
            p: ["real"],
        }
        s.names = {name: f.substitute(a, at) for name, a in s.names.items()}
        square = squared(s, Form.of(s, s.H, x, p), s.H, level)
        whole = f.mul(f.number(2), f.node("s", "pi"))
        return square is not None and any(
            is_so(s, x, square, equals, turn, rate=True, exists=False) for turn in (None, whole)
        )
    finally:
        s.conditions, s.words, s.names = kept
