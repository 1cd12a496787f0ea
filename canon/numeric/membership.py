"""Whether floating-point numbers satisfy the conditions under which formulas are defined."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.numeric.emit import run
from canon.numeric.lower import lower_map
from canon.numeric.scalar_program import scalar_program
from canon.program import Program

if TYPE_CHECKING:
    import sympy as sp

    from canon.domain import Condition

MOST_OPERATIONS: Final = 100_000


@dataclass(frozen=True)
class Membership:
    """Conditions "positive", "nonzero" and "uncut", by their `kinds`; `program` has their terms, one after another."""

    kinds: tuple[str, ...]
    program: Program

    def __call__(self, rows: Sequence[Any], numbers: Any = np) -> Any:
        """Which points satisfy all conditions, as far as floats tell: truth values (N,).

        `rows` are the points' variables, one array each, and `numbers` the module that computes, numpy or jax.numpy.
        """
        result = numbers.ones(rows[0].shape, dtype=bool)
        with np.errstate(all="ignore"):
            values = iter(run(self.program, rows, numbers))
            for kind in self.kinds:
                first = next(values)
                if kind == "positive":
                    result = result & (first > 0)
                elif kind == "nonzero":
                    result = result & (first != 0)
                else:
                    result = result & ((first != 0) | (next(values) > 0))
        return result


def membership(
    conditions: Sequence[Condition], symbols: Sequence[sp.Symbol], parameters: Mapping[sp.Symbol, float]
) -> Membership | None:
    """The test of conditions at values of `symbols`, with fixed `parameters`; None where there are no conditions."""
    if not conditions:
        return None
    terms = [term for condition in conditions for term in condition.terms]
    program = scalar_program(lower_map(terms, symbols, parameters), len(symbols), most=MOST_OPERATIONS)
    return Membership(tuple(condition.kind for condition in conditions), program)
