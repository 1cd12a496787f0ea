"""Running rounding-error analysis of a jax program: every value beside a bound on its distance from the exact one.

The program (a jaxpr) is read operation by operation. An operation's bound is its operands' bounds times its partial
derivatives, plus its own rounding (Higham, Accuracy and Stability of Numerical Algorithms, section 3.3). Derivatives
of elementary functions are taken at the computed point, so the bound holds to first order in the unit roundoff; what
the compiler fuses or contracts only rounds less.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from canon.numeric.precision import unit_of
from canon.numeric.running_bound import ULPS, slope_of

_MOVES: Final = frozenset(
    [
        "broadcast_in_dim",
        "reshape",
        "squeeze",
        "expand_dims",
        "transpose",
        "concatenate",
        "slice",
        "rev",
        "gather",
        "dynamic_slice",
        "scatter",
        "dynamic_update_slice",
        "pad",
        "copy",
        "copy_p",
        "select_n",
        "real",
        "tile",
        "split",
        "stack",
        "unstack",
    ]
)
_CALLS: Final = frozenset(
    ["jit", "pjit", "closed_call", "core_call", "remat", "checkpoint", "custom_jvp_call", "custom_vjp_call"]
)
_STEPS: Final = frozenset(["sign", "floor", "ceil", "round", "stop_gradient"])


class Unbounded(Exception):
    """The program has an operation for which there is no rule."""


def with_rounding(function: Callable[[Any], Any], example: Any) -> Callable[[Any], tuple[Any, Any]]:
    """The function x -> (function(x), bounds on the rounding errors of its entries), for an exact input x.

    **Raises:** `Unbounded` where the function's program has an operation without a rule.
    """
    import jax

    closed = jax.make_jaxpr(function)(example)

    def bounded(x: Any) -> tuple[Any, Any]:
        import jax.numpy as jnp

        ((value, error),) = _run(closed.jaxpr, closed.consts, [(x, jnp.zeros_like(x))])
        return value, error

    try:
        jax.eval_shape(bounded, example)
    except (TypeError, ValueError, KeyError) as reason:
        raise Unbounded(str(reason)) from reason
    return bounded


def _is_float(x: Any) -> bool:
    import jax.numpy as jnp

    return jnp.issubdtype(_dtype(x), np.floating)  # numpy takes bfloat16 for no float


def _dtype(x: Any) -> np.dtype:
    return x.dtype if hasattr(x, "dtype") else np.result_type(x)


def _exact(x: Any) -> tuple[Any, Any]:
    """A value without an error (None for what is no floating-point number)."""
    import jax.numpy as jnp

    return x, (jnp.zeros_like(x) if _is_float(x) else None)


def _run(jaxpr: Any, consts: Sequence[Any], arguments: Sequence[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    place: dict[Any, tuple[Any, Any]] = {}
    place.update(zip(jaxpr.constvars, map(_exact, consts), strict=True))
    place.update(zip(jaxpr.invars, arguments, strict=True))

    def read(atom: Any) -> tuple[Any, Any]:
        return _exact(atom.val) if hasattr(atom, "val") else place[atom]

    for equation in jaxpr.eqns:
        results = _apply(equation, [read(atom) for atom in equation.invars])
        place.update(zip(equation.outvars, results, strict=True))
    return [read(atom) for atom in jaxpr.outvars]


def _apply(equation: Any, operands: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    import jax.numpy as jnp

    name, bind = equation.primitive.name, equation.primitive.bind
    if name in _CALLS:
        inner = equation.params.get("jaxpr") or equation.params.get("call_jaxpr") or equation.params["fun_jaxpr"]
        return _run(getattr(inner, "jaxpr", inner), getattr(inner, "consts", ()), operands)
    if name == "scan":
        return _scan(equation, operands)
    if name == "cond":
        return _cond(equation, operands)
    if name == "while":
        raise Unbounded(name)
    values = [value for value, _ in operands]
    result = bind(*values, **equation.params)
    results = list(result) if equation.primitive.multiple_results else [result]
    if any(np.issubdtype(_dtype(x), np.complexfloating) for x in (*values, *results)):
        raise Unbounded("complex numbers")
    if not any(_is_float(r) for r in results):
        return [(r, None) for r in results]
    if name in _MOVES:
        # a move of values moves their errors alike; indices and predicates stay what they are
        moved = [value if error is None else error for value, error in operands]
        errors = bind(*moved, **equation.params)
        return list(zip(results, list(errors) if equation.primitive.multiple_results else [errors], strict=True))
    if len(results) != 1:
        raise Unbounded(name)
    (value,) = results
    if all(error is None for _, error in operands):
        return [_exact(value)]
    if name in _STEPS:
        error = operands[0][1] if name == "stop_gradient" else jnp.zeros_like(value)
        return [(value, error)]
    unit = unit_of(value.dtype)
    errors = [jnp.zeros_like(v, dtype=value.dtype) if e is None else e for v, e in operands]
    return [(value, _rule(name, equation.params, bind, values, errors, value, unit))]


def _rule(name: str, params: dict[str, Any], bind: Any, x: list[Any], e: list[Any], value: Any, unit: float) -> Any:
    """The bound of one operation's result."""
    import jax.numpy as jnp

    own = unit * jnp.abs(value)
    if name in ("add", "sub", "add_any"):
        return e[0] + e[1] + own
    if name == "mul":
        return jnp.abs(x[0]) * e[1] + jnp.abs(x[1]) * e[0] + e[0] * e[1] + own
    if name == "div":
        room = jnp.abs(x[1]) - e[1]
        return jnp.where(room > 0, (e[0] + jnp.abs(value) * e[1]) / room, jnp.inf) + own
    if name in ("neg", "abs"):
        return e[0]
    if name in ("max", "min"):
        return jnp.maximum(e[0], e[1])
    if name == "convert_element_type":
        return e[0].astype(value.dtype) + (own if _dtype(x[0]) != value.dtype else 0)
    if name in ("rem", "clamp"):
        return e[1] + own if name == "clamp" else e[0] + jnp.abs(x[0] / x[1]) * e[1] + own
    if name == "scatter-add":
        return bind(e[0], x[1], e[2], **params) + x[2].size * unit * bind(jnp.abs(x[0]), x[1], jnp.abs(x[2]), **params)
    if name == "cumsum":
        return bind(e[0], **params) + x[0].shape[params["axis"]] * unit * bind(jnp.abs(x[0]), **params)
    if name == "reduce_sum":
        length = x[0].size // max(1, value.size)
        return bind(e[0], **params) + length * unit * bind(jnp.abs(x[0]), **params)
    if name == "dot_general":
        size = [jnp.abs(v) for v in x]
        ((contracted, _), _) = params["dimension_numbers"]
        length = 1 + int(np.prod([x[0].shape[axis] for axis in contracted], dtype=int))
        carried = bind(size[0] + e[0], e[1], **params) + bind(e[0], size[1], **params)
        return carried + length * unit * bind(*size, **params)
    if name == "integer_pow":
        y = params["y"]
        slope = abs(y) * jnp.abs(x[0]) ** (y - 1) if y > 1 else jnp.abs(y * value / x[0])
        return slope * e[0] + (abs(y) + 1) * own
    if name == "pow":
        slope = jnp.abs(x[1] * jnp.power(x[0], x[1] - 1)) * e[0]
        other = jnp.where(e[1] > 0, jnp.abs(value * jnp.log(jnp.abs(x[0]))) * e[1], 0)
        return slope + other + ULPS * own
    if name == "atan2":
        return (jnp.abs(x[0]) * e[1] + jnp.abs(x[1]) * e[0]) / (x[0] ** 2 + x[1] ** 2) + ULPS * own
    try:
        slope = slope_of(name, x[0], value, jnp)
    except KeyError:
        raise Unbounded(name) from None
    return jnp.where(e[0] > 0, jnp.abs(slope) * e[0], 0) + ULPS * own


def _cond(equation: Any, operands: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    """One of several programs, chosen by the computed index."""
    import jax

    (index, _), *rest = operands
    branches = [
        lambda *pairs, closed=closed: tuple(_run(closed.jaxpr, closed.consts, pairs))
        for closed in equation.params["branches"]
    ]
    return list(jax.lax.switch(index, branches, *rest))


def _scan(equation: Any, operands: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    """A loop of known length: its body carries each value together with its bound."""
    import jax

    params = equation.params
    closed, fixed, carried = params["jaxpr"], params["num_consts"], params["num_carry"]
    constants, start, inputs = operands[:fixed], operands[fixed : fixed + carried], operands[fixed + carried :]

    def body(carry: Any, x: Any) -> Any:
        results = _run(closed.jaxpr, closed.consts, [*constants, *carry, *x])
        return tuple(results[:carried]), tuple(results[carried:])

    last, collected = jax.lax.scan(
        body, tuple(start), tuple(inputs), length=params["length"], reverse=params["reverse"]
    )
    return [*last, *collected]
