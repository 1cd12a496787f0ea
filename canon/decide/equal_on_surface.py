"""On a surface: what its equations say of functions whose arguments they relate.

An equation that gives a coordinate, y = g(the others), puts g in its place. And of two calls f(a), f(b) whose arguments
agree on the surface the one is put in place of the other: V(x**2) = V(y**2) where x**2 = y**2.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from canon.budget import Budget
from canon.decide.certificate import Certificate
from canon.decide.derivative import derivative, substitute
from canon.decide.on_surface import vanishes_on_surface
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.sign import declared

MOST_PAIRS = 12


def solved_for(tape: Tape, node: Node, region: Region) -> tuple[Node, Region] | None:
    """The node and the region without the surface's equations, where each gives a coordinate by the others; else None.

    At each point of the surface the node has the same value there.
    """
    while region.surface:
        equation = region.surface[0]
        for x in sorted(tape.support(equation)):
            slope = derivative(tape, equation, x)
            factor, symbol = tape.value(slope), tape.symbol_at(x)
            if not factor or symbol.is_integer or (symbol.is_nonnegative and not symbol.is_positive):
                continue  # that a value isn't negative is no condition of a region: a root of it may be at 0
            value = tape.scaled(substitute(tape, equation, {x: tape.zero}), -1 / factor)  # it is affine in x
            if symbol.is_real and tape.is_complex(value):
                continue
            try:
                moved = _without(tape, region, x, value)
                node = substitute(tape, node, {x: value})
            except (InputError, ZeroDivisionError):
                return None
            region = moved
            break
        else:
            return None
    return node, region


def _without(tape: Tape, region: Region, x: Node, value: Node) -> Region:
    """The region of the other coordinates, x being a function of them."""
    facts, here = declared(tape.symbol_at(x)), {x: value}
    kept = [replace(r, nodes=tuple(substitute(tape, n, here) for n in r.nodes)) for r in region.requirements]
    if facts.get("positive") or facts.get("negative"):
        side = value if facts.get("positive") else tape.negative(value)
        kept.append(Requirement("positive", (side,), f"the sign of {tape.symbol_at(x)}"))
    elif tape.symbol_at(x).is_zero is False:  # what the name's assumptions said, the region must say now
        kept.append(Requirement("nonzero", (value,), f"{tape.symbol_at(x)} != 0"))
    surface = tuple(substitute(tape, equation, here) for equation in region.surface[1:])
    return Region(tuple(kept), surface, tuple(n for n in region.symbols if n != x))


def by_equal_arguments(tape: Tape, node: Node, region: Region, budget: Budget) -> Certificate | None:
    """A certificate that the node is 0 on the surface, calls with equal arguments being the same; else None."""
    changed = False
    for _ in range(MOST_PAIRS):
        pair = _equal_calls(tape, node, region, budget)
        if pair is None:
            break
        try:
            node, changed = substitute(tape, node, {pair[0]: pair[1]}), True
        except (InputError, ZeroDivisionError):
            return None
    if not changed:
        return None
    return vanishes_on_surface(tape, node, region, budget)


def _equal_calls(tape: Tape, node: Node, region: Region, budget: Budget) -> tuple[Node, Node] | None:
    calls = [i for i in tape.reach([node]) if tape.ops[i][0] in ("f", "u") and tape.support(i)]
    calls += [i for i in tape.reach([node]) if tape.ops[i][0] in ("f", "u") and not tape.support(i)]
    for a, b in combinations(calls, 2):
        one, other = tape.ops[a], tape.ops[b]
        if one[:-1] != other[:-1] or len(one[-1]) != len(other[-1]):
            continue
        budget.check()
        pairs = [tape.minus(x, y) for x, y in zip(one[-1], other[-1], strict=True)]
        if all(d == tape.zero or vanishes_on_surface(tape, d, region, budget) is not None for d in pairs):
            return a, b
    return None
