"""Is a formula positive for all values that its names may have? A number that is; or sums of terms of one sign."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from canon.checker import core
from canon.checker.functions import Unreadable
from canon.checker.intervals import Intervals, Open
from canon.checker.shapes import is_product_of_nonzeros
from canon.checker.statement import Statement

PRECISIONS = (40, 120, 400)


def is_positive(s: Statement, a: int, *, strict: bool, real: bool) -> bool:
    """True where it is shown: a number that is, or a fraction of polynomials with terms of one sign each.

    A term has a sign where its names have one, or an even exponent. Not `strict`: the formula may be 0 somewhere.
    """
    f = s.f
    if not real:
        return False
    names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"} - {"pi"}
    if not names and not any(f.ops[b][1] in f.functions for b in f.reach(a) if f.ops[b][0] == "f"):
        return _number(s, a, strict=strict)
    try:
        over, under = _fraction(s, a)
    except (Unreadable, ValueError):
        return False
    signs = [sign_of(s.words, over), sign_of(s.words, under)]
    above, below = signs
    if not above[0] or not below[0] or not below[1] or above[0] != below[0]:
        return not over and not strict
    return above[1] or not strict


def _number(s: Statement, a: int, *, strict: bool) -> bool:
    """A number's interval."""
    for digits in PRECISIONS:
        try:
            if Intervals(digits).values(s.f, [a], {})[a].a > 0:
                return True
        except Open:
            continue
    return not strict and _exact_zero(s, a)


def _exact_zero(s: Statement, a: int) -> bool:
    return s.f.value(a) == 0


def _fraction(s: Statement, target: int) -> tuple[core.Polynomial, core.Polynomial]:
    """The formula as a fraction of polynomials in its names; raises ValueError where it is none."""
    f = s.f
    steps, leaves = f.rational([target])
    out: dict[int, tuple[core.Polynomial, core.Polynomial]] = {}
    for a in leaves:
        if f.ops[a][0] != "s":
            raise ValueError
        out[a] = {((f.ops[a][1], 1),): Fraction(1)}, core.ONE
    for a in steps:
        op, x = f.ops[a], [out[b] for b in f.parts(a)]
        if op[0] == "n":
            out[a] = ({(): op[1]} if op[1] else {}), core.ONE
        elif op[0] == "+":
            (p, q), (r, t) = x
            out[a] = core.combined(core.combined({}, p, t), r, q), core.combined({}, q, t)
        elif op[0] == "*":
            out[a] = core.combined({}, x[0][0], x[1][0]), core.combined({}, x[0][1], x[1][1])
        else:
            base = x[0] if op[2] > 0 else (x[0][1], x[0][0])
            over, under = core.ONE, core.ONE
            for _ in range(abs(op[2])):
                over, under = core.combined({}, over, base[0]), core.combined({}, under, base[1])
            out[a] = over, under
        if len(out[a][0]) * len(out[a][1]) > 10_000:
            raise ValueError
    return out[target]


def sign_of(words: Mapping[str, Sequence[str]], p: core.Polynomial) -> tuple[int, bool]:
    """1 or -1 where all terms have this sign (0: they haven't), and whether one of them is never 0."""
    found: set[int] = set()
    never = False
    for monomial, c in p.items():
        sign, nowhere = (1 if c > 0 else -1), True
        for name, e in monomial:
            own = words.get(name, ())
            if "complex" in own or name == "1j":
                return 0, False
            if "negative" in own or "nonpositive" in own:
                sign *= (-1) ** e
            elif not ("positive" in own or "nonnegative" in own or e % 2 == 0):
                return 0, False
            nowhere &= "positive" in own or "negative" in own or "nonzero" in own
        found.add(sign)
        never |= nowhere
    return (found.pop(), never) if len(found) == 1 else (0, False)


def is_nowhere_zero(s: Statement, a: int) -> bool:
    """Whether a formula of parameters is seen to have one sign, or to be a product of what isn't 0."""
    signs = a, s.f.mul(s.f.number(-1), a)
    return is_product_of_nonzeros(s, a) or any(is_positive(s, x, strict=True, real=True) for x in signs)
