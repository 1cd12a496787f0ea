"""The tape: a hash-consed straight-line program that every evaluator of the deciders shares.

A node is a small tuple; equal tuples are one node, so common subexpressions exist once. Sums are
n-ary linear combinations with rational coefficients, products are n-ary with integer exponents.

    ("n", value)                      a rational number
    ("c", name)                       the constants pi and I
    ("s", k)                          the k-th symbol
    ("+", constant, ((node, coefficient), …))
    ("*", ((node, exponent), …))
    ("r", base, numerator, denominator)     base ** (numerator/denominator), principal value
    ("f", name, (argument, …))        an elementary or special function
    ("u", name, (order, …), (argument, …))  an arbitrary smooth function, differentiated `order` times
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import sympy as sp

from canon.decide.known_values import at_known_arguments
from canon.errors import InputError

ZERO = Fraction(0)
ONE = Fraction(1)
LONG = 64
"""Terms of a sum, beyond which a difference of two such is merged."""

Node = int


class Unsupported(Exception):
    """A construct that the exact deciders have no argument for; the ladder answers `undecided`."""


class Tape:
    """A growing straight-line program over real (or complex) symbols.

    The tape only ever appends, so a node id stays valid for the tape's life.
    """

    def __init__(self) -> None:
        self.ops: list[tuple[Any, ...]] = []
        self.symbols: list[sp.Symbol] = []
        self.loaded: dict[sp.Basic, Node] = {}
        self.derivatives: dict[Node, dict[Node, Node]] = {}
        self._memo: dict[tuple[Any, ...], Node] = {}
        self._arguments: list[tuple[Node, ...]] = []
        self._symbol_node: dict[sp.Symbol, Node] = {}
        self._support: dict[Node, frozenset[Node]] = {}
        self._complex: dict[Node, bool] = {}
        self.zero, self.one = self.number(ZERO), self.number(ONE)

    def make(self, op: tuple[Any, ...], key: tuple[Any, ...] | None = None) -> Node:
        """The node of this operation, new or old; `key` stands for the operation where that is quicker to look up."""
        if key is None:
            key = op
        node = self._memo.get(key)
        if node is None:
            node = len(self.ops)
            self.ops.append(op)
            self._arguments.append(_arguments(op))
            self._memo[key] = node
        return node

    def number(self, value: Fraction | int) -> Node:
        """A rational number."""
        return self.make(("n", value if type(value) is Fraction else Fraction(value)))

    def symbol(self, symbol: sp.Symbol) -> Node:
        """A variable, parameter or time."""
        node = self._symbol_node.get(symbol)
        if node is None:
            self.symbols.append(symbol)
            node = self.make(("s", len(self.symbols) - 1))
            self._symbol_node[symbol] = node
        return node

    def constant(self, name: str) -> Node:
        """`pi` or the imaginary unit `I`."""
        return self.make(("c", name))

    def value(self, node: Node) -> Fraction | None:
        """The rational value of a number node, else None."""
        op = self.ops[node]
        return op[1] if op[0] == "n" else None

    def symbol_at(self, node: Node) -> sp.Symbol:
        """The sympy symbol of a symbol node."""
        return self.symbols[self.ops[node][1]]

    def add(self, terms: Iterable[tuple[Node, Fraction | int]], constant: Fraction | int = 0) -> Node:
        """The linear combination constant + Σ coefficient · node."""
        ops = self.ops
        merged: dict[Node, Fraction | int] = {}
        for node, coefficient in terms:
            op = ops[node]
            kind = op[0]
            if kind == "n":
                constant = constant + (op[1] if coefficient is ONE else coefficient * op[1])
                continue
            if kind == "+" and len(op[2]) == 1 and not op[1]:
                node, inner = op[2][0]
                coefficient = inner if coefficient is ONE else coefficient * inner
            known = merged.get(node)
            merged[node] = coefficient if known is None else known + coefficient
        kept = [(node, c if type(c) is Fraction else Fraction(c)) for node, c in merged.items() if c]
        if not kept:
            return self.number(constant)
        if len(kept) == 1 and not constant and kept[0][1] == 1:
            return kept[0][0]
        kept.sort()
        constant = constant if type(constant) is Fraction else Fraction(constant)
        key = ("+", constant.as_integer_ratio(), *[(node, *c.as_integer_ratio()) for node, c in kept])
        return self.make(("+", constant, tuple(kept)), key)  # a hash of integers is quicker than one of fractions

    def mul(self, factors: Iterable[tuple[Node, int]], coefficient: Fraction | int = 1) -> Node:
        """The power product coefficient · Π node ** exponent (integer exponents).

        Raises InputError for a division by an expression that is the number zero.
        """
        ops = self.ops
        merged: dict[Node, int] = {}
        pending = list(factors)
        while pending:
            node, exponent = pending.pop()
            if not exponent:
                continue
            op = ops[node]
            kind = op[0]
            if kind == "n":
                if op[1] == 0 and exponent < 0:
                    raise InputError("a denominator is zero everywhere")
                coefficient = coefficient * (op[1] if exponent == 1 else op[1] ** exponent)
            elif kind == "+" and len(op[2]) == 1 and not op[1]:
                inner, factor = op[2][0]
                coefficient = coefficient * (factor if exponent == 1 else factor**exponent)
                pending.append((inner, exponent))
            elif kind == "*":
                for inner, power in op[1]:
                    merged[inner] = merged.get(inner, 0) + exponent * power
            elif op == ("c", "I"):
                unit, sign = divmod(exponent % 4, 2)
                coefficient *= -1 if unit else 1
                merged[node] = merged.get(node, 0) + sign
            else:
                merged[node] = merged.get(node, 0) + exponent
        if not coefficient:
            return self.zero
        imaginary = self._memo.get(("c", "I"))
        if imaginary is not None and abs(merged.get(imaginary, 0)) > 1:
            unit, sign = divmod(merged[imaginary] % 4, 2)
            coefficient *= -1 if unit else 1
            merged[imaginary] = sign
        kept = [(node, e) for node, e in merged.items() if e]
        if not kept:
            return self.number(coefficient)
        kept.sort()
        product = kept[0][0] if len(kept) == 1 and kept[0][1] == 1 else self.make(("*", tuple(kept)))
        return product if coefficient == 1 else self.add(((product, coefficient),))

    def plus(self, *nodes: Node) -> Node:
        """The sum of the nodes."""
        return self.add([(node, ONE) for node in nodes])

    def minus(self, left: Node, right: Node) -> Node:
        """left − right; of two long sums term by term, so that what they share is gone before anything is computed."""
        a, b = self.ops[left], self.ops[right]
        if a[0] == b[0] == "+" and min(len(a[2]), len(b[2])) > LONG:
            return self.add([*a[2], *((node, -c) for node, c in b[2])], a[1] - b[1])
        return self.add(((left, ONE), (right, -ONE)))

    def times(self, *nodes: Node) -> Node:
        """The product of the nodes."""
        return self.mul([(node, 1) for node in nodes])

    def negative(self, node: Node) -> Node:
        """−node."""
        return self.add(((node, -ONE),))

    def scaled(self, node: Node, factor: Fraction | int) -> Node:
        """factor · node."""
        return self.add(((node, Fraction(factor)),))

    def power(self, node: Node, exponent: int) -> Node:
        """node ** exponent for an integer exponent."""
        return self.mul(((node, exponent),))

    def root(self, base: Node, exponent: Fraction) -> Node:
        """base ** exponent, principal value, for a rational exponent."""
        exponent = Fraction(exponent)
        if exponent.denominator == 1:
            return self.power(base, exponent.numerator)
        value = self.value(base)
        if value == 1:
            return self.one
        if value == 0:
            if exponent < 0:
                raise InputError("a denominator is zero everywhere")
            return self.zero
        return self.make(("r", base, exponent.numerator, exponent.denominator))

    def sqrt(self, node: Node) -> Node:
        """The principal square root."""
        return self.root(node, Fraction(1, 2))

    def call(self, name: str, *arguments: Node) -> Node:
        """An elementary or special function; where its value is known it is that."""
        known = at_known_arguments(self, name, arguments)
        return self.make(("f", name, arguments)) if known is None else known

    def arbitrary(self, name: str, orders: tuple[int, ...], arguments: tuple[Node, ...]) -> Node:
        """The partial derivative of an arbitrary function, at these arguments."""
        return self.make(("u", name, orders, arguments))

    def load(self, expression: sp.Expr | int) -> Node:
        """The node of a sympy expression (canon.decide.load)."""
        from canon.decide.load import load

        return load(self, expression)

    def arguments(self, node: Node) -> tuple[Node, ...]:
        """The nodes that this one is computed from."""
        return self._arguments[node]

    def reach(self, targets: Iterable[Node]) -> list[Node]:
        """Every node needed for the targets, in an order of evaluation."""
        arguments = self._arguments
        seen = set(targets)
        stack = list(seen)
        while stack:
            for inner in arguments[stack.pop()]:
                if inner not in seen:
                    seen.add(inner)
                    stack.append(inner)
        return sorted(seen)

    def support(self, node: Node) -> frozenset[Node]:
        """The symbol nodes that this node depends on."""
        if node not in self._support:
            for inner in self.reach([node]):
                if inner not in self._support:
                    if self.ops[inner][0] == "s":
                        self._support[inner] = frozenset((inner,))
                    else:
                        self._support[inner] = frozenset().union(*(self._support[a] for a in self.arguments(inner)))
        return self._support[node]

    def symbols_of(self, node: Node) -> set[sp.Symbol]:
        """The sympy symbols that this node depends on."""
        return {self.symbol_at(inner) for inner in self.support(node)}

    def functions_of(self, nodes: Iterable[Node]) -> set[str]:
        """The names of the arbitrary functions in the nodes."""
        return {self.ops[i][1] for i in self.reach(nodes) if self.ops[i][0] == "u"}

    def is_complex(self, node: Node) -> bool:
        """True where the imaginary unit or a symbol that isn't real occurs in the node."""
        if node not in self._complex:
            for inner in self.reach([node]):
                if inner not in self._complex:
                    op = self.ops[inner]
                    if op[0] == "s":
                        self._complex[inner] = not self.symbols[op[1]].is_real
                    else:
                        own = op == ("c", "I")
                        inside = own or any(self._complex[a] for a in self.arguments(inner))
                        self._complex[inner] = inside and op[:2] != ("f", "abs")
        return self._complex[node]

    def to_sympy(self, node: Node) -> sp.Expr:
        """The node as a sympy expression, for showing to people (canon.decide.load)."""
        from canon.decide.unload import unload

        return unload(self, node)


def _arguments(op: tuple[Any, ...]) -> tuple[Node, ...]:
    """The nodes that an operation is applied to."""
    kind = op[0]
    if kind == "+":
        return tuple([inner for inner, _ in op[2]])
    if kind == "*":
        return tuple([inner for inner, _ in op[1]])
    if kind == "r":
        return (op[1],)
    if kind == "f":
        return op[2]
    return op[3] if kind == "u" else ()
