"""Arguments for zero where a normal form is not enough: exact constants, surfaces, and cell by cell."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Callable

from canon.budget import Budget
from canon.decide.answer import Answer
from canon.decide.certificate import Certificate
from canon.decide.constants import number_is_zero
from canon.decide.continuity import vanishes_by_cells
from canon.decide.enclosure import OutOfDomain
from canon.decide.equal_on_surface import by_equal_arguments, solved_for
from canon.decide.on_surface import vanishes_on_surface
from canon.decide.region import Region
from canon.decide.ring import TooCostly
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError

Asked = Callable[[Node, Region], Answer]
"""What the ladder answers on another residual of another region."""
Found = tuple[str, Certificate]
"""An argument's name, and what is written down of it."""


def other_argument(
    tape: Tape, node: Node, region: Region, rng: random.Random, budget: Budget, tried: list[str], asked: Asked
) -> Found | None:
    """The argument that shows the node to be 0 on the region, or None; what was `tried` is noted down.

    Raises: BudgetExceeded.
    """
    try:
        if region.surface:
            return _on_a_surface(tape, node, region, budget, tried, asked)
        if not tape.support(node):
            tried.append("exact constants")
            if not number_is_zero(tape, node, budget):
                return None
            argument = {"argument": "an algebraic number smaller than every nonzero conjugate of it could be"}
            return "exact constant", Certificate(lambda: argument)
        tried.append("cell by cell")
        found = vanishes_by_cells(tape, node, region, rng, budget)
        if found is None:
            return None
        name, cells = found
        data = {"argument": name, "cells": cells, "domain": [r.text for r in region.requirements]}
        return name, Certificate(lambda: data)
    except (Unsupported, TooCostly, ZeroDivisionError, OutOfDomain, ArithmeticError) as reason:
        tried.append(f"stopped: {reason}")
        return None


def _on_a_surface(
    tape: Tape, node: Node, region: Region, budget: Budget, tried: list[str], asked: Asked
) -> Found | None:
    """Reduction by its equations; calls whose arguments they make equal; coordinates that they give."""
    tried.append("reduction on the surface")
    certificate = vanishes_on_surface(tape, node, region, budget)
    if certificate is not None:
        return "reduction on the surface", certificate
    tried.append("equal arguments on the surface")
    certificate = by_equal_arguments(tape, node, region, budget)
    if certificate is not None:
        return "equal arguments on the surface", certificate
    plain = solved_for(tape, node, region)
    if plain is None:
        return None
    with contextlib.suppress(InputError):
        answer = asked(*plain)
        if answer.status == "proved":
            data = {"argument": f"on the surface, solved for coordinates: {answer.method}"}
            return f"{answer.method}, on the surface", Certificate(lambda: data)
    return None
