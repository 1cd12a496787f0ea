"""Names as a caller states them: one text, several names, or symbols of sympy's, with what is assumed of each."""

from collections.abc import Iterable, Mapping
from collections.abc import Set as AbstractSet
from typing import Any, Final, TypeAlias, TypedDict

import sympy as sp

from canon.errors import InputError
from canon.mechanics.admissible import check_symbol
from canon.tokens import look_alike

LONGEST_NAME: Final = 80
"""Letters of a name, in a claim file as well."""

Names: TypeAlias = str | sp.Symbol | Iterable[str | sp.Symbol]


def words_of(what: Any, name: Any) -> list[str]:
    """The assumptions on a name, one or several."""
    words = [what] if isinstance(what, str) else list(what) if isinstance(what, Iterable) else [what]
    for word in words:
        if not isinstance(word, str):
            raise InputError(f"a word such as 'positive' is expected, not {word!r}", f"symbols, {name}")
    return words


def stated_words(symbols: Any, keywords: Mapping[str, Names]) -> tuple[dict[str, list[str]], dict[str, sp.Symbol]]:
    """What is assumed of each name, by a table name = words and by a list of names for each word; and the symbols
    among them.

    **Raises:** `InputError` for what is no table, name or word, and where two different symbols have one name.
    """
    words: dict[str, list[str]] = {}
    given: dict[str, sp.Symbol] = {}
    if not isinstance(symbols, Mapping | None):
        raise InputError(f"a table name = assumptions is expected, not {symbols!r}", "symbols")
    for name, what in (symbols or {}).items():
        (stated,) = listed_names((name,), "symbols")
        if isinstance(stated, sp.Symbol):
            stated = given.setdefault(stated.name, stated).name
        words.setdefault(stated, []).extend(words_of(what, name))
    for word, names in keywords.items():
        for name in listed_names(names):
            if isinstance(name, sp.Symbol):
                check_symbol(name, word)
                if given.setdefault(name.name, name) != name:
                    raise InputError(f"two different symbols are called {name.name}", word)
                name = name.name
            words.setdefault(name, []).append(word)
    return words, given


def check_name(name: str) -> None:
    """**Raises** `InputError` for a text that no claim file could declare."""
    if not name.isidentifier() or len(name) > LONGEST_NAME:
        raise InputError(f"{name[:LONGEST_NAME]!r} is not a name", "phase_space")
    if look_alike(name) != name:
        raise InputError(f"the name {name!r} has a look-alike letter: write {look_alike(name)!r}", "phase_space")


def listed_names(names: Names, where: str = "phase_space") -> tuple[str | sp.Symbol, ...]:
    if isinstance(names, str):
        return tuple(names.replace(",", " ").split())
    if isinstance(names, bytes) or not isinstance(names, sp.Symbol | Iterable):
        raise InputError(f"names are expected, as 'x y', ['x', 'y'] or symbols, not {names!r}", where)
    listed = (names,) if isinstance(names, sp.Symbol) else _tuple(names, where)
    for name in listed:
        if not isinstance(name, str | sp.Symbol):
            raise InputError(f"a name or a symbol is expected, not {name!r}", where)
    return listed


def _tuple(names: Any, where: str) -> tuple[Any, ...]:
    try:
        return tuple(names)
    except TypeError:  # as of an array of numpy's without axes
        raise InputError(f"names are expected, as 'x y', ['x', 'y'] or symbols, not {names!r}", where) from None


def ordered_names(names: Names) -> tuple[str | sp.Symbol, ...]:
    """Names that stand in an order; **raises** `InputError` for a set, which would pair q and p by chance."""
    if isinstance(names, (AbstractSet, Mapping)):
        said = f"names in an order are expected, as 'x y' or ['x', 'y'], not {names!r}"
        raise InputError(said, "phase_space")
    return listed_names(names)


class Declared(TypedDict):
    """Two of the keywords of `PhaseSpace`."""

    real: list[sp.Symbol]
    complex: list[sp.Symbol]


def as_declared(symbols: Iterable[Any]) -> Declared:
    """Symbols as the keywords `real` and `complex` of `PhaseSpace` take them, by what is assumed of each."""
    found = Declared(real=[], complex=[])
    for symbol in symbols:
        found["real" if symbol.is_real else "complex"].append(symbol)
    return found
