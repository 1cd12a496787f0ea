"""What may be assumed of the names of phase space and of parameters."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

import sympy as sp

from canon.errors import InputError

ASSUMPTIONS: dict[str, dict[str, bool]] = {
    "real": {"real": True},
    "complex": {"complex": True},
    "positive": {"positive": True},
    "negative": {"negative": True},
    "nonnegative": {"nonnegative": True},
    "nonzero": {"zero": False},
    "integer": {"integer": True},
}
"""The words for what is assumed of a symbol, as sympy takes it."""


def symbol_with(name: str, words: str | Iterable[str] = ()) -> sp.Symbol:
    """The symbol `name` with the assumptions that `words` name; it is real unless `complex` is among them."""
    given = words.split() if isinstance(words, str) else list(words)
    facts: dict[str, bool] = {} if "complex" in given else {"real": True}
    for word in given:
        if word not in ASSUMPTIONS:
            near = get_close_matches(word, ASSUMPTIONS, 1)
            raise InputError(f"unknown assumption {word!r}" + (f"; did you mean {near[0]!r}?" if near else ""), name)
        facts |= ASSUMPTIONS[word]
    try:
        return sp.Symbol(name, **facts)
    except ValueError as error:
        raise InputError(f"the assumptions {', '.join(given)} contradict each other", name) from error


def check_words(symbol: sp.Symbol, words: Iterable[str]) -> None:
    """**Raises** `InputError` where the words say something of a symbol that it doesn't know of itself.

    sympy doesn't know it then, either: |m| isn't m, whatever is said of an m that was made without assumptions.
    """
    given = list(words)
    symbol_with(symbol.name, given)
    for word in given:
        if word == "complex":
            missing = symbol.is_real is True
        else:
            missing = any(symbol.assumptions0.get(fact) is not value for fact, value in ASSUMPTIONS[word].items())
        if missing:
            raise InputError(
                f"the symbol {symbol} was not made {word}: make it so, or give its name {symbol.name!r} in its place",
                "symbols",
            )
