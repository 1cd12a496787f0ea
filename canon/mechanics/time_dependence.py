"""What a time-dependent transformation adds to the Hamiltonian: K = scale H + R."""

from collections.abc import Sequence

import sympy as sp

from canon.errors import InputError
from canon.mechanics.formulas import Expression, as_expression, as_formula, replaced
from canon.mechanics.one_form import Potential, potential, tidy
from canon.mechanics.poisson import standard_j
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

    For the map of a generating function R is dF/dt. The explicit formulas that this needs are solved for.

    **Raises:** `InputError` when the formulas or R cannot be found.
    """
    back = transformation.backward()
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
