"""Conditions of a region that follow from its other ones: without them it is the same region, in fewer words.

Only conditions without roots, logarithms and inverse functions are used, as others say by their mere presence where
they are defined; and of what is left out, that it is defined is shown too.
"""

from __future__ import annotations

from dataclasses import replace

from canon.budget import Budget
from canon.decide.positivity import positive_by_signs
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape

EVERYWHERE_DEFINED = ("sin", "cos", "exp")


def without_implied(tape: Tape, region: Region, budget: Budget) -> Region:
    """The region with those conditions left out that the signs of factors show to follow from the rest.

    One by one: of two that imply each other, one stays.
    """
    left = region.requirements
    for requirement in reversed(region.requirements):
        budget.check()
        others = tuple(r for r in left if r is not requirement)
        if follows(tape, requirement, replace(region, requirements=others), budget):
            left = others
    return replace(region, requirements=left)


def follows(tape: Tape, requirement: Requirement, region: Region, budget: Budget) -> bool:
    """Whether signs show that a condition is defined and holds throughout a region."""
    plain = replace(region, requirements=tuple(r for r in region.requirements if _is_plain(tape, r)))
    return _follows(tape, requirement, plain, budget)


def _is_plain(tape: Tape, requirement: Requirement) -> bool:
    return all(
        op[0] in "ncs+*" or (op[0] == "f" and op[1] in EVERYWHERE_DEFINED)
        for op in (tape.ops[i] for i in tape.reach(requirement.nodes))
    )


def _follows(tape: Tape, requirement: Requirement, plain: Region, budget: Budget) -> bool:
    (first, *others) = requirement.nodes
    if others or requirement.kind not in ("positive", "nonzero") or tape.is_complex(first):
        return False
    wanted = [first] if requirement.kind == "positive" else []
    not_zero = [] if requirement.kind == "positive" else [first]
    for i in tape.reach([first]):
        op = tape.ops[i]
        if op[0] == "*":
            not_zero += [factor for factor, exponent in op[1] if exponent < 0]
        elif op[0] == "r":
            wanted.append(op[1])
        elif op[0] == "f" and op[1] == "log":
            wanted.append(op[2][0])
        elif op[0] not in "ncs+" and not (op[0] == "f" and op[1] in EVERYWHERE_DEFINED):
            return False
    return all(_positive(tape, node, plain, budget) for node in reversed(wanted)) and all(
        _positive(tape, node, plain, budget) or _positive(tape, tape.negative(node), plain, budget) for node in not_zero
    )


def _positive(tape: Tape, node: Node, plain: Region, budget: Budget) -> bool:
    return any(positive_by_signs(tape, node, plain, budget, strict=True, thorough=more) for more in (False, True))
