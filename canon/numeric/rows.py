"""Many formulas of few shapes as one small program: what differs by its coordinates and numbers alone is computed once,
on arrays.

The velocities p_i/m_i of a thousand bodies are one product of two arrays; a program with three thousand products would
take a minute to compile, and run interpreted.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.lower import lower, pair_values
from canon.numeric.pair_sum import PairSlope, PairSum


@dataclass
class _Group:
    """Formulas of one shape: for each the row that it is, and the coordinates and numbers that it has in place of
    `names` and `constants`."""

    formula: Any
    names: tuple[Any, ...]
    constants: tuple[Any, ...]
    rows: list[int] = field(default_factory=list)
    taken: list[list[int]] = field(default_factory=list)
    numbers: list[list[float]] = field(default_factory=list)


def lower_rows(
    expressions: Sequence[Any], coordinates: Sequence[sp.Symbol], scalars: Sequence[sp.Symbol] = ()
) -> Callable[..., Any]:
    """The jax function (z, *scalars) -> values (k, …) of the expressions, with z (n, …) the coordinates' values; with
    `numbers=numpy` it is computed by numpy, at once.

    **Raises:** `InputError` for a name that is neither, or a function that has no numerical form.
    """
    sums = tuple(dict.fromkeys(atom.of for e in expressions for atom in e.atoms(PairSlope)))
    totals = tuple(dict.fromkeys(atom for e in expressions for atom in e.atoms(PairSum)))
    index: dict[Any, int] = {symbol: k for k, symbol in enumerate(coordinates)}
    gathered = {of: np.array([index[x] for x in of.coordinates]) for of in (*sums, *totals)}
    for of in sums:
        first = len(index)
        index.update({PairSlope(of, k): first + k for k in range(len(of.coordinates))})
    index.update({of: len(index) + k for k, of in enumerate(totals)})
    groups = _grouped(expressions, index, {*scalars})
    programs = [lower((g.formula,), (*g.names, *g.constants, *scalars)) for g in groups]
    order = np.argsort(np.concatenate([g.rows for g in groups]), kind="stable") if groups else np.arange(0)

    def function(z: Any, *values: Any, numbers: Any = None) -> Any:
        import jax.numpy as jnp

        numbers = numbers or jnp
        given: Mapping[Any, Any] = dict(zip(scalars, values, strict=True))
        places = {of: z[_span(rows)].reshape(len(of.places), -1, *z.shape[1:]) for of, rows in gathered.items()}
        more = [pair_values(PairSlope(of, 0), given, places[of], numbers).reshape(-1, *z.shape[1:]) for of in sums]
        more += [pair_values(of, given, places[of], numbers)[None] for of in totals]
        arrays, starts = [z, *more], np.cumsum([0, *(len(x) for x in (z, *more))])
        found = []
        for group, program in zip(groups, programs, strict=True):
            taken = [_taken(arrays, starts, np.array(column), numbers) for column in zip(*group.taken, strict=True)]
            constants = [_spread(np.array(column), z.ndim) for column in zip(*group.numbers, strict=True)]
            (value,) = program(*taken, *constants, *values, numbers=numbers)
            found.append(numbers.broadcast_to(numbers.asarray(value, z.dtype), (len(group.rows), *z.shape[1:])))
        whole = found[0] if len(found) == 1 else numbers.concatenate(found)
        return whole if np.array_equal(order, np.arange(len(order))) else whole[order]

    return function


def same_shape(expressions: Sequence[Any], coordinates: Sequence[sp.Symbol], scalars: Sequence[sp.Symbol] = ()) -> bool:
    """Whether the formulas differ by coordinates and numbers alone."""
    index = {symbol: k for k, symbol in enumerate(coordinates)}
    if any(e.atoms(PairSlope, PairSum) for e in expressions):
        return False
    return len({_shape(e, index, {*scalars}, {}, []) for e in expressions}) == 1


def _span(rows: np.ndarray) -> Any:
    """Rows as a slice where they are one."""
    if len(rows) == 1:
        return slice(int(rows[0]), int(rows[0]) + 1)
    steps = np.unique(np.diff(rows))
    return slice(int(rows[0]), int(rows[-1]) + 1, int(steps[0])) if len(steps) == 1 and steps[0] > 0 else rows


def _taken(arrays: Sequence[Any], starts: np.ndarray, rows: np.ndarray, numbers: Any) -> Any:
    """Rows of several arrays, as if they were one below the other."""
    which = np.unique(np.searchsorted(starts, rows, side="right") - 1)
    if len(which) == 1:
        return arrays[which[0]][_span(rows - starts[which[0]])]
    return numbers.concatenate(arrays)[rows]


def _spread(numbers: np.ndarray, axes: int) -> Any:
    """Numbers along the first axis; one number where all are the same."""
    return float(numbers[0]) if np.all(numbers == numbers[0]) else numbers.reshape(-1, *(1,) * (axes - 1))


def _grouped(expressions: Sequence[Any], index: Mapping[Any, int], scalars: set[Any]) -> list[_Group]:
    groups: dict[Any, _Group] = {}
    for row, expression in enumerate(expressions):
        leaves: dict[Any, int] = {}
        numbers: list[Any] = []
        shape = _shape(expression, index, scalars, leaves, numbers)
        if shape not in groups:
            names = tuple(sp.Symbol(f"z{k}", real=True) for k in range(len(leaves)))
            constants = tuple(sp.Symbol(f"c{k}", real=True) for k in range(len(numbers)))
            replaced = _replaced(expression, dict(zip(leaves, names, strict=True)), iter(constants), scalars)
            groups[shape] = _Group(replaced, names, constants)
        group = groups[shape]
        group.rows.append(row)
        group.taken.append([index[leaf] for leaf in leaves])
        group.numbers.append([float(number) for number in numbers])
    return list(groups.values())


def _shape(expression: Any, index: Mapping[Any, int], scalars: set[Any], leaves: dict[Any, int], numbers: list) -> Any:
    """What is the same for formulas that differ by coordinates and numbers alone; these are listed as they come."""
    if expression in index:
        return ("z", leaves.setdefault(expression, len(leaves)))
    if expression.is_Symbol:
        if expression not in scalars:
            raise InputError(f"no value is given for {expression}: give one in `parameters`")
        return expression
    if not expression.args:
        if expression.is_real is False:
            raise InputError(f"{expression} is no real number")
        numbers.append(expression)
        return "c"
    if expression.is_Pow and expression.exp.is_Rational:
        return ("power", expression.exp, _shape(expression.base, index, scalars, leaves, numbers))
    return (expression.func, *(_shape(x, index, scalars, leaves, numbers) for x in expression.args))


def _replaced(expression: Any, names: Mapping[Any, Any], constants: Any, scalars: set[Any]) -> Any:
    """The same with names in place of coordinates and numbers, unevaluated so that it keeps its shape."""
    if expression in names:
        return names[expression]
    if expression in scalars:
        return expression
    if not expression.args:
        return next(constants)
    if expression.is_Pow and expression.exp.is_Rational:
        return sp.Pow(_replaced(expression.base, names, constants, scalars), expression.exp, evaluate=False)
    arguments = [_replaced(x, names, constants, scalars) for x in expression.args]
    return expression.func(*arguments, evaluate=False)
