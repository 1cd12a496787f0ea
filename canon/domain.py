"""Where formulas are smooth: conditions on points, and the domain that they cut out.

A domain is open: zeros of radicands and of the arguments of `abs` and `sign`, cuts and poles are left out of it,
so that a claim made on it speaks of analytic functions only. A condition that holds for every value of its names is
dropped when it is made; one that can't hold anywhere is an `InputError` at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final, Literal, get_args

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.expected import listed, table, text
from canon.sign import Reality, known_sign
from canon.sign import is_complex as _is_complex
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiEpsilon, JacobiSN
from canon.substitution import parts_of, replaced

Test = Callable[[Any], bool]
ConditionKind = Literal["positive", "nonzero", "uncut", "slit", "regular"]
_KINDS: Final = get_args(ConditionKind)


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

    `text` is how a reader of the formula would write it, `closed` how it was written where that was e ≥ 0, and `kink`
    whether it is there for the smoothness of |e| or its powers alone, which have values at 0, too; they take no part in
    equality. Where `text` is empty the words are made of the terms when somebody asks for them.
    """

    kind: ConditionKind
    terms: tuple[sp.Expr, ...]
    text: str = field(default="", compare=False)
    closed: str = field(default="", compare=False)
    kink: bool = field(default=False, compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.kind, str) or self.kind not in _KINDS:
            raise InputError(f"a condition is one of {', '.join(_KINDS)}, not {self.kind!r}")
        terms = self.terms if type(self.terms) is tuple else listed(self.terms, "expressions", "terms")
        if len(terms) != 1 + (self.kind == "uncut") or not all(isinstance(term, sp.Expr) for term in terms):
            raise InputError(f"the terms of a condition are expressions of sympy's in a tuple, not {self.terms!r}")
        text(self.text, "text")
        object.__setattr__(self, "terms", terms)

    def __str__(self) -> str:
        return self.text or describe(self.kind, *(str(term) for term in self.terms))

    def substitute(self, mapping: Mapping[sp.Expr, sp.Expr]) -> Condition:
        """The condition pulled back: every key of `mapping` replaced by its value, all at once."""
        table(mapping, "formulas to put in", "mapping")
        terms: tuple[Any, ...] = tuple(replaced(term, mapping) for term in self.terms)
        call: Any = self.terms[0]
        if self.kind == "regular" and isinstance(call, sp.Function) and terms != self.terms:
            # E(m) isn't analytic at m = 1, nor is W at −1/e: their values there, 1 and −1, no longer show it.
            terms = (call.func(*(replaced(argument, mapping) for argument in call.args), evaluate=False),)
        return self if terms == self.terms else Condition(self.kind, terms, closed=self.closed, kink=self.kink)


@dataclass(frozen=True)
class Domain:
    """The points where all `conditions` hold and every expression of `surface` vanishes."""

    conditions: tuple[Condition, ...] = ()
    surface: tuple[sp.Expr, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "conditions", checked_conditions(self.conditions))
        surface = listed(self.surface, "expressions", "surface")
        if not all(isinstance(expression, sp.Expr) for expression in surface):
            raise InputError(f"a surface is where expressions of sympy's vanish, not {self.surface!r}", "domain")
        object.__setattr__(self, "surface", surface)

    def __and__(self, other: Domain | Iterable[Condition]) -> Domain:
        joined = other if isinstance(other, Domain) else Domain(checked_conditions(other))
        return Domain(unique(self.conditions, joined.conditions), tuple(dict.fromkeys(self.surface + joined.surface)))

    def substitute(self, mapping: Mapping[sp.Expr, sp.Expr]) -> Domain:
        """The domain pulled back: every key of `mapping` replaced by its value, all at once."""
        table(mapping, "formulas to put in", "mapping")
        surface: tuple[Any, ...] = tuple(replaced(expression, mapping) for expression in self.surface)
        return Domain(unique(condition.substitute(mapping) for condition in self.conditions), surface)


def checked_conditions(conditions: Iterable[Condition]) -> tuple[Condition, ...]:
    """The conditions as a tuple, which nobody changes any more. **Raises** `InputError` where something else is."""
    found = listed(conditions, "conditions", "conditions")
    for condition in found:
        if not isinstance(condition, Condition):
            raise InputError(f"a Condition is expected, not {condition!r}: relations are read by space.where(...)")
    return found


def unique(*groups: Iterable[Condition]) -> tuple[Condition, ...]:
    """All conditions of `groups` in order, each once: as a strict one where it is one of these."""
    found = dict[Condition, Condition]()
    for c in (c for group in groups for c in group):
        found[c] = stricter(found.get(c, c), c)
    return tuple(found.values())


def stricter(one: Condition, other: Condition) -> Condition:
    """Of two equal conditions the one that leaves more out: the zeros of e, and what has a value at a kink."""
    return other if (one.closed and not other.closed) or (one.kink and not other.kink) else one


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


def positive(expression: Any, text: str = "", *, is_complex: Test = _is_complex) -> tuple[Condition, ...]:
    """`expression` is real and positive; of a complex one, that it isn't in (−∞, 0]."""
    sign = known_sign(expression, is_complex=is_complex)
    if sign == "positive":
        return ()
    kind: ConditionKind = "slit" if is_complex(expression) else "positive"
    if sign in ("negative", "zero", "nonpositive"):
        words = describe(kind, text or str(expression))
        raise InputError(f"undefined everywhere: it needs {words}, which is never so")
    return (Condition(kind, (expression,), text and describe(kind, text)),)


def nonzero(expression: Any, text: str = "", *, is_complex: Test = _is_complex) -> tuple[Condition, ...]:
    """`expression` doesn't vanish."""
    sign = known_sign(expression, is_complex=is_complex)
    if sign in ("positive", "negative", "nonzero"):
        return ()
    if sign == "zero":
        raise InputError(f"undefined everywhere: {text or expression} is zero")
    return (Condition("nonzero", (expression,), text and describe("nonzero", text)),)


def uncut(
    y: Any, x: Any, y_text: str = "", x_text: str = "", *, is_complex: Test = _is_complex
) -> tuple[Condition, ...]:
    """atan2(y, x) is smooth: not (y = 0 and x ≤ 0)."""
    if is_complex(y) or is_complex(x):
        raise InputError(f"atan2({y_text or y}, {x_text or x}) is for real arguments only")
    if (
        known_sign(y, is_complex=is_complex) in ("positive", "negative", "nonzero")
        or known_sign(x, is_complex=is_complex) == "positive"
    ):
        return ()
    if known_sign(y, is_complex=is_complex) == "zero":
        return positive(x, x_text, is_complex=is_complex)
    return (Condition("uncut", (y, x), y_text and describe("uncut", y_text, x_text)),)


def power_conditions(
    base: Any, exponent: Any, text: str = "", *, is_complex: Test = _is_complex
) -> tuple[Condition, ...]:
    """Where `base**exponent` is smooth.

    Everywhere for an exponent 0, 1, 2, …; where the base isn't 0 for other integers; for any other exponent where
    the base is positive (if complex: off the cut), cube roots included.
    """
    if exponent.is_integer and (exponent.is_nonnegative or exponent.is_zero):
        return ()
    if exponent.is_integer:
        return nonzero(base, text, is_complex=is_complex)
    found = positive(base, text, is_complex=is_complex)
    bent = isinstance(base, sp.Abs) and known_sign(exponent, is_complex=is_complex) == "positive"
    return tuple(replace(c, kink=True) for c in found) if bent else found


_ENTIRE: Final = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh)


def leans_on_kinks(operation: Any, arguments: Iterable[Any]) -> bool:
    """Whether what an operation demands of its arguments may rest on |x| > 0 in them, as that √|x| isn't 0 does.

    A whole power of |x| that isn't negative, and another positive one of |x| alone, demand nothing else.
    """
    given = tuple(arguments)
    if not any(argument.has(sp.Abs) for argument in given) or operation in (sp.Add, sp.Mul, *_ENTIRE):
        return False
    if operation is not sp.Pow:
        return True
    base, exponent = given
    plain = known_sign(exponent) == "positive" and not exponent.has(sp.Abs)
    return not (plain and (exponent.is_Integer or isinstance(base, sp.Abs)))


def hardened(conditions: Iterable[Condition], names: Iterable[sp.Basic]) -> tuple[Condition, ...]:
    """The conditions; of these names none is there for a kink alone, which may be passed."""
    bent = {*names}
    return tuple(replace(c, kink=False) if c.kink and bent & c.terms[0].free_symbols else c for c in conditions)


_BOUNDED: Final = (sp.asin, sp.acos, sp.atanh)
_POLES: Final = {
    sp.tan: sp.cos, sp.sec: sp.cos, sp.cot: sp.sin, sp.csc: sp.sin, sp.coth: sp.sinh, sp.csch: sp.sinh,
}  # fmt: skip
_SPECIAL: Final = (
    sp.gamma, sp.LambertW, sp.elliptic_k, sp.elliptic_e, sp.elliptic_f, sp.polygamma, JacobiSN, JacobiCN, JacobiDN,
    JacobiEpsilon, EllipticPi,
)  # fmt: skip


def function_conditions(
    function: Any, arguments: tuple[Any, ...], texts: tuple[str, ...] = (), *, is_complex: Test = _is_complex
) -> tuple[Condition, ...]:
    """Where the sympy function `function`, one of the language's, is smooth at `arguments`.

    `texts` are the arguments as their author wrote them.

    **Raises:** `InputError` if that is nowhere, or if the function isn't in the language.
    """
    argument, text = arguments[0], texts[0] if texts else ""

    def words(pattern: str) -> str:
        return text and pattern.format(text)

    if function in _ENTIRE:
        return ()
    if function in _SPECIAL:
        if function is sp.LambertW and len(arguments) > 1:
            raise InputError(f"{function.__name__} with a branch: only the principal one is in the language")
        if function is sp.gamma and argument.is_Rational and argument > 0:
            return ()
        name = f"{function.__name__}({', '.join(texts)})"
        call: Any = function(*arguments, evaluate=False)
        return (Condition("regular", (call,), text and describe("regular", name)),)
    if function in _POLES:
        inner = _POLES[function]
        return nonzero(inner(argument), words(f"{inner.__name__}({{}})"), is_complex=is_complex)
    if function is sp.log:
        return positive(argument, text, is_complex=is_complex)
    if function in (sp.Abs, sp.sign):
        found = nonzero(argument, text, is_complex=is_complex)
        return tuple(replace(c, kink=True) for c in found) if function is sp.Abs else found
    if function in _BOUNDED:
        return positive(1 - argument**2, words("1 - ({})**2"), is_complex=is_complex)
    if function is sp.acosh:
        return positive(argument - 1, words("{} - 1"), is_complex=is_complex)
    if function in (sp.atan, sp.asinh):
        return positive(1 + argument**2, words("1 + ({})**2"), is_complex=is_complex) if is_complex(argument) else ()
    if function in (sp.tanh, sp.sech):
        return nonzero(sp.cosh(argument), words("cosh({})"), is_complex=is_complex) if is_complex(argument) else ()
    if function is sp.atan2:
        return uncut(argument, arguments[1], text, texts[1] if texts else "", is_complex=is_complex)
    raise InputError(f"{function} is not a function of the language")


class Smoothness:
    """Where sympy expressions are smooth, from their subexpressions as they stand; each is inspected once for all.

    What sympy has merged before it got here can't be seen: `x/x` arrives as 1.
    """

    def __init__(self) -> None:
        self.is_complex = Reality()
        self._known: dict[Any, tuple[Condition, ...]] = {}

    def __call__(self, expression: Any) -> tuple[Condition, ...]:
        """The conditions of the expression, outermost first, each once.

        **Raises:** `InputError` if it is smooth nowhere, or isn't in the language: floats (write an exact `Rational`),
        noncommutative symbols, `Piecewise`, integrals, infinities and so on.
        """
        known = self._known
        stack = [expression]
        while stack:
            node = stack[-1]
            if node in known:
                stack.pop()
                continue
            parts = node.args if node.__class__ in _COMMON else parts_of(node)
            try:
                inner = [found for part in parts if (found := known[part])]
            except KeyError:
                stack.extend(reversed(parts))
                continue
            stack.pop()
            own = () if node.__class__ in _EVERYWHERE else _node_conditions(node, self.is_complex)
            found = unique(own, *inner) if inner else own
            if any(c.kink for c in found) and leans_on_kinks(node.func, node.args):
                found = hardened(found, (name for part in node.atoms(sp.Abs) for name in part.free_symbols))
            known[node] = found
        return known[expression]


_EVERYWHERE: Final = frozenset((sp.Add, sp.Mul, sp.Integer, sp.Rational, *(type(sp.Integer(k)) for k in (-1, 0, 1))))
_COMMON: Final = _EVERYWHERE | {sp.Pow, sp.Symbol}


def conditions_of(*expressions: Any) -> tuple[Condition, ...]:
    """Where sympy expressions are all smooth, from their subexpressions as they stand: see `Smoothness`."""
    smoothness = Smoothness()
    return unique(*(smoothness(expression) for expression in expressions))


def _node_conditions(node: Any, is_complex: Test) -> tuple[Condition, ...]:
    if isinstance(node, (sp.Add, sp.Mul, sp.Rational)):
        return ()
    if isinstance(node, sp.Float):
        raise InputError(f"{node} is a floating-point number: write an exact one, such as Rational(1, 10)")
    if node.is_Atom and node in (sp.oo, sp.S.NegativeInfinity, sp.zoo, sp.nan):
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
        return power_conditions(node.base, node.exp, is_complex=is_complex)
    if isinstance(node, AppliedUndef):
        return ()
    if isinstance(node, sp.Function):
        return function_conditions(node.func, node.args, is_complex=is_complex)
    raise InputError(f"{type(node).__name__} is not in the language")
