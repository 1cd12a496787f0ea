"""Regions in which every loop can be contracted, so that every closed one-form on them is exact.

Three facts are put together, for any values of the parameters. Conditions that hold everywhere, or that take out what
another condition takes out too, are left aside first.
* A condition on an expression y = A + B·v, in which v is an unbounded coordinate that neither A and B nor the other
  conditions contain, and B has no zero, becomes a condition on y alone when y takes the place of v. The region is then
  the product of a half-line, of a line without 0, or of a plane without the slit of atan2, with the region of the other
  conditions. These are what is left to look at.
* Conditions on one coordinate each, and affine ones, cut out convex sets (Poincaré's lemma).
* A set of codimension three or more may be taken out of a region without making it multiply connected: loops and the
  discs that they span can be moved off it (Guillemin and Pollack, Differential Topology, §2.3).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations

from canon.budget import Budget
from canon.decide.derivative import derivative, substitute
from canon.decide.intervals import Interval, intervals_of
from canon.decide.region import Region, Requirement
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.sign import declared

HANDLED = ("positive", "nonzero", "uncut")


def loops_contract(tape: Tape, region: Region, coordinates: Sequence[Node], budget: Budget) -> bool:
    """True when every loop of the region, at fixed parameters, is shown to be contractible in it."""
    space = _Space(tape, coordinates, intervals_of(tape, region), budget)
    if region.surface or not space.is_real():
        return False
    asked = [r for whole in region.requirements for r in space.parts(whole)]
    left = [r for r in asked if not space.is_idle(r)]
    if any(r.kind not in HANDLED for r in left):
        return False
    for r in list(left):  # one by one: of two conditions that take out the same points, one must stay
        if space.is_elsewhere(r, [other for other in left if other is not r]):
            left.remove(r)
    while left:
        budget.check()
        straight = next((r for r in left if space.straightens(r, [other for other in left if other is not r])), None)
        if straight is None:
            break
        left.remove(straight)
    return all(space.is_convex(r) or space.is_thin(r) for r in left)


class _Space:
    """The space of the coordinates, with the bounds that single ones have."""

    def __init__(self, tape: Tape, coordinates: Sequence[Node], box: dict[Node, Interval], budget: Budget) -> None:
        self.tape, self.coordinates, self.box, self.budget = tape, frozenset(coordinates), box, budget

    def is_real(self) -> bool:
        return all(s.is_real and not s.is_integer for s in map(self.tape.symbol_at, self.coordinates))

    def inside(self, *nodes: Node) -> set[Node]:
        """The coordinates that the nodes contain."""
        return {x for node in nodes for x in self.tape.support(node) & self.coordinates}

    def parts(self, requirement: Requirement) -> Iterator[Requirement]:
        """A product isn't 0 where no factor is, a root where its radicand isn't."""
        op = self.tape.ops[requirement.nodes[0]]
        inner = [factor for factor, _ in op[1]] if op[0] == "*" else [op[1]] if op[0] == "r" else []
        if requirement.kind == "nonzero" and inner:
            for node in inner:
                yield from self.parts(Requirement("nonzero", (node,), requirement.said))
        else:
            yield requirement

    def is_elsewhere(self, requirement: Requirement, others: Sequence[Requirement]) -> bool:
        """It takes out the zeros of a sum of squares, and these lie outside of the region anyway."""
        if requirement.kind == "uncut" or not is_sum_of_squares(self.tape, requirement.nodes[0]):
            return False
        zeros: dict[Node, Node] = {}
        for term, _ in self.tape.ops[requirement.nodes[0]][2]:
            base = substitute(self.tape, self.base(term), zeros)
            for x in sorted(self.inside(base)):
                slope = self.tape.value(derivative(self.tape, base, x))
                if slope:
                    image = self.tape.scaled(substitute(self.tape, base, {x: self.tape.zero}), -1 / slope)
                    zeros = {y: substitute(self.tape, old, {x: image}) for y, old in zeros.items()} | {x: image}
                    break
        return any(self.fails(other, zeros) for other in others)

    def fails(self, requirement: Requirement, zeros: Mapping[Node, Node]) -> bool:
        """Whether the condition is false at all points of this form."""
        try:
            first, *rest = [substitute(self.tape, node, zeros) for node in requirement.nodes]
        except (InputError, ZeroDivisionError):
            return False
        if requirement.kind == "uncut":
            return first == self.tape.zero and (rest[0] == self.tape.zero or self.sign(rest[0]) == "neg")
        return first == self.tape.zero or (requirement.kind == "positive" and self.sign(first) == "neg")

    def base(self, term: Node) -> Node:
        """b of a term b², the term itself where it is none."""
        op = self.tape.ops[term]
        return op[1][0][0] if op[0] == "*" and len(op[1]) == 1 else term

    def is_idle(self, requirement: Requirement) -> bool:
        """It restricts nothing but parameters, or holds wherever it is defined."""
        nodes = requirement.nodes
        if not self.inside(*nodes):
            return True
        if requirement.kind not in HANDLED:
            return False
        sign = self.sign(nodes[0])
        if requirement.kind == "uncut":
            return sign is not None or self.sign(nodes[1]) == "pos"
        return sign == "pos" or (requirement.kind == "nonzero" and sign == "neg")

    def is_complex(self, requirement: Requirement) -> bool:
        """Whether it isn't one equation in real numbers that it takes out, but two: x + i·y is 0 at a point alone."""
        return any(self.tape.is_complex(node) for node in requirement.nodes)

    def sign(self, node: Node) -> str | None:
        return definite_sign(self.tape, node, self.box, self.budget)

    def is_free(self, x: Node) -> bool:
        """All real numbers are allowed for the coordinate."""
        facts = declared(self.tape.symbol_at(x))
        return x not in self.box and not (
            facts.get("nonnegative") or facts.get("nonpositive") or facts.get("zero") is False
        )

    def straightens(self, requirement: Requirement, others: Sequence[Requirement]) -> bool:
        """Whether its expressions may take the places of coordinates that the other conditions don't contain."""
        if self.is_complex(requirement):
            return False
        elsewhere = self.inside(*(node for other in others for node in other.nodes))
        free = [x for x in sorted(self.inside(*requirement.nodes) - elsewhere) if self.is_free(x)]
        if len(requirement.nodes) == 1:
            return any(self.is_monotone(requirement.nodes[0], x, others) for x in free)
        return any(
            x not in self.inside(second) and self.is_monotone(first, x, others) and self.is_monotone(second, y, others)
            for first, second in permutations(requirement.nodes)
            for x, y in permutations(free, 2)
        )

    def is_monotone(self, node: Node, x: Node, others: Sequence[Requirement]) -> bool:
        """node = A + B·x with B nowhere 0, where the others hold."""
        slope = derivative(self.tape, node, x)
        if x in self.inside(slope):
            return False
        asked = {other.nodes[0] for other in others if other.kind in ("positive", "nonzero")}
        op = self.tape.ops[slope]
        factors = [factor for factor, _ in op[1]] if op[0] == "*" else [slope]
        return all(factor in asked or self.sign(factor) is not None for factor in factors)

    def is_convex(self, requirement: Requirement) -> bool:
        """It concerns one coordinate alone, or is affine: then each side of it is convex."""
        nodes = requirement.nodes
        inside = self.inside(*nodes)
        if len(inside) <= 1:
            return True
        if requirement.kind == "uncut" or self.is_complex(requirement):
            return False
        return not any(self.inside(derivative(self.tape, nodes[0], x)) for x in inside)

    def is_thin(self, requirement: Requirement) -> bool:
        """It only takes out points where three independent affine forms, the terms of a sum of even powers, are 0."""
        op = self.tape.ops[requirement.nodes[0]]
        if requirement.kind == "uncut" or not is_sum_of_squares(self.tape, requirement.nodes[0]):
            return False
        used: set[Node] = set()
        forms = 0
        for term, _ in op[2]:
            base = self.base(term)
            inside = self.inside(base)
            slopes = [derivative(self.tape, base, x) for x in inside]
            if inside and not inside & used and all(self.tape.value(s) is not None for s in slopes):
                forms += 1
                used |= inside
        return forms >= 3


def is_sum_of_squares(tape: Tape, node: Node) -> bool:
    """Whether a real node is written as a sum of positive multiples of even powers, without a negative constant."""
    op = tape.ops[node]
    if op[0] != "+" or op[1] < 0 or tape.is_complex(node):
        return False
    return all(
        coefficient > 0 and tape.ops[term][0] == "*" and all(e % 2 == 0 and e > 0 for _, e in tape.ops[term][1])
        for term, coefficient in op[2]
    )
