"""Where formulas are smooth: conditions on points, and the domain that they cut out.

A domain is open: zeros of radicands and of the arguments of `abs` and `sign`, cuts and poles are left out of it,
so that a claim made on it speaks of analytic functions only. A condition that holds for every value of its names is
dropped when it is made; one that can't hold anywhere is an `InputError` at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

import sympy as sp

from canon.errors import InputError
from canon.special import JacobiCN, JacobiDN, JacobiSN

ConditionKind = Literal["positive", "nonzero", "uncut", "slit", "regular"]


@dataclass(frozen=True)
class Condition:
    """One condition on a point.

    | kind | terms | what it says |
    |---|---|---|
    | `positive` | e | e is real and e > 0 |
    | `nonzero` | e | e ≠ 0 |
    | `uncut` | y, x | not (y = 0 and x ≤ 0): `atan2(y, x)` is smooth |
    | `slit` | e | the complex number e is not in (−∞, 0] |
    | `regular` | f | the special function f is finite and analytic at its arguments |

    `text` is how a reader of the formula would write it; it takes no part in equality.
    """

    kind: ConditionKind
    terms: tuple[sp.Expr, ...]
    text: str = field(default="", compare=False)

    def __str__(self) -> str:
        return self.text or describe(self.kind, *(str(term) for term in self.terms))

    def substitute(self, mapping: Mapping[sp.Expr, sp.Expr]) -> Condition:
        """The condition pulled back: every key of `mapping` replaced by its value, all at once."""
        terms = tuple(term.xreplace(dict(mapping)) for term in self.terms)
        return self if terms == self.terms else Condition(self.kind, terms)


@dataclass(frozen=True)
class Domain:
    """The points where all `conditions` hold and every expression of `surface` vanishes."""

    conditions: tuple[Condition, ...] = ()
    surface: tuple[sp.Expr, ...] = ()

    def __and__(self, other: Domain | Iterable[Condition]) -> Domain:
        conditions, surface = (other.conditions, other.surface) if isinstance(other, Domain) else (tuple(other), ())
        return Domain(unique(self.conditions, conditions), tuple(dict.fromkeys(self.surface + surface)))

    def substitute(self, mapping: Mapping[sp.Expr, sp.Expr]) -> Domain:
        """The domain pulled back: every key of `mapping` replaced by its value, all at once."""
        return Domain(
            unique(condition.substitute(mapping) for condition in self.conditions),
            tuple(expression.xreplace(dict(mapping)) for expression in self.surface),
        )


def unique(*groups: Iterable[Condition]) -> tuple[Condition, ...]:
    """All conditions of `groups` in order, each once."""
    return tuple(dict.fromkeys(condition for group in groups for condition in group))


def describe(kind: ConditionKind, *terms: str) -> str:
    """A condition in words, of terms given as text."""
    if kind == "positive":
        return f"{terms[0]} > 0"
    if kind == "nonzero":
        return f"{terms[0]} != 0"
    if kind == "uncut":
        return f"not ({terms[0]} = 0 and {terms[1]} <= 0)"
    if kind == "slit":
        return f"{terms[0]} not in (-oo, 0]"
    return f"{terms[0]} is analytic"


def is_complex(expression: sp.Expr) -> bool:
    """Whether `expression` contains i or a name that isn't known to be real."""
    return expression.has(sp.I) or any(symbol.is_real is not True for symbol in expression.free_symbols)


def positive(expression: sp.Expr, text: str = "") -> tuple[Condition, ...]:
    """`expression` is real and positive; of a complex one, that it isn't in (−∞, 0]."""
    text = text or str(expression)
    sign = known_sign(expression)
    if sign == "positive":
        return ()
    kind: ConditionKind = "slit" if is_complex(expression) else "positive"
    if sign in ("negative", "zero", "nonpositive"):
        raise InputError(f"undefined everywhere: it needs {describe(kind, text)}, but that is never so")
    return (Condition(kind, (expression,), describe(kind, text)),)


def nonzero(expression: sp.Expr, text: str = "") -> tuple[Condition, ...]:
    """`expression` doesn't vanish."""
    text = text or str(expression)
    sign = known_sign(expression)
    if sign in ("positive", "negative", "nonzero"):
        return ()
    if sign == "zero":
        raise InputError(f"undefined everywhere: it needs {describe('nonzero', text)}, but that is never so")
    return (Condition("nonzero", (expression,), describe("nonzero", text)),)


def uncut(y: sp.Expr, x: sp.Expr, y_text: str = "", x_text: str = "") -> tuple[Condition, ...]:
    """atan2(y, x) is smooth: not (y = 0 and x ≤ 0)."""
    y_text, x_text = y_text or str(y), x_text or str(x)
    if is_complex(y) or is_complex(x):
        raise InputError(f"atan2({y_text}, {x_text}) is for real arguments only")
    if known_sign(y) in ("positive", "negative", "nonzero") or known_sign(x) == "positive":
        return ()
    if y.is_zero:
        return positive(x, x_text)
    return (Condition("uncut", (y, x), describe("uncut", y_text, x_text)),)


def power_conditions(base: sp.Expr, exponent: sp.Expr, text: str = "") -> tuple[Condition, ...]:
    """Where `base**exponent` is smooth.

    Everywhere for an exponent 0, 1, 2, …; where the base isn't 0 for other integers; for any other exponent where
    the base is positive (if complex: off the cut), cube roots included.
    """
    if exponent.is_integer and (exponent.is_nonnegative or exponent.is_zero):
        return ()
    if exponent.is_integer:
        return nonzero(base, text)
    return positive(base, text)


_BOUNDED: Final = {sp.asin: -1, sp.acos: -1, sp.atanh: -1}
_POLES: Final = {
    sp.tan: sp.cos, sp.sec: sp.cos, sp.cot: sp.sin, sp.csc: sp.sin, sp.coth: sp.sinh, sp.csch: sp.sinh,
}  # fmt: skip
_ENTIRE: Final = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh)
_SPECIAL: Final = (
    sp.gamma, sp.LambertW, sp.elliptic_k, sp.elliptic_e, sp.elliptic_f, JacobiSN, JacobiCN, JacobiDN,
)  # fmt: skip


def function_conditions(function: Any, arguments: tuple[sp.Expr, ...], texts: tuple[str, ...] = ()) -> tuple[
    Condition, ...
]:  # fmt: skip
    """Where the sympy function `function`, one of the language's, is smooth at `arguments`.

    `texts` are the arguments as their author wrote them.

    **Raises:** `InputError` if that is nowhere, or if the function isn't in the language.
    """
    texts = texts or tuple(str(argument) for argument in arguments)
    argument, text = arguments[0], texts[0]
    if function in _ENTIRE:
        return ()
    if function in _SPECIAL:
        name = f"{function.__name__}({', '.join(texts)})"
        return (Condition("regular", (function(*arguments, evaluate=False),), describe("regular", name)),)
    if function in _POLES:
        inner = _POLES[function]
        return nonzero(inner(argument), f"{inner.__name__}({text})")
    if function is sp.log:
        return positive(argument, text)
    if function in (sp.Abs, sp.sign):
        return nonzero(argument, text)
    if function in _BOUNDED:
        return positive(1 - argument**2, f"1 - ({text})**2")
    if function is sp.acosh:
        return positive(argument - 1, f"{text} - 1")
    if function in (sp.atan, sp.asinh):
        return positive(1 + argument**2, f"1 + ({text})**2") if is_complex(argument) else ()
    if function in (sp.tanh, sp.sech):
        return nonzero(sp.cosh(argument), f"cosh({text})") if is_complex(argument) else ()
    if function is sp.atan2:
        return uncut(argument, arguments[1], text, texts[1])
    raise InputError(f"{function} is not a function of the language")


def conditions_of(expression: sp.Expr) -> tuple[Condition, ...]:
    """Where a sympy expression is smooth, from its subexpressions as they stand.

    What sympy has merged before it got here can't be seen: `x/x` arrives as 1.

    **Raises:** `InputError` if that is nowhere, or if the expression isn't in the language: floats (write an exact
    `Rational`), noncommutative symbols, `Piecewise`, integrals, infinities and so on.
    """
    return unique(condition for node in _nodes(expression) for condition in _node_conditions(node))


def _nodes(expression: sp.Expr) -> Iterator[Any]:
    """Every distinct subexpression once, bound variables of derivatives left out."""
    seen: set[Any] = set()
    stack: list[Any] = [expression]
    while stack:
        node = stack.pop()
        if node in seen:
            continue
        seen.add(node)
        yield node
        if isinstance(node, sp.Subs):
            stack.extend(node.point)
            stack.extend(_nodes_to_substitute(node))
        elif isinstance(node, sp.Derivative):
            stack.append(node.expr)
        else:
            stack.extend(reversed(node.args))


def _nodes_to_substitute(node: sp.Subs) -> list[Any]:
    """What to look at inside a `Subs`: nothing more if it is the derivative of an arbitrary function."""
    inner = node.expr
    if isinstance(inner, sp.Derivative) and isinstance(inner.expr, sp.core.function.AppliedUndef):
        return [argument for argument in inner.expr.args if not argument.free_symbols & set(node.variables)]
    return [inner.doit().xreplace(dict(zip(node.variables, node.point, strict=True)))]


def _node_conditions(node: Any) -> tuple[Condition, ...]:
    if isinstance(node, sp.Float):
        raise InputError(f"{node} is a floating-point number: write an exact one, such as Rational(1, 10)")
    if node in (sp.oo, -sp.oo, sp.zoo, sp.nan):
        raise InputError(f"the expression contains {node}: it is undefined everywhere")
    if isinstance(node, sp.Symbol) and not node.is_commutative:
        raise InputError(f"{node} is noncommutative")
    if node.is_Atom or isinstance(node, (sp.Add, sp.Mul, sp.Derivative, sp.Subs)):
        if isinstance(node, (sp.Symbol, sp.Rational, sp.Add, sp.Mul, sp.Derivative, sp.Subs)):
            return ()
        if node in (sp.pi, sp.E, sp.I, sp.EulerGamma, sp.GoldenRatio, sp.Catalan):
            return ()
        raise InputError(f"{node} is not an expression of the language")
    if isinstance(node, sp.Pow):
        return power_conditions(node.base, node.exp)
    if isinstance(node, sp.core.function.AppliedUndef):
        return ()
    if isinstance(node, sp.Function):
        return function_conditions(node.func, node.args)
    raise InputError(f"{type(node).__name__} is not in the language")


Sign = Literal["positive", "negative", "zero", "nonnegative", "nonpositive", "nonzero", "real"]

_SYMBOL_SIGNS: Final[tuple[tuple[str, Sign], ...]] = (
    ("is_positive", "positive"), ("is_negative", "negative"), ("is_zero", "zero"),
)  # fmt: skip


def known_sign(expression: sp.Expr, depth: int = 8) -> Sign | None:
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
        return _sum_sign([known_sign(term, depth - 1) for term in expression.args])
    if expression.is_Mul:
        return _product_sign([known_sign(factor, depth - 1) for factor in expression.args])
    if expression.is_Pow:
        return _power_sign(expression, depth)
    if isinstance(expression, (sp.exp, sp.cosh)):
        real = not is_complex(expression)
        return "positive" if real else "nonzero" if isinstance(expression, sp.exp) else None
    return None


def _symbol_sign(symbol: Any) -> Sign | None:
    for attribute, sign in _SYMBOL_SIGNS:
        if getattr(symbol, attribute):
            return sign
    if symbol.is_nonnegative:
        return "nonnegative"
    if symbol.is_nonpositive:
        return "nonpositive"
    if symbol.is_zero is False:
        return "nonzero"
    return "real" if symbol.is_real else None


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


def _power_sign(power: Any, depth: int) -> Sign | None:
    base, exponent = known_sign(power.base, depth - 1), power.exp
    if base == "positive" and not is_complex(exponent):
        return "positive"
    if base in ("positive", "negative", "nonzero") and exponent.is_Integer:
        if exponent % 2 == 0 and not is_complex(power.base):
            return "positive"
        return base if exponent % 2 else "nonzero"
    if exponent.is_Integer and exponent > 0 and exponent % 2 == 0 and not is_complex(power.base):
        return "nonnegative"
    if exponent.is_Rational and exponent.q % 2 == 0 and not is_complex(power.base):
        return "nonnegative" if exponent > 0 else "positive"
    return None
