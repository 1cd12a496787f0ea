"""A map as a straight-line program with exact numbers: what ball arithmetic needs of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from canon.decide.tape import Tape, Unsupported
from canon.decide.tape_program import program_of
from canon.errors import InputError
from canon.numeric.map_shape import point_map
from canon.numeric.scalar_program import Unscalar, scalar_program
from canon.program import Program

if TYPE_CHECKING:
    import sympy as sp

    from canon.mechanics.transformation import Transformation


def program_of_formulas(transformation: Transformation, parameters: Mapping[sp.Symbol, Any]) -> Program:
    """The new variables as functions of the old ones (of a backward map, the old ones of the new), numbers exact.

    Parameters that are floats stand for themselves exactly.

    **Raises:** `InputError` for complex, arbitrary and special functions.
    """
    tape = Tape()
    inputs = [tape.symbol(symbol) for symbol in transformation.arguments]
    values = {tape.symbol(symbol): Fraction(value) for symbol, value in parameters.items()}
    try:
        return program_of(tape, [tape.load(f) for f in transformation.expressions], inputs, values)
    except Unsupported as reason:
        raise InputError(f"these formulas have no enclosure by power series: {reason}") from reason


def program_of_function(function: Callable[..., Any], points: np.ndarray) -> Program:
    """The program of a jax function's 2n values; it is tried at `points` (N, 2n) to see how it takes them.

    Its numbers are the floats in it, taken exactly.

    **Raises:** `InputError` where the function is no straight-line program that jax can trace.
    """
    one = point_map(function, points).one
    try:
        return scalar_program(one, points.shape[1])
    except Unscalar as reason:
        raise InputError(f"the function is no straight-line program of elementary functions: {reason}") from reason
    except Exception as reason:  # a function of numpy may raise anything when it is given a tracer
        raise InputError(
            "jax cannot trace the function, so that balls cannot follow it: write it with jax.numpy instead of numpy, "
            f"or give formulas ({type(reason).__name__})"
        ) from reason
