"""Claims about functions on phase space, stated as a physicist would; `verify` gives their verdicts.

Claims about transformations and generating functions are methods of these.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from canon.claim import Claim
from canon.errors import InputError
from canon.expected import listed
from canon.mechanics.formulas import Expression, as_formula, as_formulas, check_symbols
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.subject import Subject


def _about(space: PhaseSpace, H: Expression | None = None) -> Subject:
    check_space(space)
    form = None if H is None else as_formula(H, "hamiltonian, H")
    return Subject(space, hamiltonian=form, domain=space.domain, functions=space.functions)


def bracket(space: PhaseSpace, f: Expression, g: Expression, equals: Expression) -> Claim:
    """{f, g} = equals, in the old variables."""
    keys = {"f": as_formula(f, "f"), "g": as_formula(g, "g"), "equals": as_formula(equals, "equals")}
    return _about(space).claim("bracket", keys)


def jacobi(space: PhaseSpace, f: Expression, g: Expression, h: Expression) -> Claim:
    """{f, {g, h}} + {g, {h, f}} + {h, {f, g}} = 0."""
    return _about(space).claim("jacobi", {"f": as_formula(f), "g": as_formula(g), "h": as_formula(h)})


def conserved(space: PhaseSpace, H: Expression, f: Expression) -> Claim:
    """f is a constant of the motion of H: df/dt + {f, H} = 0."""
    return _about(space, H).claim("conserved", {"f": as_formula(f)})


def involution(space: PhaseSpace, functions: Sequence[Expression]) -> Claim:
    """Every pair of the functions has bracket 0."""
    return _about(space).claim("involution", {"functions": as_formulas(functions)})


def independent(space: PhaseSpace, functions: Sequence[Expression]) -> Claim:
    """The functions are functionally independent almost everywhere."""
    return _about(space).claim("independent", {"functions": as_formulas(functions)})


def identity(space: PhaseSpace, lhs: Expression, rhs: Expression) -> Claim:
    """lhs = rhs throughout the domain."""
    return _about(space).claim("identity", {"lhs": as_formula(lhs), "rhs": as_formula(rhs)})


def lie_series(
    space: PhaseSpace,
    generator: Expression,
    parameter: sp.Symbol | str,
    f: Expression,
    equals: Expression,
    *,
    order: int | None = None,
) -> Claim:
    """exp(parameter {., generator}) f = equals; with `order`, the polynomial of that degree in the parameter."""
    keys: dict[str, object] = {
        "generator": as_formula(generator),
        "parameter": _symbol(space, parameter, "parameter"),
        "f": as_formula(f),
        "equals": as_formula(equals),
    }
    return _about(space).claim("lie_series", keys if order is None else keys | {"order": order})


def infinitesimal(
    space: PhaseSpace,
    generator: Expression,
    dq: Expression | Sequence[Expression],
    dp: Expression | Sequence[Expression],
) -> Claim:
    """The generator moves (q, p) by eps (dq, dp): dq = dG/dp, dp = -dG/dq."""
    keys = {"generator": as_formula(generator), "dq": as_formulas(dq), "dp": as_formulas(dp)}
    return _about(space).claim("infinitesimal", keys)


def equations_of_motion(
    space: PhaseSpace,
    H: Expression,
    qdot: Expression | Sequence[Expression],
    pdot: Expression | Sequence[Expression],
) -> Claim:
    """Hamilton's equations of H are these: qdot = dH/dp, pdot = -dH/dq."""
    return _about(space, H).claim("equations_of_motion", {"qdot": as_formulas(qdot), "pdot": as_formulas(pdot)})


def hamiltonian_field(
    space: PhaseSpace,
    qdot: Expression | Sequence[Expression],
    pdot: Expression | Sequence[Expression],
    H: Expression | None = None,
) -> Claim:
    """The vector field is locally Hamiltonian; with `H`, it is that of H."""
    keys: dict[str, object] = {"qdot": as_formulas(qdot), "pdot": as_formulas(pdot)}
    return _about(space).claim("hamiltonian_field", keys if H is None else keys | {"H": as_formula(H)})


def legendre(space: PhaseSpace, H: Expression, L: Expression, velocities: sp.Symbol | Sequence[sp.Symbol]) -> Claim:
    """H is the Legendre transform of L, with momenta dL/dv and a Hessian in the velocities that is not singular."""
    names = (velocities,) if isinstance(velocities, sp.Symbol) else listed(velocities, "symbols", "velocities")
    speeds = tuple(_symbol(space, name, "velocities") for name in names)
    return _about(space, H).claim("legendre", {"L": as_formula(L), "velocities": speeds})


def normal_form(space: PhaseSpace, H: Expression, order: int, N: Mapping[int, Expression]) -> Claim:
    """N, by degree, is a Birkhoff–Gustavson normal form of H about the origin to this order."""
    if not isinstance(order, int) or not isinstance(N, Mapping) or not all(isinstance(k, int) for k in N):
        raise InputError("a whole number is expected as the order, and a table degree: polynomial as N")
    table = {degree: as_formula(part, f"N, degree {degree}") for degree, part in N.items()}
    return _about(space, H).claim("normal_form", {"order": order, "N": table})


def action(
    space: PhaseSpace,
    H: Expression,
    coordinate: sp.Symbol | str,
    energy: sp.Symbol | str,
    equals: Expression,
    *,
    branch: str | None = None,
    period: Expression | None = None,
    well: Expression | None = None,
    fixed: Mapping[Any, Expression] | None = None,
) -> Claim:
    """∮ p d(coordinate) over one period of the motion at that energy is `equals`; options as in claim files."""
    keys = _of_orbit(space, coordinate, energy, equals, branch, period, well, fixed)
    return _about(space, H).claim("action", keys)


def frequency(
    space: PhaseSpace,
    H: Expression,
    coordinate: sp.Symbol | str,
    energy: sp.Symbol | str,
    equals: Expression,
    *,
    branch: str | None = None,
    period: Expression | None = None,
    well: Expression | None = None,
    fixed: Mapping[Any, Expression] | None = None,
) -> Claim:
    """dE/dJ of that motion, in cycles in unit time, is `equals`."""
    keys = _of_orbit(space, coordinate, energy, equals, branch, period, well, fixed)
    return _about(space, H).claim("frequency", keys)


def _of_orbit(
    space: PhaseSpace,
    coordinate: sp.Symbol | str,
    energy: sp.Symbol | str,
    equals: Expression,
    branch: str | None,
    period: Expression | None,
    well: Expression | None,
    fixed: Mapping[Any, Expression] | None,
) -> dict[str, object]:
    keys: dict[str, object] = {
        "coordinate": _symbol(space, coordinate, "coordinate"),
        "energy": _symbol(space, energy, "energy"),
        "equals": as_formula(equals, "equals"),
    }
    if branch is not None:
        keys["branch"] = branch
    for name, value in (("period", period), ("well", well)):
        if value is not None:
            keys[name] = as_formula(value, name)
    if not isinstance(fixed, Mapping | None):
        raise InputError(f"a table name: value is expected, not {fixed!r}", "fixed")
    if fixed:
        keys["fixed"] = {
            _symbol(space, symbol, "fixed"): as_formula(value, f"fixed, {symbol}") for symbol, value in fixed.items()
        }
    return keys


def _symbol(space: PhaseSpace, name: Any, where: str) -> sp.Symbol:
    """The symbol that is meant; **raises** `InputError` where the space has none of that name, or another one."""
    check_space(space)
    symbol = space.symbol(name) if isinstance(name, str) else name
    if not isinstance(symbol, sp.Symbol):
        raise InputError(f"a symbol is expected, not {name!r}", where)
    check_symbols([symbol], space.vocabulary, where)
    return symbol
