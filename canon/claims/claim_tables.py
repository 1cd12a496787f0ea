"""A claim that was made in Python as the tables of a claim file, so that its certificate can speak of it.

Formulas are written in the language of claim files and read again, in their authors' own words where their conditions
don't show in them otherwise, as q > 0 of √q². A claim that doesn't come back as it was, with its domain, is refused:
else its certificate would speak of another one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.str import StrPrinter

from canon.claim import Claim
from canon.claims.keys import KEYS, WRITTEN
from canon.claims.lost_conditions import lost_condition
from canon.claims.reader import read_tables
from canon.domain import Condition
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.subject import Subject

Data = dict[str, Any]
NAMES: Final = {"Abs": "abs", "LambertW": "lambertw", "JacobiSN": "jacobi_sn", "JacobiCN": "jacobi_cn",
                "JacobiDN": "jacobi_dn", "EllipticPi": "elliptic_pi"}  # fmt: skip
WORDS: Final = ("positive", "negative", "nonnegative", "integer")
RELATIONS: Final = {"positive": ">", "nonzero": "!="}


class _Language(StrPrinter):
    """sympy's text, with the words of the language of claim files."""

    def _print_Function(self, expr: Any) -> str:
        name = NAMES.get(type(expr).__name__, expr.func.__name__)
        return f"{name}({self.stringify(expr.args, ', ')})"

    def _print_Derivative(self, expr: Any) -> str:
        text = self._print(expr.expr)
        for symbol, order in expr.variable_count:
            text = f"D({text}, {self._print(symbol)}, {order})"
        return text

    def _print_ImaginaryUnit(self, expr: Any) -> Any:
        return "1j"

    def _print_Exp1(self, expr: Any) -> Any:
        return "exp(1)"

    _print_Abs = _print_Function


def text_of(expression: Any) -> str:
    """An expression in the language of claim files."""
    return _Language().doprint(expression)


def claim_tables(claim: Claim) -> Data:
    """The tables of a claim file with this claim, under "claim".

    **Raises:** `InputError` where the claim can't be written so: for a domain with a cut that has no inequality, a
    name that isn't one of the language, or a key that is no formula.
    """
    try:
        return _as_read(claim, _by_form)
    except InputError:
        try:
            return _as_read(claim, _as_written)
        except InputError:
            pass  # the first reason is the one to be told
        raise


Writer = Callable[[Formula], str]


def _by_form(formula: Formula) -> str:
    return text_of(formula.expr)


def _as_written(formula: Formula) -> str:
    return formula.text or text_of(formula.expr)


def _as_read(claim: Claim, text: Writer) -> Data:
    """The tables with formulas in this text; **raises** `InputError` unless they are read as this very claim."""
    kept = {"kind": claim.kind, "title": claim.title, "source": claim.source}
    keys = {WRITTEN.get(name, name): _plain(value, text) for name, value in claim.keys.items() if value is not None}
    if "brackets" in claim.keys and claim.kind in KEYS and "structure" in KEYS[claim.kind].keys:
        keys["structure"] = {pair: _combination(row) for pair, row in keys["structure"].items()}
    tables = {**_sections(claim.subject, text), "claim": {**{k: v for k, v in kept.items() if v}, **keys}}
    reading = read_tables({**tables, "claim": [tables["claim"]]})
    for problem in reading.problems:
        raise InputError(f"this claim can't be written as a claim file: {problem['message']}", problem["where"])
    again = reading.claims[0]
    if _formulas(again.keys) != _formulas(claim.keys) or _shared(again.subject) != _shared(claim.subject):
        raise InputError("this claim can't be written as a claim file: its formulas don't come back as they were")
    if lost := lost_condition(claim, again):
        raise InputError(f"this claim can't be written as a claim file: the condition {lost} doesn't come back")
    return tables


def _sections(subject: Subject, text: Writer) -> Data:
    space = subject.space
    found: Data = {"phase_space": {"q": list(map(str, space.q)), "p": list(map(str, space.p))}}
    if space.Q:
        found["phase_space"] |= {"Q": list(map(str, space.Q)), "P": list(map(str, space.P))}
    if str(space.t) != "t":
        found["phase_space"]["time"] = str(space.t)
    found["symbols"] = {name: _words(symbol) for name, symbol in space.vocabulary.items() if symbol != space.t}
    found["symbols"] |= dict.fromkeys(subject.functions or space.functions, "function")
    if subject.hamiltonian is not None:
        found["hamiltonian"] = {"H": text(subject.hamiltonian)}
    if subject.transformation is not None and subject.transformation.direction != "implicit":
        map_ = subject.transformation
        sides = ("Q", "P") if map_.direction == "forward" else ("q", "p")
        texts, half = [text(f) for f in map_.formulas], len(map_.formulas) // 2
        found["transformation"] = {sides[0]: texts[:half], sides[1]: texts[half:]}
    generating = generating_of(subject)
    if generating is not None:
        kind = generating.type
        found["generating_function"] = {
            "type": kind if isinstance(kind, int) else list(kind),
            "F": text(generating.F),
        }
    where = list(dict.fromkeys(_inequality(condition) for condition in subject.domain.conditions))
    on = [text_of(expression) for expression in subject.domain.surface]
    if where or on:
        found["domain"] = {key: value for key, value in (("where", where), ("on", on)) if value}
    return {key: value for key, value in found.items() if value}


def _words(symbol: sp.Symbol) -> str | list[str]:
    """What is assumed of a name."""
    if symbol.is_real is not True:
        return "complex"
    words = [word for word in WORDS if getattr(symbol, f"is_{word}")]
    if symbol.is_zero is False and not {"positive", "negative"} & {*words}:
        words.append("nonzero")
    if "positive" in words:
        words.remove("nonnegative")
    return words[0] if len(words) == 1 else words or "real"


def _inequality(condition: Condition) -> str:
    if condition.kind not in RELATIONS:
        raise InputError(f"the condition {condition} has no inequality: it can't be written into a claim file")
    return f"{text_of(condition.terms[0])} {RELATIONS[condition.kind]} 0"


def _plain(value: Any, text: Writer) -> Any:
    """A key's value as TOML and JSON hold it."""
    if isinstance(value, Formula):
        return text(value)
    if isinstance(value, Mapping):
        named = ((text_of(name) if isinstance(name, sp.Basic) else str(name), v) for name, v in value.items())
        return {name: _plain(v, text) for name, v in named}
    if isinstance(value, sp.MatrixBase):
        return [[text_of(entry) for entry in row] for row in value.tolist()]
    if isinstance(value, (list, tuple)):
        return [_plain(item, text) for item in value]
    if isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, (sp.Basic, Fraction)):
        return text_of(value) if isinstance(value, sp.Basic) else str(value)
    raise InputError(f"a value of type {type(value).__name__} can't be written into a claim file")


def _combination(row: Mapping[str, str]) -> str:
    """A linear combination of names, of which the texts of the coefficients are given, as one text."""
    return " + ".join(f"({coefficient})*{name}" for name, coefficient in row.items()) or "0"


def _formulas(value: Any) -> Any:
    """The formulas in a key's value, bare, for comparison."""
    if isinstance(value, Formula):
        return value.expr
    if isinstance(value, Mapping):
        return {str(name): _formulas(item) for name, item in value.items() if item is not None}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_formulas(item) for item in value]
    return value if not isinstance(value, AppliedUndef) else str(value)


def _shared(subject: Subject) -> tuple[Any, ...]:
    map_ = subject.map
    formulas = () if map_ is None or map_.direction == "implicit" else map_.expressions
    F = generating_of(subject)
    H = None if subject.hamiltonian is None else subject.hamiltonian.expr
    generated = None if F is None else (F.types, F.F.expr)
    space, surface = subject.space, frozenset(subject.domain.surface)
    return space.q, space.p, space.Q, space.P, space.t, H, formulas, generated, surface


def generating_of(subject: Subject) -> GeneratingFunction | None:
    """The subject's own generating function, or the one that its map was made of (by `.forward()` or `.backward()`)."""
    given = subject.transformation
    return subject.generating_function or (None if given is None else given.generating_function)
