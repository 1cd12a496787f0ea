"""A jax function taken apart: its arrays into scalars, its calls and loops of known length unrolled.

What moves numbers about (slices, transposes, gathers) is carried out here, once, on the nodes themselves; what is left
is a straight-line program. `Unscalar` is raised where it depends on more than that: a loop whose length depends on
the values, an index that does, an operation that is no elementary function.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, Final

import numpy as np

from canon.numeric.precision import double
from canon.program import BINARY, PREDICATES, UNARY, Builder, Node, Program, TooLong

Array = np.ndarray

MOST_OPERATIONS: Final = 6000
"""Longer programs are left to jax as they are: compiling every scalar of them would take longer than running them."""

_CALLS: Final = frozenset(
    ["jit", "pjit", "closed_call", "core_call", "remat", "checkpoint", "custom_jvp_call", "custom_vjp_call"]
)
_SAME: Final = {
    "add_any": "add",
    "lt": "less",
    "le": "less_equal",
    "eq": "equal",
}
_SWAPPED: Final = {"gt": "less", "ge": "less_equal"}
_MOVES: Final = frozenset(
    [
        *("broadcast_in_dim", "reshape", "squeeze", "expand_dims", "transpose", "concatenate", "slice", "rev", "copy"),
        *("gather", "dynamic_slice", "scatter", "dynamic_update_slice", "pad", "copy_p", "split", "stack", "unstack"),
        "tile",
    ]
)


class Unscalar(Exception):
    """The function is no straight-line program of scalars."""


@dataclass(frozen=True)
class _Traced:
    """An array whose entries are nodes of the program."""

    nodes: Array

    @property
    def shape(self) -> tuple[int, ...]:
        return self.nodes.shape


_Value = _Traced | Array
"""An array of nodes, or one that is known: integers and truth values that do not depend on the point."""


def scalar_program(function: Callable[[Any], Any], size: int, *, most: int = MOST_OPERATIONS) -> Program:
    """The program of a jax function of one array (size,); its outputs are the function's, flattened, one after another.

    **Raises:** `Unscalar` where there is none with at most `most` operations, or the function computes in another type
    than float64; whatever jax raises where it cannot trace the function.
    """
    import jax

    with double():
        closed = jax.make_jaxpr(function)(np.zeros(size))
        builder = Builder(size, 20 * most)
        inputs = _Traced(np.array([builder.input(k) for k in range(size)]))
        try:
            results = _run(builder, closed.jaxpr, closed.consts, [inputs])
            nodes = [int(node) for result in results for node in _lifted(builder, result).nodes.ravel()]
        except TooLong as reason:
            raise Unscalar(str(reason)) from None
        except (TypeError, ValueError, KeyError, IndexError, NotImplementedError) as reason:
            # an operation in a form that is not known here: jax runs it all the same
            raise Unscalar(f"{type(reason).__name__}: {reason}") from reason
        program = builder.program(tuple(nodes))
    if len(program.operations) > most:
        raise Unscalar(f"more than {most} operations")
    return program


def values_and_jacobian(one: Callable[[Any], Any], size: int, *, most: int = MOST_OPERATIONS) -> Program:
    """The program of (Z, M) for a jax map z -> Z: its 2n values, then the entries of M = dZ/dz row by row.

    The derivatives are jax's own, in forward mode. **Raises:** as `scalar_program` does.
    """
    import jax

    def both(z: Any) -> Any:
        push = lambda direction: jax.jvp(one, (z,), (direction,))
        return jax.vmap(push, out_axes=(None, 1))(np.eye(size))

    return scalar_program(both, size, most=most)


def _run(builder: Builder, jaxpr: Any, consts: Sequence[Any], arguments: Sequence[_Value]) -> list[_Value]:
    place: dict[Any, _Value] = {}
    for name, value in zip(jaxpr.constvars, consts, strict=True):
        place[name] = _known(value)
    place.update(zip(jaxpr.invars, arguments, strict=True))

    def read(atom: Any) -> _Value:
        return _known(atom.val) if hasattr(atom, "val") else place[atom]

    for equation in jaxpr.eqns:
        results = _apply(builder, equation, [read(atom) for atom in equation.invars])
        place.update(zip(equation.outvars, results, strict=True))
    return [read(atom) for atom in jaxpr.outvars]


def _known(value: Any) -> Array:
    array = np.asarray(value)
    if (array.dtype.kind == "f" and array.dtype != np.float64) or array.dtype.kind not in "fiub":
        raise Unscalar(f"numbers of type {array.dtype}")
    return array


def _lifted(builder: Builder, value: _Value) -> _Traced:
    """Known numbers as nodes; truth values as the comparison of two numbers."""
    if isinstance(value, _Traced):
        return value
    flat = []
    for x in value.ravel():
        if value.dtype == bool:
            flat.append(builder.apply("equal", builder.number(1.0 if x else 0.0), builder.number(1.0)))
        else:
            flat.append(builder.number(float(x)))
    return _Traced(np.array(flat, dtype=int).reshape(value.shape))


def _apply(builder: Builder, equation: Any, operands: list[_Value]) -> list[_Value]:
    name, params = equation.primitive.name, equation.params
    for out in equation.outvars:
        kind = np.dtype(out.aval.dtype) if not str(out.aval.dtype).startswith("key") else np.dtype(object)
        if kind.kind not in "iub" and kind != np.float64:
            raise Unscalar(f"numbers of type {kind}")
    if name in _CALLS:
        inner = params.get("jaxpr") or params.get("call_jaxpr") or params["fun_jaxpr"]
        return _run(builder, getattr(inner, "jaxpr", inner), getattr(inner, "consts", ()), operands)
    if name in _CONTROL:
        return _CONTROL[name](builder, params, operands)
    if name in _MOVES:
        return _moved(builder, equation, operands)
    integral = all(not isinstance(x, _Traced) and x.dtype.kind in "iub" for x in operands)
    if integral and all(out.aval.dtype.kind in "iub" for out in equation.outvars):
        found = equation.primitive.bind(*operands, **params)
        return [np.asarray(x) for x in (found if equation.primitive.multiple_results else [found])]
    return [_computed(builder, equation, operands)]


def _moved(builder: Builder, equation: Any, operands: list[_Value]) -> list[_Value]:
    """Move numbers about: the operation itself, applied to the nodes' positions."""
    positions = [x.nodes if isinstance(x, _Traced) else x for x in operands]
    if any(isinstance(x, _Traced) for x in operands):
        for k, x in enumerate(operands):
            index = equation.primitive.name in _INDICES and k in _INDICES[equation.primitive.name](len(operands))
            if isinstance(x, _Traced) and index:
                raise Unscalar(f"{equation.primitive.name} at an index that depends on the point")
            if not isinstance(x, _Traced) and not index:
                positions[k] = _lifted(builder, x).nodes
        found = _bound(equation, positions)
        return [_Traced(np.asarray(x)) for x in found]
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
    found = equation.primitive.bind(*arrays, **params)
    return list(found) if equation.primitive.multiple_results else [found]


def _elementwise(builder: Builder, name: str, operands: Sequence[_Traced]) -> _Traced:
    shape = np.broadcast_shapes(*(x.shape for x in operands))
    columns = [np.broadcast_to(x.nodes, shape).ravel() for x in operands]
    nodes = [builder.apply(name, *(int(a) for a in row)) for row in zip(*columns, strict=True)]
    return _Traced(np.array(nodes, dtype=int).reshape(shape))


def _computed(builder: Builder, equation: Any, operands: list[_Value]) -> _Traced:
    """An operation on numbers, entry by entry."""
    name, params = equation.primitive.name, equation.params
    if name in ("convert_element_type", "stop_gradient", "reduce_precision"):
        if equation.outvars[0].aval.dtype != np.float64 or name == "reduce_precision":
            raise Unscalar(name)
        (value,) = operands
        if isinstance(value, _Traced) and any(_truth(builder, int(node)) for node in value.nodes.ravel()):
            one, zero = (_Traced(np.full(value.shape, builder.number(x), dtype=int)) for x in (1.0, 0.0))
            return _elementwise(builder, "select", [value, one, zero])
        return _lifted(builder, value)
    if name == "select_n" and len(operands) == 3:
        which, no, yes = operands
        if not isinstance(which, _Traced):
            no, yes = _lifted(builder, no), _lifted(builder, yes)
            return _Traced(np.where(which, yes.nodes, no.nodes))
        return _elementwise(builder, "select", [which, _lifted(builder, yes), _lifted(builder, no)])
    if name == "scatter-add":
        return _scattered_sum(builder, equation, operands)
    x = [_lifted(builder, value) for value in operands]
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


def _each(x: _Traced, rule: Callable[[Node], Node]) -> _Traced:
    return _Traced(np.array([rule(int(a)) for a in x.nodes.ravel()], dtype=int).reshape(x.shape))


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


def _reduced(builder: Builder, name: str, x: _Traced, axes: Sequence[int]) -> _Traced:
    kept = [axis for axis in range(x.nodes.ndim) if axis not in axes]
    rows = x.nodes.transpose((*kept, *axes)).reshape((*(x.shape[axis] for axis in kept), -1))
    if not rows.shape[-1]:
        raise Unscalar("a sum of nothing")
    shape = rows.shape[:-1]
    nodes = [reduce(lambda a, b: builder.apply(name, int(a), int(b)), row) for row in rows.reshape(-1, rows.shape[-1])]
    return _Traced(np.array(nodes, dtype=int).reshape(shape))


def _running_sums(builder: Builder, x: _Traced, axis: int, backwards: bool) -> _Traced:
    rows = np.moveaxis(np.flip(x.nodes, axis) if backwards else x.nodes, axis, 0).copy()
    for k in range(1, len(rows)):
        rows[k] = _elementwise(builder, "add", [_Traced(rows[k - 1]), _Traced(rows[k])]).nodes
    result = np.moveaxis(rows, 0, axis)
    return _Traced(np.flip(result, axis) if backwards else result)


def _scattered_sum(builder: Builder, equation: Any, operands: list[_Value]) -> _Traced:
    """An array with updates added to some of its entries: where each goes is seen by sending a 1 there."""
    import jax

    target, index, updates = operands
    if isinstance(index, _Traced):
        raise Unscalar("an index that depends on the point")
    into, added = _lifted(builder, target).nodes.copy(), _lifted(builder, updates).nodes
    ones = np.eye(added.size).reshape((added.size, *added.shape))
    send = lambda one: equation.primitive.bind(np.zeros(into.shape), index, one, **equation.params)
    places = np.asarray(jax.vmap(send)(ones)).reshape(added.size, -1)
    flat = into.reshape(-1)
    for update, place in zip(added.ravel(), places, strict=True):
        for k in np.flatnonzero(place):
            flat[k] = builder.apply("add", int(flat[k]), int(update))
    return _Traced(flat.reshape(into.shape))


def _dot(builder: Builder, x: _Traced, y: _Traced, numbers: Any) -> _Traced:
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
    return _Traced(np.array(nodes, dtype=int).reshape((*head, *free_x, *free_y)))


# -- control flow -----------------------------------------------------------------------------------


def _scan(builder: Builder, params: Any, operands: list[_Value]) -> list[_Value]:
    """A loop of known length, unrolled."""
    closed, fixed, carried = params["jaxpr"], params["num_consts"], params["num_carry"]
    constants, state, inputs = operands[:fixed], operands[fixed : fixed + carried], operands[fixed + carried :]
    collected: list[list[_Value]] = []
    order = range(params["length"])
    for k in reversed(order) if params["reverse"] else order:
        slices: list[_Value] = [_Traced(x.nodes[k]) if isinstance(x, _Traced) else x[k] for x in inputs]
        results = _run(builder, closed.jaxpr, closed.consts, [*constants, *state, *slices])
        state = results[:carried]
        collected.append(results[carried:])
    if params["reverse"]:
        collected.reverse()
    stacked: list[_Value] = []
    for column in zip(*collected, strict=True):
        if all(not isinstance(x, _Traced) for x in column):
            stacked.append(np.stack([np.asarray(x) for x in column]))
        else:
            stacked.append(_Traced(np.stack([_lifted(builder, x).nodes for x in column])))
    return [*state, *stacked]


def _while(builder: Builder, params: Any, operands: list[_Value]) -> list[_Value]:
    """A loop whose end does not depend on the point, unrolled."""
    condition, body = params["cond_jaxpr"], params["body_jaxpr"]
    first, second = params["cond_nconsts"], params["body_nconsts"]
    fixed, constants, state = operands[:first], operands[first : first + second], operands[first + second :]
    while True:
        (goes_on,) = _run(builder, condition.jaxpr, condition.consts, [*fixed, *state])
        if isinstance(goes_on, _Traced):
            raise Unscalar("a loop whose length depends on the point")
        if not goes_on:
            return state
        state = _run(builder, body.jaxpr, body.consts, [*constants, *state])


def _cond(builder: Builder, params: Any, operands: list[_Value]) -> list[_Value]:
    """One of several programs, by an index that is known."""
    which, *rest = operands
    branches = params["branches"]
    if not isinstance(which, _Traced):
        closed = branches[int(np.clip(which, 0, len(branches) - 1))]
        return _run(builder, closed.jaxpr, closed.consts, rest)
    raise Unscalar("a choice of programs by an index that depends on the point")


_CONTROL: Final[dict[str, Callable[[Builder, Any, list[_Value]], list[_Value]]]] = {
    "scan": _scan,
    "while": _while,
    "cond": _cond,
}
