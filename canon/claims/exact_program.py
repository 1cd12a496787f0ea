"""A map as a straight-line program with exact numbers: what ball arithmetic needs of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from canon.decide.tape import Tape, Unsupported
from canon.decide.tape_program import program_of
from canon.errors import InputError
from canon.numeric.scalar_program import Unscalar, scalar_program
from canon.numeric.traced import traced
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


def program_of_function(function: Callable[..., Any], size: int) -> Program:
    """The program of a jax function's values, for points of `size` variables.

    Its numbers are the floats in it, taken exactly.

    **Raises:** `InputError` where jax cannot trace the function, or it is no straight-line program.
    """
    if not callable(function):
        raise InputError(f"a map is a function or a transformation, not {type(function).__name__}")
    program = traced(function, size)
    if program is None:
        raise InputError(
            f"jax cannot trace the function as a map of {size} variables, so that balls cannot follow it: "
            "write it with jax.numpy instead of numpy, or give formulas"
        )
    try:
        return scalar_program(program.one, size)
    except Unscalar as reason:
        raise InputError(f"the function is no straight-line program of elementary functions: {reason}") from reason
