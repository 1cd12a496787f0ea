"""Keys of a claim that it makes nothing of are input errors: what they say would pass for shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def none_idle(question: Question, belongs: str, *words: str) -> None:
    """None of these keys is given. **Raises** `InputError` with what they belong to, which isn't in the claim."""
    for word in words:
        if question.key(word) is not None:
            raise InputError(f"{word!r} belongs to {belongs}, and is no part of this claim", f"key {word!r}")
