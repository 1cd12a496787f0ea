"""Work that is given out in batches to any executor of `concurrent.futures`, and asked again where a worker is lost.

So many batches are out at a time that every worker has something to do, and no more, however much work there is. What a
lost worker had is asked again, item by item; an item whose worker is lost again is answered by who asks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
from typing import Any, Final, TypeVar

AHEAD: Final = 64
"""Batches that are out at a time."""

Item = TypeVar("Item")
Answer = TypeVar("Answer")


def answers(
    batches: Iterator[list[tuple[int, Item]]],
    executor: Executor,
    ask: Callable[..., list[Answer]],
    arguments: Sequence[Any],
    lost: Callable[[Item, BaseException], Answer],
) -> Iterator[tuple[int, Answer]]:
    """(number, answer) of each numbered item, as they come.

    **Arguments:** `batches`, taken only as they are needed; `ask(items, *arguments)`, which a worker calls and which
    answers each item; `lost(item, error)`, the answer where two workers were lost over an item, or the executor takes
    nothing more.
    """
    out: dict[Future[list[Answer]], list[tuple[int, Item]]] = {}
    again: list[tuple[int, Item]] = []
    alone: set[int] = set()
    try:
        while True:
            while len(out) < AHEAD:
                work = [again.pop()] if again else next(batches, [])
                if not work:
                    break
                try:
                    out[executor.submit(ask, [item for _, item in work], *arguments)] = work
                except Exception as error:  # a pool that is broken takes nothing more
                    yield from ((number, lost(item, error)) for number, item in work)
            if not out:
                return
            for future in wait(out, return_when=FIRST_COMPLETED).done:
                work = out.pop(future)
                error = CancelledError("it was called off") if future.cancelled() else future.exception()
                if error is None:
                    yield from zip((number for number, _ in work), future.result(), strict=True)
                    continue
                once_more = [(k, item) for k, item in work if k not in alone]
                yield from ((k, lost(item, error)) for k, item in work if k in alone)
                alone.update(k for k, _ in once_more)
                again += once_more
    finally:
        for future in out:
            future.cancel()
