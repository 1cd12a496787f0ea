"""The words of formulas: numbers, names and signs, with the place of what is none of them."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Final

from canon.errors import InputError

LONGEST: Final = 20_000
"""The most characters that a formula may have."""


def place(text: str, position: int) -> str:
    """Where in the text, in words: "at column 7", with the line if there are several."""
    line = text.count("\n", 0, position) + 1
    column = position - (text.rfind("\n", 0, position) + 1) + 1
    return f"at line {line}, column {column}" if "\n" in text.strip() else f"at column {column}"


def look_alike(name: str) -> str:
    """What a name is to be written as: itself, or the plain letters that it only looks like (`ℎ`, `ﬁ`, `µ`)."""
    return unicodedata.normalize("NFKC", name)


@dataclass(frozen=True, slots=True)
class Token:
    """A piece of text of a kind: "number", "name", "sign" or "end"."""

    kind: str
    text: str
    start: int
    end: int


_TOKEN: Final = re.compile(
    r"(?P<space>[ \t\r\n]+)"
    r"|(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[^\W\d]\w*)"
    r"|(?P<sign>\*\*|<=|>=|==|!=|[-+*/(),<>])"
)
RELATIONS: Final = ("<", "<=", ">", ">=", "==", "!=")
_ADVICE: Final = {
    "^": "write a power as **",
    ".": "attributes are not part of the language",
    "[": "subscripts and lists are not part of the language",
    "{": "braces are not part of the language",
    "'": "strings and primes are not part of the language; a derivative is written as D(f, x)",
    '"': "strings are not part of the language",
    "|": "write an absolute value as abs(...)",
    "!": "write n! as gamma(n + 1)",
    "\\": "LaTeX is not read; write a fraction as a/b, a root as sqrt(...)",
    "%": "there is no remainder in the language",
    "=": "an equation is written as two keys, or as a difference",
    "−": "write the minus sign as -",
    "–": "write the minus sign as -",
    "·": "write a product as *",
    "×": "write a product as *",
    "²": "write a square as **2",
    "³": "write a cube as **3",
    "√": "write a square root as sqrt(...)",
    "∂": "write a partial derivative as D(f, x)",
}


def tokens(text: str) -> list[Token]:
    """The tokens of a formula, "end" last. **Raises:** `InputError` with the place of what isn't in the language."""
    if len(text) > LONGEST:
        raise InputError(f"a formula of {len(text)} characters: at most {LONGEST} are read; use [definitions]")
    found, position = list[Token](), 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            raise InputError(_stranger(text, position))
        kind = match.lastgroup or ""
        if kind == "name":
            _check_name(text, match.group(), position)
        if kind != "space":
            found.append(Token(kind, match.group(), position, match.end()))
        position = match.end()
    found.append(Token("end", "", len(text), len(text)))
    return found


def _stranger(text: str, position: int) -> str:
    character = text[position]
    shown = repr(character) if character.isprintable() else "a character"
    code = "" if character.isascii() and character.isprintable() else f" (U+{ord(character):04X})"
    advice = _ADVICE.get(character)
    return f"{shown}{code} {place(text, position)} is not part of the language" + (f": {advice}" if advice else "")


def _check_name(text: str, name: str, position: int) -> None:
    for offset, character in enumerate(name):
        if character in _ADVICE:
            raise InputError(_stranger(text, position + offset))
    plain = look_alike(name)
    if plain != name:
        codes = " ".join(f"U+{ord(c):04X}" for c in name if look_alike(c) != c) or "a decomposed letter"
        raise InputError(
            f"the name {name!r} {place(text, position)} has a look-alike letter ({codes}): write {plain!r}"
        )
    if not name.isidentifier():
        raise InputError(f"{name!r} {place(text, position)} is not a name")
