"""What is demanded of names and holds by what is assumed of them: log(m) is real for every positive m.

Such a condition isn't one of a formula's domain, since all points that are looked at satisfy it. But claims put other
things in a name's place, or are made at its 0, where the assumption doesn't hold; and in 0·log(m) the name shows
neither in the value nor in a condition. So a formula keeps the operations that demanded nothing, and here is asked what
they would have demanded of names of which nothing is assumed but that they are real.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.domain import Condition, function_conditions, power_conditions
from canon.errors import InputError
from canon.substitution import replaced

Operation: TypeAlias = tuple[Any, tuple[Any, ...]]
"""A power or a function of the language, with its arguments; or `AppliedUndef` with the call of an arbitrary one."""


def freed_conditions(operation: Operation, names: Collection[sp.Symbol]) -> tuple[Condition, ...]:
    """Where the operation is smooth, of these names only known to be real. **Raises:** `InputError` if nowhere."""
    function, arguments = operation
    if function is AppliedUndef:
        return ()
    plain = {name: sp.Dummy(name.name, real=True) for name in names}
    freed: Any = tuple(argument.xreplace(plain) for argument in arguments)
    found = power_conditions(*freed) if function is sp.Pow else function_conditions(function, freed)
    back: dict[sp.Expr, sp.Expr] = {dummy: name for name, dummy in plain.items()}
    return tuple(condition.substitute(back) for condition in found)


def is_limited(name: Any) -> bool:
    """Whether more is assumed of a name than that it is real: it has one sign, isn't 0, or is whole."""
    signed = name.is_nonnegative or name.is_nonpositive or name.is_zero is False
    return isinstance(name, sp.Symbol) and bool(signed or name.is_integer)


def leant_on(operations: Iterable[Operation], but: Collection[Any] = ()) -> set[sp.Symbol]:
    """The names on whose assumptions the operations rest; `but` those of which that isn't asked."""
    found = set[sp.Symbol]()
    for operation in operations:
        names = {name for argument in operation[1] for name in argument.free_symbols if is_limited(name)}
        names = {name for name in names if name not in but and name not in found}
        if names and _rests_on(operation, names):
            found |= names
    return found


def _rests_on(operation: Operation, names: Collection[sp.Symbol]) -> bool:
    try:
        return bool(freed_conditions(operation, names))
    except InputError:
        return True


def called(operations: Iterable[Operation]) -> Iterator[Any]:
    """The calls of arbitrary functions, also those that show no more, as in 0·x(0), which has x(0) for a value."""
    yield from (arguments[0] for function, arguments in operations if function is AppliedUndef)


def moved(operations: Iterable[Operation], mapping: Mapping[Any, Any]) -> tuple[Operation, ...]:
    """The operations that may rest on assumptions, with what `mapping` says put in their arguments."""
    return tuple(
        (function, tuple(replaced(part, mapping) for part in parts))
        for function, parts in operations
        if function is AppliedUndef or any(is_limited(name) for part in parts for name in part.free_symbols)
    )
