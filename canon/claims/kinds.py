"""All kinds of claims, each with the function that decides it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from types import MappingProxyType

from canon.claims import (
    action,
    action_angle,
    algebra,
    average,
    bracket,
    casimir,
    constraint,
    dimension,
    dynamics,
    field_equations,
    generating_function,
    group,
    hamilton_jacobi,
    independence,
    inequality,
    integral,
    invariant,
    lagrangian,
    lie_series,
    limit,
    matrix_algebra,
    matrix_group,
    new_hamiltonian,
    normal_form,
    solves,
    stationary,
    transformation,
)
from canon.claims.outcome import Outcome
from canon.claims.question import Question
from canon.errors import InputError

Kind = Callable[[Question], Outcome]

KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        **transformation.KINDS,
        **invariant.KINDS,
        **generating_function.KINDS,
        **new_hamiltonian.KINDS,
        **bracket.KINDS,
        **independence.KINDS,
        **dynamics.KINDS,
        **lagrangian.KINDS,
        **constraint.KINDS,
        **dimension.KINDS,
        **average.KINDS,
        **inequality.KINDS,
        **stationary.KINDS,
        **integral.KINDS,
        **limit.KINDS,
        **matrix_group.KINDS,
        **field_equations.KINDS,
        **solves.KINDS,
        **lie_series.KINDS,
        **hamilton_jacobi.KINDS,
        **normal_form.KINDS,
        **algebra.KINDS,
        **matrix_algebra.KINDS,
        **group.KINDS,
        **casimir.KINDS,
        **action.KINDS,
        **action_angle.KINDS,
    }
)


def kind_named(name: str) -> Kind:
    """The function that decides claims of a kind; **raises** `InputError` for an unknown one."""
    if name in KINDS:
        return KINDS[name]
    near = get_close_matches(name, KINDS, 1)
    hint = f"; did you mean {near[0]!r}?" if near else f"; known are {', '.join(sorted(KINDS))}"
    raise InputError(f"unknown kind of claim {name!r}{hint}", "key 'kind'")
