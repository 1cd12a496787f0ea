"""The language of formulas: a text, as Python's own parser sees it, made into operations. Nothing in it is executed."""

from __future__ import annotations

import ast
import re
import unicodedata
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

from canon.checker.functions import ARITIES, Unknown, Unreadable

if TYPE_CHECKING:
    from canon.checker.formulas import Formulas

_NAME = re.compile(r"(?<![\w.])[^\W\d]\w*")
_DIGITS = re.compile(r"(?<![\w.])\.?\d[\w.]*")
_NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE]\d*)?j?")
LONGEST = 50_000
"""The most characters of a formula."""


def tree(text: Any) -> tuple[ast.expr, bytes]:
    """The tree of a text; every name gets a mark in front, so that Python's own words are names too."""
    if not isinstance(text, (str, int)) or isinstance(text, bool) or len(str(text)) > LONGEST:
        raise Unreadable(f"no formula: {str(text)[:40]}")
    if "#" in str(text) or unicodedata.normalize("NFKC", str(text)) != str(text):
        raise Unreadable(f"letters that aren't of the language, or look like others: {str(text)[:60]}")
    marked = _NAME.sub(r"_\g<0>", " ".join(str(text).split()))
    if not all(_NUMBER.fullmatch(word) for word in _DIGITS.findall(str(text))):
        raise Unreadable(f"a number with letters in it: {str(text)[:60]}")
    try:
        return ast.parse(marked, mode="eval").body, marked.encode()
    except (SyntaxError, RecursionError, MemoryError, ValueError):
        raise Unreadable(f"not a formula: {str(text)[:60]}") from None


def read(f: Formulas, text: Any, names: Mapping[str, int], *, plain: bool = False) -> int:
    """The formula of a text; `names` are abbreviations, any other name stands for itself.

    A `plain` one is of this program's own, in which the file's functions and abbreviations have no part.
    """
    parsed, written = tree(text)
    try:
        return _built(_Text(f, written, names, plain), parsed)
    except (RecursionError, TypeError, LookupError, AttributeError, ArithmeticError, ValueError) as error:
        if isinstance(error, (Unreadable, Unknown)):
            raise
        raise Unreadable(f"not a formula of the language: {str(text)[:60]}") from None


class _Text(NamedTuple):
    """What a text is read with."""

    f: Formulas
    written: bytes
    names: Mapping[str, int]
    plain: bool


def _built(t: _Text, at: Any) -> int:
    f, rights = t.f, list[Any]()
    while isinstance(at, ast.BinOp) and not isinstance(at.op, ast.Pow):  # a long sum is no deep one
        rights.append((type(at.op), at.right))
        at = at.left
    found = _operand(t, at)
    for op, right in reversed(rights):
        rule = {ast.Add: f.add, ast.Sub: f.sub, ast.Mult: f.mul, ast.Div: f.mul}[op]
        other = _built(t, right)
        other = f.power(other, f.number(-1)) if op == ast.Div else other
        f.unseen += [found, other] if rule == f.mul and f.number(0) in (found, other) and not t.plain else []
        found = rule(found, other)
    return found


def _operand(t: _Text, at: Any) -> int:
    f = t.f
    if isinstance(at, ast.BinOp):
        return f.power(_built(t, at.left), _built(t, at.right))
    if isinstance(at, ast.UnaryOp) and isinstance(at.op, (ast.UAdd, ast.USub)):
        return f.mul(f.number(1 if isinstance(at.op, ast.UAdd) else -1), _built(t, at.operand))
    if isinstance(at, ast.Constant):
        digits = t.written[at.col_offset : at.end_col_offset].decode()
        if len(digits) > 4000 or len(digits.lower().partition("e")[2].strip("+-")) > 4:
            raise Unreadable("a number that is too long")
        return f.mul(f.number(digits.rstrip("j")), f.node("s", "1j") if digits.endswith("j") else f.number(1))
    if isinstance(at, ast.Name):
        return _named(t, at.id[1:])
    if not isinstance(at, ast.Call) or at.keywords:
        raise Unreadable("something that isn't in the language of formulas")
    of: Any = at.func
    counts: Any = getattr(of, "slice", None)
    orders = [item.value for item in getattr(counts, "elts", [counts])] if counts else []
    if any(type(order) is not int for order in orders):
        raise Unreadable("derivatives are counted")
    of = of.value if isinstance(of, ast.Subscript) else of
    name = of.id[1:]
    if name == "D" and len(at.args) > 2 and not isinstance(at.args[2], ast.Constant):
        raise Unreadable("derivatives are counted")
    if not t.plain and (name in t.names or name in f.taken):
        raise Unreadable(f"{name[:40]!r} is no function here")
    return call(f, name, orders, [_built(t, item) for item in at.args], plain=t.plain)


def _named(t: _Text, name: str) -> int:
    if name in t.names:
        t.f.unseen += t.f.behind(name)
        return t.names[name]
    if name in t.f.functions and not t.plain:
        raise Unreadable(f"{name[:40]!r} is a function: it needs its arguments")
    return t.f.node("s", name)


def call(f: Formulas, name: str, orders: Sequence[int], arguments: Sequence[int], *, plain: bool = False) -> int:
    """The value of a function, a derivative or a bracket."""
    a, count = arguments[0], len(arguments)
    if not plain and len(orders) in (0, count) and f.has_arguments(name, count):
        return f.node("f", name, tuple(orders) or (0,) * count, tuple(arguments))
    if orders or count not in ARITIES.get(name, ()) or (name in f.functions and not plain):
        raise Unreadable(f"{name[:40]} is no function of {count} arguments")
    if name in ("sqrt", "cbrt"):
        return f.power(a, f.number(Fraction(1, 2 if name == "sqrt" else 3)))
    if name == "bracket":
        f.unseen += arguments
        return f.bracket(a, arguments[1], f.pairs)
    if name == "D":
        f.unseen.append(a)
        order = f.value(arguments[2]) if count > 2 else Fraction(1)
        if order is None or order.denominator > 1 or not 0 <= order <= 20:
            raise Unreadable("D is of a whole order up to 20")
        for _ in range(int(order)):
            a = f.slope(a, _continuous(f, arguments[1]))
        return a
    return f.node("f", name, (), tuple(arguments))


def _continuous(f: Formulas, a: int) -> str:
    """The name that there is a derivative by: no number, and no integer. Raises Unreadable."""
    op = f.ops[a]
    if op[0] != "s" or op[1] in ("pi", "1j") or "integer" in f.words.get(op[1], ()):
        raise Unreadable("D is by a name that may change")
    return op[1]
