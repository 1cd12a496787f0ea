"""What can go wrong between a claim and its verdict, other than the verdict itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from canon.verdict import Verdict

NO_NUMBER: Final = (TypeError, ValueError, OverflowError, IndexError)
"""What Python, numpy and sympy raise where a float is made of what is no number: an IndexError of a function of
sympy's (`Lambda`)."""


class CanonError(Exception):
    """Every error that this package raises on purpose."""


class InputError(CanonError):
    """The input is malformed or ill-posed, so that there is nothing to give a verdict on.

    **Arguments:** `message`, a sentence for the author of the input; `where`, the place in it
    ("claim 2, key 'f'"), empty if there is none to name.
    """

    def __init__(self, message: str, where: str = "") -> None:
        super().__init__(message, where)
        self.message = message
        self.where = where

    def __str__(self) -> str:
        return f"{self.where}: {self.message}" if self.where else self.message

    def at(self, where: str) -> InputError:
        """The same error at `where`, put before the place that it already names."""
        place = ", ".join(part for part in (where, self.where) if part)
        return InputError(self.message, place)


class EmptyDomain(InputError):
    """No point was found at which the claim is made."""


class NoValue(InputError):
    """A map has no finite value at any point at which it was tried, or raises at each."""


class BudgetExceeded(CanonError):
    """The time given to a claim is spent."""


class ClaimFailed(CanonError):
    """A claim that was required to be proved isn't: `verdict` says what is known instead."""

    def __init__(self, verdict: Verdict) -> None:
        super().__init__(verdict)
        self.verdict = verdict

    def __str__(self) -> str:
        return str(self.verdict)
