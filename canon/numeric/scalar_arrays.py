"""Operations of jax on arrays whose entries are nodes of a program.

What moves numbers about (slices, transposes, gathers) is carried out here, once, on the nodes themselves; arithmetic
becomes operations of the program, entry by entry.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, Final

import numpy as np

from canon.program import BINARY, PREDICATES, UNARY, Builder, Node

Array = np.ndarray

_SAME: Final = {
    "add_any": "add",
    "lt": "less",
    "le": "less_equal",
    "eq": "equal",
}
_SWAPPED: Final = {"gt": "less", "ge": "less_equal"}
MOVES: Final = frozenset(
    [
        *("broadcast_in_dim", "reshape", "squeeze", "expand_dims", "transpose", "concatenate", "slice", "rev", "copy"),
        *("gather", "dynamic_slice", "scatter", "dynamic_update_slice", "pad", "copy_p", "split", "stack", "unstack"),
        "tile",
    ]
)


WHOLE: Final[dict[str, Callable[..., Array]]] = {
    "add": lambda params, a, b: np.asarray(a + b),
    "sub": lambda params, a, b: np.asarray(a - b),
    "mul": lambda params, a, b: np.asarray(a * b),
    "lt": lambda params, a, b: np.asarray(a < b),
    "le": lambda params, a, b: np.asarray(a <= b),
    "gt": lambda params, a, b: np.asarray(a > b),
    "ge": lambda params, a, b: np.asarray(a >= b),
    "eq": lambda params, a, b: np.asarray(a == b),
    "ne": lambda params, a, b: np.asarray(a != b),
    "and": lambda params, a, b: np.asarray(a & b),
    "or": lambda params, a, b: np.asarray(a | b),
    "select_n": lambda params, which, *cases: np.choose(np.asarray(which, int), cases),
    "convert_element_type": lambda params, a: np.asarray(a != 0 if np.dtype(params["new_dtype"]).kind == "b" else a),
}
"""Operations on whole numbers that are known, such as those that count turns of a loop: jax would compile each."""


class Unscalar(Exception):
    """The function is no straight-line program of scalars."""


@dataclass(frozen=True)
class Traced:
    """An array whose entries are nodes of the program."""

    nodes: Array

    @property
    def shape(self) -> tuple[int, ...]:
        return self.nodes.shape


Value = Traced | Array
"""An array of nodes, or one that is known: integers and truth values that do not depend on the point."""


def known(value: Any) -> Array:
    array = np.asarray(value)
    if (array.dtype.kind == "f" and array.dtype != np.float64) or array.dtype.kind not in "fiub":
        raise Unscalar(f"numbers of type {array.dtype}")
    return array


def lifted(builder: Builder, value: Value) -> Traced:
    """Known numbers as nodes; truth values as the comparison of two numbers."""
    if isinstance(value, Traced):
        return value
    flat = []
    for x in value.ravel():
        if value.dtype == bool:
            flat.append(builder.apply("equal", builder.number(1.0 if x else 0.0), builder.number(1.0)))
        else:
            flat.append(builder.number(float(x)))
    return Traced(np.array(flat, dtype=int).reshape(value.shape))


def moved(builder: Builder, equation: Any, operands: list[Value]) -> list[Value]:
    """Move numbers about: the operation itself, applied to the nodes' positions."""
    positions = [x.nodes if isinstance(x, Traced) else x for x in operands]
    if any(isinstance(x, Traced) for x in operands):
        for k, x in enumerate(operands):
            index = equation.primitive.name in _INDICES and k in _INDICES[equation.primitive.name](len(operands))
            if isinstance(x, Traced) and index:
                raise Unscalar(f"{equation.primitive.name} at an index that depends on the point")
            if not isinstance(x, Traced) and not index:
                positions[k] = lifted(builder, x).nodes
        found = _bound(equation, positions)
        return [Traced(np.asarray(x)) for x in found]
    return [np.asarray(x) for x in _bound(equation, positions)]


_INDICES: Final[dict[str, Callable[[int], range]]] = {
    "gather": lambda count: range(1, 2),
    "scatter": lambda count: range(1, 2),
    "dynamic_slice": lambda count: range(1, count),
    "dynamic_update_slice": lambda count: range(2, count),
}
"""Which operands are indices."""


def _bound(equation: Any, arrays: list[Array]) -> list[Any]:
    name, params = equation.primitive.name, equation.params
    (x, *_) = arrays
    if name == "broadcast_in_dim":
        shape, axes = params["shape"], params["broadcast_dimensions"]
        opened = [1] * len(shape)
        for axis, length in zip(axes, x.shape, strict=True):
            opened[int(axis)] = length
        return [np.broadcast_to(x.reshape(opened), shape)]
    if name == "reshape":
        return [x.reshape(params["new_sizes"])]
    if name in ("squeeze", "expand_dims", "copy", "copy_p"):
        return [x.reshape(equation.outvars[0].aval.shape)]
    if name == "transpose":
        return [x.transpose(params["permutation"])]
    if name == "concatenate":
        return [np.concatenate(arrays, axis=params["dimension"])]
    if name == "stack":
        return [np.stack(arrays, axis=params["axis"])]
    if name == "slice":
        strides = params["strides"] or (1,) * x.ndim
        bounds = zip(params["start_indices"], params["limit_indices"], strides, strict=True)
        return [x[tuple(slice(a, b, c) for a, b, c in bounds)]]
    if name == "rev":
        return [np.flip(x, params["dimensions"])]
    if name in ("dynamic_slice", "dynamic_update_slice"):
        return [_slice_at(arrays, params.get("slice_sizes"))]
    found = equation.primitive.bind(*arrays, **params)
    return list(found) if equation.primitive.multiple_results else [found]


def _slice_at(arrays: list[Array], sizes: Sequence[int] | None) -> Array:
    """A slice of known size at known indices, which are moved until it fits; or an array with one replaced."""
    x, *rest = arrays
    update = None if sizes is not None else rest.pop(0)
    sizes = update.shape if update is not None else sizes or ()
    begins = [min(max(int(k), 0), n - size) for k, n, size in zip(rest, x.shape, sizes, strict=True)]
    where = tuple(slice(begin, begin + size) for begin, size in zip(begins, sizes, strict=True))
    if update is None:
        return x[where]
    new = x.copy()
    new[where] = update
    return new


def _elementwise(builder: Builder, name: str, operands: Sequence[Traced]) -> Traced:
    shape = np.broadcast_shapes(*(x.shape for x in operands))
    columns = [np.broadcast_to(x.nodes, shape).ravel() for x in operands]
    nodes = [builder.apply(name, *(int(a) for a in row)) for row in zip(*columns, strict=True)]
    return Traced(np.array(nodes, dtype=int).reshape(shape))


def computed(builder: Builder, equation: Any, operands: list[Value]) -> Traced:
    """An operation on numbers, entry by entry."""
    name, params = equation.primitive.name, equation.params
    if name in ("convert_element_type", "stop_gradient", "reduce_precision"):
        if equation.outvars[0].aval.dtype != np.float64 or name == "reduce_precision":
            raise Unscalar(name)
        (value,) = operands
        if isinstance(value, Traced) and any(_truth(builder, int(node)) for node in value.nodes.ravel()):
            one, zero = (Traced(np.full(value.shape, builder.number(x), dtype=int)) for x in (1.0, 0.0))
            return _elementwise(builder, "select", [value, one, zero])
        return lifted(builder, value)
    if name == "select_n" and len(operands) == 3:
        which, no, yes = operands
        if not isinstance(which, Traced):
            no, yes = lifted(builder, no), lifted(builder, yes)
            return Traced(np.where(which, yes.nodes, no.nodes))
        return _elementwise(builder, "select", [which, lifted(builder, yes), lifted(builder, no)])
    if name == "scatter-add":
        return _scattered_sum(builder, equation, operands)
    x = [lifted(builder, value) for value in operands]
    if name in _SAME or name in BINARY or name in UNARY:
        return _elementwise(builder, _SAME.get(name, name), x)
    if name in _SWAPPED:
        return _elementwise(builder, _SWAPPED[name], x[::-1])
    if name in _COMPOSED:
        return _each(x[0], lambda a: _COMPOSED[name](builder, a))
    if name == "integer_pow":
        return _each(x[0], lambda a: builder.power(a, int(params["y"])))
    if name == "round":
        if params["rounding_method"].value != 1:
            raise Unscalar("rounding away from zero")
        return _elementwise(builder, "round", x)
    if name == "ne":
        return _elementwise(builder, "not", [_elementwise(builder, "equal", x)])
    if name == "clamp":
        low, value, high = x
        return _elementwise(builder, "min", [_elementwise(builder, "max", [value, low]), high])
    if name in _REDUCTIONS:
        return _reduced(builder, _REDUCTIONS[name], x[0], params["axes"])
    if name == "cumsum":
        return _running_sums(builder, x[0], params["axis"], params["reverse"])
    if name == "dot_general":
        return _dot(builder, x[0], x[1], params["dimension_numbers"])
    raise Unscalar(f"the operation {name}")


def _truth(builder: Builder, node: Node) -> bool:
    return builder.operations[node].name in PREDICATES


def _each(x: Traced, rule: Callable[[Node], Node]) -> Traced:
    return Traced(np.array([rule(int(a)) for a in x.nodes.ravel()], dtype=int).reshape(x.shape))


_COMPOSED: Final[dict[str, Callable[[Builder, Node], Node]]] = {
    "square": lambda b, x: b.power(x, 2),
    "rsqrt": lambda b, x: b.apply("div", b.number(1.0), b.apply("sqrt", x)),
    "exp2": lambda b, x: b.apply("pow", b.number(2.0), x),
    "logistic": lambda b, x: b.apply(
        "div", b.number(1.0), b.apply("add", b.number(1.0), b.apply("exp", b.apply("neg", x)))
    ),
}
_REDUCTIONS: Final = {
    "reduce_sum": "add",
    "reduce_prod": "mul",
    "reduce_max": "max",
    "reduce_min": "min",
    "reduce_and": "and",
    "reduce_or": "or",
}


def _reduced(builder: Builder, name: str, x: Traced, axes: Sequence[int]) -> Traced:
    kept = [axis for axis in range(x.nodes.ndim) if axis not in axes]
    rows = x.nodes.transpose((*kept, *axes)).reshape((*(x.shape[axis] for axis in kept), -1))
    if not rows.shape[-1]:
        raise Unscalar("a sum of nothing")
    shape = rows.shape[:-1]
    nodes = [reduce(lambda a, b: builder.apply(name, int(a), int(b)), row) for row in rows.reshape(-1, rows.shape[-1])]
    return Traced(np.array(nodes, dtype=int).reshape(shape))


def _running_sums(builder: Builder, x: Traced, axis: int, backwards: bool) -> Traced:
    rows = np.moveaxis(np.flip(x.nodes, axis) if backwards else x.nodes, axis, 0).copy()
    for k in range(1, len(rows)):
        rows[k] = _elementwise(builder, "add", [Traced(rows[k - 1]), Traced(rows[k])]).nodes
    result = np.moveaxis(rows, 0, axis)
    return Traced(np.flip(result, axis) if backwards else result)


def _scattered_sum(builder: Builder, equation: Any, operands: list[Value]) -> Traced:
    """An array with updates added to some of its entries: where each goes is seen by sending a 1 there."""
    import jax

    target, index, updates = operands
    if isinstance(index, Traced):
        raise Unscalar("an index that depends on the point")
    into, added = lifted(builder, target).nodes.copy(), lifted(builder, updates).nodes
    ones = np.eye(added.size).reshape((added.size, *added.shape))
    send = lambda one: equation.primitive.bind(np.zeros(into.shape), index, one, **equation.params)
    places = np.asarray(jax.vmap(send)(ones)).reshape(added.size, -1)
    flat = into.reshape(-1)
    for update, place in zip(added.ravel(), places, strict=True):
        for k in np.flatnonzero(place):
            flat[k] = builder.apply("add", int(flat[k]), int(update))
    return Traced(flat.reshape(into.shape))


def _dot(builder: Builder, x: Traced, y: Traced, numbers: Any) -> Traced:
    """Sums of products, as dot_general has them: batch axes first, then the free ones of x and of y."""
    ((contracted_x, contracted_y), (batch_x, batch_y)) = numbers

    def arranged(a: Array, contracted: Sequence[int], batch: Sequence[int]) -> Array:
        free = [k for k in range(a.ndim) if k not in contracted and k not in batch]
        moved = a.transpose((*batch, *free, *contracted))
        head = a.shape[: len(batch)] if not batch else tuple(a.shape[k] for k in batch)
        return moved.reshape((*head, int(np.prod([a.shape[k] for k in free], dtype=int)), -1))

    X, Y = arranged(x.nodes, contracted_x, batch_x), arranged(y.nodes, contracted_y, batch_y)
    head = tuple(x.shape[k] for k in batch_x)
    free_x = tuple(n for k, n in enumerate(x.shape) if k not in contracted_x and k not in batch_x)
    free_y = tuple(n for k, n in enumerate(y.shape) if k not in contracted_y and k not in batch_y)
    X, Y = X.reshape((-1, *X.shape[-2:])), Y.reshape((-1, *Y.shape[-2:]))
    nodes = []
    for A, B in zip(X, Y, strict=True):
        for row in A:
            for column in B:
                terms = [builder.apply("mul", int(a), int(b)) for a, b in zip(row, column, strict=True)]
                nodes.append(reduce(lambda a, b: builder.apply("add", a, b), terms, builder.number(0.0)))
    return Traced(np.array(nodes, dtype=int).reshape((*head, *free_x, *free_y)))
