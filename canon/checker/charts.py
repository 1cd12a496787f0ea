"""Functions x of a coordinate q in which a momentum's square is rational, with (dx/dq)² and the range of both."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from canon.checker.formulas import ONE, ZERO
from canon.checker.functions import Unreadable
from canon.checker.positive import is_positive
from canon.checker.rational import NoForm, Rational, X
from canon.checker.statement import Statement

Rule = Callable[[int], int | None]


class Chart(NamedTuple):
    """x of q: `pace` is (dx/dq)², as a formula of x, and x lies between `low` and `high` (None: without an end).

    It is one to one on the `half` of the coordinate's range, between two places; at the ends `mirrors` of x the motion
    goes on to the other side, where x comes back, as long as the `whole` range is there.
    """

    rule: Rule
    pace: int
    low: int | None = None
    high: int | None = None
    mirrors: Sequence[int] = ()
    half: tuple[int | None, int | None] = (None, None)
    whole: tuple[int | None, int | None] = (None, None)
    period: int | None = None

    def moved(self, s: Statement, target: int, q: str) -> int:
        """A formula with x in place of q. Raises NoForm where q is left."""
        f, new = s.f, dict[int, int]()
        for a in f.reach(target):
            image = self.rule(a)
            new[a] = f.rebuilt(a, [new[b] for b in f.parts(a)]) if image is None else image
        if any(f.ops[b] == ("s", q) for b in f.reach(new[target])):
            raise NoForm
        return new[target]


def charts(s: Statement, r: Rational, q: str, targets: Sequence[int]) -> Iterator[Chart]:
    """Those that formulas suggest."""
    f, x, t = s.f, s.f.node("s", X), s.f.node("s", q)
    one = {*s.words.get(q, ())} & {"positive", "nonnegative"}
    yield Chart(lambda a: x if a == t else None, ONE, low=ZERO if one else None, half=(ZERO if one else None, None))
    square = _powers(s, lambda a: f.ops[a] == ("s", q), x)
    yield Chart(square, f.mul(f.number(4), x), low=ZERO, mirrors=(ZERO,), half=(ZERO, None))
    angles = set[int]()
    for a in f.reach(*targets):
        op = f.ops[a]
        if op[:2] == ("f", "power") and f.value(op[3][1]) == f.value(f.read("1/2", {})):
            yield from _rooted(s, r, q, a)
        if op[0] == "f" and op[1] in ("sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "coth"):
            angles |= {*op[3]} if t in f.reach(*op[3]) else set[int]()
    if len(angles) == 1:
        yield from _circular(s, r, q, *angles)


def _powers(s: Statement, is_base: Callable[[int], bool], image: int) -> Rule:
    """Even powers of a node, by its square."""
    f = s.f

    def rule(a: int) -> int | None:
        op = f.ops[a]
        even = op[0] == "^" and op[2] % 2 == 0 and is_base(op[1])
        return f.power(image, f.number(op[2] // 2)) if even else None

    return rule


def _any(*rules: Rule) -> Rule:
    return lambda a: next((image for rule in rules if (image := rule(a)) is not None), None)


def _rooted(s: Statement, r: Rational, q: str, a: int) -> Iterator[Chart]:
    """x = √(b² + q²), for positive q and b."""
    f, x = s.f, s.f.node("s", X)
    try:
        base = f.substitute(f.ops[a][3][0], {q: ZERO})
    except Unreadable:  # a pole
        return
    b = f.ops[base][1] if f.ops[base][0] == "^" and f.ops[base][2] == 2 else None
    rest = f.sub(f.sub(f.ops[a][3][0], base), f.power(f.node("s", q), f.number(2)))
    if b is None or not r.is_zero(rest) or not is_positive(s, b, strict=True, real=True):
        return
    image = f.mul(f.sub(x, b), f.add(x, b))
    square = _powers(s, lambda c: f.ops[c] == ("s", q), image)
    whole = (f.mul(image, f.power(x, f.number(-2))), b)
    yield Chart(_any(lambda c: x if c == a else None, square), *whole, mirrors=(b,), half=(ZERO, None))


def _circular(s: Statement, r: Rational, q: str, angle: int) -> Iterator[Chart]:
    """cos αq, sin² αq and sinh² αq, for a positive α."""
    f, x = s.f, s.f.node("s", X)
    rate = f.slope(angle, q)
    constant = all(f.ops[b] != ("s", q) for b in f.reach(rate)) and r.is_zero(f.substitute(angle, {q: ZERO}))
    if not constant or not is_positive(s, rate, strict=True, real=True):
        return
    turn, left, right = f.over(f.node("s", "pi"), rate), f.add(ONE, x), f.sub(ONE, x)

    def half(n: int) -> tuple[int, int]:
        return ZERO, f.mul(turn, f.number(f"1/{n}"))

    def rules(square: int, other: int, names: Sequence[str]) -> Rule:
        ratio = f.over(square, other)
        images = zip(names, (square, other, ratio, f.over(other, square)), strict=True)
        return _any(*(_powers(s, lambda a, name=name: a == f.node("f", name, (), (angle,)), y) for name, y in images))

    squared, circle, hyperbola = f.mul(rate, rate), ("sin", "cos", "tan", "cot"), ("sinh", "cosh", "tanh", "coth")
    plain, both = f.node("f", "cos", (), (angle,)), f.mul(left, right)
    cosine = _any(lambda a: x if a == plain else None, rules(both, f.mul(x, x), circle))
    ends, opposite = (f.number(-1), ONE), f.mul(f.number(-1), turn)
    yield Chart(cosine, f.mul(squared, both), *ends, ends, half(1), (opposite, turn), f.mul(f.number(2), turn))
    four, quarter = f.mul(f.number(4), squared), f.mul(turn, f.number("1/2"))
    whole = (f.mul(f.number(-1), quarter), quarter)
    yield Chart(rules(x, right, circle), f.mul(four, x, right), ZERO, ONE, (ZERO,), half(2), whole)
    yield Chart(rules(x, left, hyperbola), f.mul(four, x, left), low=ZERO, mirrors=(ZERO,), half=(ZERO, None))


def is_inside(s: Statement, r: Rational, q: str, low: int | None, high: int | None) -> bool:
    """Whether the domain says nothing of the coordinate that doesn't hold between two places anyway."""
    f = s.f
    own = [a for a, _ in s.conditions if any(f.ops[b] == ("s", q) for b in f.reach(a))]
    words = {*s.words.get(q, ())} - {"real"}
    if any(kind == "nonzero" for a, kind in s.conditions if a in own) or not words <= {"positive", "nonnegative"}:
        return False
    own += [f.node("s", q)] if words else []
    for a in own:
        slope = f.slope(a, q)
        if any(f.ops[b] == ("s", q) for b in f.reach(slope)):
            return False
        for end, sign in ((low, -1), (high, 1)):
            value = f.mul(f.number(sign), slope) if end is None else f.substitute(a, {q: end})
            if not r.is_zero(value) and not is_positive(s, value, strict=False, real=True):
                return False
    return True
