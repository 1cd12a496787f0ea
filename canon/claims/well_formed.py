"""Is a claim that was made in Python one that its kind's decider can read? What a file's reader would have refused."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any, Final

from canon.budget import is_budget
from canon.claim import Claim
from canon.claims.keys import KEYS, WRITTEN
from canon.claims.open_variables import check_variables
from canon.decide.to_accuracy import LEAST
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.subject import Subject

_LISTS: Final = ("expressions", "per pair")


def check_claim(claim: Claim) -> None:
    """**Raises** `InputError` for a claim about no subject, with a key that its kind hasn't got, or with a value that
    is no formula where one is expected. A key that is misspelt would be left out in silence."""
    if not isinstance(claim.subject, Subject):
        raise InputError(f"a claim is about a Subject, not {claim.subject!r}")
    if claim.budget is not None:
        check_budget(claim.budget)
    if claim.kind not in KEYS:
        return
    known = KEYS[claim.kind].keys
    for name, value in claim.keys.items():
        if WRITTEN.get(name, name) not in known:
            near = get_close_matches(str(name), known, 1)
            meant = f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known) or 'none'}"
            raise InputError(f"a claim of kind {claim.kind!r} has no key {name!r}: {meant}")
        form = known[WRITTEN.get(name, name)].form
        stated = value if form in _LISTS and isinstance(value, Sequence) else (value,)
        if value is not None and form in ("expression", *_LISTS):
            _check_formulas(stated, name)
    check_variables(claim)


def _check_formulas(values: Sequence[Any], name: str) -> None:
    for value in values:
        if not isinstance(value, Formula):
            advice = "as_formula of canon.mechanics.formulas makes one of an expression"
            raise InputError(f"a Formula is expected, not {value!r}: {advice}", f"key {name!r}")


def check_budget(budget: Any) -> None:
    """**Raises** `InputError` for what is no number of seconds."""
    if not is_budget(budget):
        short = isinstance(budget, (float, str)) or (isinstance(budget, int) and abs(budget) < 10**9)
        shown = repr(budget) if short else f"this {type(budget).__name__}"
        raise InputError(f"a budget is a number of seconds from 0 on, below 1e308, not {shown[:60]}")


def check_seed(seed: Any) -> None:
    """**Raises** `InputError` for a seed by which points can't be drawn again."""
    if not isinstance(seed, int) or isinstance(seed, bool):
        raise InputError(f"a seed is a whole number, not {seed!r}")


def check_accuracy(accuracy: Any) -> None:
    """**Raises** `InputError` for an accuracy that no residual can have."""
    if accuracy is not None and not (isinstance(accuracy, (int, float)) and LEAST <= accuracy < 1):
        raise InputError(f"an accuracy is a number from {LEAST:g} to 1, as 1e-30, not {accuracy!r}")
