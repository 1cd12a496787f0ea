"""From a model to what an integrator takes: its exactly solvable parts where it has them, else its whole field."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

import sympy as sp

from canon.numeric.constrained_formula import constrained, drag_of
from canon.numeric.friction import friction_part
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrators.constrained import Held
from canon.numeric.integrators.problem import Field, Part, Splitting
from canon.numeric.integrators.side_by_side import SideBySide
from canon.numeric.pair_sum import PairSum
from canon.numeric.pendulum_formula import SOURCE as PENDULUM
from canon.numeric.pendulum_formula import pendulum_of
from canon.numeric.shears import shear
from canon.numeric.split_hamiltonian import SplitHamiltonian, quadratic_in, split_hamiltonian, with_clock
from canon.scenes.model import Model
from canon.scenes.rigid_model import KINETIC, rigid_splitting
from canon.scenes.skates import skate_splitting

TOPS: Final = "Landau and Lifshitz (1976), Mechanics, § 37; van Zon and Schofield (2007), J. Comput. Phys. 225, 145"
SMALL: Final = 12
"""Coordinates up to which all splittings are looked for: that takes algebra, which many bodies are too many for."""


@dataclass(frozen=True)
class Problem:
    """What is integrated: `value`, on slots (q, p); `parts` names each part with its formula.

    `exact`: it is one part, whose closed flow is the motion, by `source`; `closed`: in elliptic functions, whose own
    derivatives lose digits. `kind` says how it was split. `beside`: the independent problems that it consists of.
    """

    value: Splitting | Field | Held | SideBySide
    kind: str
    parts: tuple[tuple[str, str], ...] = ()
    exact: bool = False
    source: str = ""
    closed: bool = False
    beside: tuple[Problem, ...] = ()

    @property
    def splits(self) -> bool:
        """Whether it is a sum of parts that are solved exactly."""
        return isinstance(self.value, Splitting)


def problem_of(model: Model, *, exact: bool = True) -> Problem:
    """The problem of a model; `exact`: a motion that is known in closed form is taken so, where it also splits."""
    found = _problem(model, exact)
    # a method that is asked for need not know that its one part is the motion
    return found if exact else replace(found, exact=False, closed=False)


def _beside(model: Model, exact: bool) -> Problem:
    """The problems of a model's independent parts."""
    found = tuple(problem_of(each, exact=exact) for each in model.beside)
    value = SideBySide(tuple(each.value for each in found), tuple((len(each.q), len(each.p)) for each in model.beside))
    return Problem(
        value,
        "; ".join(each.kind for each in found),
        tuple(part for each in found for part in each.parts),
        all(each.exact for each in found),
        "; ".join(each.source for each in found if each.source),
        beside=found,
    )


def _problem(model: Model, exact: bool) -> Problem:
    if model.beside:
        return _beside(model, exact)
    if model.rigid:
        return rigid_problem(model, exact)
    if model.gliders:
        return skate_problem(model)
    if model.constraints:
        return constrained_problem(model)
    if exact and model.n == 1 and not model.frictions:
        (q,), (p,) = model.q, model.p
        swing = pendulum_of(model.H, q, p)
        if swing is not None:
            shown = (("pendulum", _text(model.H)),)
            return Problem(swing, "a pendulum, in closed form", shown, True, PENDULUM, closed=True)
    linear = all(friction.matrix is not None for friction in model.frictions)
    many = model.n > SMALL or any(isinstance(term.expr, PairSum) for term in model.terms)
    if linear and many and (split := _large(model)) is not None:
        return split
    found = split_hamiltonian(model.H, model.q, model.p, model.t) if linear else ()
    chosen = _best(found, exact)
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


def _large(model: Model) -> Problem | None:
    """T(p) + V(q, t) of many bodies, taken as it is written; None where it is not written so."""
    kinetic, rest = list[Any](), list[Any]()
    for term in model.terms:
        free = term.expr.free_symbols
        if free & {*model.p} and free & {*model.q, model.t}:
            return None
        (kinetic if free & {*model.p} else rest).append(term.expr)
    T, V = sp.Add(*kinetic), sp.Add(*rest)
    parts = [shear(T, model.q, model.p, model.t, {}, "T"), shear(V, model.q, model.p, model.t, {}, "V")]
    quadratic = quadratic_in(T, model.p, model.t)
    splitting = with_clock(parts, [False, model.t in V.free_symbols], quadratic)
    shown = (("T", _text(T)), ("V", _text(V)))
    if not model.frictions:
        return Problem(splitting, "T(p) + V(q)", shown)
    return Problem(
        _with_friction(splitting, model), "T(p) + V(q), and damping", (*shown, ("damping", "linear friction"))
    )


def constrained_problem(model: Model) -> Problem:
    """The problem of a model with constraints, for which the whole motion is one part."""
    surfaces = [g for _, g in model.constraints]
    drag = drag_of(*_drag(model), model.q, model.t) if model.frictions else None
    masses = [float(m) for m in model.mass]
    value = constrained(masses, model.H, surfaces, model.q, model.p, model.t, drag, model.strings)
    signs = ["≤" if k in model.strings else "=" for k in range(len(surfaces))]
    shown = [(effect, f"{_text(g)} {sign} 0") for (effect, g), sign in zip(model.constraints, signs, strict=True)]
    shown.append(("H", _text(model.H)))
    if drag is not None:
        shown.append(("damping", "linear friction, before and after each step"))
    return Problem(
        value,
        "constraints, by their multipliers" + ("; strings by their events" if model.strings else ""),
        tuple(shown),
    )


def skate_problem(model: Model) -> Problem:
    """The problem of bodies on skates, whose free motion has a closed form."""
    splitting = skate_splitting(model)
    free = [_text(term.expr) for term in model.terms if term.effect in (KINETIC, "skate")]
    rest = [f"{term.effect}: {_text(term.expr)}" for term in model.terms[2:]]
    shown = [(part.name, {"gliding": " + ".join(free), "damping": "linear friction"}.get(part.name, "; ".join(rest)))
             for part in splitting.parts]  # fmt: skip
    exact = len(splitting.parts) == 1
    return Problem(splitting, "free motion on skates, and forces along their headings", tuple(shown), exact)


def rigid_problem(model: Model, closed: bool = True) -> Problem:
    """The problem of rigid bodies: free tops, in closed form unless it's said otherwise, or rotations and a kick."""
    splitting = rigid_splitting(model, closed)
    exact = len(splitting.parts) == 1
    free = _text(model.terms[0].expr)
    rest = [f"{term.effect}: {_text(term.expr)}" for term in model.terms[1:]]
    rest += [f"{torque.effect}: K = ({', '.join(map(_text, torque.force))})" for torque in model.frictions]
    shown = [(part.name, free if exact else "" if part.name == "torque" else "exact") for part in splitting.parts]
    if rest:
        shown[-1] = ("torque", "; ".join(rest))
    parts = "free motion and torques" if rest else "rotations about the bodies' axes"
    kind = "free rigid bodies, in closed form" if exact else f"{parts} (Lie–Poisson)"
    return Problem(splitting, kind, tuple(shown), exact, TOPS if exact else "", closed=exact)


def _text(term: Any) -> str:
    from canon.scenes.values import text_of

    return text_of(term)


def _best(found: tuple[SplitHamiltonian, ...], exact: bool) -> SplitHamiltonian | None:
    """A splitting in one part, which is `exact`, before all others, or after them; else the first."""
    ones = [split for split in found if len(split.terms) == 1 and not split.time_dependent]
    others = [split for split in found if split not in ones]
    order = [*ones, *others] if exact else [*others, *ones]
    return order[0] if order else None


def _drag(model: Model) -> tuple[Any, tuple[Any, ...]]:
    """D and s of all frictions, −D (p − s)."""
    matrix: Any = sp.zeros(model.n, model.n)
    for friction in model.frictions:
        matrix += friction.matrix
    rests = {f.rest for f in model.frictions if f.rest}
    return matrix.tolist(), rests.pop() if rests else (sp.S.Zero,) * model.n


def _with_friction(splitting: Splitting, model: Model) -> Splitting:
    """The same with the frictions as one further part, before the last."""
    matrix, rest = _drag(model)
    part = friction_part(matrix, rest, model.q, model.t)
    parts: tuple[Part, ...] = (*splitting.parts[:-1], part, splitting.parts[-1])
    clock = splitting.clock
    if clock is None:
        clock = 0 if any(model.t in value.free_symbols for value in rest) else None
    elif clock == len(splitting.parts) - 1:
        clock = len(parts) - 1
    return Splitting(parts, clock, False)
