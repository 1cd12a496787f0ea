"""A claim file as data: its bytes, its TOML, and the values in it with their types checked."""

from __future__ import annotations

import hashlib
import os
import re
import stat
import sys
import tomllib
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any, Final

from canon.claims.toml_advice import toml_advice
from canon.errors import InputError
from canon.tokens import LONGEST, look_alike
from canon.vocabulary import nearest

BIGGEST: Final = 1_000_000
"""The most bytes that a claim file or a scene may have: what can be read as TOML in about a second."""
DEEPEST: Final = 12
"""The most parts of a dotted key, each of which makes a table in the one before."""
MOST: Final = 1_000
"""The most entries of a table or a list, but for claims and bodies: some of what is done takes the square of it."""

_PART: Final = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')"""
_DOTTED: Final = re.compile(rf"(?<![\w-]){_PART}(?:[ \t]*+\.[ \t]*+{_PART}){{{DEEPEST}}}")

Table = Mapping[str, Any]


def load(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The TOML document in the file at `path`.

    **Raises:** `InputError` if it isn't there, can't be read, is no regular file, is too big, isn't UTF-8 text, or
    isn't TOML (with line and column).
    """
    return parse(content(path))


def parse(text: str) -> dict[str, Any]:
    """The TOML document that `text` is; its decimal numbers are exact. **Raises:** `InputError`."""
    if deep := _DOTTED.search(text):
        number = text.count("\n", 0, deep.start()) + 1
        raise InputError(f"not readable: a key of more than {DEEPEST} parts in line {number}")
    try:
        return tomllib.loads(text, parse_float=_exact)
    except tomllib.TOMLDecodeError as error:
        line, column = text.count("\n") + 1, len(text) - text.rfind("\n")
        reason = str(error).replace("(at end of document)", f"(at line {line}, column {column}, the end)")
        raise InputError(f"not TOML: {reason}{toml_advice(str(error), text)}") from None
    except RecursionError:
        raise InputError("not readable: lists or tables are nested too deeply") from None
    except ValueError as error:
        long = "integer string conversion" in str(error)
        reason = f"a whole number of more than {sys.get_int_max_str_digits()} digits" if long else str(error)
        raise InputError(f"not readable: {reason}") from None


def _exact(text: str) -> Decimal:
    try:
        return Decimal(text)
    except ArithmeticError:
        raise ValueError(f"the number {text[:40]} is out of range") from None


def content(path: str | os.PathLike[str]) -> str:
    """The text of the file at `path`. **Raises:** `InputError` as `load`, but for what is in the text."""
    try:
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except FileNotFoundError:
        raise InputError("there is no such file") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"can't be read: {reason}") from None
    status = os.fstat(handle)
    if not stat.S_ISREG(status.st_mode) or status.st_size > BIGGEST:
        os.close(handle)
        if stat.S_ISDIR(status.st_mode):
            raise InputError("is a directory")
        if not stat.S_ISREG(status.st_mode):
            raise InputError("is not a regular file")
        raise InputError(f"is too big: {status.st_size} bytes, at most {BIGGEST} are read")
    with os.fdopen(handle, "rb") as file:
        try:
            data = file.read(BIGGEST + 1)
        except OSError as error:
            raise InputError(f"can't be read: {error.strerror or error}") from None
    if data is None:  # a file of the system's that has nothing to say now
        raise InputError("can't be read: there is nothing in it yet")
    if len(data) > BIGGEST:
        raise InputError(f"is too big: at most {BIGGEST} bytes are read")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise InputError(f"is not text in UTF-8: byte 0x{data[error.start]:02x} in line {line}") from None


def digest(text: str) -> str:
    """A name for what a file says, by which an answer about it is kept: a file may change while it is worked on."""
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def key(name: str, section: str = "") -> str:
    """The place of a key, in words."""
    return ", ".join(part for part in (section, f"key {name[:80]!r}") if part)


def only(table: Table, known: Iterable[str], where: str, elsewhere: Mapping[str, str] | None = None) -> None:
    """Refuse keys that aren't known, with the nearest known one, or with what `elsewhere` says of it.

    **Raises:** `InputError`.
    """
    known = tuple(known)
    for name in table:
        if name not in known:
            belongs = f": {elsewhere[name]}" if elsewhere and name in elsewhere else ""
            advice = belongs or nearest(name, known) or _choices(known)
            raise InputError(f"unknown key {name[:80]!r}{advice}", where)


def _choices(known: tuple[str, ...]) -> str:
    return f": the keys here are {', '.join(known)}" if known else ""


def table(value: Any, where: str) -> Table:
    """A table. **Raises:** `InputError`."""
    if not isinstance(value, dict):
        raise InputError(f"a table is expected, not {kind_of(value)}", where)
    if len(value) > MOST:
        raise InputError(f"{len(value)} entries: at most {MOST} are read", where)
    return value


def text(value: Any, where: str) -> str:
    """A string. **Raises:** `InputError`."""
    if not isinstance(value, str):
        raise InputError(f"a string is expected, not {kind_of(value)}", where)
    return value


def listing(value: Any, where: str, most: int = MOST) -> list[Any]:
    """A list of at most so many entries. **Raises:** `InputError`."""
    if not isinstance(value, list):
        advice = ": write it in brackets" if isinstance(value, (str, int, Decimal)) else ""
        raise InputError(f"a list is expected, not {kind_of(value)}{advice}", where)
    if len(value) > most:
        raise InputError(f"{len(value)} entries: at most {most} are read", where)
    return value


def whole(value: Any, where: str) -> int:
    """A whole number. **Raises:** `InputError`."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise InputError(f"a whole number is expected, not {kind_of(value)}", where)
    return value


def expression_text(value: Any, where: str) -> str:
    """The text of an expression, given as a string or a number. **Raises:** `InputError`."""
    if isinstance(value, str):
        return value
    if isinstance(value, int) and not isinstance(value, bool):
        if value.bit_length() > 3 * LONGEST:
            raise InputError("the number is too large", where)
        return str(value)
    if isinstance(value, Decimal) and value.is_finite():
        return str(value)
    raise InputError(f"an expression is expected, as a string, not {kind_of(value)}", where)


def name(value: Any, where: str) -> str:
    """A name that can be declared. **Raises:** `InputError`."""
    word = text(value, where)
    if look_alike(word) != word:
        raise InputError(f"the name {word!r} has a look-alike letter: write {look_alike(word)!r}", where)
    if not word.isidentifier() or len(word) > 80:
        raise InputError(f"{word[:80]!r} is not a name: letters, digits and underscores, no digit first", where)
    return word


def names(value: Any, where: str) -> tuple[str, ...]:
    """A list of different names. **Raises:** `InputError`."""
    found = dict[str, None]()
    for item in listing(value, where):
        if (word := name(item, where)) in found:
            raise InputError(f"{word!r} is listed twice", where)
        found[word] = None
    return tuple(found)


def kind_of(value: Any) -> str:
    """What a TOML value is, in words."""
    if isinstance(value, bool):
        return "true or false"
    if isinstance(value, Decimal):
        return f"the number {value}"
    if isinstance(value, int):
        return "a whole number"
    if isinstance(value, str):
        return "a string"
    if isinstance(value, list):
        return "a list"
    return "a table" if isinstance(value, dict) else "a date or time"
