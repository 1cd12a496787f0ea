"""What a time-dependent transformation adds to the Hamiltonian: K = scale H + R."""

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.mechanics.explicit import explicit_branches
from canon.mechanics.formulas import Expression, as_expression, as_formula, check_symbols, replaced
from canon.mechanics.map_points import agree, points_of
from canon.mechanics.one_form import Potential, potential, tidy
from canon.mechanics.poisson import standard_j
from canon.mechanics.solution_points import real_value
from canon.mechanics.transformation import Transformation


def shift_gradient(transformation: Transformation) -> tuple[sp.Expr, ...]:
    """The gradient of R in the old variables, -M^T J dOmega/dt, of a forward canonical map Omega.

    R is K o Omega - scale H. For a backward map omega(Omega) with Jacobian A the same in the new variables:
    scale A^T J domega/dt with scale 1.
    """
    jacobian = transformation.jacobian()
    sign = -1 if transformation.direction == "forward" else 1
    column = sp.Matrix(transformation.velocity())
    return tuple(sign * jacobian.T * standard_j(jacobian.rows // 2) * column)


def hamiltonian_shift(transformation: Transformation) -> Potential | None:
    """R itself, up to a function of time, in the variables in which the map is written; `None` if not found."""
    if not any(transformation.velocity()):
        return Potential(sp.S.Zero, (sp.S.Zero,) * len(transformation.arguments))
    return potential([tidy(part) for part in shift_gradient(transformation)], transformation.arguments)


def transformed_hamiltonian(transformation: Transformation, H: Expression, scale: Expression = 1) -> sp.Expr:
    """K in the new variables: scale H + R with the old variables eliminated, up to a function of time.

    For the map of a generating function R is dF/dt. The explicit formulas that this needs are solved for; of several
    solutions one is taken with which K is right at all sample points of the domain at which it is defined.

    **Raises:** `InputError` when the formulas or R cannot be found, or no solution will do throughout the domain.
    """
    H, scale = as_formula(H, "H"), as_formula(scale, "scale")
    check_symbols([H, scale], transformation.space.vocabulary, "H")
    if transformation.direction == "backward":
        return _with_old_eliminated(transformation, transformation, H, scale)
    found = explicit_branches(transformation, "backward")
    if not found:
        transformation.backward()  # raises with what isn't found
    points, asked = list(points_of(transformation)), (as_expression(H), as_expression(scale))
    for back in found:
        K = _with_old_eliminated(transformation, back, H, scale)
        if all(_is_new_hamiltonian(transformation, *asked, K, point) for point in points):
            return K
    raise InputError(
        "H is not one function of the new variables throughout the domain: the old ones are "
        f"{' or '.join(str(back) for back in found)}; restrict the domain to where one of these holds, as by "
        "space.where('q > 0'), or choose one by .backward(branch)",
        "transformation",
    )


def _is_new_hamiltonian(
    transformation: Transformation, H: sp.Expr, scale: sp.Expr, K: sp.Expr, point: Mapping[Any, Any]
) -> bool:
    """Whether K is what it has to be at a point, or has no value there; of a forward map its gradient is looked at."""
    at = dict(point)
    others: set[Any] = (K.free_symbols | H.free_symbols | scale.free_symbols) - {*at}
    at |= {name: sp.Rational(-5 if name.is_negative else 5, 1 if name.is_integer else 7) for name in others}
    if K.atoms(AppliedUndef) or H.atoms(AppliedUndef) or real_value(K, at) is None:
        return True
    F = transformation.generating_function
    if transformation.direction == "implicit" and F is not None:
        return agree(real_value(K, at), real_value(scale * H + F.time_derivative(), at))
    space, M, shift = transformation.space, transformation.jacobian(), shift_gradient(transformation)
    slopes = sp.Matrix([[K.diff(x) for x in space.new]])
    wanted = [scale * H.diff(x) + part for x, part in zip(space.old, shift, strict=True)]
    found: Any = slopes * M
    return all(agree(real_value(a, at), real_value(b, at)) for a, b in zip(found, wanted, strict=True))


def _with_old_eliminated(
    transformation: Transformation, back: Transformation, H: Expression, scale: Expression
) -> sp.Expr:
    """scale H + R in the new variables, where the old ones are what a backward map says."""
    images = {target: formula.expr for target, formula in back.mapping.items()}
    value = as_expression(scale) * replaced(as_expression(H), images)
    F = transformation.generating_function
    if F is not None:
        return tidy(value + replaced(F.time_derivative(), images))
    shift = hamiltonian_shift(back)
    if shift is None:
        raise InputError("what the transformation adds to H could not be integrated")
    return tidy(value + as_expression(scale) * shift.function)


def new_hamiltonian_residuals(
    transformation: Transformation, H: Expression, K: Expression, scale: Expression = 1
) -> Sequence[sp.Expr]:
    """The gradient of K o Omega - scale H less that of R, which vanishes when K is a new Hamiltonian (forward maps).

    **Raises:** `InputError` for a map that is not given forward.
    """
    if transformation.direction != "forward":
        raise InputError("the residuals are written for a map given forward")
    difference = transformation.pull_back(as_formula(K)).expr - as_expression(scale) * as_expression(H)
    required = shift_gradient(transformation)
    return tuple(difference.diff(x) - part for x, part in zip(transformation.space.old, required, strict=True))
