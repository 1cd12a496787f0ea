"""Straight-line programs on real numbers: what is left of a function once its arrays are taken apart into scalars.

A program is a value that every arithmetic can run: floats by the thousand, running error bounds, balls, power series
in balls. Equal operations are one node, and what multiplies by 0 or 1 has gone, so that a sparse Jacobian is sparse.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isfinite
from typing import Final, NamedTuple

Node = int

UNARY: Final = frozenset(
    [
        *("neg", "abs", "sign", "floor", "ceil", "round", "not"),
        *("sqrt", "cbrt", "exp", "expm1", "log", "log1p", "sin", "cos", "tan", "asin", "acos", "atan"),
        *("sinh", "cosh", "tanh", "asinh", "acosh", "atanh"),
    ]
)
BINARY: Final = frozenset(
    ["add", "sub", "mul", "div", "pow", "atan2", "max", "min", "rem", "less", "less_equal", "equal", "and", "or"]
)
PREDICATES: Final = frozenset(["less", "less_equal", "equal", "and", "or", "not"])
"""Operations whose value is true or false; `select` chooses by one of them."""


class Operation(NamedTuple):
    """One operation: its name, the nodes it works on, and a datum.

    The datum is the position of an "input", the value of a "number" (an int, a float or a Fraction, exactly; or "pi"),
    the exponent of a "power" (an int), or of a "root" (a Fraction).
    """

    name: str
    operands: tuple[Node, ...] = ()
    datum: int | float | Fraction | str = 0


@dataclass(frozen=True)
class Program:
    """`operations` in an order of evaluation, of `inputs` real numbers; `outputs` are nodes, that is, positions."""

    inputs: int
    operations: tuple[Operation, ...]
    outputs: tuple[Node, ...]

    @cached_property
    def spent(self) -> tuple[tuple[Node, ...], ...]:
        """For each operation the nodes that nothing needs after it: memory that can be used again."""
        last = dict.fromkeys(self.outputs, len(self.operations))
        found: list[tuple[Node, ...]] = []
        for place in range(len(self.operations) - 1, -1, -1):
            operands = dict.fromkeys(self.operations[place].operands)
            found.append(tuple(node for node in operands if last.setdefault(node, place) == place))
        return tuple(reversed(found))

    def select(self, outputs: tuple[Node, ...]) -> Program:
        """The part of the program that computes these nodes."""
        needed = [False] * len(self.operations)
        for node in outputs:
            needed[node] = True
        for node in range(len(self.operations) - 1, -1, -1):
            if needed[node]:
                for operand in self.operations[node].operands:
                    needed[operand] = True
        place: dict[Node, Node] = {}
        kept: list[Operation] = []
        for node, operation in enumerate(self.operations):
            if needed[node]:
                place[node] = len(kept)
                kept.append(operation._replace(operands=tuple(place[a] for a in operation.operands)))
        return Program(self.inputs, tuple(kept), tuple(place[node] for node in outputs))

    def constant(self, node: Node) -> int | float | Fraction | str | None:
        """The number that a node is, None for any other operation."""
        operation = self.operations[node]
        return operation.datum if operation.name == "number" else None


class TooLong(Exception):
    """The program has more operations than were allowed."""


def _not_finite(value: object) -> bool:
    return isinstance(value, float) and not isfinite(value)


class Builder:
    """A program under construction: equal operations become one node, and neutral elements vanish.

    **Arguments:** `inputs`, how many real numbers the program takes; `most`, how many operations it may have, beyond
    which `TooLong` is raised.
    """

    def __init__(self, inputs: int, most: int) -> None:
        self.inputs = inputs
        self.most = most
        self.operations: list[Operation] = []
        self.known: dict[tuple[object, ...], Node] = {}

    def input(self, position: int) -> Node:
        """The input at a position."""
        return self._node(Operation("input", (), position))

    def number(self, value: int | float | Fraction | str) -> Node:
        """A number, exactly."""
        return self._node(Operation("number", (), value))

    def value(self, node: Node) -> int | float | Fraction | str | None:
        """The number that a node is, None for any other operation."""
        operation = self.operations[node]
        return operation.datum if operation.name == "number" else None

    def power(self, base: Node, exponent: int) -> Node:
        """base to an integer."""
        if exponent == 0:
            return self.number(1.0)
        return base if exponent == 1 else self._node(Operation("power", (base,), exponent))

    def root(self, base: Node, exponent: Fraction) -> Node:
        """The principal value of base to a fraction; base is positive."""
        return self._node(Operation("root", (base,), exponent))

    def apply(self, name: str, *operands: Node) -> Node:
        """An operation that takes no datum, simplified where one operand is 0, 1 or −1."""
        values = [self.value(a) for a in operands]
        simple = self._simplified(name, operands, values)
        if simple is not None:
            return simple
        if name in ("add", "mul") and operands[0] > operands[1]:
            operands = operands[::-1]
        return self._node(Operation(name, operands))

    def program(self, outputs: tuple[Node, ...]) -> Program:
        """The finished program, without what its outputs do not need."""
        return Program(self.inputs, tuple(self.operations), outputs).select(outputs)

    def _simplified(self, name: str, operands: tuple[Node, ...], values: Sequence[object]) -> Node | None:
        if name == "neg":
            inner = self.operations[operands[0]]
            if inner.name == "neg":
                return inner.operands[0]
            return self.number(-inner.datum) if isinstance(inner.datum, float) and inner.name == "number" else None
        if name == "add":
            return operands[1] if values[0] == 0 else operands[0] if values[1] == 0 else None
        if name == "sub":
            if values[1] == 0:
                return operands[0]
            return self.apply("neg", operands[1]) if values[0] == 0 else None
        if name == "mul":
            for a, b in ((0, 1), (1, 0)):
                if values[a] == 0 and not _not_finite(values[b]):
                    return self.number(0.0)
                if values[a] == 1:
                    return operands[b]
                if values[a] == -1:
                    return self.apply("neg", operands[b])
            return None
        if name == "div":
            if values[0] == 0 and values[1] != 0:
                return self.number(0.0)
            return operands[0] if values[1] == 1 else None
        if name == "select":
            return operands[1] if operands[1] == operands[2] else None
        return None

    def _node(self, operation: Operation) -> Node:
        # 0.0 and −0.0 are one number here, 1 and 1.0 another: programs are of real numbers
        key = (*operation[:2], type(operation.datum), operation.datum)
        found = self.known.get(key)
        if found is None:
            if len(self.operations) >= self.most:
                raise TooLong(f"more than {self.most} operations")
            found = self.known[key] = len(self.operations)
            self.operations.append(operation)
        return found
