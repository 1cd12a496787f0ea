"""The group of transformations: identity, composition, and the extension that makes time a coordinate."""

import sympy as sp

from canon.domain import Domain
from canon.errors import InputError
from canon.expected import instance_of, listed
from canon.expression import Formula
from canon.mechanics.formulas import Expression, as_formula, substituted
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.stated_names import Names, as_declared, listed_names
from canon.mechanics.time_dependence import hamiltonian_shift
from canon.mechanics.transformation import Transformation


def identity_transformation(space: PhaseSpace) -> Transformation:
    """Q = q, P = p."""
    check_space(space)
    return Transformation(space, Q=tuple(map(as_formula, space.q)), P=tuple(map(as_formula, space.p)))


def compose(first: Transformation, second: Transformation) -> Transformation:
    """`first`, then `second`: the new variables of the one are the old ones of the other.

    They are matched by position; in the result the old names are those of `first`, the new ones those of `second`.
    Where one is forward and the other backward, `second` is turned round by solving.

    **Raises:** `InputError` when the counts differ, a name is used for different things, or solving fails.
    """
    for map_ in (first, second):
        if not isinstance(map_, Transformation):
            raise InputError(f"a Transformation is expected, not {map_!r}")
    if len(first.space.Q) != second.space.n:
        raise InputError(f"{len(first.space.Q)} pairs cannot be put into {second.space.n}")
    if first.direction == "implicit":
        first = first.forward()
    if second.direction != first.direction:
        second = second.forward() if first.direction == "forward" else second.backward()
    space = _joined(first, second)
    retimed = {second.space.t: as_formula(space.t)}
    if first.direction == "forward":
        through = dict(zip(second.space.old, first.formulas, strict=True)) | retimed
        return Transformation(
            space,
            Q=tuple(substituted(value, through) for value in second.Q),
            P=tuple(substituted(value, through) for value in second.P),
        )
    back = dict(zip(first.space.new, (substituted(value, retimed) for value in second.formulas), strict=True))
    return Transformation(
        space,
        q=tuple(substituted(value, back) for value in first.q),
        p=tuple(substituted(value, back) for value in first.p),
    )


def _joined(first: Transformation, second: Transformation) -> PhaseSpace:
    """The space with the old variables of the one and the new ones of the other; new names are primed if taken."""
    one, other = first.space, second.space
    taken = {symbol.name for symbol in one.old}

    def free(symbol: sp.Symbol) -> sp.Symbol:
        name = symbol.name
        while name in taken:
            name += "_new"
        return symbol if name == symbol.name else sp.Symbol(name, **symbol.assumptions0)

    new = (tuple(map(free, other.Q)), tuple(map(free, other.P)))
    variables = {*one.old, *new[0], *new[1], one.t}
    names = {symbol.name for symbol in variables}
    parameters = tuple(dict.fromkeys((*one.parameters, *other.parameters)))
    if clash := names & {symbol.name for symbol in parameters}:
        raise InputError(f"{min(clash)!r} is a variable of one map and a parameter of the other")
    known = {symbol.name for symbol in parameters}
    if len(known) < len(parameters):
        raise InputError("a parameter has other assumptions in the one map than in the other")
    functions = tuple(dict.fromkeys((*one.functions, *other.functions)))
    return PhaseSpace(
        one.q, one.p, new=new, time=one.t, **as_declared(parameters), functions=functions, domain=_domain(first, second)
    )


def _domain(first: Transformation, second: Transformation) -> Domain:
    """Where the composition is asked about: the domain of the first map, and the second's pulled back through it."""
    if second.space.domain == Domain() or first.direction != "forward":
        return first.space.domain
    images: dict[sp.Expr, sp.Expr] = {x: value.expr for x, value in zip(second.space.old, first.formulas, strict=True)}
    return first.space.domain & second.space.domain.substitute(images)


def extended_by_time(
    transformation: Transformation,
    added: Expression | None = None,
    time: tuple[Names, Names] = ("t_momentum", "T"),
    new_momentum: Names = "T_momentum",
) -> Transformation:
    """The map of extended phase space, in which t is one more coordinate and its momentum stands for -H.

    Q and P as before, T = t, and P_T = p_t - R with R = K - H (`added`) as a function of (q, p, t), so that
    p dq + p_t dt and P dQ + P_T dT differ by an exact form when the map is canonical.

    **Arguments:** a forward transformation; R, integrated if it is left out; the names of the momentum of time and of
    the new time; the name of the new time's momentum.

    **Raises:** `InputError` for a map that is not given forward, or when R is not found.
    """
    instance_of(transformation, Transformation, "transformation")
    if transformation.direction != "forward":
        raise InputError("only a map given forward is extended by time; ask for .forward() first")
    if added is None:
        found = hamiltonian_shift(transformation)
        if found is None:
            raise InputError("what the transformation adds to H could not be integrated; give it")
        added = found.function
    space, shift = transformation.space, as_formula(added)
    both = listed(time, "two names, of the momentum of time and of the new time,", "time")
    if len(both) != 2:
        raise InputError(f"two names are expected, of the momentum of time and of the new time, not {time!r}", "time")
    names = [*(listed_names(name, "time") for name in both), listed_names(new_momentum, "new_momentum")]
    if any(len(name) != 1 for name in names):
        raise InputError(
            "a single name is expected for each of time's momentum, the new time, and its momentum", "time"
        )
    (momentum_name,), (time_name,), (new_name,) = names

    extended = PhaseSpace(
        (*space.q, space.t),
        (*space.p, momentum_name),
        new=((*space.Q, time_name), (*space.P, new_name)),
        time="extended_time",
        **as_declared(space.parameters),
        functions=space.functions,
        domain=space.domain,
    )
    balance = Formula(extended.p[-1] - shift.expr, shift.conditions, f"{extended.p[-1]} - ({shift})")
    return Transformation(extended, Q=(*transformation.Q, as_formula(space.t)), P=(*transformation.P, balance))
