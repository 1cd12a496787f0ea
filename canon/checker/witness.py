"""Refutations by a point: at the witness, which lies in the domain, the claim fails, in 50 digits and in 100."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from canon.checker.functions import Rejected, Unknown
from canon.checker.obligations import Case
from canon.checker.points import (
    CLOSE,
    Numbers,
    Outside,
    completed,
    domain_of,
    independence,
    inside,
    names_in,
    on_surface,
)
from canon.checker.statement import Statement

TRIES, FEW = 20, (0, 10, 20)


def refutes(s: Statement, cases: Sequence[Case], witness: Mapping[str, Any], *, real: bool) -> None:
    """Some case fails at the witness; what it leaves open may have any value of the domain. Raises Rejected."""
    f, rng = s.f, random.Random(1)
    numbers, unmeasured = Numbers(real=real), False
    for case, k in ((x, k) for x in cases for k in (range(TRIES) if x.measured is None else FEW)):
        targets = [*case.zeros, *case.independent, *(a for a, _ in case.positive), *domain_of(s), *case.mentions]
        names = (names_in(s, targets) | {n for n in witness if n not in f.functions}) - case.images.keys()
        given = {n: x if n in f.functions else numbers.read(x) for n, x in witness.items()}
        of = completed(s, numbers, given, names, rng, Fraction(1, 2**k))  # ever nearer to 0, should that be needed
        sizes = []
        for precise in (numbers, Numbers(100, real=real)):
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
            return
    if unmeasured:
        raise Unknown("the checker couldn't measure what is claimed at the witness")
    raise Rejected("at the witness the claim doesn't fail, or it isn't a point of the domain")


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
