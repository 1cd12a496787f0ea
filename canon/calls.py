"""Calls of functions of which nothing is known, with derivatives by their places.

Of f(x(t) + a, t + s) sympy writes ∂₁f as a derivative by one name that stands for a place, the other argument as it is.
What sympy 1.14 makes of the derivative of that by t has a name of its own in it (`_s + t`) that nothing is put in for,
so that mixed derivatives aren't symmetric. Here all arguments get a name by their place, unless they are names, each
another one; and a derivative of such a derivative is one by places, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction


@cache
def _place(k: int) -> sp.Dummy:
    """The name that stands for the k-th argument, 1 for the first."""
    return sp.Dummy(f"xi_{k}")


def derivative_of(call: Any, orders: Sequence[int], arguments: Sequence[Any]) -> Any:
    """The derivative of so many orders by each place, at the arguments: `call` makes one of the function."""
    if not any(orders):
        return call(*arguments)
    plain = len({*arguments}) == len(arguments) and all(argument.is_Symbol for argument in arguments)
    names = tuple(arguments) if plain else tuple(_place(k) for k in range(1, len(arguments) + 1))
    counted = [(name, n) for name, n in zip(names, orders, strict=True) if n]
    slope = sp.Derivative(call(*names), *counted, evaluate=False) if sum(orders) == 1 else call(*names).diff(*counted)
    return slope if plain else Placed(slope, names, tuple(arguments))


def at_places(slope: Any) -> tuple[Any, list[int], list[Any]] | None:
    """Function, orders and arguments of a derivative of a call, also one that sympy has written; None for any other."""
    inner = slope.expr if isinstance(slope, sp.Subs) else slope
    if not isinstance(inner, sp.Derivative) or not isinstance(inner.expr, AppliedUndef):
        return None
    call: Any = inner.expr
    orders = [0] * len(call.args)
    counts: Any = inner.variable_count
    for name, n in counts:
        places = [k for k, argument in enumerate(call.args) if argument.has(name)]
        if len(places) != 1 or call.args[places[0]] != name or not n.is_Integer:
            return None
        orders[places[0]] += int(n)
    at = _put_in(slope) if isinstance(slope, sp.Subs) else {}
    return call.func, orders, [argument.xreplace(at) for argument in call.args]


def _put_in(slope: Any) -> dict[Any, Any]:
    return dict(zip(slope.variables, slope.point, strict=True))


class Placed(sp.Subs):
    """A derivative by places at the arguments: the chain rule is all that there is to it."""

    def _eval_derivative(self, s: Any) -> Any:
        if (found := at_places(self)) is None:
            return self.doit().diff(s)
        call, orders, arguments = found
        total: Any = sp.S.Zero
        for k, argument in enumerate(arguments):
            further = [n + (j == k) for j, n in enumerate(orders)]
            total += argument.diff(s) * derivative_of(call, further, arguments)
        return total

    def _hashable_content(self) -> tuple[Any, ...]:
        """What it consists of; by sympy, places where the same stands have one name: ∂₁f(t, t) would be ∂₂f(t, t)."""
        return self.args

    def doit(self, **hints: Any) -> Any:
        """The value, where a function has been put in; else there is nothing to be evaluated."""
        if at_places(self) is not None:
            return self
        at = _put_in(self)
        inner: Any = self.expr
        return inner.doit(**hints).xreplace(at)


class _Call(AppliedUndef):
    """A call whose partial derivatives are taken at its places."""

    def fdiff(self, argindex: int = 1) -> Any:
        orders = [int(k == argindex) for k in range(1, len(self.args) + 1)]
        return derivative_of(self.func, orders, self.args)


def function(name: str) -> Any:
    """The function of this name, to be called with any arguments. It isn't equal to sympy's own of this name.

    Equal ones would be one in sympy's cache: what it answers for the derivative of the other would come back here.
    """
    return UndefinedFunction(name, bases=(_Call,), by_places=True)
