"""The Hamiltonian of a claim file with numbers for its parameters."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from canon.claims import document
from canon.claims.names import read_names
from canon.claims.sections import read_subject
from canon.errors import InputError
from canon.mechanics.phase_space import PhaseSpace
from canon.vocabulary import nearest


def hamiltonian_with(path: str | os.PathLike[str], values: Mapping[str, Any]) -> tuple[str, PhaseSpace, Any]:
    """(title, phase space, H) of a claim file, with `values` in the place of the symbols of these names.

    **Raises:** `InputError` where the file has no Hamiltonian, or a parameter has no value.
    """
    tables = document.load(path)
    names = read_names(tables)
    subject = read_subject(tables, names)
    if subject.hamiltonian is None:
        raise InputError("there is no Hamiltonian: [hamiltonian] with H is what actions are taken of", "[hamiltonian]")
    H: Any = subject.hamiltonian.expr
    space = subject.space
    parameters = {s.name: s for s in H.free_symbols if s not in (*space.q, *space.p)}
    for name in values:
        if name not in parameters:
            advice = nearest(name, parameters) or f": its parameters are {', '.join(parameters) or 'none'}"
            raise InputError(f"H has no parameter {name!r}{advice}", "--parameter")
    missing = [name for name in parameters if name not in values]
    if missing:
        raise InputError(
            f"no value is given for {', '.join(missing)}: give one, as --parameter {missing[0]}=1", "[hamiltonian]"
        )
    return str(tables.get("title", "")), space, H.subs({parameters[name]: value for name, value in values.items()})
