"""Actions in wells c + k |q|^n, by Euler's beta function, whatever n > 0 is.

∮ √((E − c − k |q|^n)/a) dq = 2 √(π (E − c)/a) ((E − c)/k)^(1/n) Γ(1 + 1/n)/Γ(3/2 + 1/n): with q = ((E − c) u/k)^(1/n)
it is an integral of u^(1/n − 1) √(1 − u) (Landau & Lifshitz, Mechanics, § 12).

Nothing but the power moves with q: of c + |q|^n + 1/q − 1/q, which has no value at 0, no well is seen.
"""

from __future__ import annotations

from fractions import Fraction

from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.formulas import ONE
from canon.checker.functions import Unreadable
from canon.checker.orbits import Form
from canon.checker.positive import is_positive
from canon.checker.radicals import Radicals
from canon.checker.statement import Statement

HIGHEST = 40
WELL = "#well"
"""The name that |q|^n has where a well is seen to be linear in it, whatever its value."""


def well_action(s: Statement, form: Form, level: int) -> tuple[int, int] | None:
    """The action in such a well, and what is left of the energy there; the domain says nothing of q and p."""
    f, x = s.f, form.x
    if not form.quadratic or _is_bound(s, x, form.p):
        return None
    a, b, c = form.parts
    powers = [p for p in f.reach(c) if _exponent(s, p, x) is not None]
    powers = [p for p in powers if not any(p in f.parts(other) for other in powers)]  # |x| in |x|^n is none by itself
    if len(powers) != 1:
        return None
    (power,) = powers
    beside = (p for p in f.reach(c) if p not in {*f.reach(power)} and f.ops[p][0] in "^f")
    if any(f.ops[y] == ("s", x) for p in beside for y in f.reach(p)):  # as of 1/(q² − 1) − 1/(q² − 1), at 1
        return None
    u = f.node("s", WELL)
    first, second, moved = (_put(s, c, power, m) for m in (f.number(1), f.number(2), u))
    k, n = f.sub(second, first), _exponent(s, power, x) or ONE
    base = f.sub(first, k)
    room, values = f.sub(level, base), at_random(s)
    free = all(f.ops[p] != ("s", x) for y in (a, b, base, k, n) for p in f.reach(y))
    linear = is_identity(values, f.sub(moved, f.add(base, f.mul(k, u)))) and is_identity(values, b)
    if not free or not linear or not all(is_positive(s, y, strict=True, real=True) for y in (a, k, n)):
        return None
    inverse = f.over(ONE, n)
    gammas = (f.node("f", "gamma", (), (f.add(f.number(m), inverse),)) for m in (1, Fraction(3, 2)))
    root = f.power(f.over(f.mul(f.node("s", "pi"), room), a), f.number(Fraction(1, 2)))
    total = f.mul(f.number(2), root, f.power(f.over(room, k), inverse), f.over(*gammas))
    return total, room


def is_action(s: Statement, form: Form, level: int, equals: int) -> bool:
    """Whether the action in such a well is what is claimed."""
    found, f = well_action(s, form, level), s.f
    if found is None:
        return False
    (total, room), values, kept = found, at_random(s), s.conditions
    try:
        s.conditions = [*kept, (room, "positive"), *((y, "positive") for y in Radicals(s, [room]).known())]
        radicals = Radicals(s, [])
        return is_identity(values, f.sub(*(_reduced(s, radicals.split(y)) for y in (total, equals))))
    except (Unreadable, *FAILURES):
        return False
    finally:
        s.conditions = kept


def _is_bound(s: Statement, *names: str) -> bool:
    said = any({*s.words.get(name, ())} - {"real"} for name in names)
    moving = [("s", name) for name in names]
    return said or any(s.f.ops[b] in moving for a, _ in s.conditions for b in s.f.reach(a))


def _exponent(s: Statement, a: int, x: str) -> int | None:
    """n of |x|^n, or of an even power of x; None for anything else."""
    f, op = s.f, s.f.ops[a]
    size = f.node("f", "abs", (), (f.node("s", x),))
    if op[:2] == ("f", "power") and op[3][0] == size:
        return int(op[3][1])
    if op[0] == "^" and (op[1] == size or (op[1] == f.node("s", x) and op[2] % 2 == 0)):
        return f.number(op[2])
    return ONE if a == size else None


def _put(s: Statement, target: int, node: int, image: int) -> int:
    new: dict[int, int] = {}
    for a in s.f.reach(target):
        new[a] = image if a == node else s.f.rebuilt(a, [new[b] for b in s.f.parts(a)])
    return new[target]


def _reduced(s: Statement, target: int) -> int:
    """Γ(x + 1) = x Γ(x) for numbers, down to 0 < x ≤ 1, with Γ(1) = 1 and Γ(1/2) = √π."""
    f, new = s.f, dict[int, int]()
    root = f.power(f.node("s", "pi"), f.number(Fraction(1, 2)))
    for a in f.reach(target):
        op, parts = f.ops[a], [new[b] for b in f.parts(a)]
        new[a] = f.rebuilt(a, parts)
        number = f.value(parts[0]) if op[:2] == ("f", "gamma") else None
        if number is not None and 0 < number < HIGHEST:
            factor = Fraction(1)
            while number > 1:
                number -= 1
                factor *= number
            known = {Fraction(1): ONE, Fraction(1, 2): root}
            gamma = known.get(number) or f.node("f", "gamma", (), (f.number(number),))
            new[a] = f.mul(f.number(factor), gamma)
    return new[target]
