"""The Hamiltonian of a claim file with numbers for its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from canon.claims.document import Table
from canon.claims.names import read_names
from canon.claims.sections import read_subject
from canon.errors import InputError
from canon.mechanics.phase_space import PhaseSpace
from canon.vocabulary import nearest


def hamiltonian_with(tables: Table, values: Mapping[str, Any]) -> tuple[str, PhaseSpace, Any]:
    """(title, phase space, H) of a claim file's tables, with `values` in the place of the symbols of these names.

    **Raises:** `InputError` where the file has no Hamiltonian, or a parameter has no value.
    """
    subject = read_subject(tables, read_names(tables))
    if subject.hamiltonian is None:
        raise InputError("there is no Hamiltonian: [hamiltonian] with H is what actions are taken of", "[hamiltonian]")
    H: Any = subject.hamiltonian.expr
    space = subject.space
    return str(tables.get("title", "")), space, _with(H, {s.name: s for s in H.free_symbols - {*space.old}}, values)


def one_degree_with(tables: Table, values: Mapping[str, Any]) -> tuple[str, Any, Any, Any]:
    """(title, q, p, H) of a claim file's Hamiltonian in which one coordinate moves and all others are cyclic.

    The momenta of the others are constants, and have `values` as the parameters have.

    **Raises:** `InputError` as `hamiltonian_with`, and where several coordinates, or none, occur in H.
    """
    subject = read_subject(tables, read_names(tables))
    if subject.hamiltonian is None:
        raise InputError("there is no Hamiltonian: [hamiltonian] with H is what actions are taken of", "[hamiltonian]")
    H: Any = subject.hamiltonian.expr
    space = subject.space
    moving = [k for k, q in enumerate(space.q) if q in H.free_symbols] if space.n > 1 else [0]
    if len(moving) != 1:
        words = ", ".join(str(space.q[k]) for k in moving)
        raise InputError(
            "actions of a claim file are those of one coordinate, all others being cyclic, but "
            + (f"{words} occur in H: state a scene, or separate them" if moving else "none occurs in H"),
            "[hamiltonian]",
        )
    q, p = space.q[moving[0]], space.p[moving[0]]
    return str(tables.get("title", "")), q, p, _with(H, {s.name: s for s in H.free_symbols - {q, p}}, values)


def _with(H: Any, parameters: Mapping[str, Any], values: Mapping[str, Any]) -> Any:
    for name in values:
        if name not in parameters:
            advice = nearest(name, parameters) or f": its parameters are {', '.join(parameters) or 'none'}"
            raise InputError(f"H has no parameter {name!r}{advice}", "--parameter")
    missing = [name for name in parameters if name not in values]
    if missing:
        raise InputError(
            f"no value is given for {', '.join(missing)}: give one, as --parameter {missing[0]}=1", "[hamiltonian]"
        )
    return H.subs({parameters[name]: value for name, value in values.items()})
