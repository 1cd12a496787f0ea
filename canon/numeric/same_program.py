"""Whether two of jax's programs are one, operation by operation: their texts say it too, and take longer to write."""

from __future__ import annotations

from typing import Any

import numpy as np


def alike(first: Any, second: Any) -> bool:
    """Whether two programs (closed jaxprs) are seen to have the same operations, in order, on the same numbers.

    False says nothing: parameters that are programs or functions themselves, or arrays that are referred to, are not
    looked into.
    """
    if first.consts or second.consts or len(first.eqns) != len(second.eqns):
        return False
    one, other = first.jaxpr, second.jaxpr
    renamed: dict[Any, Any] = {}
    if [v.aval for v in one.invars] != [v.aval for v in other.invars]:
        return False
    renamed.update(zip(one.invars, other.invars, strict=True))
    for left, right in zip(one.eqns, other.eqns, strict=True):
        if left.primitive is not right.primitive or not _equal(left.params, right.params):
            return False
        if not _read(left.invars, right.invars, renamed) or len(left.outvars) != len(right.outvars):
            return False
        renamed.update(zip(left.outvars, right.outvars, strict=True))  # of one type, as their operands are
    return _read(one.outvars, other.outvars, renamed)


def _read(left: Any, right: Any, renamed: dict[Any, Any]) -> bool:
    """Whether operands are the same numbers, or counterparts."""
    if len(left) != len(right):
        return False
    return all(_counterparts(a, b, renamed) for a, b in zip(left, right, strict=True))


def _counterparts(a: Any, b: Any, renamed: dict[Any, Any]) -> bool:
    if not hasattr(a, "val"):
        return renamed.get(a) is b
    return hasattr(b, "val") and a.aval == b.aval and _bits(a.val) == _bits(b.val)


def _bits(number: Any) -> tuple[Any, bytes]:
    """A number's type and bits, by which 0.0 and -0.0 differ."""
    array = np.asarray(number)
    return array.dtype, array.tobytes()


def _equal(left: dict[str, Any], right: dict[str, Any]) -> bool:
    """Whether parameters are equal: those that are not plain data, only where they are one object."""
    return left.keys() == right.keys() and all(_one(value, right[name]) for name, value in left.items())


def _one(a: Any, b: Any) -> bool:
    if a is b:
        return True
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(_one, a, b))
    return type(a) is type(b) and isinstance(a, (bool, int, float, str)) and repr(a) == repr(b)
