"""Symbols and functions of sympy's that a claim may speak of: what is assumed of them is what a claim file could say.

sympy lets a symbol be even, imaginary, infinite or zero, and a function positive; it evaluates by that, and nothing of
canon's that looks for witnesses, or shows signs, knows of it. To leave such a fact out changes the claim: |z|² = −z² of
an imaginary z would be refuted at z = 1.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from itertools import combinations, product
from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.calls import Placed, at_places
from canon.errors import InputError
from canon.expression import Formula
from canon.functions import FUNCTIONS

_SIGNS: Final[tuple[dict[str, bool], ...]] = (
    {}, {"positive": True}, {"negative": True}, {"nonnegative": True}, {"nonpositive": True}, {"zero": False},
)  # fmt: skip
_BUILT_IN: Final[dict[str, Any]] = {"pi": sp.pi, **{name: made for name, (made, _) in FUNCTIONS.items()}}
"""What these names stand for where nobody declares them."""
_WORDS: Final = "a claim may assume that a name is real, complex, positive, negative, nonnegative, nonzero or integer"


@cache
def _known() -> frozenset[frozenset[tuple[str, bool]]]:
    """All sets of facts about a name that a claim may assume, with what follows from them."""
    kinds: tuple[dict[str, bool], ...] = ({"real": True}, {"integer": True}, {"rational": True})
    real = [kind | sign for kind, sign in product(kinds, _SIGNS)]
    others: list[dict[str, bool]] = [{}, {"complex": True}, {"complex": True, "zero": False}, {"zero": False}]
    return frozenset(frozenset(sp.Symbol("x", **facts).assumptions0.items()) for facts in (*real, *others))


@cache
def _real_values() -> dict[str, bool]:
    """What sympy knows of a function with real values."""
    return getattr(sp.Function("f", real=True), "_kwargs", {})


def check_symbol(symbol: sp.Symbol, where: str = "") -> None:
    """**Raises** `InputError` where more is assumed of the symbol than a claim can."""
    if isinstance(symbol, sp.Wild):
        raise InputError(f"{symbol} is a pattern of sympy's: take a symbol, as space.symbol({symbol.name!r})", where)
    if frozenset(symbol.assumptions0.items()) in _known():
        return
    given: Any = getattr(symbol, "_assumptions_orig", {})
    said = ", ".join(f"{word}={value}" for word, value in given.items() if word != "commutative")
    raise InputError(f"the symbol {symbol} has assumptions that no claim can state ({said}): {_WORDS}", where)


def check_leak(symbol: sp.Symbol, expression: Any, where: str = "") -> None:
    """**Raises** `InputError` for a name that sympy 1.14 has left in a derivative of its own of an unknown function.

    It makes the name `_s + t` for the place s + t of a second derivative, and doesn't put the place in again. What
    `PhaseSpace.function` makes has no such derivatives (`canon.calls`).
    """
    if symbol.name.startswith("_") and not symbol.is_Dummy and expression.has(sp.Subs):
        raise InputError(
            f"sympy has put {symbol.name!r} in a derivative of an unknown function, where a place should be: make the "
            "function by space.function(...), whose derivatives are by their places",
            where,
        )


def check_calls(formulas: Iterable[Formula | sp.Expr], where: str = "") -> None:
    """**Raises** `InputError` where an arbitrary function has assumptions of its own, or is called in two ways."""
    counts: dict[str, int] = {}
    for formula in formulas:
        expression: Any = formula.expr if isinstance(formula, Formula) else formula
        if not expression.has(AppliedUndef):
            continue
        _check_places(expression, where)
        for call in sorted(expression.atoms(AppliedUndef), key=str):
            name, given = call.func.__name__, dict(getattr(call.func, "_kwargs", {}))
            given.pop("by_places", None)  # what tells the functions of `canon.calls` from sympy's
            if given and given != _real_values():
                raise InputError(
                    f"of the function {name} more is assumed than that it is real and smooth: restrict its values by "
                    f"space.where(...), as in '{name}(x) > 0'",
                    where,
                )
            known = counts.setdefault(name, len(call.args))
            if known != len(call.args):
                many = " and with ".join(map(str, sorted((known, len(call.args)))))
                raise InputError(f"the function {name} is called with {many} arguments", where)


def _check_places(expression: Any, where: str) -> None:
    """**Raises** `InputError` for a derivative in sympy's words that sympy takes for another one.

    Two Subs are equal for it where their places hold the same: with V(q, q), ∂₁V − ∂₂V is 0 before it can be looked at,
    and ∂₁V + ∂₂V has become 2 ∂₁V. What canon writes itself are `Placed`.
    """
    for node in expression.atoms(sp.Subs) if expression.has(sp.Subs) else ():
        if isinstance(node, Placed) or not node.expr.has(sp.Derivative):
            continue
        values: Any = node.point
        alike = len({*values}) < len(values)
        if alike and (found := at_places(node)) is not None:
            _, orders, at = found
            alike = any(m != n for (m, a), (n, b) in combinations(zip(orders, at, strict=True), 2) if a == b)
        if alike:
            raise InputError(
                f"sympy does not tell {node} from the derivative by another place that holds the same: make it by "
                "differentiating V(x, ...), a function of space.function(...), which tells its places apart",
                where,
            )


def check_namesakes(formulas: Iterable[Formula | sp.Expr], where: str = "") -> None:
    """**Raises** `InputError` where two symbols bear one name: a witness could give only one value."""
    found: dict[str, sp.Symbol] = {}
    formulas = tuple(formulas)
    bare: list[Any] = [formula.expr if isinstance(formula, Formula) else formula for formula in formulas]
    called = {symbol.name for expression in bare for symbol in expression.free_symbols if hasattr(symbol, "name")}
    applied = {call.func.__name__ for expression in bare for call in expression.atoms(AppliedUndef)}
    unwritten = [each for each, formula in zip(bare, formulas, strict=True) if not getattr(formula, "text", "")]
    for name in sorted((called | applied) & _BUILT_IN.keys()):
        if any(
            expression.has(_BUILT_IN[name]) for expression in unwritten
        ):  # a text says itself which of them it means
            said = f"{name} is a declared name here, and a function or a constant of the language as well"
            raise InputError(f"{said}: give the declared one another name", where)
    for formula in formulas:
        expression = formula.expr if isinstance(formula, Formula) else formula
        for name in sorted({call.func.__name__ for call in expression.atoms(AppliedUndef)} & called):
            raise InputError(f"{name} is a variable and a function: give one of them another name", where)
        for symbol in expression.free_symbols:
            if isinstance(symbol, sp.Symbol) and found.setdefault(symbol.name, symbol) != symbol:
                raise InputError(
                    f"two different symbols are called {symbol.name}: give one of them another name",
                    where,
                )
