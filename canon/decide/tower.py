"""The tower: the kernels of the residuals as generators with relations.

Radicals, exponentials, trigonometric and inverse functions become generators of a polynomial ring.
Every relation holds throughout the region (on every branch that the written formulas can take there),
so what reduces to 0 by the relations is the zero function. Nothing is claimed of what doesn't.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from canon.budget import Budget
from canon.decide import angles, exponentials, inverse, jacobi_kernels, radicals, signs
from canon.decide.fraction_field import Element, FractionField
from canon.decide.intervals import Interval
from canon.decide.ring import Polynomial, Ring
from canon.decide.tape import Node, Tape
from canon.sign import declared

KERNELS = "rfu"
SPARE = 2
"""Generators that a ring may have too many: to carry everything into a smaller one costs more."""


class NeedSlots(Exception):
    """The ring was made with too few generators; it is made again, larger."""


@dataclass
class Generator:
    """One generator: what it stands for, its sign where known, and its relation, if it has one.

    `sign` is one of "pos", "neg", "nonneg", "nonpos", "real" and "cplx"; `constant` marks a number.
    """

    index: int
    kind: str
    sign: str
    data: Any
    constant: bool
    degree: int = 0
    lower: Polynomial = None


class Tower:
    """The generators for the kernels that the targets need, built level by level.

    Arguments:
      targets: the nodes whose vanishing is asked.
      positive: nodes known to be positive on the region.
      intervals: exact open intervals of symbols.
      limit: term products that building may cost.
    """

    def __init__(
        self,
        tape: Tape,
        targets: Sequence[Node],
        *,
        positive: Iterable[Node] = (),
        intervals: Mapping[Node, Interval] | None = None,
        limit: float = 2e7,
        budget: Budget,
    ) -> None:
        self.tape, self.budget, self.limit = tape, budget, limit
        self.targets = tuple(targets)
        self.intervals = dict(intervals or {})
        own = set(tape.reach(targets))
        self.positive = [n for n in positive if _adds_no_kernel(tape, n, own)]
        self.need = tape.reach([*targets, *self.positive])
        self.known_signs: dict[Node, str] = {}
        kernels = sum(1 for i in self.need if tape.ops[i][0] in KERNELS)
        leaves = sum(1 for i in self.need if tape.ops[i][0] in "sc")
        slots = max(leaves, 1) + (min(kernels, 24) + SPARE if kernels else 0)
        while True:
            try:
                self._build(slots)
            except NeedSlots:
                slots *= 2
                continue
            late = {g.data: g.sign for g in self.generators if g.kind == "symbol" and g.sign != self._declared(g.data)}
            if all(self.known_signs.get(node) == sign for node, sign in late.items()):
                return
            self.known_signs.update(late)

    # -- generators ---------------------------------------------------------------------------------

    def generator(
        self,
        kind: str,
        sign: str,
        data: Any,
        *,
        relation: tuple[int, Polynomial] | None = None,
        constant: bool = False,
    ) -> Generator:
        """A new generator, with its relation generator ** degree = lower."""
        index = len(self.generators)
        if index >= self.ring.size:
            raise NeedSlots
        made = Generator(index, kind, sign, data, constant)
        self.generators.append(made)
        if relation is not None:
            made.degree, made.lower = relation
            self.field.relate(index, *relation)
        return made

    def element(self, made: Generator) -> Element:
        """The generator as an element of the field."""
        return self.field.generator(made.index)

    def bare(self, p: Polynomial) -> Generator | None:
        """The generator that p is, when p is exactly one generator."""
        if len(p) != 1 or p.total_degree() != 1 or self.ring.leading(p) != 1:
            return None
        return self.generators[self.ring.degrees(p).index(1)]

    def used(self, p: Polynomial) -> list[Generator]:
        """The generators that occur in p."""
        return [self.generators[k] for k, e in enumerate(self.ring.degrees(p)) if e > 0] if p else []

    def parts(self, x: Element) -> list[Polynomial]:
        """Numerator and denominator factors of x."""
        return [x[0], *(self.field.factors[k] for k in x[1])]

    def is_complex(self, x: Element) -> bool:
        """True when a generator that need not be real occurs in x."""
        return any(g.sign == "cplx" for part in self.parts(x) for g in self.used(part))

    def is_constant(self, x: Element) -> bool:
        """True when only numbers occur in x."""
        return all(g.constant for part in self.parts(x) for g in self.used(part))

    def imaginary(self) -> Generator:
        """The imaginary unit, with I² = −1."""
        for g in self.generators:
            if g.kind == "I":
                return g
        return self.generator("I", "cplx", None, relation=(2, self.ring.constant(-1)), constant=True)

    # -- building -----------------------------------------------------------------------------------

    def _declared(self, node: Node) -> str:
        facts = declared(self.tape.symbol_at(node))
        if not facts.get("real"):
            return "cplx"
        if facts.get("positive"):
            return "pos"
        if facts.get("negative"):
            return "neg"
        if facts.get("nonnegative"):
            return "nonneg"
        return "nonpos" if facts.get("nonpositive") else "real"

    def _build(self, slots: int) -> None:
        tape, ops = self.tape, self.tape.ops
        self.ring = Ring(slots, self.limit, self.budget)
        self.field = FractionField(self.ring)
        self.generators: list[Generator] = []
        self.facts: list[tuple[Polynomial, str]] = []
        self.signs: dict[int, list[list[Any]]] = {}
        self.memory: dict[str, list[Any]] = {}
        self.values: dict[Node, Element] = {}
        self.kernels: dict[Node, Element] = {}
        level: dict[Node, int] = {}
        kernels = [i for i in self.need if ops[i][0] in KERNELS]
        for i in self.need:
            below = max((level[j] for j in tape.arguments(i)), default=0)
            level[i] = below + 1 if ops[i][0] in KERNELS else below
        inside = set(tape.reach([*(a for i in kernels for a in tape.arguments(i)), *self.positive]))
        for i in self.need:
            if ops[i][0] in "sc":
                self._leaf(i)
        levels: dict[int, list[Node]] = {}
        for i in self.need:
            levels.setdefault(level[i], []).append(i)
        for number in sorted(levels):
            here = [i for i in levels[number] if ops[i][0] in KERNELS]
            if here:
                self._level(here)
            for i in levels[number]:
                if i in inside and i not in self.values:
                    self.values[i] = combine(self.field, ops[i], self.values)
            for i in self.positive:
                if level[i] == number and i in self.values and not self.is_complex(self.values[i]):
                    signs.learn_positive(self, [self.values[i]])

    def _leaf(self, node: Node) -> None:
        op = self.tape.ops[node]
        if op == ("c", "I"):
            made = self.imaginary()
        elif op[0] == "c":
            made = self.generator("pi", "pos", None, constant=True)
        else:
            sign = self.known_signs.get(node) or self._declared(node)
            if sign == "real" and node in self.intervals:
                sign = self.intervals[node].sign() or sign
            made = self.generator("symbol", sign, node)
        self.values[node] = self.kernels[node] = self.element(made)

    def _level(self, here: Sequence[Node]) -> None:
        """The kernels of one level; radicands and log arguments tell signs before anything is split."""
        tape, ops, values = self.tape, self.tape.ops, self.values
        for argument in sorted({a for i in here for a in tape.arguments(i)}):
            if self.field.relations:
                values[argument] = radicals.tidy(self, values[argument])
        positive = [ops[i][1] for i in here if ops[i][0] == "r"]
        positive += [ops[i][2][0] for i in here if ops[i][0] == "f" and ops[i][1] == "log"]
        signs.learn_positive(self, [values[n] for n in positive if not tape.is_complex(n)])
        elliptic = [ops[i][2] for i in here if ops[i][0] == "f" and ops[i][1] in jacobi_kernels.JACOBI]
        if len(elliptic) > 1 and not any(self.is_complex(values[a]) for pair in elliptic for a in pair):
            jacobi_kernels.prepare(self, [(values[u], values[m]) for u, m in elliptic])
        for i in here:
            op = ops[i]
            if op[0] == "r":
                self._keep(i, radicals.power(self, values[op[1]], Fraction(op[2], op[3])))
            elif op[0] == "u":
                self._keep(i, inverse.arbitrary(self, op[1], op[2], [values[a] for a in op[3]]))
            elif op[1] == "log":
                self._keep(i, exponentials.logarithm(self, values[op[2][0]]))
            elif op[1] == "abs":
                self._keep(i, radicals.absolute(self, values[op[2][0]]))
            elif op[1] not in ("sin", "cos", "exp"):
                self._keep(i, inverse.kernel(self, op[1], [values[a] for a in op[2]]))
        trigonometric = [i for i in here if ops[i][0] == "f" and ops[i][1] in ("sin", "cos")]
        if trigonometric:
            arguments = sorted({ops[i][2][0] for i in trigonometric})
            pairs = dict(zip(arguments, angles.cosines_and_sines(self, [values[a] for a in arguments]), strict=True))
            for i in trigonometric:
                self._keep(i, pairs[ops[i][2][0]][0 if ops[i][1] == "cos" else 1])
        exponential = [i for i in here if ops[i][0] == "f" and ops[i][1] == "exp"]
        for i, value in zip(
            exponential, exponentials.exponential(self, [values[ops[i][2][0]] for i in exponential]), strict=True
        ):
            self._keep(i, value)

    def _keep(self, node: Node, value: Element) -> None:
        self.values[node] = self.kernels[node] = value

    def compact(self, limit: float, budget: Budget) -> tuple[FractionField, dict[Node, Element]]:
        """The finished field with just as many generators as there are, and the kernels in it."""
        size = self.ring.size
        if size - len(self.generators) > SPARE:
            size = max(len(self.generators), 1)
        ring = Ring(size, limit, budget)
        field = FractionField(ring)
        same = ring.context is self.ring.context

        def carried(p: Polynomial) -> Polynomial:
            # of generators that were never made nothing is dropped
            return p if same else p.project_to_context(ring.context)

        for generator, degree, lower, _ in self.field.relations:
            field.relate(generator, degree, carried(lower))
        field.factors = [carried(f) for f in self.field.factors]
        field.root_of = [(carried(f), g, d) for f, g, d in self.field.root_of]
        return field, {node: (carried(x[0]), dict(x[1])) for node, x in self.kernels.items()}


def combine(field: FractionField, op: tuple[Any, ...], values: Mapping[Node, Element]) -> Element:
    """A sum, product or number node from the values of its arguments."""
    if op[0] == "+":
        return field.combine([(c, values[a]) for a, c in op[2]], op[1])
    if op[0] == "*":
        return field.product([field.power(values[a], e) for a, e in op[1]])
    return field.constant(op[1])


def _adds_no_kernel(tape: Tape, node: Node, own: set[Node]) -> bool:
    """True when a condition speaks of kernels and symbols that the targets contain anyway."""
    return all(i in own or tape.ops[i][0] in "n+*" for i in tape.reach([node]))
