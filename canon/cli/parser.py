"""A parser of arguments whose errors say what to do instead, and end with exit status 3 (bad input)."""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections.abc import Iterator
from typing import Any, NoReturn

from canon.cli.spoken import shown

NOT_FOUND = 2
"""The exit status where the time was over before there was an answer."""
BAD_INPUT = 3
FLAW = 70
"""The exit status of an error that nobody has foreseen (EX_SOFTWARE of sysexits)."""
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

    def parse_args(  # pyright: ignore[reportIncompatibleMethodOverride] - it has overloads
        self, args: Any = None, namespace: Any = None
    ) -> Any:
        """Read the arguments. Of those that nobody knows the command that was meant says so, and not the program."""
        parsed, unknown = self.parse_known_args(args, namespace)
        if unknown:
            chosen = self._chosen(parsed)
            message, words = (
                f"unrecognized arguments: {' '.join(unknown)}",
                [word.partition("=")[0] for word in unknown],
            )
            chosen._refuse(message, chosen._nearest(words, self))
        return parsed

    def error(self, message: str) -> NoReturn:
        """Print the usage, the error and the nearest thing that exists, and exit with status 3."""
        unknown = re.search(r"invalid choice: '([^']*)'", message)
        self._refuse(message, "" if unknown is None else self._nearest(unknown[1].split(), self))

    def _refuse(self, message: str, advice: str) -> NoReturn:
        lines = [self.format_usage().rstrip(), shown(f"{self.prog}: error: {message}")]
        lines.append(f"{shown(advice)} See `{self.prog} --help`.".lstrip())
        self.exit(BAD_INPUT, "\n".join(lines) + "\n")

    def _nearest(self, words: list[str], top: Parser) -> str:
        """What may have been meant by words that this command doesn't know; never one of these themselves."""
        from difflib import get_close_matches

        every = list(top._below())
        for word in words:
            if owners := [parser.prog for parser in every if word.startswith("-") and word in parser._options()]:
                return f"{word} is an option of {', '.join(f'`{prog}`' for prog in owners)}, not of `{self.prog}`."
            others = [option for parser in every for option in parser._options()]
            choices = [choice for parser in self._below() for choice in parser._choices()]
            for known in (self._options(), others) if word.startswith("-") else (choices, self._options()):
                if near := get_close_matches(word, sorted(set(known) - {word}), n=1, cutoff=0.75):
                    return f"Did you mean {near[0]}?"
        return ""

    def _options(self) -> list[str]:
        return [option for action in self._actions for option in action.option_strings]

    def _choices(self) -> list[str]:
        return [str(choice) for action in self._actions for choice in action.choices or ()]

    def _chosen(self, parsed: argparse.Namespace) -> Parser:
        """The parser of the command that was named, and of what it was told to do."""
        for action in self._actions:
            if isinstance(action, argparse._SubParsersAction) and getattr(parsed, action.dest, None) in action.choices:
                return action.choices[getattr(parsed, action.dest)]._chosen(parsed)
        return self

    def _below(self) -> Iterator[Parser]:
        yield self
        for action in self._actions:
            if isinstance(action, argparse._SubParsersAction):
                for parser in action.choices.values():
                    yield from parser._below()


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
