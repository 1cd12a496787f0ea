"""What was probably meant by a file that is not TOML: the mistakes that people make who write it by hand."""

from __future__ import annotations

import re
from typing import Final

TABLES: Final = ("claim", "effect", "body", "rigid_body")
"""The tables of which there may be several."""

_TWICE: Final = re.compile(r"Cannot declare \('(\w+)',\) twice")
_LINE: Final = re.compile(r"at line (\d+), column \d+")
_BARE: Final = re.compile(r"\s*[\w.-]+\s*=\s*[-+(]*[\w.]")
"""A key with a value that begins as a formula does, without quotes."""
_WORDS: Final = ("true", "false", "inf", "nan")


def toml_advice(reason: str, text: str) -> str:
    """Advice to end the message with, or nothing; `reason` is what the reader of TOML says of `text`."""
    if twice := _TWICE.search(reason):
        name = twice[1]
        return f": write [[{name}]], in double brackets, for each" if name in TABLES else ": each section stands once"
    place = _LINE.search(reason)
    lines = text.splitlines()
    line = lines[int(place[1]) - 1] if place and int(place[1]) <= len(lines) else ""
    if "Cannot overwrite a value" in reason:
        return ": a key stands once in its section"
    if reason.startswith(("Invalid value", "Expected newline or end of document")) and _BARE.match(line):
        value = line.partition("=")[2].strip()
        return "" if value in _WORDS else ": a formula is written in quotes, and a number without a unit"
    return ""
