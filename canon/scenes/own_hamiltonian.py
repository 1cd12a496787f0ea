"""A Hamiltonian of the user's own as a scene: [system] with q_names, p_names and H."""

from __future__ import annotations

from typing import Any, Final

import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.model import Model, Term
from canon.scenes.values import expression, needed, number, numbers

KEYS: Final = ("q_names", "p_names", "H", "parameters", "q", "p")
WHERE: Final = "[system]"
_AXES: Final = "xyz"


def read_own_hamiltonian(table: Table) -> tuple[Model, tuple[float, ...], tuple[float, ...]]:
    """The model and the initial q and p. **Raises:** `InputError` with the place."""
    document.only(table, KEYS, WHERE)
    q_names, p_names = (document.names(needed(table, word, WHERE), key(word, WHERE)) for word in ("q_names", "p_names"))
    if not q_names or len(q_names) != len(p_names):
        raise InputError(f"{len(q_names)} coordinates and {len(p_names)} momenta: as many of each, 1 or more", WHERE)
    parameters = document.table(table.get("parameters", {}), key("parameters", WHERE))
    declared = [*q_names, *p_names, *parameters]
    for name in declared:
        if declared.count(name) > 1 or name == "t":
            raise InputError(f"{name!r} is declared twice" if name != "t" else "'t' is the time", WHERE)
    variables = {name: sp.Symbol(name, real=True) for name in ("t", *q_names, *p_names)}
    given = {name: number(value, key(name, f"{WHERE}, parameters")) for name, value in parameters.items()}
    undeclared = "give its value in parameters, as in parameters = { m = 1.0 }"
    H = expression(needed(table, "H", WHERE), {**variables, **given}, key("H", WHERE), undeclared)
    q, p = (tuple(variables[name] for name in names) for names in (q_names, p_names))
    start = (numbers(needed(table, word, WHERE), key(word, WHERE), [len(q)]) for word in ("q", "p"))
    model = Model(q, p, variables["t"], (Term("H", H),), momenta=momenta(p), angular_momenta=angular_momenta([q], [p]))
    first, second = (tuple(map(float, values)) for values in start)
    return model, first, second


def momenta(p: tuple[Any, ...]) -> dict[str, Any]:
    """Every momentum by its name."""
    return {symbol.name: symbol for symbol in p}


def angular_momenta(positions: list[tuple[Any, ...]], p: list[tuple[Any, ...]]) -> dict[str, Any]:
    """M = Σ x × p of Cartesian positions in two or three dimensions; none in others."""
    size = len(positions[0])
    if size not in (2, 3):
        return {}
    pairs = [(0, 1)] if size == 2 else [(1, 2), (2, 0), (0, 1)]
    names = ["M"] if size == 2 else [f"M_{axis}" for axis in _AXES]
    return {
        name: sp.Add(*(x[i] * y[j] - x[j] * y[i] for x, y in zip(positions, p, strict=True)))
        for name, (i, j) in zip(names, pairs, strict=True)
    }
