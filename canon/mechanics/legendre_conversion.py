"""Generating functions from one another, and from a transformation."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import count

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.generating_function import MOMENTA, GeneratingFunction
from canon.mechanics.given_maps import listed_types
from canon.mechanics.map_points import agree, gives, points_of
from canon.mechanics.one_form import potential, tidy
from canon.mechanics.solution_points import Point, real_value
from canon.mechanics.solving import branches
from canon.mechanics.transformation import Transformation


def converted(F: GeneratingFunction, type: int | Sequence[int], branch: int = 0) -> GeneratingFunction:  # noqa: A002
    """The generating function of another type of the same map.

    In each degree of freedom where the types differ, a Legendre transform: Q -> P adds QP, P -> Q takes it away,
    q -> p takes qp away, p -> q adds it. The equations of F are solved for the arguments that disappear.
    Goldstein, Poole and Safko (2002), section 9.1.

    **Raises:** `InputError` when sympy finds no solution (the map may have no function of that type: the identity has
    none of type 1).
    """
    type = listed_types(type)  # noqa: A001
    whole_number(branch, "branch", 0)
    aim = (type,) * F.space.n if isinstance(type, int) else tuple(type)
    template = GeneratingFunction(F.space, aim, 0)
    formulas = F.conjugates()
    gone = [
        (x, y) for x, y in zip(F.mixed, F.old_conjugates + F.new_conjugates, strict=True) if x not in template.mixed
    ]
    value = F.F.expr + sp.Add(*(_sign(F, x) * x * y for x, y in gone))
    if gone:
        result = sp.Dummy("F")
        solved = {y: formulas[y] for _, y in gone}
        besides = {y: value for y, value in formulas.items() if y not in solved}
        conditions = F.space.domain.conditions
        found = branches(solved, [x for x, _ in gone], {result: value}, within=conditions, besides=besides)
        if len(found) <= branch:
            raise InputError(f"the map has no generating function of type {_written(type)} that could be found")
        value = found[branch][result]
    return GeneratingFunction(F.space, type, value)


def _written(type: int | Sequence[int]) -> str:  # noqa: A002
    """The type as a file has it: 2, or [2, 3]."""
    return str(type if isinstance(type, int) else [*type])


def _sign(F: GeneratingFunction, argument: sp.Symbol) -> int:
    """The sign of the product that is added when `argument` gives way to its conjugate."""
    return 1 if argument in F.space.Q or argument in F.space.p else -1


_DETOURS = 3  # other types that are tried and converted from


@dataclass(frozen=True)
class Recovered:
    """A generating function found for an explicit transformation.

    `residuals` are dF/du less what the transformation gives for it. That they vanish is for the caller to decide: they
    do where the map is canonical and the integration went well.
    """

    generating_function: GeneratingFunction
    residuals: tuple[sp.Expr, ...]


def recovered(transformation: Transformation, type: int | Sequence[int]) -> Recovered:  # noqa: A002
    """A generating function of this type of an explicit transformation, up to a function of time.

    The map is written in the mixed coordinates u, and the one-form that dF must be (for type 1, p dq - P dQ) is
    integrated.

    **Raises:** `InputError` when the map cannot be written in u, or an integral is not found.
    """
    instance_of(transformation, Transformation, "transformation")
    space = transformation.space
    template = GeneratingFunction(space, type, 0)
    if transformation.direction == "implicit":
        assert transformation.generating_function is not None
        F = converted(transformation.generating_function, type)
        return Recovered(F, (sp.S.Zero,) * len(F.mixed))
    points = list(points_of(transformation))
    forms: dict[tuple[int, ...], list[sp.Expr]] = {}
    for pattern in (template.types, *regular_types(template)[:_DETOURS]):
        values = _in_mixed_coordinates(transformation, GeneratingFunction(space, pattern, 0), points)
        if values is not None:
            forms[pattern] = values
    for pattern in sorted(forms, key=lambda kinds: (_has_roots(forms[kinds]), kinds != template.types)):
        aim = GeneratingFunction(space, pattern, 0)
        found = potential(forms[pattern], aim.mixed)
        if found is not None:
            F = GeneratingFunction(space, pattern, tidy(found.function))
            residuals = tuple(tidy(residual) for residual in found.residuals)
            of_type = _branch_of(F, type, points) if vanish(residuals, points) else converted(F, type)
            if of_type is not None:
                return Recovered(of_type, residuals)
    raise InputError(
        f"no generating function of type {_written(type)} was found that is right throughout the domain; where one "
        "variable has several values for those on which it would depend, restrict the domain, as by "
        "space.where('p > 0')"
    )


def vanish(residuals: Sequence[sp.Expr], points: Iterable[Point]) -> bool:
    """Whether residuals are 0 at all points, as far as they have values there."""
    return all(agree(real_value(rest, point), 0.0) for point in points for rest in residuals)


def _branch_of(
    F: GeneratingFunction,
    type: int | Sequence[int],  # noqa: A002
    points: Sequence[Point],
) -> GeneratingFunction | None:
    """F of another type of the map to which the points belong, `None` where none of the branches is of it."""
    for branch in count():
        try:
            candidate = converted(F, type, branch)
        except InputError:
            return None
        if all(gives(candidate.conjugates(), point) for point in points):
            return candidate
    return None


def _has_roots(form: Sequence[sp.Expr]) -> bool:
    """Whether integrals of roots are to be expected: other types may be easier, and are then tried first."""
    return any(power.exp.is_Rational and not power.exp.is_Integer for part in form for power in part.atoms(sp.Pow))


def _in_mixed_coordinates(
    transformation: Transformation, template: GeneratingFunction, points: Sequence[Point]
) -> list[sp.Expr] | None:
    """What dF/du must be for F of this type, as functions of u; `None` when the map cannot be written in u, or not by
    one function of u at all the points."""
    given = {target: formula.expr for target, formula in transformation.mapping.items()}
    forward = transformation.direction == "forward"
    known = template.new_arguments if forward else template.old_arguments
    unknown = template.old_conjugates if forward else template.new_conjugates
    rest = template.new_conjugates if forward else template.old_conjugates
    conditions = transformation.space.domain.conditions
    found = branches({x: given[x] for x in known}, unknown, {y: given[y] for y in rest}, within=conditions)
    values = next((branch for branch in found if all(gives(branch, point) for point in points)), None)
    if values is None:
        return None
    old, new = template.signs()
    conjugates = template.old_conjugates + template.new_conjugates
    return [sign * values[y] for sign, y in zip((*old, *new), conjugates, strict=True)]


def regular_types(F: GeneratingFunction) -> tuple[tuple[int, ...], ...]:
    """Other types that may serve where the mixed Hessian of F is singular, those with the fewest changes first."""
    n = F.space.n
    patterns = [tuple(1 + (index // 4**k) % 4 for k in range(n)) for index in range(4**n)]
    changed = {
        kinds: sum(MOMENTA[a][side] != MOMENTA[b][side] for a, b in zip(kinds, F.types, strict=True) for side in (0, 1))
        for kinds in patterns
        if kinds != F.types
    }
    return tuple(sorted(changed, key=lambda kinds: (changed[kinds], kinds)))
