"""A parser of arguments whose errors say what to do instead, and end with exit status 3 (bad input)."""

from __future__ import annotations

import argparse
import math
import re
import sys
from typing import Any, NoReturn

from canon.cli.spoken import shown

BAD_INPUT = 3
NO_RESOURCES = 71
"""The exit status where the system gives no more memory, files or processes (EX_OSERR of sysexits)."""
NOT_WRITTEN = 74
"""The exit status where the output could not be written: the disk is full, most likely (EX_IOERR of sysexits)."""


class Parser(argparse.ArgumentParser):
    """`argparse.ArgumentParser`, but no abbreviated options, and errors with advice and exit status 3."""

    def __init__(self, **settings: object) -> None:
        super().__init__(**{"allow_abbrev": False, **settings})  # type: ignore[arg-type]
        # a value that begins as a negative number does is no option: -1/4, as -0.25
        self._negative_number_matcher = re.compile(r"-[\d.]")

    def print_help(self, file: Any = None) -> None:
        """Print the help; where that can't be written, it is an error, which argparse would keep to itself."""
        (sys.stdout if file is None else file).write(self.format_help())

    def error(self, message: str) -> NoReturn:
        """Print the usage, the error and the nearest thing that exists, and exit with status 3."""
        lines = [self.format_usage().rstrip(), shown(f"{self.prog}: error: {message}")]
        advice = self._advice(message)
        lines.append(f"{advice} See `{self.prog} --help`." if advice else f"See `{self.prog} --help`.")
        self.exit(BAD_INPUT, "\n".join(lines) + "\n")

    def _advice(self, message: str) -> str:
        from difflib import get_close_matches

        unknown = re.search(r"unrecognized arguments: (.+)|invalid choice: '([^']*)'", message)
        if unknown is None:
            return ""
        words = [word.partition("=")[0] for word in (unknown[1] or unknown[2] or "").split()]
        options = [option for action in self._every_action() for option in action.option_strings]
        choices = [str(choice) for action in self._every_action() for choice in action.choices or ()]
        for word in words:
            known = options if word.startswith("-") else options + choices
            if near := get_close_matches(word, known, n=1, cutoff=0.75):
                return f"Did you mean {near[0]}?"
        return ""

    def _every_action(self) -> list[argparse.Action]:
        actions = list(self._actions)
        for action in self._actions:
            if isinstance(action, argparse._SubParsersAction):
                for sub in action.choices.values():
                    actions += sub._actions
        return actions


def positive(text: str, *, wanted: str = "positive number: give one as 0.01") -> float:
    """Read a number above 0; `wanted` ends the message about what is none."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (value > 0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text!r} is no {wanted}")
    return value


def seconds(text: str) -> float:
    """Read a time in seconds, more than 0."""
    return positive(text, wanted="number of seconds: give one above 0, as 2.5")


def count(text: str) -> int:
    """Read a whole number, at least 1."""
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise argparse.ArgumentTypeError(f"{text!r} is no count: give a whole number from 1 on")
    return int(text)


def whole(text: str) -> int:
    """Read a whole number, 0 or more."""
    if not (text.isascii() and text.isdigit() and len(text) < 20):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 0 on")
    return int(text)
