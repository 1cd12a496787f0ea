"""The checker's formulas on the deciders' tape: what a certificate must show, where it can be decided."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy as sp

from canon.checker.formulas import Formulas
from canon.decide.defined_functions import COMPLEX, RULES
from canon.decide.load import DIRECT, load
from canon.decide.tape import Node, Tape, Unsupported
from canon.functions import FUNCTIONS
from canon.special import JacobiEpsilon


class OnTape:
    """Nodes of the tape for the checker's formulas, each made once.

    **Arguments:** the tape; the formulas; `symbols`, the claim's names; a name beyond these is a real one.
    """

    def __init__(self, tape: Tape, formulas: Formulas, symbols: Mapping[str, sp.Symbol]) -> None:
        self.tape, self.formulas, self.symbols = tape, formulas, symbols
        self._known: dict[int, Node] = {}

    def node(self, target: int) -> Node:
        """The node of a formula."""
        for a in self.formulas.reach(target):
            if a not in self._known:
                self._known[a] = self._made(a)
        return self._known[target]

    def _made(self, a: int) -> Node:
        tape, op = self.tape, self.formulas.ops[a]
        parts = [self._known[b] for b in self.formulas.parts(a)]
        if op[0] == "n":
            return tape.number(op[1])
        if op[0] == "s":
            if op[1] in ("pi", "1j") and op[1] not in self.symbols:
                return tape.constant("pi" if op[1] == "pi" else "I")
            return tape.symbol(self.symbols.get(op[1]) or sp.Symbol(op[1], real=True))
        if op[0] in "+*":
            return tape.plus(*parts) if op[0] == "+" else tape.times(*parts)
        if op[0] == "^":
            return tape.power(parts[0], op[2])
        if op[1] in self.formulas.functions:
            return tape.arbitrary(op[1], op[2], tuple(parts))
        return self._power(*parts) if op[1] == "power" else self._call(op[1], parts)

    def _power(self, base: Node, exponent: Node) -> Node:
        tape, value = self.tape, self.tape.value(exponent)
        if value is not None:
            return tape.root(base, Fraction(value))
        shown: sp.Expr = tape.to_sympy(exponent)
        if shown.is_integer:
            return load(tape, sp.Pow(tape.to_sympy(base), shown, evaluate=False))
        return tape.call("exp", tape.times(exponent, tape.call("log", base)))

    def _call(self, name: str, parts: list[Node]) -> Node:
        tape, function = self.tape, JacobiEpsilon if name == "jacobi_epsilon" else FUNCTIONS[name][0]
        direct = DIRECT.get(function)
        if direct in COMPLEX and tape.is_complex(parts[0]):
            return COMPLEX[direct](tape, parts[0])
        if direct is not None:
            return tape.call(direct, *parts)
        rule = RULES.get(function.__name__)
        if rule is None:
            raise Unsupported(f"no exact argument about {name}")
        return rule(tape, *parts)
