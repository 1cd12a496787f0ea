"""The normal form: a residual's numerator modulo the relations of its kernels.

A numerator that reduces to 0 is a proof, on the whole region and on every branch that the written
formulas take there. A numerator that doesn't is no refutation.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from canon.budget import Budget
from canon.decide.fraction_field import Element, FractionField
from canon.decide.grouped_sums import GroupedSums
from canon.decide.ring import TooCostly
from canon.decide.tape import Node
from canon.decide.tower import Tower, combine

# Two ways of adding fractions and four sizes; neither way dominates, so each size tries both.
FIRST, LARGER = (3e5, 6e6), (4e7, 4e8)


def reduce_to_zero(
    tower: Tower, nodes: Sequence[Node], budget: Budget, sizes: Sequence[float] = FIRST + LARGER
) -> tuple[set[Node], dict[Node, Element], FractionField]:
    """The nodes that reduce to 0, and the nonzero normal forms of those that certainly don't reduce.

    Nodes in neither were too costly. Also returns the field in which the normal forms live.
    """
    zero: set[Node] = set()
    nonzero: dict[Node, Element] = {}
    field, kernels = tower.compact(sizes[0], budget)
    values: dict[Node, Any] = dict(kernels)
    left = list(nodes)
    divides = bool(tower.field.factors) or _divides(tower)
    for size in sizes:
        for grouped in (False, True) if divides else (False,):
            left = [node for node in left if node not in zero and node not in nonzero]
            if not left:
                return zero, nonzero, field
            budget.check()
            if grouped:
                zero |= _by_groups(tower, left, size, budget)
            else:
                field.ring.limit, field.ring.spent = size, 0.0
                found, rest = _by_fractions(tower, left, field, values)
                zero |= found
                nonzero.update(rest)
    return zero, nonzero, field


def _divides(tower: Tower) -> bool:
    ops = tower.tape.ops
    return any(e < 0 for i in tower.need if ops[i][0] == "*" for _, e in ops[i][1])


def _by_fractions(
    tower: Tower, nodes: Sequence[Node], field: FractionField, values: dict[Node, Any]
) -> tuple[set[Node], dict[Node, Element]]:
    """The nodes that reduce to 0, and what the others reduce to, where that isn't too costly.

    `values` are those of the kernels and of what an attempt before this one has left; they are added to.
    """
    zero: set[Node] = set()
    nonzero: dict[Node, Element] = {}
    tape = tower.tape
    kernels = tower.kernels
    for i, done in _steps(tower, nodes, values):
        # what is too costly, or needs what was, has no value
        with contextlib.suppress(TooCostly, ZeroDivisionError, KeyError):
            values[i] = combine(field, tape.ops[i], values)
            for j in done:
                if j not in kernels:
                    values.pop(j, None)
    for node in nodes:
        value = values.get(node)
        if value is None:
            continue
        remainder = _attempt(lambda value=value: (field.normal(value[0]), value[1]))
        if remainder is not None and not remainder[0]:
            zero.add(node)
        elif remainder is not None:
            nonzero[node] = remainder
    return zero, nonzero


def _steps(tower: Tower, nodes: Sequence[Node], values: Mapping[Node, Any]) -> list[tuple[Node, list[Node]]]:
    """What is left to be evaluated for the nodes, in order, each with those that nothing later needs."""
    kept, arguments = set(nodes), tower.tape.arguments
    need, stack = set(), [node for node in nodes if node not in values]
    while stack:
        node = stack.pop()
        if node not in need:
            need.add(node)
            stack.extend(a for a in arguments(node) if a not in values)
    order = sorted(need)
    last = {a: i for i in order for a in arguments(i)}
    done: dict[Node, list[Node]] = {}
    for a, i in last.items():
        if a not in kept:
            done.setdefault(i, []).append(a)
    return [(i, done.get(i, [])) for i in order]


def _by_groups(tower: Tower, nodes: Sequence[Node], size: float, budget: Budget) -> set[Node]:
    field, kernels = tower.compact(size, budget)
    sums = GroupedSums(field)
    values: dict[Node, Any] = {i: sums.lift(x) for i, x in kernels.items()}
    zero: set[Node] = set()
    ops, last = tower.tape.ops, _last_uses(tower, nodes)
    for i in tower.tape.reach(nodes):
        if i not in values:
            values[i] = _attempt(lambda i=i: sums.node(ops[i], values)) if _ready(tower, i, values) else None
        for j in last.get(i, ()):
            if j not in kernels:
                values.pop(j, None)
    for node in nodes:
        value = values[node]
        if value is not None and _attempt(lambda value=value: sums.is_zero(value)):
            zero.add(node)
    return zero


def _ready(tower: Tower, node: Node, values: dict[Node, Any]) -> bool:
    return all(values[a] is not None for a in tower.tape.arguments(node))


def _attempt(step: Callable[[], Any]) -> Any:
    try:
        return step()
    except (TooCostly, ZeroDivisionError):
        return None


def _last_uses(tower: Tower, nodes: Sequence[Node]) -> dict[Node, list[Node]]:
    """For each node, those whose last use it is (their values are let go after it)."""
    kept, last = set(nodes), {}
    for i in tower.tape.reach(nodes):
        for j in tower.tape.arguments(i):
            last[j] = i
    out: dict[Node, list[Node]] = {}
    for j, i in last.items():
        if j not in kept:
            out.setdefault(i, []).append(j)
    return out
