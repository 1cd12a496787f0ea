"""What is simulated: a Hamiltonian, effect by effect, and the forces that no Hamiltonian has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.numeric.gradient import poisson_terms

if TYPE_CHECKING:
    from canon.scenes.rigid import RigidBody
    from canon.scenes.skates import Glider

Formula = Any
"""A sympy expression: its operations have no useful types."""


Bracket = tuple[sp.Symbol, sp.Symbol, Formula]
"""Two coordinates u, v and {u, v}."""


@dataclass(frozen=True)
class Term:
    """A part of the Hamiltonian, and the effect that it is due to."""

    effect: str
    expr: Formula


@dataclass(frozen=True)
class Friction:
    """The force F(q, p, t) (n,) of an effect, which is in no Hamiltonian.

    Where it is −D (p − s) with numbers D (n, n) and the momentum s(q, t) of a body at rest, `matrix` is D and `rest` is
    s: then it is solved exactly. `rate` is the one number λ of D = 2λ, if there is one.
    """

    effect: str
    force: tuple[Formula, ...]
    matrix: Formula | None = None
    rest: tuple[Formula, ...] = ()
    rate: Formula | None = None


@dataclass(frozen=True)
class Model:
    """A Hamiltonian system with friction, in canonical variables, with numbers for all parameters.

    **Arguments:** `q` and `p` (n,) symbols, `t` the time; `terms`, whose sum is the Hamiltonian; `momenta`,
    `angular_momenta` and `lrl`, those that the monitors of these names follow, each with its name; empty where there
    are none; `constraints` g(q, t) = 0, each with its effect (g ≤ 0 for those at the places
    `strings`), and the `mass` and `charge` of every coordinate, for bodies;
    `scatters`, for the name of a body that is deflected the potential V(r), in one symbol.

    Of `rigid` bodies q are the attitudes and p the angular momenta in the bodies' frames: they have other brackets, and
    `casimirs`, which commute with all momenta. A friction is a torque there. Of `gliders`, bodies on skates, q has the
    headings last, and p the momenta along them; their brackets are no Poisson brackets. `brackets` are all that are not
    0, where the variables are not canonical.

    `beside` are models that do not act on each other and make this one together: q and p are theirs, in this order.
    """

    q: tuple[sp.Symbol, ...]
    p: tuple[sp.Symbol, ...]
    t: sp.Symbol
    terms: tuple[Term, ...]
    frictions: tuple[Friction, ...] = ()
    momenta: Mapping[str, Formula] = field(default_factory=dict)
    angular_momenta: Mapping[str, Formula] = field(default_factory=dict)
    lrl: Mapping[str, Formula] = field(default_factory=dict)
    constraints: tuple[tuple[str, Formula], ...] = ()
    strings: tuple[int, ...] = ()
    mass: tuple[Formula, ...] = ()
    charge: tuple[Formula, ...] = ()
    scatters: Mapping[str, Formula] = field(default_factory=dict)
    rigid: tuple[RigidBody, ...] = ()
    casimirs: Mapping[str, Formula] = field(default_factory=dict)
    brackets: tuple[Bracket, ...] = ()
    gliders: tuple[Glider, ...] = ()
    beside: tuple[Model, ...] = ()

    def bracket_terms(self, f: Formula, g: Formula) -> list[Formula]:
        """The terms of {f, g}."""
        if not self.brackets:
            return poisson_terms(f, g, self.q, self.p)
        terms = (
            term
            for u, v, bracket in self.brackets
            for term in (f.diff(u) * bracket * g.diff(v), -f.diff(v) * bracket * g.diff(u))
        )
        return [term for term in terms if term != 0]

    @property
    def H(self) -> Formula:
        """The Hamiltonian."""
        return sp.Add(*(term.expr for term in self.terms))

    @property
    def n(self) -> int:
        """Degrees of freedom."""
        return len(self.q)

    @property
    def effects(self) -> tuple[str, ...]:
        """The names of the effects that contribute, each once."""
        return tuple(
            dict.fromkeys(
                (*(x.effect for x in (*self.terms, *self.frictions)), *(effect for effect, _ in self.constraints))
            )
        )
