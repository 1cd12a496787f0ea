"""Changes to formulas that may make a true claim false: a sign, a factor near 1, a swapped pair, a dropped term."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction

from properties.soundness.formula import Formula, call, of

NEAR = tuple(1 + Fraction(sign, 10**k) for k in (3, 3, 3, 4, 6, 9, 12) for sign in (1, -1))
SWAPS = {"sin": "cos", "cos": "sin", "exp": "cosh", "tanh": "atan", "atan": "tanh", "sqrt": "cbrt", "log": "atan"}
Path = tuple[int, ...]


def places(formula: Formula, path: Path = ()) -> Iterator[tuple[Path, Formula]]:
    """Every subformula with its place, exponents left out."""
    yield path, formula
    if formula.head in ("num", "var"):
        return
    parts = formula.args[:1] if formula.head in ("**", "D") else formula.args
    for k, part in enumerate(parts):
        yield from places(part, (*path, k))


def changed(formula: Formula, path: Path, change: Callable[[Formula], Formula]) -> Formula:
    """The formula with the subformula at a place changed."""
    if not path:
        return change(formula)
    args = list(formula.args)
    args[path[0]] = changed(args[path[0]], path[1:], change)
    return Formula(formula.head, tuple(args))


def mutant(rng: random.Random, formula: Formula) -> tuple[Formula, str]:
    """The formula with one small change, and what was changed."""
    found = list(places(formula))
    path, part = rng.choice(found)
    kind = rng.choice(("near", "near", "sign", "factor", "drop", "swap", "power"))
    if kind == "near":
        factor = rng.choice(NEAR)
        return changed(formula, path, lambda f: f * factor), f"factor {factor}"
    if kind == "sign":
        return changed(formula, path, lambda f: -f), "sign"
    if kind == "factor":
        factor = rng.choice((2, Fraction(1, 2), 3))
        return changed(formula, path, lambda f: f * factor), f"factor {factor}"
    if kind == "drop" and part.head == "+":
        return changed(formula, path, lambda f: f.args[rng.randrange(2)]), "dropped term"
    if kind == "swap" and part.head in SWAPS:
        return changed(formula, path, lambda f: call(SWAPS[f.head], *f.args)), "swapped function"
    if kind == "power":
        return changed(formula, path, lambda f: f + Fraction(1, 1000) * f**2), "added term of 1/1000"
    return changed(formula, path, lambda f: f * of(Fraction(1001, 1000))), "factor 1001/1000"
