"""A case, and how its truth is found out and a refutation confirmed: all by mpmath, at points."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import mpmath as mp

from properties.soundness import oracle
from properties.soundness.formula import DIGITS, Formula, Outside, TooLarge, of, value
from properties.soundness.identities import Equation


@dataclass(frozen=True)
class Case:
    """A claim as the text of a file.

    **Arguments:** `truth`, True by construction, False with a witness of the oracle's, None where it isn't known;
    `confirm`, whether the claim fails at a point, recomputed by mpmath (None where that can't be said).
    """

    family: str
    text: str
    truth: bool | None
    note: str = ""
    confirm: Callable[[Mapping[str, Any]], bool | None] = field(default=lambda point: None, compare=False)


def numbers(point: Mapping[str, Any]) -> dict[str, Any] | None:
    """A witness's table as numbers."""
    out: dict[str, Any] = {}
    for name, text in point.items():
        try:
            if isinstance(text, Mapping):
                out[name] = mp.mpc(_number(text["re"]), _number(text["im"]))
            else:
                out[name] = _number(text)
        except ValueError:
            continue
    return out


def _number(text: Any) -> Any:
    if "." in str(text):
        return mp.mpf(str(text))
    fraction = Fraction(str(text))
    return mp.mpf(fraction.numerator) / fraction.denominator


def gap(found: Equation) -> Callable[[Mapping[str, Any]], bool | None]:
    def confirm(point: Mapping[str, Any]) -> bool | None:
        with mp.workdps(oracle.FINER * DIGITS):
            place = numbers(point)
            if place is None or "V(" in f"{found.lhs}{found.rhs}":
                return None
            try:
                differ = oracle.apart(found.lhs, found.rhs, place, noise=oracle.NOISE**8)
                if not all(value(f, place) > 0 for f in found.positive):
                    return False
            except TooLarge:
                return None
            except Outside:
                return False
            except (KeyError, ZeroDivisionError):
                return None
            for name, (low, high) in found.box.items():
                if name in place:
                    if low is not None and not place[name] > oracle.edge(low):
                        return False
                    if high is not None and not place[name] < oracle.edge(high):
                        return False
            return differ

    return confirm


def judged(
    rng: random.Random,
    family: str,
    text: str,
    residuals: Sequence[Formula],
    names: Sequence[str],
    *,
    changed: str = "",
    note: str = "",
    box: oracle.Box | None = None,
) -> Case | None:
    """The case of a claim that says that all residuals vanish: true by construction, unless something was `changed`.

    Then it is false if one of them doesn't vanish at some point of the box, and else of unknown truth.
    """
    equations = [Equation(residual, of(0), {}, dict(box or {})) for residual in residuals]

    def confirm(point: Mapping[str, Any]) -> bool | None:
        seen = [gap(equation)(point) for equation in equations]
        return True if True in seen else None if None in seen else False

    if not changed:
        return Case(family, text, True, note, confirm)
    looked = 0
    for residual in residuals:
        point, seen = oracle.differs(rng, residual, of(0), names, box or {}, count=15)
        looked += seen
        if point is not None:
            return Case(family, text, False, f"{note}: {changed}", confirm)
    return Case(family, text, None, f"{note}: {changed}", confirm) if looked else None
