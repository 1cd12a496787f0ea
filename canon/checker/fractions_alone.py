"""Refutations in fractions alone: a rational residual isn't 0 at a rational point of the domain.

The claim's formulas, the domain's and the residuals have no functions, and the witness has a rational value for each
name in them: their values are exact, and nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from canon.checker import core
from canon.checker.case import Case
from canon.checker.functions import Unreadable
from canon.checker.intervals import is_allowed
from canon.checker.points import domain_of
from canon.checker.statement import Statement


class _Exact(NamedTuple):
    """A number as an interval with one point in it."""

    a: Fraction
    b: Fraction


def fails_exactly(s: Statement, case: Case, witness: Mapping[str, Any]) -> bool:
    """Whether a residual isn't 0 at the witness, which lies in the domain; False where fractions don't tell."""
    f = s.f
    if case.images or case.measured is not None:
        return False
    images = {name: s.pull(image) for name, image in s.images.items()}
    written = [*domain_of(s), *images.values(), *(a for a, _ in s.conditions)]
    reached = [f.ops[a] for a in f.reach(*case.zeros, *written, *s.surface)]
    names = {op[1] for op in reached if op[0] == "s"}
    if any(op[0] == "f" for op in reached) or not names <= witness.keys() or names & {"pi", "1j"}:
        return False
    if any(isinstance(x, Mapping) or "complex" in s.words.get(n, ()) for n, x in witness.items()):
        return False
    point = {n: core.number(x) for n, x in witness.items() if n not in f.functions}
    at = {n: f.number(x) for n, x in point.items()}
    try:
        found = {a: f.value(f.substitute(a, at)) for a in (*case.zeros, *written, *s.surface)}
    except Unreadable:  # a pole
        return False
    signs = [(found[a], kind) for a, kind in s.conditions]
    inside = all(x is not None and (x > 0 if kind == "positive" else x != 0) for x, kind in signs)
    if None in found.values() or not inside or any(found[a] for a in s.surface):
        return False
    moved = {**point, **{name: found[a] for name, a in images.items()}}
    assumed = [(x, s.words.get(n, ())) for n, x in moved.items() if x is not None]
    return all(is_allowed(words, _Exact(x, x)) for x, words in assumed) and any(found[a] for a in case.zeros)
