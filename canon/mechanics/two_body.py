"""The reduction of two bodies to their centre of mass and one body of the reduced mass; exact, with sympy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.formulas import as_expression, check_symbols
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.stated_names import as_declared
from canon.mechanics.transformation import Transformation

AXES = "xyz"


@dataclass(frozen=True)
class TwoBodies:
    """Two bodies in new variables.

    **Arguments:** `total` and `reduced`, the masses m₁ + m₂ and m₁m₂/(m₁ + m₂); `transformation`, from x1, y1, …, x2, …
    to the centre X, Y, Z and the relative place x, y, z = r₁ − r₂, with their momenta PX, … and px, …
    """

    total: Any
    reduced: Any
    transformation: Transformation

    def hamiltonian(self, V: Any, r: sp.Symbol) -> Any:
        """P²/2M + p²/2μ + V(√(x² + …)) in the new variables, for a potential V of the distance r."""
        space = self.transformation.space
        n = len(space.Q) // 2
        momenta, place = space.P, space.Q[n:]
        kinetic = sum(p**2 / (2 * self.total) for p in momenta[:n]) + sum(
            p**2 / (2 * self.reduced) for p in momenta[n:]
        )
        return kinetic + _at(V, r, sp.sqrt(sum(x**2 for x in place)))

    def old_hamiltonian(self, V: Any, r: sp.Symbol, m1: Any, m2: Any) -> Any:
        """p₁²/2m₁ + p₂²/2m₂ + V(|r₁ − r₂|) in the old variables."""
        space = self.transformation.space
        n = len(space.q) // 2
        masses = [as_expression(m1, "m1")] * n + [as_expression(m2, "m2")] * n
        distance = sp.sqrt(sum((a - b) ** 2 for a, b in zip(space.q[:n], space.q[n:], strict=True)))
        kinetic = sum(p**2 / (2 * m) for p, m in zip(space.p, masses, strict=True))
        return kinetic + _at(V, r, distance)


def _at(V: Any, r: sp.Symbol, distance: Any) -> Any:
    """V(r) at a distance; **raises** `InputError` where V is of another r, which would stay in it."""
    instance_of(r, sp.Symbol, "r")
    potential = as_expression(V, "V")
    check_symbols([potential], {r.name: r}, "V")
    return potential.subs(r, distance)


def two_bodies(m1: Any, m2: Any, dimension: int = 3) -> TwoBodies:
    """The canonical transformation to centre-of-mass and relative variables (Goldstein, Poole and Safko, section 3.1).

    R = (m₁r₁ + m₂r₂)/M, r = r₁ − r₂, P = p₁ + p₂, p = (m₂p₁ − m₁p₂)/M. Nothing is assumed of which mass is the larger.

    **Arguments:** exact masses: numbers, or sympy symbols declared positive; `dimension` 1, 2 or 3. **Raises:**
    `InputError`.
    """
    whole_number(dimension, "dimension")
    if dimension not in (1, 2, 3):
        raise InputError(f"one to three dimensions are expected, not {dimension}", "dimension")
    first, second = as_expression(m1, "m1"), as_expression(m2, "m2")
    for mass, where in ((first, "m1"), (second, "m2")):
        if mass.is_positive is not True:
            raise InputError(f"a positive mass is expected, not {mass}", where)
    parameters: list[Any] = sorted(first.free_symbols | second.free_symbols, key=str)
    axes = AXES[:dimension]
    old = [f"{x}{k}" for k in (1, 2) for x in axes]
    centre, place = [x.upper() for x in axes], list(axes)
    space = PhaseSpace(
        old,
        [f"p{x}" for x in old],
        new=([*centre, *place], [f"P{x}" for x in centre] + [f"p{x}" for x in place]),
        **as_declared(parameters),
    )
    total = first + second
    n = dimension
    q, p = space.q, space.p
    Q = [(first * a + second * b) / total for a, b in zip(q[:n], q[n:], strict=True)]
    Q += [a - b for a, b in zip(q[:n], q[n:], strict=True)]
    P = [a + b for a, b in zip(p[:n], p[n:], strict=True)]
    P += [(second * a - first * b) / total for a, b in zip(p[:n], p[n:], strict=True)]
    return TwoBodies(total, first * second / total, Transformation(space, Q=Q, P=P))
