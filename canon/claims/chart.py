"""Coordinates in which both the old and the new variables are explicit, so that no map is ever inverted.

For a map given forward these are (q, p); for one given backward (Q, P); for one that a generating function
defines the mixed variables u, of which q, p, Q and P all are explicit functions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from canon.claims.determinant import determinant
from canon.decide.derivative import derivative, substitute
from canon.decide.region import Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.sign import declared

if TYPE_CHECKING:
    import sympy as sp

    from canon.mechanics import PhaseSpace, Transformation


@dataclass(frozen=True)
class Chart:
    """Old and new variables as nodes over common coordinates.

    **Arguments:** `direction` of the map ("none" where there is no map); `coordinates`, symbol nodes, positions
    first; `old` = (q, p) and `new` = (Q, P) as functions of these; `images`, the nodes that stand for the variables
    that are not coordinates themselves; `hessian`, the determinant of the mixed Hessian of a generating function,
    which is not 0 where the map that it defines exists.
    """

    tape: Tape
    direction: str
    coordinates: tuple[Node, ...]
    old: tuple[Node, ...]
    new: tuple[Node, ...]
    images: Mapping[Node, Node]
    time: Node
    hessian: Node | None = None

    def pull(self, node: Node) -> Node:
        """A function of old and new variables, as a function of the coordinates."""
        return substitute(self.tape, node, self.images) if self.images else node

    def jacobian(self, functions: Sequence[Node]) -> list[list[Node]]:
        """Their derivatives by the coordinates, one row for each function."""
        return [[derivative(self.tape, f, u) for u in self.coordinates] for f in functions]

    def by_time(self, functions: Sequence[Node]) -> list[Node]:
        """Their derivatives by time at fixed coordinates."""
        return [derivative(self.tape, f, self.time) for f in functions]


def chart_of(tape: Tape, space: PhaseSpace, transformation: Transformation | None) -> Chart:
    """The chart of a transformation (of none at all: the old variables)."""
    old = tuple(tape.symbol(s) for s in space.old)
    new = tuple(tape.symbol(s) for s in space.new)
    time = tape.symbol(space.t)
    if transformation is None:
        return Chart(tape, "none", old, old, (), {}, time)
    if transformation.direction == "implicit":
        return _mixed_chart(tape, transformation, old, new, time)
    formulas = tuple(tape.load(formula.expr) for formula in transformation.formulas)
    if transformation.direction == "forward":
        return Chart(tape, "forward", old, old, formulas, dict(zip(new, formulas, strict=True)), time)
    return Chart(tape, "backward", new, formulas, new, dict(zip(old, formulas, strict=True)), time)


def _mixed_chart(
    tape: Tape, transformation: Transformation, old: tuple[Node, ...], new: tuple[Node, ...], time: Node
) -> Chart:
    generating = transformation.generating_function
    assert generating is not None
    F = tape.load(generating.F.expr)
    u = tuple(tape.symbol(s) for s in generating.mixed)
    names = tuple(tape.symbol(s) for s in (*generating.old_conjugates, *generating.new_conjugates))
    old_signs, new_signs = generating.signs()
    images = {
        name: tape.scaled(derivative(tape, F, x), sign)
        for name, x, sign in zip(names, u, (*old_signs, *new_signs), strict=True)
    }
    columns = u[len(u) // 2 :]
    rows = [derivative(tape, F, a) for a in u[: len(u) // 2]]
    hessian = determinant(tape, [[derivative(tape, row, b) for b in columns] for row in rows])
    every = [tuple(images.get(variable, variable) for variable in side) for side in (old, new)]
    return Chart(tape, "implicit", u, every[0], every[1], images, time, hessian)


def required_of(tape: Tape, symbol: sp.Symbol, image: Node) -> Iterator[Requirement]:
    """What is assumed of a variable must hold of its image: the domain of a map ends where it doesn't."""
    facts = declared(symbol)
    value = tape.value(image)
    if value == 0 and facts.get("zero") is not False:  # the edge of what is assumed, which belongs to it
        return
    if facts.get("nonnegative"):
        yield Requirement("positive", (image,), f"{symbol} > 0 (pulled back)")
    elif facts.get("nonpositive"):
        yield Requirement("positive", (tape.negative(image),), f"{symbol} < 0 (pulled back)")
    elif facts.get("zero") is False:
        yield Requirement("nonzero", (image,), f"{symbol} != 0 (pulled back)")


def required_in_place_of(tape: Tape, symbol: sp.Symbol, image: Node, where: str) -> Iterator[Requirement]:
    """What is assumed of a name must hold of what is put in its place: its formulas are simplified by that.

    √a² is a where a is positive, and cos 2πn is 1 for whole numbers n.

    **Raises:** `InputError` where a whole or a real number stands for something that isn't seen to be one.
    """
    facts = declared(symbol)
    if image == tape.symbol(symbol) or not facts:
        return
    if facts.get("integer") and not tape.to_sympy(image).expand().is_integer:
        raise InputError(
            f"{symbol} is an integer, and {tape.to_sympy(image)} in its place is not seen to be one", where
        )
    if facts.get("real") and tape.is_complex(image):
        raise InputError(f"{symbol} is real, and {tape.to_sympy(image)} in its place is not seen to be", where)
    yield from required_of(tape, symbol, image)
