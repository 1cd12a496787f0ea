"""A jax function taken apart: its arrays into scalars, its calls and loops of known length unrolled.

What is left is a straight-line program. `Unscalar` is raised where the function depends on more than that: a loop whose
length depends on the values, an index that does, an operation that is no elementary function.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from canon.numeric.precision import double
from canon.numeric.scalar_arrays import MOVES, WHOLE, Traced, Unscalar, Value, computed, known, lifted, moved
from canon.program import Builder, Program, TooLong

__all__ = ["Unscalar", "scalar_program", "taken_apart", "values_and_jacobian"]

MOST_OPERATIONS: Final = 6000
"""Longer programs are left to jax as they are: compiling every scalar of them would take longer than running them."""

_CALLS: Final = frozenset(
    ["jit", "pjit", "closed_call", "core_call", "remat", "checkpoint", "custom_jvp_call", "custom_vjp_call"]
)


def scalar_program(function: Callable[[Any], Any], size: int, *, most: int = MOST_OPERATIONS) -> Program:
    """The program of a jax function of one array (size,); its outputs are the function's, flattened, one after another.

    **Raises:** `Unscalar` where there is none with at most `most` operations, or the function computes in another type
    than float64; whatever jax raises where it cannot trace the function.
    """
    import jax

    with double():
        closed = jax.make_jaxpr(function)(np.zeros(size))
        builder = Builder(size, 20 * most)
        results = taken_apart(builder, closed, [Traced(np.array([builder.input(k) for k in range(size)]))])
        program = builder.program(tuple(int(node) for result in results for node in result.nodes.ravel()))
    if len(program.operations) > most:
        raise Unscalar(f"more than {most} operations")
    return program


def taken_apart(builder: Builder, closed: Any, arguments: Sequence[Value], *, whole: bool = False) -> list[Any]:
    """What a jaxpr returns, as nodes of the program that is being built; what does not depend on nodes, and is no
    double, as it is with `whole`, else as numbers. Called in double precision.

    **Raises:** `Unscalar` where it can't be taken apart.
    """
    try:
        found = _run(builder, closed.jaxpr, closed.consts, arguments)
        return [x if whole and not isinstance(x, Traced) and x.dtype.kind != "f" else lifted(builder, x) for x in found]
    except TooLong as reason:
        raise Unscalar(str(reason)) from None
    except (TypeError, ValueError, KeyError, IndexError, NotImplementedError) as reason:
        # an operation in a form that is not known here: jax runs it all the same
        raise Unscalar(f"{type(reason).__name__}: {reason}") from reason


def values_and_jacobian(one: Callable[[Any], Any], size: int, *, most: int = MOST_OPERATIONS) -> Program:
    """The program of (Z, M) for a jax map z -> Z: its 2n values, then the entries of M = dZ/dz row by row.

    The derivatives are jax's own, in forward mode. **Raises:** as `scalar_program` does.
    """
    import jax

    def both(z: Any) -> Any:
        push = lambda direction: jax.jvp(one, (z,), (direction,))
        return jax.vmap(push, out_axes=(None, 1))(np.eye(size))

    return scalar_program(both, size, most=most)


def _run(builder: Builder, jaxpr: Any, consts: Sequence[Any], arguments: Sequence[Value]) -> list[Value]:
    place: dict[Any, Value] = {}
    for name, value in zip(jaxpr.constvars, consts, strict=True):
        place[name] = known(value)
    place.update(zip(jaxpr.invars, arguments, strict=True))

    def read(atom: Any) -> Value:
        return known(atom.val) if hasattr(atom, "val") else place[atom]

    for equation in jaxpr.eqns:
        results = _apply(builder, equation, [read(atom) for atom in equation.invars])
        place.update(zip(equation.outvars, results, strict=True))
    return [read(atom) for atom in jaxpr.outvars]


def _apply(builder: Builder, equation: Any, operands: list[Value]) -> list[Value]:
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
    if name in MOVES:
        return moved(builder, equation, operands)
    integral = all(not isinstance(x, Traced) and x.dtype.kind in "iub" for x in operands)
    if integral and all(out.aval.dtype.kind in "iub" for out in equation.outvars):
        if name in WHOLE:
            return [WHOLE[name](params, *operands).astype(equation.outvars[0].aval.dtype)]
        found = equation.primitive.bind(*operands, **params)
        return [np.asarray(x) for x in (found if equation.primitive.multiple_results else [found])]
    return [computed(builder, equation, operands)]


def _scan(builder: Builder, params: Any, operands: list[Value]) -> list[Value]:
    """A loop of known length, unrolled."""
    closed, fixed, carried = params["jaxpr"], params["num_consts"], params["num_carry"]
    constants, state, inputs = operands[:fixed], operands[fixed : fixed + carried], operands[fixed + carried :]
    collected: list[list[Value]] = []
    order = range(params["length"])
    for k in reversed(order) if params["reverse"] else order:
        slices: list[Value] = [Traced(x.nodes[k]) if isinstance(x, Traced) else x[k] for x in inputs]
        results = _run(builder, closed.jaxpr, closed.consts, [*constants, *state, *slices])
        state = results[:carried]
        collected.append(results[carried:])
    if params["reverse"]:
        collected.reverse()
    stacked: list[Value] = []
    for column in zip(*collected, strict=True):
        if all(not isinstance(x, Traced) for x in column):
            stacked.append(np.stack([np.asarray(x) for x in column]))
        else:
            stacked.append(Traced(np.stack([lifted(builder, x).nodes for x in column])))
    return [*state, *stacked]


def _while(builder: Builder, params: Any, operands: list[Value]) -> list[Value]:
    """A loop whose end does not depend on the point, unrolled."""
    condition, body = params["cond_jaxpr"], params["body_jaxpr"]
    first, second = params["cond_nconsts"], params["body_nconsts"]
    fixed, constants, state = operands[:first], operands[first : first + second], operands[first + second :]
    while True:
        (goes_on,) = _run(builder, condition.jaxpr, condition.consts, [*fixed, *state])
        if isinstance(goes_on, Traced):
            raise Unscalar("a loop whose length depends on the point")
        if not goes_on:
            return state
        state = _run(builder, body.jaxpr, body.consts, [*constants, *state])


def _cond(builder: Builder, params: Any, operands: list[Value]) -> list[Value]:
    """One of several programs, by an index that is known."""
    which, *rest = operands
    branches = params["branches"]
    if not isinstance(which, Traced):
        closed = branches[int(np.clip(which, 0, len(branches) - 1))]
        return _run(builder, closed.jaxpr, closed.consts, rest)
    raise Unscalar("a choice of programs by an index that depends on the point")


_CONTROL: Final[dict[str, Callable[[Builder, Any, list[Value]], list[Value]]]] = {
    "scan": _scan,
    "while": _while,
    "cond": _cond,
}
