"""Exact rewritings of a straight-line program before it becomes instructions: nothing here changes what is meant.

Signs are moved out of products, quotients and even powers, so that a pair's two differences share what follows them;
integer powers become products; and where the processor multiplies and adds in one instruction, Dekker's error of a
product is that instruction, with the same bits. What is then contracted is a sum with a product that nothing else
uses: it is rounded once instead of twice. Sums are never reordered, so that those whose rounding is kept stay right.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import pi
from typing import Final

from canon.numeric.compensated import SPLITTER
from canon.program import Node, Operation, Program

COMMUTING: Final = frozenset(["add", "mul", "max", "min", "equal", "and", "or"])


def rewritten(program: Program, *, fused: bool) -> Program:
    """The program with exact rewritings, and "fma" (a·b + c, rounded once) where the processor is `fused`."""
    first = _Signs(program).done()
    return _contracted(_product_errors(first)) if fused else first


class _Signs:
    """A program built anew, with signs moved outwards and powers multiplied out."""

    def __init__(self, program: Program) -> None:
        self.old = program
        self.operations: list[Operation] = []
        self.known: dict[Operation, Node] = {}
        self.differences = {o.operands for o in program.operations if o.name == "sub"}

    def done(self) -> Program:
        place: list[Node] = []
        for name, operands, datum in self.old.operations:
            a = [place[k] for k in operands]
            if name == "sub" and operands[0] > operands[1] and operands[::-1] in self.differences:
                place.append(self.apply("neg", self.apply("sub", a[1], a[0])))
            elif name == "power":
                place.append(self.power(a[0], int(datum)))
            elif name == "number":
                place.append(self.node("number", (), number(datum)))
            elif name in ("input", "root"):
                place.append(self.node(name, tuple(a), datum))
            else:
                place.append(self.apply(name, *a))
        whole = Program(self.old.inputs, tuple(self.operations), tuple(place[k] for k in self.old.outputs))
        return whole.select(whole.outputs)

    def node(self, name: str, operands: tuple[Node, ...] = (), datum: object = 0) -> Node:
        made = Operation(name, operands, datum)  # type: ignore[arg-type]
        if made not in self.known:
            self.known[made] = len(self.operations)
            self.operations.append(made)
        return self.known[made]

    def inner(self, node: Node) -> Node | None:
        """x where the node is −x."""
        operation = self.operations[node]
        return operation.operands[0] if operation.name == "neg" else None

    def negative(self, node: Node) -> Node:
        found = self.inner(node)
        return self.node("neg", (node,)) if found is None else found

    def apply(self, name: str, *a: Node) -> Node:
        inner = [self.inner(k) for k in a]
        if name == "neg":
            return self.negative(a[0])
        if name in ("mul", "div") and any(x is not None for x in inner):
            bare = [k if x is None else x for k, x in zip(a, inner, strict=True)]
            found = self.apply(name, *bare)
            return found if all(x is not None for x in inner) else self.negative(found)
        if name in ("add", "sub") and any(x is not None for x in inner):
            return self.signed_sum(name, a, inner)
        if name == "abs" and inner[0] is not None:
            return self.node("abs", (inner[0],))
        return self.node(name, tuple(sorted(a)) if name in COMMUTING else a)

    def signed_sum(self, name: str, a: Sequence[Node], inner: Sequence[Node | None]) -> Node:
        x, y = inner
        if x is not None and y is not None:
            return self.negative(self.node(name, (x, y) if name == "sub" else (min(x, y), max(x, y))))
        if y is not None:
            return self.apply("sub" if name == "add" else "add", a[0], y)
        assert x is not None
        if name == "add":
            return self.apply("sub", a[1], x)
        return self.negative(self.apply("add", x, a[1]))

    def power(self, base: Node, exponent: int) -> Node:
        if exponent < 0:
            return self.apply("div", self.node("number", (), 1.0), self.power(base, -exponent))
        result: Node | None = None
        while exponent:
            if exponent & 1:
                result = base if result is None else self.apply("mul", result, base)
            exponent >>= 1
            base = self.apply("mul", base, base) if exponent else base
        return self.node("number", (), 1.0) if result is None else result


def number(datum: int | float | Fraction | str) -> float:
    """The double nearest to a program's number."""
    return pi if datum == "pi" else float(Fraction(datum)) if isinstance(datum, (int, Fraction)) else float(datum)


def _product_errors(program: Program) -> Program:
    """Dekker's error of a product, ((a₁b₁ − ab) + a₁b₂ + a₂b₁) + a₂b₂ of the halves a₁ + a₂ = a, as fma(a, b, −ab)."""
    operations = [*program.operations]
    halves = _halves(operations)
    if not halves:
        return program

    def products(node: Node) -> list[tuple[tuple[Node, str], tuple[Node, str]]]:
        """The halves (of what, which) that a node multiplies, in both orders."""
        name, operands, _ = operations[node]
        if name != "mul" or any(k not in halves for k in operands):
            return []
        first, second = (halves[k] for k in operands)
        return [(first, second), (second, first)]

    def terms(node: Node) -> list[tuple[Node, Node]]:
        name, operands, _ = operations[node]
        return [operands, operands[::-1]] if name == "add" else []  # type: ignore[list-item]

    def matched(node: Node) -> tuple[Node, Node, Node] | None:
        """(a, b, ab) where the node is the error of their product."""
        for three, lowest in terms(node):
            for (a, which), (b, other) in products(lowest)[:1]:
                if (which, other) != ("low", "low"):
                    continue
                crossed = {((a, "high"), (b, "low")), ((a, "low"), (b, "high"))}
                for two, last in terms(three):
                    for one, middle in terms(two):
                        found = [next((p for p in products(k) if p in crossed), None) for k in (middle, last)]
                        if None in found or (a != b and found[0] == found[1]):
                            continue
                        name, operands, _ = operations[one]
                        if name == "sub" and ((a, "high"), (b, "high")) in products(operands[0]):
                            product = operands[1]
                            if operations[product] == Operation("mul", (min(a, b), max(a, b))):
                                return a, b, product
        return None

    increments: dict[Node, Node] = {}
    for node, operation in enumerate(operations):
        if operation.name == "add" and (found := matched(node)) is not None:
            operations[node] = Operation("fms", found)
        elif operation.name == "add":
            operations[node] = _increment(operations, node, increments)
        elif operation.name == "sub":
            _increment_error(operations, node, increments)
    return Program(program.inputs, tuple(operations), program.outputs).select(program.outputs)


def _increment(operations: Sequence[Operation], node: Node, increments: dict[Node, Node]) -> Operation:
    """a·b + (its error + c) as fma(a, b, c), the sum of the three rounded once, as it is meant: one of `increments`."""
    for product, rest in (operations[node].operands, operations[node].operands[::-1]):
        if operations[product].name == "mul" and operations[rest].name == "add":
            for error, other in (operations[rest].operands, operations[rest].operands[::-1]):
                name, operands, _ = operations[error]
                if name == "fms" and operands[2] == product:
                    increments[node] = rest
                    return Operation("fma", (operands[0], operands[1], other))
    return operations[node]


def _increment_error(operations: list[Operation], node: Node, increments: dict[Node, Node]) -> None:
    """What rounding took from such an increment i, (error + c) − (i − ab), as (ab − i) + c: of these the first is exact
    but for a rounding of its own small size.
    """
    rest, below = operations[node].operands
    name, operands, _ = operations[below]
    if name == "sub" and increments.get(operands[0]) == rest:
        a, b, c = operations[operands[0]].operands
        if operations[operands[1]] == Operation("mul", (min(a, b), max(a, b))):
            operations[below] = Operation("fms", (a, b, operands[0]))
            operations[node] = Operation("add", (below, c))


def _halves(operations: Sequence[Operation]) -> dict[Node, tuple[Node, str]]:
    """What is the high or the low half of what: c − (c − a) with c = 134217729 a, and a minus that. Dekker (1971)."""
    scaled: dict[Node, Node] = {}
    below: dict[Node, Node] = {}
    halves: dict[Node, tuple[Node, str]] = {}
    for node, (name, operands, _) in enumerate(operations):
        if name == "mul":
            for a, b in (operands, operands[::-1]):
                if operations[b].name == "number" and operations[b].datum == SPLITTER:
                    scaled[node] = a
        elif name == "sub":
            a, b = operands
            if scaled.get(a) == b:
                below[node] = b
            elif a in scaled and below.get(b) == scaled[a] and operations[b].operands[0] == a:
                halves[node] = (scaled[a], "high")
            elif halves.get(b) == (a, "high"):
                halves[node] = (a, "low")
    return halves


def _contracted(program: Program) -> Program:
    """Sums with a product that nothing else uses as one operation: "fma" a·b + c, "fms" a·b − c, "fnma" c − a·b.

    Where both terms are such products, the one that takes longer to be known is multiplied and added at once.
    """
    operations = [*program.operations]
    uses = [0] * len(operations)
    for operation in operations:
        for k in operation.operands:
            uses[k] += 1
    for k in program.outputs:
        uses[k] += 1
    depth: list[int] = []
    for node, (name, operands, _) in enumerate(operations):
        if name in ("add", "sub"):
            single = [k for k in operands if operations[k].name == "mul" and uses[k] == 1]
            if single:
                product = max(single, key=lambda k: depth[k])
                a, b = operations[product].operands
                other = operands[1] if product == operands[0] else operands[0]
                if name == "add":
                    operations[node] = Operation("fma", (a, b, other))
                else:
                    operations[node] = Operation("fms" if product == operands[0] else "fnma", (a, b, other))
        name, operands, _ = operations[node]
        depth.append(max((depth[k] for k in operands), default=0) + (0 if name in ("input", "number", "neg") else 1))
    return Program(program.inputs, tuple(operations), program.outputs).select(program.outputs)
