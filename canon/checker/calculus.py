"""What claims about integrals and limits ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from canon.checker.case import Case
from canon.checker.defined import is_there, is_upward
from canon.checker.expansions import Series
from canon.checker.functions import Unknown, Unreadable
from canon.checker.intervals import Intervals
from canon.checker.points import Numbers, Outside
from canon.checker.positive import is_positive
from canon.checker.shapes import has_complex, is_smooth
from canon.checker.statement import Statement
from canon.checker.tendency import fades, is_near, towards

PRECISE, DIGITS = 32, 10
PIECES = (16, 128, 1024)
"""Into so many pieces an interval is cut."""
STEPS = (40, 60, 80)
"""Of a limit, so far towards it: at distances 2^-k, or at 2^k."""


def _end(s: Statement, word: str, x: str) -> int | str:
    """An end of an interval, or a limit: a formula without the name that moves, or "infinity" with its sign."""
    text = s.claim[word]
    if text in ("infinity", "-infinity"):
        if "infinity" in {x, *s.declared, *s.names}:
            raise Unreadable("'infinity' is a name of the file")
        return str(text)
    found = s.f.read(text, s.names)
    if moves(s, found, x):
        raise Unreadable(f"{x} moves: {str(text)[:40]!r} is nothing that it moves to")
    if word != "equals" and has_complex(s, found):
        raise Unreadable(f"{str(text)[:40]!r} is complex: a range is one of real numbers")
    return found


def moves(s: Statement, a: int, x: str) -> bool:
    """Whether a name is in a formula."""
    return any(s.f.ops[b] == ("s", x) for b in s.f.reach(a))


def _check_image(s: Statement, x: str, *written: int) -> None:
    """Refuse what the map bounds by its image: old variables that it gives by others. Raises Unknown."""
    if s.direction in ("backward", "implicit") and any(moves(s, a, n) for a in written for n in {*s.q, *s.p} - {x}):
        raise Unknown("old variables that the map gives by others, held fixed")


def _is_free(s: Statement, x: str) -> bool:
    """Whether nothing is said of a name but that it is real: else what is 0 there may not be 0 along its range."""
    return not ({*s.words.get(x, ())} - {"real"} or s.surface or any(moves(s, a, x) for a, _ in s.conditions))


def by_antiderivative(s: Statement, inside: int, x: str, ends: Sequence[int | str], total: int) -> Case | None:
    """F' = f, and F between the ends is the total, where the claim or the certificate states an F that is smooth.

    Against the claim speaks an F that is an antiderivative, and another total. An F that is smooth between the ends
    alone counts by its limits there.
    """
    f, text = s.f, s.claim.get("antiderivative", s.known.get("antiderivative"))
    if text is None:
        return None
    F = f.apart(text, s.names)
    finite = [end for end in ends if isinstance(end, int)]
    if len(finite) == 2 and _is_free(s, x) and is_smooth(s, F, x):
        low, high = (f.substitute(F, {x: end}) for end in finite)
    else:
        kept = s.conditions, s.words
        limits = _limits(s, F, x, ends)
        if limits is None or s.verdict == "refuted":  # of a proof the rest is looked at between the ends alone
            s.conditions, s.words = kept
        if limits is None:
            return None
        low, high = limits
    slope, whole = f.sub(f.slope(F, x), inside), f.sub(f.sub(high, low), total)
    if s.verdict == "refuted":
        return Case([whole], granted=[slope])
    s.added.append(F)
    return Case([slope, whole])


def _limits(s: Statement, F: int, x: str, ends: Sequence[int | str]) -> tuple[int, int] | None:
    """What F tends to at the ends, if it is smooth between; the domain must say no more of x than that it is there."""
    f, t = s.f, s.f.node("s", x)
    if any(moves(s, a, x) for a, _ in s.conditions) or s.surface or has_complex(s):
        return None
    low, high = ends
    words = {*s.words.get(x, ())} - {"real"}
    if not isinstance(low, int) or high == "-infinity" or not words <= {"positive", "nonnegative"}:
        return None
    walls = [f.sub(t, low), *([f.sub(high, t)] if isinstance(high, int) else [])]
    ordered = not isinstance(high, int) or is_positive(s, f.sub(high, low), strict=True, real=True)
    above = is_positive(s, low, strict=False, real=True)
    if not ordered or (words and not above):
        return None
    s.conditions = [*s.conditions, *((wall, "positive") for wall in walls)]
    s.words = {**s.words, x: ["positive" if above else "real"]}
    if not is_smooth(s, F, x, anywhere=False):
        return None
    found = list[int]()
    for end, side in ((low, 1), (high, -1)):
        if end == "infinity" and fades(s, F, x):
            found.append(f.number(0))
            continue
        series = towards(s, F, x, end, side)
        if series is None or series.low < 0 or series.end < 1:
            return None
        found.append(series.terms[0] if series.low == 0 else f.number(0))
    return found[0], found[1]


def by_gauss(s: Statement, inside: int, x: str, ends: Sequence[int | str], total: int) -> Case | None:
    """∫ A exp(u) cos(v) over all x, u quadratic and v linear in x, or sin(v), or neither: Gauss's integral.

    With u = u(0) + b x − κ x²/2 and v = v(0) + w x it is A √(2π/κ) exp(u(0) + (b² − w²)/2κ) cos(v(0) + b w/κ).
    """
    f, nothing, factors = s.f, {x: s.f.number(0)}, [inside]
    outer, waves, exponents = [f.number(1)], list[tuple[str, int]](), list[int]()
    while factors and list(ends) == ["-infinity", "infinity"] and _is_free(s, x):
        a = factors.pop()
        op = f.ops[a]
        if all(f.ops[b] != ("s", x) for b in f.reach(a)):
            outer.append(a)
        elif op[0] == "*":
            factors += f.parts(a)
        elif op[:2] == ("f", "exp"):
            exponents.append(op[3][0])
        elif op[0] == "f" and op[1] in ("sin", "cos"):
            waves.append((op[1], op[3][0]))
        else:
            return None
    (name, v), u = waves[0] if waves else ("cos", f.number(0)), f.add(*exponents)
    b, w = (f.slope(a, x) for a in (u, v))
    kappa = f.mul(f.number(-1), f.slope(b, x))
    moving = any(f.ops[c] == ("s", x) for a in (kappa, w) for c in f.reach(a))
    if not exponents or len(waves) > 1 or moving or not is_positive(s, kappa, strict=True, real=True):
        return None
    u, b, v = (f.substitute(a, nothing) for a in (u, b, v))
    turned = f.node("f", name, (), (f.add(v, f.over(f.mul(b, w), kappa)),))
    half = f.over(f.sub(f.mul(b, b), f.mul(w, w)), f.mul(f.number(2), kappa))
    root = f.power(f.over(f.mul(f.number(2), f.node("s", "pi")), kappa), f.read("1/2", {}))
    value = f.mul(*outer, root, f.node("f", "exp", (), (f.add(u, half),)), turned)
    return Case([f.sub(value, total)])


def integral(s: Statement) -> Case:
    """∫ f over the variable between the ends is `equals`: by an antiderivative, where one is stated; or measured."""
    f, claim, x = s.f, s.claim, str(s.claim["variable"])
    s.declared |= {x}
    inside, equals = f.read(claim["f"], s.names), s.key("equals")
    ends = [_end(s, word, x) for word in ("from", "to")]
    if moves(s, equals, x):
        raise Unreadable(f"{x} is the variable of integration: the integral doesn't depend on it")
    s.written += [end for end in ends if isinstance(end, int)]
    _check_image(s, x, inside, equals, *(end for end in ends if isinstance(end, int)))

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        own = Numbers(PRECISE, real=numbers.real)
        found = own.values(f, [equals, *(end for end in ends if isinstance(end, int))], of)
        a, b = (found[e] if isinstance(e, int) else own.mp.inf * (1 if e == "infinity" else -1) for e in ends)
        point = {**of}

        def value(q: Any) -> Any:
            point[x] = q
            try:
                return own.values(f, [inside], point)[inside]
            except Outside:  # an end, or beyond what can be told from it
                return own.mp.mpf(0)

        total, error = own.mp.quad(value, _pieces(own, a, b), error=True, maxdegree=7)
        size = abs(found[equals])
        if not error < max(size, own.mp.mpf(10) ** -6) * own.mp.mpf(10) ** (-DIGITS - 1):
            raise Outside
        return [(total - found[equals]) / size if size > 10.0**-6 else total - found[equals]]

    def enclosed(own: Intervals, of: Mapping[str, Any]) -> Iterator[Any]:
        """Intervals that hold ∫ f - equals: sums of f over pieces of the interval, ever finer ones."""
        found = own.values(f, [equals, *bounded], of)
        a, b = (found[end] for end in bounded)
        for n in PIECES:
            pieces = (a + (b - a) * own.iv.mpf([k, k + 1]) / n for k in range(n))
            total = sum((own.values(f, [inside], {**of, x: at})[inside] for at in pieces), own.iv.mpf(0))
            yield total * (b - a) / n - found[equals]

    bounded = [end for end in ends if isinstance(end, int)]
    there = is_there(s, x, ends, [inside]) and is_upward(s, ends)
    case = by_antiderivative(s, inside, x, ends, equals) or by_gauss(s, inside, x, ends, equals)
    if case is None:
        case = Case([], measured=measured, digits=DIGITS)
        case.enclosed = enclosed if len(bounded) == 2 and there else None
        return replace(case, mentions=[inside])
    doubt = "" if there else "that the range runs upwards, and all formulas have values all over it"
    return replace(case, mentions=[inside], trusted=doubt, against=doubt)


def _pieces(numbers: Numbers, a: Any, b: Any) -> list[Any]:
    mp = numbers.mp
    if mp.isfinite(a) and mp.isfinite(b):
        return [a, (a + b) / 2, b]
    if mp.isfinite(a):
        return [a, a + 1, b]
    return [a, b - 1, b] if mp.isfinite(b) else [a, -1, 1, b]


def by_expansion(s: Statement, found: Sequence[Series | None], equals: int | str) -> Case | None:
    """No pole, and the constant is the limit; or a pole whose first coefficient has the sign of the infinity."""
    f, case = s.f, Case([])
    for series in found:
        if series is None:
            return None
        poles, rest = series.terms[: max(-series.low, 0)], series.terms[max(-series.low, 0) :]
        if isinstance(equals, int):
            if not rest:
                return None
            constant = rest[0] if series.low <= 0 else f.number(0)
            case.zeros += [*(c for c in poles if f.value(c) != 0), f.sub(constant, equals)]
        elif not poles or s.verdict == "refuted":
            return None
        else:
            sign = f.number(1 if equals == "infinity" else -1)
            case.positive.append((f.mul(sign, poles[0]), True))
    return case


def limit(s: Statement) -> Case:
    """f tends to `equals`: by its expansion, or measured at points that come nearer and nearer."""
    f, claim, x = s.f, s.claim, str(s.claim["variable"])
    s.declared |= {x}
    inside, to, equals = f.read(claim["f"], s.names), _end(s, "to", x), _end(s, "equals", x)
    s.written += [end for end in (to, equals) if isinstance(end, int)]
    _check_image(s, x, inside, *(end for end in (to, equals) if isinstance(end, int)))
    if "side" in claim and not isinstance(to, int):
        raise Unreadable("an infinity is reached from one side only")
    sides = {"+": [1], "-": [-1]}.get(str(claim.get("side")), [1, -1] if isinstance(to, int) else [1])
    shown = by_expansion(s, [towards(s, inside, x, to, side) for side in sides], equals)
    if shown is not None:
        doubt = "" if is_near(s, x, to, sides) else f"that {x} may come there, in the domain"
        return replace(shown, mentions=[inside], trusted=doubt, against=doubt)

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        own = Numbers(120, real=numbers.real)
        mp = own.mp
        found = own.values(f, [end for end in (to, equals) if isinstance(end, int)], of)
        worst = mp.mpf(0)
        for side in sides:
            values = []
            for k in STEPS:
                near = mp.mpf(2) ** -k * side
                far = mp.mpf(2) ** (k // 4) * (-1 if to == "-infinity" else 1)
                at = found[to] + near if isinstance(to, int) else far
                values.append(own.values(f, [inside], {**of, x: at})[inside])
            worst = max(worst, _distance(own, values, found[equals] if isinstance(equals, int) else str(equals)))
        return [worst]

    return Case([], measured=measured, digits=6, mentions=[inside])


def _distance(numbers: Numbers, values: list[Any], equals: Any) -> Any:
    """0 where values come nearer to their limit, each to half of the distance at most; else what they are off by."""
    mp = numbers.mp
    if isinstance(equals, str):
        grown = [v if equals == "infinity" else -v for v in values]
        return mp.mpf(0) if all(b > a for a, b in pairwise(grown)) and grown[-1] > 1 else mp.mpf(1)
    off = [abs(v - equals) for v in values]
    scale = 1 + abs(equals)
    if off[-1] < scale * mp.mpf(10) ** -4 or all(2 * b <= a for a, b in pairwise(off)):
        return mp.mpf(0)
    steps = [abs(b - a) for a, b in pairwise(values)]
    if 2 * steps[-1] <= steps[-2] and off[-1] > 4 * steps[-1]:  # it tends to something else
        return off[-1] / scale
    raise Outside  # slowly, as a logarithm does, or not at all: nothing can be said


KINDS: dict[str, Callable[[Statement], Case]] = {
    "integral": integral,
    "limit": limit,
}
