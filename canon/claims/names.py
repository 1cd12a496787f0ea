"""The names of a claim file: phase space, symbols and abbreviations, and which of them a formula may use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from decimal import Decimal
from typing import Any, Final

from canon.claims import document
from canon.claims.document import Table, key
from canon.claims.keys import Side
from canon.claims.reality import complex_variables
from canon.errors import InputError
from canon.expression import Formula, Vocabulary, read
from canon.measure import Measure
from canon.mechanics.assumptions import ASSUMPTIONS, symbol_with
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import UNSTATED, PhaseSpace
from canon.vocabulary import nearest

FUNCTION_WORDS: Final = ("function", "real", "positive", "negative", "nonzero")
"""The words that can stand together for an arbitrary function; one sign at most."""
SIGNS: Final = ("positive", "negative", "nonzero")
BARE: Final = ("matrix_algebra", "group", "matrix_group", "invariant_interval")
"""The kinds of claims of files that need no phase space."""


@dataclass
class Names:
    """The names of a file while it is read, and what the formulas read so far have shown of them.

    **Arguments:** the phase space; the vocabulary without restrictions; the number of arguments with which each
    arbitrary function has been called; the Hamiltonian, once it has been read; the
    measure of all formulas.
    """

    space: PhaseSpace
    vocabulary: Vocabulary
    arity: dict[str, int] = field(default_factory=dict)
    hamiltonian: Formula | None = None
    measure: Measure = field(default_factory=Measure)
    _restricted: dict[Any, tuple[Vocabulary, Vocabulary]] = field(default_factory=dict)

    def formula(self, value: Any, side: Side, where: str, **options: Any) -> Formula:
        """The formula that a TOML value states, in the variables of `side` (see `restricted`).

        **Raises:** `InputError` with the place.
        """
        text = document.expression_text(value, where)
        return self.counted(read(text, self.restricted(side, **options), where, self.measure), where)

    def counted(self, formula: Formula, where: str) -> Formula:
        """The formula, if every arbitrary function has as many arguments as elsewhere in the file."""
        for called, count in sorted(formula.calls):
            known = self.arity.setdefault(called, count)
            if known != count:
                raise InputError(f"{called!r} is called with {count} arguments here and with {known} elsewhere", where)
        return formula

    def restricted(
        self,
        side: Side,
        *,
        types: tuple[int, ...] = (),
        vocabulary: Vocabulary | None = None,
        allowed: Iterable[str] | None = None,
    ) -> Vocabulary:
        """The vocabulary of a formula in the variables of `side`.

        **Arguments:** `types`, of a generating function, for "mixed"; `vocabulary`, with a claim's own names;
        `allowed`, the variables that are open instead of those of `side`.
        """
        vocabulary = vocabulary or self.vocabulary
        key = (side, types, None if allowed is None else tuple(allowed))
        known = self._restricted.get(key)
        if known is None or known[0] is not vocabulary:
            self._restricted[key] = known = (vocabulary, self._restrict(vocabulary, *key))
        return known[1]

    def _restrict(
        self, vocabulary: Vocabulary, side: Side, types: tuple[int, ...], allowed: tuple[str, ...] | None
    ) -> Vocabulary:
        space = self.space
        old, new = _named(space.old), _named(space.new)
        no_bracket = "" if side in ("old", "both") else "it is the bracket in the old variables"
        open_names = _open(space, side, types) if allowed is None else allowed
        taken = {*open_names}
        refused = [name for name in (*old, *new) if name not in taken]
        if side == "parameters":
            refused.append(space.t.name)
        return vocabulary.refusing(refused, _allowed_words(side, open_names), no_bracket)


_KEYS = {
    section: (
        name,
        f'a key of [{section}] is no name: define {name} in [definitions], and write {name} = "{name}" there',
    )
    for section, name in (("hamiltonian", "H"), ("generating_function", "F"))
}
"""For sections whose key people take for a name, the key, and how formulas can have it."""


def _named(symbols: Iterable[Any]) -> tuple[str, ...]:
    return tuple(symbol.name for symbol in symbols)


def _open(space: PhaseSpace, side: Side, types: tuple[int, ...]) -> tuple[str, ...]:
    """The variables that a formula of this side may use."""
    if side == "mixed":
        template = GeneratingFunction(space, types, 0)
        return _named((*template.old_arguments, *template.new_arguments))
    old, new = _named(space.old), _named(space.new)
    return {"old": old, "new": new, "both": old + new, "parameters": ()}.get(side, _named(space.q))


def _allowed_words(side: Side, allowed: tuple[str, ...]) -> str:
    words = {
        "old": "a formula of the old variables",
        "new": "a formula of the new variables",
        "mixed": "a generating function of the variables",
        "both": "a formula of the variables",
        "parameters": "an expression in parameters alone",
        "lagrangian": "a formula of velocities and of the coordinates",
        "integral": "a formula of the coordinates and of the constants",
        "jet": "a formula of accelerations, velocities and coordinates",
        "group": "a formula of the group's parameters",
    }[side]
    return f"{words} {', '.join(allowed)}".rstrip()


def read_names(tables: Table, letters: int = 0) -> Names:
    """Phase space, symbols and definitions of a file of so many `letters`.

    Time is `t` where the file doesn't name it; if it calls something else `t`, its formulas have no time.

    **Raises:** `InputError` with the place.
    """
    bare = "phase_space" not in tables and _needs_no_space(tables)
    declared = {} if bare else _phase_space(tables)
    words = _symbols(tables.get("symbols", {}), declared)
    definitions = document.table(tables.get("definitions", {}), "[definitions]")
    words |= {name: ["complex"] for name in complex_variables(tables, words)}
    taken = {**dict.fromkeys(words, "[symbols]"), **declared}
    time = next((name for name, place in declared.items() if place == "[phase_space], time"), None)
    hidden = bare or (time is None and ("t" in declared or "t" in definitions or "function" in words.get("t", ())))
    time = _unused("t_", {*taken, *definitions}) if hidden else time or "t"
    for name in definitions:
        where = key(name, "[definitions]")
        document.name(name, where)
        if name in taken or name == time:
            raise InputError(f"{name!r} is declared already, in {taken.get(name, '[phase_space]')}", where)
    for name in orders(tables.get("claim")):
        if name not in taken and name not in definitions and name != time:
            words[name] = ["real"]
    signs = {name: sign for name, given in words.items() if "function" in given for sign in given if sign in SIGNS}
    words |= {name: ["function"] for name, given in words.items() if "function" in given}
    spoken = {**{name: ["real"] for name in declared}, **words}  # what is complex has been found in the formulas
    sides = {word: [n for n, place in declared.items() if place == f"[phase_space], {word}"] for word in "qpQP"}
    if bare:
        sides |= {"q": [UNSTATED[0]], "p": [UNSTATED[1]]}
    space = PhaseSpace(sides["q"], sides["p"], new=(sides["Q"], sides["P"]), time=time, symbols=spoken)
    vocabulary = Vocabulary(
        symbols={n: x for n, x in space.vocabulary.items() if n not in UNSTATED and not (hidden and n == time)},
        functions=frozenset(space.functions),
        signs=signs,
        pairs=tuple(zip(space.q, space.p, strict=True)),
        new=frozenset(_named(space.new)),
        undeclared="declare it in [symbols]",
        instead={name: text for section, (name, text) in _KEYS.items() if section in tables},
    )
    names = Names(space, vocabulary, measure=Measure(letters))
    _define(names, definitions)
    return names


def _needs_no_space(tables: Table) -> bool:
    """Whether all claims of a file are about matrices and groups alone, and nothing in it is about a phase space."""
    if {"hamiltonian", "transformation", "generating_function"} & set(tables):
        return False
    claims = tables.get("claim")
    return (
        bool(claims) and isinstance(claims, list) and all(isinstance(c, dict) and c.get("kind") in BARE for c in claims)
    )


def _phase_space(tables: Table) -> dict[str, str]:
    """Each name of the phase space with its place."""
    where = "[phase_space]"
    if "phase_space" not in tables:
        raise InputError(
            "a claim file declares its coordinates and momenta: [phase_space] with q = [...], p = [...]; it may be "
            f"left out where all claims are of kind {', '.join(BARE)}"
        )
    section = document.table(tables["phase_space"], where)
    document.only(section, ("q", "p", "Q", "P", "time"), where)
    declared: dict[str, str] = {}
    counts: dict[str, int] = {}
    for word in ("q", "p", "Q", "P"):
        listed = document.names(section.get(word, []), key(word, where))
        counts[word] = len(listed)
        for name in listed:
            if name in declared:
                raise InputError(f"{name!r} is declared already, in {declared[name]}", key(word, where))
            declared[name] = f"[phase_space], {word}"
    if not counts["q"]:
        raise InputError("at least one coordinate is needed", key("q", where))
    for a, b in (("q", "p"), ("Q", "P")):
        if counts[a] != counts[b]:
            raise InputError(f"{a} has {counts[a]} names but {b} has {counts[b]}", where)
    if counts["Q"] > counts["q"]:
        raise InputError(f"{counts['Q']} new pairs, but only {counts['q']} old ones", where)
    if "time" in section:
        time = document.name(section["time"], key("time", where))
        if time in declared:
            raise InputError(f"{time!r} is declared already, in {declared[time]}", key("time", where))
        declared[time] = "[phase_space], time"
    return declared


def _symbols(value: Any, declared: Mapping[str, str]) -> dict[str, list[str]]:
    """Each name of `[symbols]` with its assumptions."""
    words: dict[str, list[str]] = {}
    for name, given in document.table(value, "[symbols]").items():
        where = key(name, "[symbols]")
        document.name(name, where)
        if isinstance(given, int | Decimal) and not isinstance(given, bool):
            raise InputError('a word is expected, as "positive": what has a value is given in [definitions]', where)
        listed = [given] if isinstance(given, str) else document.listing(given, where)
        words[name] = [document.text(word, where) for word in listed]
        for word in words[name]:
            if word not in ASSUMPTIONS and word != "function":
                known = (*ASSUMPTIONS, "function")
                advice = nearest(word, known) or f": the words are {', '.join(known)}"
                raise InputError(f"unknown assumption {word[:80]!r}{advice}", where)
        if "function" in words[name]:
            if name in declared:
                raise InputError(f"{name!r} is a variable, so it can't be a function: {declared[name]}", where)
            if len(set(words[name]) - {"function", "real"}) > 1 or not set(words[name]) <= {*FUNCTION_WORDS}:
                raise InputError("a function can be positive, negative or nonzero, and nothing else besides", where)
            continue
        if "integer" in words[name] and name in declared:
            raise InputError(f"{name!r} is a variable, so it can't be an integer: {declared[name]}", where)
        if "complex" in words[name] and not set(words[name]) <= {"complex", "nonzero"}:
            raise InputError("a complex name can only be nonzero besides", where)
        try:
            symbol_with(name, words[name])
        except InputError as error:
            raise InputError(error.message, where) from None
    return words


def orders(claims: Any) -> list[str]:
    """The small parameters that claims of truncated maps name: `order = ["eps", 2]`."""
    found = list[str]()
    for claim in claims if isinstance(claims, list) else []:
        order = claim.get("order") if isinstance(claim, dict) else None
        if isinstance(order, list) and order and isinstance(order[0], str):
            with suppress(InputError):
                found.append(document.name(order[0], key("order")))
    return found


def _unused(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _define(names: Names, definitions: Table) -> None:
    """Read the abbreviations from top to bottom; an error in one is kept for where it is used."""
    known: dict[str, Formula | InputError] = {}
    for name, value in definitions.items():
        later = frozenset(definitions) - known.keys()
        names.vocabulary = replace(names.vocabulary, definitions=dict(known), later=later)
        try:
            known[name] = names.formula(value, "both", key(name, "[definitions]"))
        except InputError as error:
            if names.measure.is_spent:
                raise
            known[name] = error
    names.vocabulary = replace(names.vocabulary, definitions=known, later=frozenset())
