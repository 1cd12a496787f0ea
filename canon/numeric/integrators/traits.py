"""What is known of an integrator, by measurement: the tests measure every trait that a table states."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Traits:
    """An integrator's properties on the problems that it is for; None where nobody has shown either answer.

    `order`: the error after a fixed time goes as h**order. `symplectic`: a step's Jacobian M has M J Mᵀ = J.
    `symmetric`: a step of −h undoes a step of h. `volume_preserving`: det M = 1.
    """

    order: int
    symplectic: bool | None
    symmetric: bool | None
    volume_preserving: bool | None
