"""Explicit formulas of a transformation, in the direction that is asked for."""

import sympy as sp

from canon.errors import InputError
from canon.expected import whole_number
from canon.mechanics.solving import Solution, branches
from canon.mechanics.transformation import Direction, Transformation


def explicit(transformation: Transformation, direction: Direction, branch: int = 0) -> Transformation:
    """The same map `forward` (new in old) or `backward` (old in new); a branch is chosen by number.

    **Raises:** `InputError` when sympy finds no solution, or fewer branches.
    """
    whole_number(branch, "branch", 0)
    if transformation.direction == direction:
        return transformation
    found = explicit_branches(transformation, direction)
    if not found:
        raise InputError(f"no explicit {direction} formulas were found; the transformation can be used as it is")
    if not 0 <= branch < len(found):
        raise InputError(f"there is no branch {branch}: {len(found)} were found")
    return found[branch]


def explicit_branches(transformation: Transformation, direction: Direction) -> tuple[Transformation, ...]:
    """All branches that were found, those first that hold throughout the domain that was stated."""
    space = transformation.space
    targets = space.new if direction == "forward" else space.old
    if transformation.direction == "implicit":
        solutions = _of_generating_function(transformation, direction)
    else:
        if len(space.Q) != space.n:
            raise InputError("a map to fewer variables has no inverse")
        given = {target: formula.expr for target, formula in transformation.mapping.items()}
        # an explicit map is what its formulas say on both sides of a kink; one of a generating function is continued
        solutions = branches(given, targets, within=space.domain.conditions, throughout=True)
    return tuple(_transformation(transformation, direction, solution) for solution in solutions)


def _of_generating_function(transformation: Transformation, direction: Direction) -> tuple[Solution, ...]:
    """Solve the equations of the known side for the arguments of the other side, and put these into the rest."""
    F = transformation.generating_function
    assert F is not None
    forward = direction == "forward"
    known, unknown = (F.old_conjugates, F.new_arguments) if forward else (F.new_conjugates, F.old_arguments)
    rest = F.new_conjugates if forward else F.old_conjugates
    formulas = F.conjugates()
    rest_of_it = {y: formulas[y] for y in rest}
    return branches({y: formulas[y] for y in known}, unknown, rest_of_it, within=F.space.domain.conditions)


def _transformation(origin: Transformation, direction: Direction, solution: Solution) -> Transformation:
    space = origin.space

    def formulas(targets: tuple[sp.Symbol, ...]) -> tuple[sp.Expr, ...]:
        return tuple(solution[target] for target in targets)

    if direction == "forward":
        return Transformation(
            space, Q=formulas(space.Q), P=formulas(space.P), generating_function=origin.generating_function
        )
    return Transformation(
        space, q=formulas(space.q), p=formulas(space.p), generating_function=origin.generating_function
    )
