"""Claim files read by the workers of an executor: to read a claim takes a fifth of the time that deciding it takes.

A claim comes back as the bytes of a message, beside what a report needs of it. Who asked sends the bytes on to the
worker that decides the claim, and doesn't open them.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import replace
from typing import Final, NamedTuple

from canon.claim import Claim
from canon.claims.batches import answers
from canon.turns import in_turn

MOST: Final = 16
"""Files that travel together."""
LARGEST: Final = 200_000
"""Characters of text after which a message is sent."""


class Sent(NamedTuple):
    """A claim that another process has read: what a report needs of it (`claim`, without subject and keys), and all."""

    claim: Claim
    message: bytes

    def opened(self) -> Claim:
        """The claim itself. The message was made by a worker of this run: nothing that was stored is opened."""
        return pickle.loads(self.message)  # noqa: S301 - our own, of this moment


class Found(NamedTuple):
    """What a file holds: its claims, and its faults as {where, message}."""

    claims: list[Sent]
    problems: list[dict[str, str]]


def read_many(texts: Iterable[str], executor: Executor) -> Iterator[tuple[int, Found]]:
    """What each document holds, as `read_text` reads it, with its place in the order of `texts`, as they come.

    A document that takes two workers along, or stops the reader, has that for its fault.
    """
    yield from answers(_batches(texts), executor, read_here, (), _lost)


def _batches(texts: Iterable[str]) -> Iterator[list[tuple[int, str]]]:
    batch: list[tuple[int, str]] = []
    size = 0
    for number, text in enumerate(texts):
        batch.append((number, text))
        size += len(text)
        if len(batch) == MOST or size > LARGEST:
            yield batch
            batch, size = [], 0
    if batch:
        yield batch


def read_here(texts: list[str]) -> list[Found]:
    """What a batch of documents holds: what a worker does."""
    with in_turn():
        return [_read(text) for text in texts]


def _read(text: str) -> Found:
    from canon.claims.reader import read_text  # which who asks doesn't need

    try:
        read = read_text(text)
    except Exception as error:
        return Found([], [stopped(error)])
    return Found([_sent(claim) for claim in read.claims], read.problems)


def stopped(error: BaseException) -> dict[str, str]:
    """The fault of a file over which the reader failed: it keeps no other file from being read."""
    return {"where": "", "message": f"this file stopped the reader, which is a flaw of canon: {_words(error)}"}


def _sent(claim: Claim) -> Sent:
    return Sent(replace(claim, subject=None, keys={}), pickle.dumps(claim))


def _lost(_: str, error: BaseException) -> Found:
    return Found([], [{"where": "", "message": f"not read: its worker was lost twice ({_words(error)})"[:300]}])


def _words(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"
