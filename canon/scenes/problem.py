"""From a model to what an integrator takes: its exactly solvable parts where it has them, else its whole field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.numeric.friction import friction_part
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrators.problem import Field, Part, Splitting
from canon.numeric.split_hamiltonian import SplitHamiltonian, split_hamiltonian
from canon.scenes.model import Model


@dataclass(frozen=True)
class Problem:
    """What is integrated: `value`, a Splitting or a Field on slots (q, p); `parts` names each part with its formula.

    `exact`: it is one part, whose closed flow is the motion. `kind` says how it was split.
    """

    value: Splitting | Field
    kind: str
    parts: tuple[tuple[str, str], ...] = ()
    exact: bool = False

    @property
    def splits(self) -> bool:
        """Whether it is a sum of parts that are solved exactly."""
        return isinstance(self.value, Splitting)


def problem_of(model: Model) -> Problem:
    """The problem of a model."""
    linear = all(friction.matrix is not None for friction in model.frictions)
    found = split_hamiltonian(model.H, model.q, model.p, model.t) if linear else ()
    chosen = _best(found)
    if chosen is None:
        force = tuple(sp.Add(*column) for column in zip(*(f.force for f in model.frictions), strict=True))
        return Problem(hamilton_equations(model.H, model.q, model.p, model.t, force), "not split")
    splitting = chosen.splitting()
    shown = tuple((name, _text(term)) for name, term in zip(chosen.names, chosen.terms, strict=True))
    if not model.frictions:
        return Problem(splitting, chosen.kind, shown, exact=len(splitting.parts) == 1 and splitting.clock is None)
    return Problem(
        _with_friction(splitting, model), f"{chosen.kind}, and damping", (*shown, ("damping", "linear friction"))
    )


def _text(term: Any) -> str:
    from canon.scenes.values import text_of

    return text_of(term)


def _best(found: tuple[SplitHamiltonian, ...]) -> SplitHamiltonian | None:
    """A splitting in one part, which is exact, before all others; else the first."""
    exact = [split for split in found if len(split.terms) == 1 and not split.time_dependent]
    return exact[0] if exact else found[0] if found else None


def _with_friction(splitting: Splitting, model: Model) -> Splitting:
    """The same with the frictions as one further part, before the last."""
    matrix: Any = sp.zeros(model.n, model.n)
    for friction in model.frictions:
        matrix += friction.matrix
    rests = {f.rest for f in model.frictions if f.rest}
    rest = rests.pop() if rests else (sp.S.Zero,) * model.n
    part = friction_part(matrix.tolist(), rest, model.q, model.t)
    parts: tuple[Part, ...] = (*splitting.parts[:-1], part, splitting.parts[-1])
    clock = splitting.clock
    if clock is None:
        clock = 0 if any(model.t in value.free_symbols for value in rest) else None
    elif clock == len(splitting.parts) - 1:
        clock = len(parts) - 1
    return Splitting(parts, clock, False)
