"""How large formulas of sympy's may be: what keeps Python's claims within the time and memory that they are given.

sympy shares subexpressions, but walks them as trees: thirty squares of sums, one in the other, are sixty objects and
2³⁰ steps of `has`, before anybody looks at a clock. So each distinct object is looked at once here, by its identity,
without recursion, and what is too large or too deep is refused before sympy is asked anything about it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Final, TypeAlias

import sympy as sp

from canon.errors import InputError
from canon.measure import LARGEST, STEEPEST
from canon.syntax import BITS

TALLEST: Final = 100
"""The most levels of a formula's tree: sympy takes several of Python's for each."""

Extent: TypeAlias = tuple[int, int]
"""The nodes of a formula's tree, and its levels."""


def extent_of(expression: Any, images: Mapping[Any, Extent] | None = None) -> Extent:
    """The extent of a formula, or of what it becomes where formulas of these extents are put in for names.

    **Raises:** `InputError` for a number or a numerical exponent that is too large.
    """
    known: dict[int, Extent] = {}
    put_in = images or {}
    stack = [expression]
    while stack:
        node = stack[-1]
        if id(node) in known:
            stack.pop()
            continue
        parts = node.args
        missing = [part for part in parts if id(part) not in known]
        if missing:
            stack.extend(missing)
            continue
        stack.pop()
        if not parts:
            _check_number(node)
            known[id(node)] = put_in.get(node, (1, 1)) if node.is_Symbol else (1, 1)
            continue
        if isinstance(node, sp.Pow):
            _check_exponent(node.exp)
        inner = [known[id(part)] for part in parts]
        known[id(node)] = 1 + sum(size for size, _ in inner), 1 + max(depth for _, depth in inner)
    return known[id(expression)]


def check_extent(expression: Any, images: Mapping[Any, Extent] | None = None, where: str = "") -> Extent:
    """The extent, of `extent_of`; **raises** `InputError` where it is too large."""
    try:
        size, depth = extent_of(expression, images)
    except InputError as error:
        raise error.at(where) from None
    if size > LARGEST:
        raise InputError(f"too large: more than {LARGEST} operations", where)
    if depth > TALLEST:
        raise InputError(f"nested more than {TALLEST} levels deep", where)
    return size, depth


@contextmanager
def recursion_told(where: str = "") -> Iterator[None]:
    """Python's limit of recursion, where sympy comes upon it, is an error of input: the formula is too deep for it."""
    try:
        yield
    except RecursionError:
        limit = sys.getrecursionlimit()
        raise InputError(f"nested too deeply for Python's limit of recursion, which is {limit} here", where) from None


def _check_number(node: Any) -> None:
    if isinstance(node, sp.Rational) and max(_bits(node.p), _bits(node.q)) > BITS:
        raise InputError(f"a number of more than {BITS} bits")


def _check_exponent(exponent: Any) -> None:
    if isinstance(exponent, sp.Rational) and max(abs(int(exponent.p)), int(exponent.q)) > STEEPEST:
        raise InputError(f"an exponent above {STEEPEST}, or a root of that order")


def _bits(integer: Any) -> int:
    length: Callable[[], int] = int(integer).bit_length
    return length()
