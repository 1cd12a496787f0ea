"""Refutations by a point: at the witness, which lies in the domain, the claim fails.

In fractions where all is rational, or in intervals, where the point is rational and there are rules for the functions:
the claim's formulas and the domain's have values, the conditions hold, and a residual isn't 0. Else in 50 digits and
the same in 100, which is said.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from canon.checker import core
from canon.checker.case import Case
from canon.checker.fractions_alone import fails_exactly
from canon.checker.functions import Rejected, Unknown
from canon.checker.intervals import Intervals, Open, is_allowed, off_the_edge
from canon.checker.points import (
    CLOSE,
    Numbers,
    Outside,
    anywhere,
    completed,
    domain_of,
    functions_at_random,
    inside,
    names_in,
    on_surface,
)
from canon.checker.statement import Statement
from canon.checker.told_apart import independence

TRIES, FEW = 20, (0, 10, 20)
PRECISIONS, NEARLY = (40, 120, 400), 1e-60
"""Digits of intervals; and what is less than can be a witness."""
NEAR, NEAREST = (600, 20_000), 25
"""Points are near to another within 99 parts of so many; and a point of a surface is known to so many digits."""


def refutes(s: Statement, cases: Sequence[Case], witness: Mapping[str, Any], *, real: bool) -> list[str]:
    """Some case fails at the witness; what it leaves open may have any value of the domain. Raises Rejected.

    Returns what is to be trusted.
    """
    said = {op[1] for op in s.f.ops if op[0] == "s"} & witness.keys()
    if wrong := {n for n in said if n in ("pi", "1j") or (n[0] == "#" and n not in s.words)}:
        raise Rejected(f"a point says what {min(wrong)[:40]!r} is")
    if any(_exact(witness[n])[1] and "complex" not in s.words.get(n, ()) for n in said):
        raise Rejected("a name that is real has a complex value at the witness")
    enclosed = list[bool | None]()
    for case in cases:
        if fails_exactly(s, case, witness):
            return [case.against] if case.against else []
        for k in FEW if case.enclosed is None else (*FEW, 1, 11, 21):  # what is left open may lie outside of the domain
            enclosed.append(_enclosed(s, case, witness, k, real=real))
            if enclosed[-1]:
                return [case.against] if case.against else []
        chosen = {n: x for n, x in witness.items() if n in s.f.functions}
        if case.elsewhere and any(_enclosed(s, case, chosen, k, real=real) for k in range(TRIES)):
            return [case.against] if case.against else []
    if False in enclosed:
        raise Rejected("at the witness the claim doesn't fail: in intervals the residuals are 0 to 60 digits")
    f, rng = s.f, random.Random(1)
    numbers, finer, unmeasured = Numbers(real=real), Numbers(100, real=real), False
    numbers.signs = finer.signs = {n: words for n, words in s.words.items() if n in f.functions}
    for case, k in ((x, k) for x in cases for k in (range(TRIES) if x.measured is None else FEW)):
        targets = [*case.zeros, *case.independent, *(a for a, _ in case.positive), *domain_of(s), *case.mentions]
        names = (names_in(s, targets) | {n for n in witness if n not in f.functions}) - case.images.keys()
        given = {n: x if n in f.functions else numbers.read(x) for n, x in witness.items()}
        of = completed(s, numbers, given, names, rng, Fraction(1, 2**k))  # ever nearer to 0, should that be needed
        sizes = []
        for precise in (numbers, finer):
            of |= {n: precise.read(x) for n, x in witness.items() if n not in f.functions}
            if not on_surface(s, precise, of) or not inside(s, case, precise, of):
                break
            try:
                sizes.append(_failure(s, case, precise, of))
            except Outside:
                unmeasured |= case.measured is not None
                break
        unmeasured |= case.measured is not None and not all(sizes)  # it may fail by less than can be measured
        if len(sizes) == 2 and all(size > 10.0**-CLOSE for size in sizes) and abs(sizes[1] / sizes[0] - 1) < 1e-9:
            if case.measured is None:
                return ["that it fails at the witness, as values in 50 and in 100 digits say (not in intervals)"]
            return ["what was measured at the witness, in numbers that are rounded"]
    if unmeasured:
        raise Unknown("the checker couldn't measure what is claimed at the witness")
    raise Rejected("at the witness the claim doesn't fail, or it isn't a point of the domain")


def _enclosed(s: Statement, case: Case, witness: Mapping[str, Any], k: int, *, real: bool) -> bool | None:
    """Whether in intervals the point lies in the domain, and something there isn't 0, or isn't positive.

    False where all is nearly 0 that has to be 0; None where intervals don't tell.
    """
    f, rng, enclosed = s.f, random.Random(1 + k), case.enclosed
    if case.measured is not None and enclosed is None:
        return None
    positive = [a for a, _ in case.positive]
    written = [*domain_of(s), *(s.pull(image) for image in s.images.values()), *(a for a, _ in s.conditions)]
    names = names_in(s, [*case.zeros, *positive, *written, *s.surface, *case.mentions]) | {*witness}
    exact = {n: _exact(x) for n, x in witness.items() if n in names and n not in f.functions}
    for name in sorted(names - exact.keys() - case.images.keys() - {*f.functions}):
        words = s.words.get(name, ())
        value = anywhere([word for word in words if word != "complex"], rng, Fraction(1, 2**k))
        exact[name] = (value or Fraction(0), Fraction(rng.randint(1, 9), 7) if "complex" in words else Fraction(0))
    functions = {**functions_at_random(s, rng), **{n: x for n, x in witness.items() if n in f.functions}}
    for digits in PRECISIONS:
        own = Intervals(digits, real=real)
        try:
            own.signs = {n: words for n, words in s.words.items() if n in f.functions}
            of: dict[str, Any] = {**functions, **point_of(s, own, exact, functions)}
            for name, image in case.images.items():
                of[name] = own.values(f, [image], of)[image]
            found = own.values(f, [*case.zeros, *positive, *written], of)
            if not lies_inside(s, own, of, found):
                continue
            if any(own.is_nonzero(found[a]) for a in case.zeros):
                return True
            if enclosed is not None and any(own.is_nonzero(x) for x in enclosed(own, of)):
                return True
            enclosed = case.enclosed = None  # what it costs, it costs once
            for group, size in ((group, size) for group in case.outside for size in NEAR):
                if _are_independent(s, case, group, own, exact, functions, size):
                    return True
            if any(own.real(found[a]).b < 0 or (strict and _is_zero(s, a, exact)) for a, strict in case.positive):
                return True
            nearly = [x.a > -NEARLY and x.b < NEARLY for a in case.zeros for x in own.parts(found[a])]
            if nearly and all(nearly) and not (case.positive or case.outside or case.independent):
                return False
        except Open:
            continue
    return None


def _exact(x: Any) -> tuple[Fraction, Fraction]:
    """The real and the imaginary part of a coordinate."""
    first, second = (x["re"], x["im"]) if isinstance(x, Mapping) else (x, 0)
    return core.number(first), core.number(second)


def _at(s: Statement, a: int, exact: Mapping[str, tuple[Fraction, Fraction]]) -> Fraction | None:
    """The rational number that a formula is at a rational point; None for any other."""
    real = {n: s.f.number(x) for n, (x, y) in exact.items() if y == 0}
    return s.f.value(s.f.substitute(a, real))


def _is_zero(s: Statement, a: int, exact: Mapping[str, tuple[Fraction, Fraction]]) -> bool:
    return s.f.value(a) == 0 or _at(s, a, exact) == 0


def point_of(
    s: Statement, own: Intervals, exact: Mapping[str, tuple[Fraction, Fraction]], functions: Mapping[str, str]
) -> dict[str, Any]:
    """The point in intervals, which hold one of the surface: an equation that isn't 0 there exactly changes its sign
    across one of its names, of which the others are free. Raises Open."""
    f, free = s.f, [e for e in s.surface if not _is_zero(s, e, exact)]
    of = {n: own.number(x) if y == 0 else own.iv.mpc(own.iv.mpf(x.numerator) / x.denominator,
                                                     own.iv.mpf(y.numerator) / y.denominator)
          for n, (x, y) in exact.items()}  # fmt: skip
    used = [{f.ops[a][1] for a in f.reach(e) if f.ops[a][0] == "s"} for e in s.surface]
    for e in free:
        mine = {f.ops[a][1] for a in f.reach(e) if f.ops[a][0] == "s"} & exact.keys() - s.fixed
        for name in sorted(n for n in mine if sum(n in others for others in used) == 1):
            x = exact[name][0]
            near = (1 + abs(x)) * Fraction(1, 10**NEAREST)
            ends = [own.number(end) for end in (x - near, x + near)]
            low, high = (own.real(own.values(f, [e], {**functions, **of, name: end})[e]) for end in ends)
            if exact[name][1] == 0 and ((low.b < 0 < high.a) or (high.b < 0 < low.a)):
                held = own.iv.mpf([own.real(ends[0]).a, own.real(ends[1]).b])
                of[name] = held if own.is_real else own.iv.mpc(held, 0)
                own.values(f, [e], {**functions, **of})  # no pole lies between
                break
        else:
            raise Open
    return of


def lies_inside(s: Statement, own: Intervals, of: Mapping[str, Any], found: Mapping[int, Any]) -> bool:
    """Whether the inequalities and the assumptions hold, of all names and of the variables that the map gives."""
    signs = [(found[a], kind) for a, kind in s.conditions]
    if not all(own.real(x).a > 0 if kind == "positive" else own.is_nonzero(x) for x, kind in signs):
        return False
    given = {name: found[s.pull(image)] for name, image in s.images.items()}
    assumed = [(x, [*s.words.get(n, ())]) for n, x in of.items() if n not in (*s.f.functions, *given)]
    assumed += [(x, off_the_edge(s.words.get(n, ()))) for n, x in given.items()]
    return all(words == ["complex"] or is_allowed(words, own.real(x)) for x, words in assumed if words)


def _are_independent(
    s: Statement,
    case: Case,
    group: Sequence[int],
    own: Intervals,
    exact: Mapping[str, tuple[Fraction, Fraction]],
    functions: Mapping[str, str],
    size: int,
) -> bool:
    """Whether functions of the coordinates are linearly independent: their values near a point have a determinant."""
    rng, moving, rows = random.Random(2), {*s.coordinates, *s.bracketed} & exact.keys(), []
    if case.images or s.surface or not own.is_real:
        return False
    for _ in group:
        near = {n: x * (1 + Fraction(rng.randint(-99, 99), size)) if n in moving else x for n, (x, _) in exact.items()}
        of = {**functions, **{n: own.number(x) for n, x in near.items()}}
        images = (s.pull(image) for image in s.images.values())
        found = own.values(s.f, [*group, *domain_of(s), *images, *(a for a, _ in s.conditions)], of)
        if not lies_inside(s, own, of, found):
            return False
        rows.append([found[a] for a in group])
    return own.is_regular(rows)


def _failure(s: Statement, case: Case, numbers: Numbers, of: Mapping[str, Any]) -> Any:
    """By how much the case fails at a point; 0 where it doesn't."""
    found = numbers.values(s.f, [*case.zeros, *(a for a, _ in case.positive)], of)
    sizes = [abs(found[a]) for a in case.zeros]
    for a, strict in case.positive:
        sizes.append(1 if strict and found[a] == 0 else max(-numbers.mp.re(found[a]), 0))
    if case.measured is not None:
        sizes += (size for size in map(abs, case.measured(numbers, of)) if size > 10.0 ** (2 - case.digits))
    if case.outside:
        sizes.append(max((abs(independence(s, case, group, numbers, of)) for group in case.outside), default=0))
    return max(sizes, default=0)
