"""The tape's nodes as a straight-line program, with its exact numbers."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final

from canon.decide.tape import Node, Tape, Unsupported
from canon.program import Builder, Program

MOST_OPERATIONS: Final = 100_000
_FUNCTIONS: Final = frozenset(["exp", "log", "sin", "cos", "abs", "atan", "asin", "acos", "atan2"])


def program_of(tape: Tape, nodes: Sequence[Node], inputs: Sequence[Node], values: dict[Node, Fraction]) -> Program:
    """The program of `nodes` as functions of the symbols `inputs`, with numbers for the other symbols.

    **Raises:** `Unsupported` for complex numbers, arbitrary functions, special ones, and a symbol without a value.
    """
    builder = Builder(len(inputs), MOST_OPERATIONS)
    place: dict[Node, Node] = {}
    for node in tape.reach(nodes):
        kind, *rest = tape.ops[node]
        if kind == "n":
            place[node] = builder.number(rest[0])
        elif kind == "s":
            if node in inputs:
                place[node] = builder.input(list(inputs).index(node))
            elif node in values:
                place[node] = builder.number(values[node])
            else:
                raise Unsupported(f"no value for {tape.symbol_at(node)}")
        elif kind == "c":
            if rest[0] != "pi":
                raise Unsupported("complex numbers")
            place[node] = builder.number("pi")
        elif kind == "+":
            total = builder.number(rest[0])
            for inner, coefficient in rest[1]:
                total = builder.apply("add", total, builder.apply("mul", builder.number(coefficient), place[inner]))
            place[node] = total
        elif kind == "*":
            product = builder.number(1.0)
            for inner, exponent in rest[0]:
                product = builder.apply("mul", product, builder.power(place[inner], exponent))
            place[node] = product
        elif kind == "r":
            place[node] = builder.root(place[rest[0]], Fraction(rest[1], rest[2]))
        elif kind == "f" and rest[0] in _FUNCTIONS:
            place[node] = builder.apply(rest[0], *(place[a] for a in rest[1]))
        else:
            raise Unsupported(f"no series of {rest[0]}")
    return builder.program(tuple(place[node] for node in nodes))
