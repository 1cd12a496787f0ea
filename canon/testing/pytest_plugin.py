"""Claim files as tests: `pytest claims/*.toml`, in a project that asks for it in its pytest configuration.

    [tool.pytest.ini_options]
    canon_claims = ["claims/*.toml"]

Without that line nothing is collected, and nothing beyond this file is imported.
"""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from canon.claim import Claim

PATTERNS = "canon_claims"
BUDGET = "canon_budget"
LONGEST = 200
"""Characters of the name of a test."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Declare the options of the configuration file."""
    parser.addini(
        PATTERNS,
        "claim files to collect as tests, as patterns relative to the root folder (`*` matches folders too)",
        type="linelist",
        default=[],
    )
    parser.addini(BUDGET, "seconds for each claim that has no budget of its own", default="10")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> ClaimFile | None:
    """A claim file, where a pattern matches it or the command line names it and there are patterns."""
    if file_path.suffix != ".toml":
        return None
    patterns = parent.config.getini(PATTERNS)
    if not patterns:
        return None
    if parent.session.isinitpath(file_path) or any(fnmatch(_below(file_path, parent), p) for p in patterns):
        return ClaimFile.from_parent(parent, path=file_path)
    return None


def _below(path: Path, parent: pytest.Collector) -> str:
    root = parent.config.rootpath
    return path.relative_to(root).as_posix() if path.is_relative_to(root) else path.as_posix()


class ClaimAgainstExpectation(Exception):
    """A claim whose verdict isn't what its author expects; the text is what a reader needs to see."""


class ClaimFile(pytest.File):
    """A claim file: a test for each claim, and one that fails for each fault of input."""

    def collect(self) -> Iterator[pytest.Item]:
        """Read the file; its faults are tests too, so that they don't hide the claims that can be read."""
        from canon.claims.reader import read_file

        reading = read_file(self.path)
        lines = _lines_of_claims(self.path) if reading.claims else []  # else it may be no file that can be read
        for claim in reading.claims:
            name = _plain(f"{claim.index + 1} {claim.title or claim.kind}")
            line = lines[claim.index] if claim.index < len(lines) else None
            yield ClaimItem.from_parent(self, name=name, claim=claim, line=line)
        for problem in reading.problems:
            yield FaultItem.from_parent(
                self, name=_plain(f"input: {problem['where'] or 'the file'}"), message=problem["message"]
            )


class ClaimItem(pytest.Item):
    """One claim, decided as `canon verify` decides it; it passes where its expectation is met."""

    def __init__(self, *, claim: Claim, line: int | None, **given: Any) -> None:
        super().__init__(**given)
        self.claim = claim
        self.line = line

    def runtest(self) -> None:
        """Verify the claim; **raises** where the verdict is another than expected, or the claim is ill-posed."""
        from canon.claims.verify import verify
        from canon.errors import InputError

        try:
            verdict = verify(self.claim, budget=_budget(self.config))
        except InputError as error:
            where = error.where or f"claim {self.claim.index + 1}"
            raise ClaimAgainstExpectation(f"input error, {where}: {error.message}") from None
        if not self.claim.is_met_by(verdict.status):
            expected = "to hold" if self.claim.expect == "holds" else "to fail"
            if self.claim.expect not in ("holds", "fails"):
                expected = f"to be {self.claim.expect}"
            raise ClaimAgainstExpectation(f"claim {self.claim.index + 1} was expected {expected}\n{verdict}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The refutation, without the stack of calls that found it."""
        if isinstance(excinfo.value, ClaimAgainstExpectation):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where the claim stands."""
        return self.path, self.line, self.name


class FaultItem(pytest.Item):
    """A fault of input, as a test that fails."""

    def __init__(self, *, message: str, **given: Any) -> None:
        super().__init__(**given)
        self.message = message

    def runtest(self) -> None:
        """**Raises** with what is wrong."""
        raise ClaimAgainstExpectation(f"{self.name}: {self.message}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The message alone."""
        return str(excinfo.value)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """The file."""
        return self.path, None, self.name


def _budget(config: pytest.Config) -> float:
    text = str(config.getini(BUDGET))
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < float("inf"):
        raise pytest.UsageError(f"{BUDGET} is a number of seconds greater than 0, not {text!r}")
    return seconds


def _plain(name: str) -> str:
    """A name from a file as that of a test: on one line, without what a terminal or pytest would take for its own."""
    line = " ".join(name.split()).replace("::", ":")
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in line)[:LONGEST]


def _lines_of_claims(path: Path) -> list[int]:
    """The lines (from 0) on which the claims begin."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return []
    return [number for number, line in enumerate(text.splitlines()) if line.strip().startswith("[[claim]]")]
