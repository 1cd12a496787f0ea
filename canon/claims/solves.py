"""Functions that solve equations: each arbitrary function of the file is replaced by the formula claimed for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from canon.claims.chart import required_in_place_of
from canon.claims.outcome import Outcome, Residual
from canon.decide.derivative import derivative, rebuild, substitute
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node
from canon.domain import Domain
from canon.errors import InputError
from canon.expression import Formula
from canon.granted import called

if TYPE_CHECKING:
    import sympy as sp

    from canon.claims.question import Question


def solves(question: Question) -> Outcome:
    """`solves`: with `solution` in place of the functions, every one of `equations` vanishes.

    Derivatives are those of the formulas; x(0) and x(2*t) are their values at these arguments, so that initial and
    boundary conditions are equations like others.
    """
    solution: Mapping[sp.Expr, Formula] = question.key("solution")
    equations = question.formulas("equations", side="both")
    for formula in equations:
        if not any(_calls(formula, call) for call in solution):
            raise InputError(f"the equation {formula} has none of the functions of 'solution' in it", "key 'equations'")
        _check_slopes(question, formula, solution)
    written = question.region(*equations)
    replaced = _Replaced(question, solution)
    residuals = [
        Residual(f"equation {i}", replaced.value(question.chart.pull(question.load(formula))))
        for i, formula in enumerate(equations, 1)
    ]
    for formula in equations:
        for call in called(formula.granted):
            replaced.value(question.chart.pull(question.load(call)))
    kept = [
        Requirement(r.kind, tuple(replaced.value(node) for node in r.nodes), r.said, r.note)
        for r in written.requirements
    ]
    surface = tuple(replaced.value(node) for node in written.surface)
    region = Region((*kept, *replaced.requirements), surface, written.symbols)
    return question.decide(residuals, region)


def _check_slopes(question: Question, formula: Formula, solution: Mapping[sp.Expr, Formula]) -> None:
    """D(f(t), a) is no 0 where the solution is a cos t: a derivative is taken before anything is put in.

    **Raises:** `InputError` for one by a name on which a solution depends otherwise than by the function's arguments:
    one that stands in it, or, where the file has a map, one on which what stands in it depends by the map.
    """
    space = question.space
    old, new = {x.name for x in space.old}, {x.name for x in space.new}
    for call, value in solution.items():
        held: set[str] = {x.name for x in value.expr.free_symbols}  # pyright: ignore[reportAttributeAccessIssue]
        held |= (new if held & old else set()) | (old if held & new else set())
        held -= {x.name for x in call.args}  # pyright: ignore[reportAttributeAccessIssue]
        wrong = sorted(x for x, name in formula.slopes if name == call.func.__name__ and x in held)
        if wrong:
            raise InputError(
                f"the equation {formula} has a derivative of {call} by {wrong[0]!r}, on which the solution {value} "
                f"depends, but not the function: make {wrong[0]!r} one of its arguments, or write the derivative",
                "key 'equations'",
            )


def _calls(formula: Formula, call: sp.Expr) -> bool:
    return any(name == call.func.__name__ for name, _ in formula.calls)


@dataclass(frozen=True)
class _Function:
    """A formula with the nodes of its arguments, and where it is smooth."""

    arguments: tuple[Node, ...]
    value: Node
    region: Region


class _Replaced:
    """Nodes with the functions of a solution put in, and the conditions that come with them."""

    def __init__(self, question: Question, solution: Mapping[sp.Expr, Formula]) -> None:
        self.tape = question.tape
        self.images = question.chart.images
        self.values: dict[Node, Node] = {}
        self.requirements: list[Requirement] = []
        self.functions = {
            call.func.__name__: _Function(
                tuple(self.tape.symbol(x) for x in call.args),  # pyright: ignore[reportArgumentType]
                question.load(formula),
                Region.of(self.tape, Domain(formula.conditions)),
            )
            for call, formula in solution.items()
        }

    def value(self, node: Node) -> Node:
        """The node with every function replaced, its arguments first."""
        for i in self.tape.reach([node]):
            if i not in self.values:
                op = self.tape.ops[i]
                known = op[0] == "u" and op[1] in self.functions
                self.values[i] = self._applied(i) if known else rebuild(self.tape, i, self.values)
        return self.values[node]

    def _applied(self, node: Node) -> Node:
        _, name, orders, arguments = self.tape.ops[node]
        function = self.functions[name]
        slope = function.value
        for x, order in zip(function.arguments, orders, strict=True):
            for _ in range(order):
                slope = derivative(self.tape, slope, x)
        own_images = dict(zip(function.arguments, (self.values[a] for a in arguments), strict=True))
        images = {**self.images, **own_images}  # what else stands in the solution is related to the rest by the map
        own: list[Requirement] = []
        for r in function.region.requirements:
            nodes = tuple(substitute(self.tape, n, images) for n in r.nodes)
            own.append(r if nodes == r.nodes else Requirement(r.kind, nodes, r.said, f" (of {name} at its argument)"))
        for x, image in own_images.items():
            own += required_in_place_of(self.tape, self.tape.symbol_at(x), image, "key 'equations'")
        self.requirements += [r for r in dict.fromkeys(own) if r not in self.requirements]
        return substitute(self.tape, slope, images)


KINDS = {"solves": solves}
