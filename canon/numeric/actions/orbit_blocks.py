"""Arrays of orbits in blocks of few sizes, so that little is compiled; formulas of one variable as jax functions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.expected import finite_number, instance_of, real_array, table
from canon.expected import formula_of as expected_formula
from canon.expression import read
from canon.numeric.actions.oscillation import Scalar
from canon.numeric.lower import lower
from canon.vocabulary import Vocabulary

Array = Any  # numpy arrays

BLOCK: Final = 4096
_LEAST: Final = 64


def blocks(indices: Array) -> Iterator[Array]:
    """The indices, a block at a time."""
    for start in range(0, indices.size, BLOCK):
        yield indices[start : start + BLOCK]


def on_block(kernel: Any, block: Array, rows: Any) -> list[Array]:
    """What a kernel finds of the orbits of a block: arrays of a power of two are passed, the last orbit repeated."""
    size = max(_LEAST, 1 << max(0, block.size - 1).bit_length())
    chosen = [row[block] for row in rows]
    if size > block.size:
        chosen = [np.pad(row, (0, size - block.size), mode="edge") for row in chosen]
    return [np.asarray(x)[: block.size] for x in kernel(*chosen)]


def orbits_of(rows: Sequence[Any], names: Sequence[str]) -> tuple[list[Array], tuple[int, ...]]:
    """Arrays of one shape as rows of one length, and that shape. **Raises:** `InputError` where they have none."""
    given = [real_array(row, name) for row, name in zip(rows, names, strict=True)]
    try:
        shape = np.broadcast_shapes(*(row.shape for row in given))
    except ValueError:
        shapes = ", ".join(str(row.shape) for row in given)
        raise InputError(f"arrays of one shape are expected, not of {shapes}", ", ".join(names)) from None
    return [np.broadcast_to(row, shape).ravel() for row in given], shape


def formula_of(text: Any, variable: str, parameters: Mapping[str, Any], where: str) -> tuple[Any, sp.Symbol]:
    """A formula in one variable, with numbers for its parameters, and its symbol. **Raises:** `InputError`."""
    instance_of(variable, str, "variable")
    table(parameters, "numbers", "parameters")
    for name, value in parameters.items():
        instance_of(name, str, "parameters")
        if not isinstance(value, sp.Expr) or not value.is_real:  # an exact number, such as Rational(1, 3)
            finite_number(value, f"parameters, {name}")
    symbol = sp.Symbol(variable, real=True)
    if isinstance(text, str):
        names = {name: sp.Symbol(name, real=True) for name in (variable, *parameters)}
        text = read(text, Vocabulary(names), where).expr
    formula: Any = expected_formula(text, where)
    values = {name: sp.Rational(value) if isinstance(value, float) else value for name, value in parameters.items()}
    formula = formula.subs({s: symbol if s.name == variable else values.get(s.name, s) for s in formula.free_symbols})
    strange = formula.free_symbols - {symbol}
    if strange:
        raise InputError(f"no value is given for {', '.join(sorted(map(str, strange)))}", where)
    return formula, symbol


def as_function(formula: Any, symbol: sp.Symbol) -> Scalar:
    """The formula as a jax function of arrays."""
    import jax.numpy as jnp

    lowered = lower((formula,), (symbol,))
    return lambda x: jnp.broadcast_to(lowered(x)[0], jnp.shape(x))
