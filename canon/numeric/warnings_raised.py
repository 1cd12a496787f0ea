"""Warnings are errors within a `with`, in this thread alone."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any


class _OfAThread(type):
    """Of such a class every class of warnings is one, where it is asked in the class's own thread."""

    thread: int

    def __subclasscheck__(cls, _: type) -> bool:
        return threading.get_ident() == cls.thread


@contextmanager
def warnings_raised() -> Iterator[None]:
    """What warns raises here, and only here.

    `warnings.catch_warnings` puts the list of filters back that it found: where two threads are within it, what is left
    may be the one's for ever, and meanwhile both have it. So each has a filter of its own, which is taken out again.
    """
    category = _OfAThread("Raised", (Warning,), {"thread": threading.get_ident()})
    warnings.simplefilter("error", category=category)
    try:
        yield
    finally:
        category.thread = 0  # no thread's number, should the filter have got into a list that is put back later
        filters: Any = warnings.filters
        with suppress(ValueError):
            filters.remove(("error", None, category, None, 0))
