"""`casimir`: a function that commutes with every coordinate in a Poisson bracket of the claim's own."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from canon.claims.bracket import bracket_of, decided, keys_domain, tensor_of
from canon.claims.outcome import Outcome, Residual
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def casimir(question: Question) -> Outcome:
    """{f, x_i} = 0 for every coordinate, and the tensor satisfies Jacobi's identity.

    Marsden and Ratiu, Introduction to Mechanics and Symmetry (1999), 10.1.
    """
    if question.key("tensor") is None and question.key("structure") is None:
        raise InputError(
            "a claim of kind 'casimir' needs a bracket of its own: 'tensor' with 'coordinates', or 'structure'"
        )
    f = question.formula("f")
    region = keys_domain(question, f)
    bracket = bracket_of(question)
    coordinates = question.nodes(tensor_of(question)[1])
    node = question.load(f)

    def residuals() -> Iterator[Residual]:
        for x in coordinates:
            value = bracket(node, x)
            yield Residual(f"{{{f}, {question.tape.symbol_at(x)}}}", value, value)
        for x, y, z in combinations(coordinates, 3):
            cycle = question.tape.plus(bracket(x, bracket(y, z)), bracket(y, bracket(z, x)), bracket(z, bracket(x, y)))
            names = ", ".join(str(question.tape.symbol_at(node)) for node in (x, y, z))
            yield Residual(f"Jacobi's identity for {names}", cycle, cycle)

    return decided(question, residuals(), region, warn=False)


KINDS = {"casimir": casimir}
