"""Does the Hamilton–Jacobi equation separate? Decided as the identity that Stäckel or Levi-Civita make of it."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from canon.claims.verify import verify
from canon.display import text_in_html
from canon.domain import Condition
from canon.mechanics.formulas import Expression
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.separation.coordinates import OrthogonalCoordinates, orthogonal_coordinates
from canon.mechanics.separation.levi_civita import levi_civita
from canon.mechanics.separation.staeckel import Separation, separation
from canon.mechanics.stated_names import as_declared
from canon.mechanics.statements import identity
from canon.verdict import Verdict


@dataclass(frozen=True)
class Separability:
    """Whether H separates in some coordinates: `verdict` is that on the identity which is equivalent to it.

    `proved`: it separates, with the equations of `separation`. `refuted`: it doesn't in these coordinates, by a
    certified point at which the identity fails. Anything else isn't decided. `separation` is None for Levi-Civita's
    conditions.
    """

    coordinates: str
    verdict: Verdict
    separation: Separation | None = None

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        words = {"proved": "separates", "refuted": "does not separate"}
        said = words.get(self.verdict.status, f"is not decided ({self.verdict.status}): separates or not")
        proof = ": that is a proof" if self.verdict.status == "refuted" else ""
        return f"{said} in {self.coordinates} coordinates{proof}"


def separates(
    space: PhaseSpace, H: Expression, coordinates: str | OrthogonalCoordinates, *, focus: sp.Expr | int = 1,
    budget: float = 10.0,
) -> Separability:  # fmt: skip
    """Does H = (Σ p²)/2m + V(q), in Cartesian coordinates, separate in these orthogonal ones? By Stäckel's theorem.

    **Arguments:** the name of a system, or one of `orthogonal_coordinates`; `focus` of elliptic and prolate spheroidal
    coordinates; `budget` in seconds.

    **Raises:** `InputError` for another kinetic energy, another dimension, an unknown name.
    """
    if isinstance(coordinates, str):
        coordinates = orthogonal_coordinates(coordinates, space.n, focus)
    found = separation(space, H, coordinates)
    u = coordinates.u
    free = as_declared(sorted(_parameters(found, u), key=str))
    fresh = PhaseSpace(u, [f"p_{x}" for x in u], **free, functions=space.functions)
    inside = [Condition("positive", (h,)) for h in coordinates.squares if h.free_symbols & set(u)]
    claim = identity(fresh.with_domain(fresh.domain & inside), found.residual(), 0)
    return Separability(coordinates.name, verify(claim, budget=budget), found)


def _parameters(found: Separation, u: tuple[sp.Symbol, ...]) -> set[sp.Symbol]:
    residual = found.residual()
    return {s for s in residual.free_symbols if isinstance(s, sp.Symbol)} - set(u)


def separates_here(space: PhaseSpace, H: Expression, *, budget: float = 10.0) -> Separability:
    """Does H separate in the coordinates in which it is written? By Levi-Civita's conditions."""
    verdicts = [verify(identity(space, value, 0), budget=budget) for value in levi_civita(space, H).values()]
    order = ("refuted", "undecided", "supported", "proved")
    worst = min(verdicts, key=lambda verdict: order.index(verdict.status))
    return Separability("its own", worst)
