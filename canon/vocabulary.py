"""What a formula may speak of: the names that are declared, and which of them are out of place in it."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from difflib import SequenceMatcher
from functools import cached_property
from heapq import nlargest
from itertools import islice
from typing import Final

import sympy as sp

from canon.display import latex
from canon.domain import Condition, checked_conditions
from canon.errors import InputError
from canon.expected import text
from canon.granted import Operation, leant_on
from canon.syntax import Call, Name, Node, children

CONSTANTS: Final[Mapping[str, sp.Expr]] = {"pi": sp.pi}
"""Built-in names that stand for a number."""

CALLABLE: Final = (
    "sqrt", "cbrt", "exp", "log", "sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "atan2", "sinh",
    "cosh", "tanh", "coth", "asinh", "acosh", "atanh", "abs", "sign", "elliptic_k", "elliptic_e", "elliptic_f",
    "elliptic_pi", "jacobi_sn", "jacobi_cn", "jacobi_dn", "gamma", "lambertw", "D", "bracket",
)  # fmt: skip
"""Built-in names that are called."""

LONG: Final = 1_000
"""The most nodes of a formula that is printed in an answer, where it has no text of its own."""

LIKE: Final = 0.6
"""The share of letters, in their order, that a word has to have in common with a name to be meant by it."""
FEW: Final = 8
"""Words whose letters are looked at in their order."""

_MEANT: Final = {
    "e": "write exp(x) for e**x, or declare e", "E": "write exp(1), or declare E", "I": "the imaginary unit is 1j",
    "i": "the imaginary unit is 1j", "j": "the imaginary unit is 1j", "ln": "write log", "arcsin": "write asin",
    "arccos": "write acos", "arctan": "write atan", "arctan2": "write atan2", "arsinh": "write asinh",
    "arcosh": "write acosh", "artanh": "write atanh", "arcsinh": "write asinh", "arccosh": "write acosh",
    "arctanh": "write atanh", "Abs": "write abs", "ellipk": "write elliptic_k",
    "diff": "write D(f, x)", "Derivative": "write D(f, x)",
    "ellippi": "write elliptic_pi", "EllipticPi": "write elliptic_pi", "LambertW": "write lambertw",
}  # fmt: skip


@dataclass(frozen=True)
class Formula:
    """An expression with the conditions under which what was written is smooth.

    **Arguments:** `expr`, as sympy holds it; `conditions`, also those that no longer show in `expr` (`x/x` is 1
    where x ≠ 0); `text`, as its author wrote it; `names`, those that were written, abbreviations followed;
    `has_bracket`, whether a Poisson bracket was; `calls`, the arbitrary functions with their numbers of arguments;
    `slopes`, the names by which a derivative or a bracket is taken, each with an arbitrary function inside of it;
    `granted`, the operations that were written, with their arguments, whose conditions hold by what is assumed of the
    names in them, as that of log(m) for a positive m, and the calls of arbitrary functions.

    **Raises:** `InputError` where `expr` isn't sympy's, or a condition isn't a `Condition`.
    """

    expr: sp.Expr
    conditions: tuple[Condition, ...] = ()
    text: str = ""
    names: frozenset[str] = field(default=frozenset(), compare=False)
    has_bracket: bool = field(default=False, compare=False)
    calls: frozenset[tuple[str, int]] = field(default=frozenset(), compare=False)
    slopes: frozenset[tuple[str, str]] = field(default=frozenset(), compare=False)
    granted: tuple[Operation, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.expr, sp.Expr):
            raise InputError(f"a formula holds an expression of sympy's, not {self.expr!r}")
        text(self.text, "text")
        object.__setattr__(self, "conditions", checked_conditions(self.conditions))

    def __str__(self) -> str:
        return self.text or str(self.expr)

    @cached_property
    def symbols(self) -> frozenset[sp.Basic]:
        """The names of its expression and of its conditions: 0*log(x) is 0, but for x > 0 alone.

        Those, too, of which such a condition is assumed, as where x is declared positive.
        """
        said = (term.free_symbols for condition in self.conditions for term in condition.terms)
        shown = self.expr.free_symbols.union(*said)
        return frozenset(shown | leant_on(self.granted, but=shown))

    @property
    def label(self) -> str:
        """What an answer calls it: its text, or how large it is where nobody wrote or would read one.

        sympy sorts the terms of a sum before it prints them, in time and memory of the square of their number.
        """
        if self.text or next(islice(sp.preorder_traversal(self.expr), LONG, None), None) is None:
            return str(self)
        parts = len(self.expr.args)
        return f"a sum of {parts} terms" if self.expr.is_Add else "a long formula"

    def __repr__(self) -> str:
        where = ", ".join(map(str, self.conditions))
        return f"Formula({self}{', where ' if where else ''}{where})"

    def _repr_latex_(self) -> str:
        return f"${latex(self.expr)}$"


@dataclass(frozen=True)
class Vocabulary:
    """The names that a formula may use; declared ones win over built-in ones.

    **Arguments:** `symbols` by name; `functions`, the names of arbitrary functions; `definitions`, abbreviations with
    their formula, or with the error in it that is reported where they are used; `pairs`, the canonical pairs
    (q_i, p_i) of `bracket`; `new`, the names of new variables, which its arguments can't contain; `refused`, names
    that are declared but out of place here, each with the reason; `no_bracket`, why `bracket` is out of place, if it
    is; `later`, abbreviations that are defined further down; `signs`, the words "positive", "negative" or "nonzero"
    that some of the functions are declared with; `undeclared`, what to do with a name that nothing else is known of,
    and `instead` with certain of them.
    """

    symbols: Mapping[str, sp.Symbol] = field(default_factory=dict)
    functions: frozenset[str] = frozenset()
    definitions: Mapping[str, Formula | InputError] = field(default_factory=dict)
    pairs: tuple[tuple[sp.Symbol, sp.Symbol], ...] = ()
    new: frozenset[str] = frozenset()
    refused: Mapping[str, str] = field(default_factory=dict)
    no_bracket: str = ""
    later: frozenset[str] = frozenset()
    signs: Mapping[str, str] = field(default_factory=dict)
    undeclared: str = ""
    instead: Mapping[str, str] = field(default_factory=dict)

    def refusing(self, names: Iterable[str], reason: str, no_bracket: str = "") -> Vocabulary:
        """The same with `names` out of place, `reason` said of each."""
        refused = {**self.refused, **dict.fromkeys(names, reason)}
        return replace(self, refused=refused, no_bracket=no_bracket or self.no_bracket)

    def declaring(self, symbols: Mapping[str, sp.Symbol]) -> Vocabulary:
        """The same with further symbols; a name that is declared already keeps its symbol."""
        new = {name: symbol for name, symbol in symbols.items() if not self.declares(name)}
        return replace(self, symbols={**self.symbols, **new}) if new else self

    def declares(self, name: str) -> bool:
        """Whether the file declares `name`, so that it wins over a built-in one."""
        return name in self.symbols or name in self.functions or name in self.definitions

    @cached_property
    def has_integers(self) -> bool:
        """Whether a name stands for whole numbers alone."""
        return any(symbol.is_integer for symbol in self.symbols.values())

    @property
    def words(self) -> int:
        """How many names there are that may be meant."""
        return len(self.symbols) + len(self.functions) + len(self.definitions) + len(CONSTANTS) + len(CALLABLE)

    def unknown(self, name: str, where: str = "", *, compared: bool = True) -> str:
        """What to say of a name that nobody declared: the nearest known one, where it is `compared` with them, or what
        is probably meant."""
        if name in self.later:
            return f"{name!r} {where}".rstrip() + " is defined further down: definitions are read from top to bottom"
        if advice := self.instead.get(name) or _MEANT.get(name):
            return f"unknown name {name!r} {where}".rstrip() + f": {advice}"
        known = [*self.symbols, *self.functions, *self.definitions, *CONSTANTS, *CALLABLE]
        meant = nearest(_spelled(name), known, but=name) if compared else ""
        advice = meant or (f": {self.undeclared}" if self.undeclared else "")
        return f"unknown name {name[:80]!r} {where}".rstrip() + advice


def _spelled(name: str) -> str:
    """A name of one Greek letter in Latin ones, as formulas mostly have it: `ω` as `omega`; any other as it is."""
    words = unicodedata.name(name, "").lower().split() if len(name) == 1 else []
    return words[-1] if words[:1] == ["greek"] else name


def nearest(name: str, known: Iterable[str], but: str | None = None) -> str:
    """ ": did you mean …?" with the nearest of the known words, or nothing if none is near; never `but` or `name`."""
    words = [word for word in dict.fromkeys(known) if word != (but or name)]
    lowered = {word.lower(): word for word in reversed(words)}
    name = name[:80]
    close = closest(name, words) or lowered.get(closest(name.lower(), lowered))
    return f": did you mean {close!r}?" if close else ""


def closest(name: str, words: Iterable[str]) -> str:
    """The word that is most like a name, or nothing where none is much like it.

    Of `difflib`'s measures the one that looks at the order of letters takes a millisecond for long words: it is asked
    of the few that have most letters in common with the name.
    """
    matcher = SequenceMatcher(b=name)
    found = list[tuple[float, str]]()
    for word in words:
        matcher.set_seq1(word)
        if matcher.real_quick_ratio() >= LIKE and (common := matcher.quick_ratio()) >= LIKE:
            found.append((common, word))
    likeness = list[tuple[float, str]]()
    for _, word in nlargest(FEW, found):
        matcher.set_seq1(word)
        likeness.append((matcher.ratio(), word))
    most, word = max(likeness, default=(0.0, ""))
    return word if most >= LIKE else ""


def written_names(node: Node, vocabulary: Vocabulary) -> frozenset[str]:
    """The names that are written below `node`, abbreviations followed."""
    found: set[str] = set()
    stack = [node]
    while stack:
        part = stack.pop()
        stack.extend(children(part))
        if isinstance(part, Name):
            formula = vocabulary.definitions.get(part.name)
            found |= formula.names if isinstance(formula, Formula) else {part.name}
    return frozenset(found)


def written_functions(node: Node, vocabulary: Vocabulary) -> frozenset[str]:
    """The arbitrary functions that are called below `node`, abbreviations followed."""
    found: set[str] = set()
    stack = [node]
    while stack:
        part = stack.pop()
        stack.extend(children(part))
        formula = vocabulary.definitions.get(part.name) if isinstance(part, Name) else None
        if isinstance(formula, Formula):
            found |= {name for name, _ in formula.calls}
        elif isinstance(part, Call) and part.name in vocabulary.functions:
            found.add(part.name)
    return frozenset(found)
