"""The sign of an expression as far as the assumptions on its names show it at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Literal

import sympy as sp

Sign = Literal["positive", "negative", "zero", "nonnegative", "nonpositive", "nonzero", "real"]

_SYMBOL_SIGNS: Final[tuple[Sign, ...]] = ("positive", "negative", "zero", "nonnegative", "nonpositive")


def declared(symbol: sp.Symbol) -> dict[str, bool]:
    """What is assumed of a symbol, with all that follows from it; a word that isn't there is unknown.

    The same answers as `symbol.is_positive` and its like, which search anew for what can't be known of a new symbol.
    """
    return symbol.assumptions0


def is_complex(expression: Any) -> bool:
    """Whether `expression` contains i or a name that isn't known to be real, outside of absolute values."""
    return _mentions_complex(expression) and (not expression.has(sp.Abs) or Reality()(expression))


def _mentions_complex(expression: Any) -> bool:
    return expression.has(sp.I) or any(symbol.is_real is not True for symbol in expression.free_symbols)


class Reality:
    """`is_complex` that looks at each subexpression once, for the many questions about one formula."""

    def __init__(self) -> None:
        self._known: dict[Any, bool] = {}

    def __call__(self, expression: Any) -> bool:
        """Whether `expression` contains i or a name that isn't known to be real, outside of absolute values."""
        known = self._known
        stack = [expression]
        while stack:
            node = stack[-1]
            if node in known:
                stack.pop()
            elif not node.args or isinstance(node, (sp.Derivative, sp.Subs)):
                known[stack.pop()] = _mentions_complex(node)
            elif missing := [part for part in node.args if part not in known]:
                stack.extend(missing)
            else:
                known[stack.pop()] = not isinstance(node, sp.Abs) and any(known[part] for part in node.args)
        return known[expression]


def known_sign(expression: Any, depth: int = 8, *, is_complex: Callable[[Any], bool] = is_complex) -> Sign | None:
    """The sign that `expression` has wherever it is defined, as far as its outermost `depth` levels show it.

    "nonnegative" and "nonpositive" include that it may vanish; "nonzero" may be complex; None where nothing shows.
    No numerical evaluation and no rewriting: what it says follows from the assumptions on the names alone.
    """
    if expression.is_Rational:
        return "zero" if not expression else "positive" if expression > 0 else "negative"
    if expression in (sp.pi, sp.E):
        return "positive"
    if expression is sp.I:
        return "nonzero"
    if expression.is_Symbol:
        return _symbol_sign(expression)
    if depth == 0:
        return None
    if expression.is_Add:
        return _sum_sign([known_sign(term, depth - 1, is_complex=is_complex) for term in expression.args])
    if expression.is_Mul:
        return _product_sign([known_sign(factor, depth - 1, is_complex=is_complex) for factor in expression.args])
    if expression.is_Pow:
        return _power_sign(expression, depth, is_complex)
    if isinstance(expression, (sp.exp, sp.cosh)):
        real = not is_complex(expression)
        return "positive" if real else "nonzero" if isinstance(expression, sp.exp) else None
    return None


def _symbol_sign(symbol: Any) -> Sign | None:
    facts = declared(symbol)
    for sign in _SYMBOL_SIGNS:
        if facts.get(sign):
            return sign
    if facts.get("zero") is False:
        return "nonzero"
    return "real" if facts.get("real") else None


def _sum_sign(signs: list[Sign | None]) -> Sign | None:
    found = set(signs) - {"zero"}
    if found <= {"positive", "nonnegative"}:
        return "positive" if "positive" in found else "nonnegative" if found else "zero"
    if found <= {"negative", "nonpositive"}:
        return "negative" if "negative" in found else "nonpositive"
    return None


def _product_sign(signs: list[Sign | None]) -> Sign | None:
    if "zero" in signs:
        return "zero"
    if None in signs:
        return None
    if "real" in signs:
        return None
    flips = sum(sign in ("negative", "nonpositive") for sign in signs) % 2
    if set(signs) <= {"positive", "negative"}:
        return "negative" if flips else "positive"
    if set(signs) <= {"positive", "negative", "nonzero"}:
        return "nonzero"
    if "nonzero" in signs:
        return None
    return "nonpositive" if flips else "nonnegative"


def _power_sign(power: Any, depth: int, is_complex: Callable[[Any], bool]) -> Sign | None:
    base, exponent = known_sign(power.base, depth - 1, is_complex=is_complex), power.exp
    if base == "positive" and not is_complex(exponent):
        return "positive"
    if base in ("positive", "negative", "nonzero") and exponent.is_Integer:
        if exponent % 2 == 0 and not is_complex(power.base):
            return "positive"
        return base if exponent % 2 else "nonzero"
    if exponent.is_Integer and exponent > 0 and exponent % 2 == 0 and not is_complex(power.base):
        return "nonnegative"
    if exponent.is_Rational and exponent.q % 2 == 0 and not is_complex(power.base):
        return "positive"  # where it is defined, the radicand is positive
    return None
