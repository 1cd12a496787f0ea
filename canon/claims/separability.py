"""Does the Hamilton–Jacobi equation separate? Decided as the identity that Stäckel or Levi-Civita make of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import sympy as sp

from canon.claims.verify import verify
from canon.display import text_in_html
from canon.domain import Condition, Domain
from canon.errors import EmptyDomain, InputError
from canon.expected import instance_of
from canon.mechanics.formulas import Expression, as_expression, replaced
from canon.mechanics.phase_space import PhaseSpace, check_space
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


_WORST: Final = ("refuted", "undecided", "supported", "proved")
_ELSEWHERE: Final = "the parts are those along lines that may leave the domain: there they needn't say what V is in it"


def separates(
    space: PhaseSpace, H: Expression, coordinates: str | OrthogonalCoordinates, *, focus: sp.Expr | int = 1,
    budget: float = 10.0,
) -> Separability:  # fmt: skip
    """Does H = (Σ p²)/2m + V(q), in Cartesian coordinates, separate in these orthogonal ones? By Stäckel's theorem.

    **Arguments:** the name of a system, or one of `orthogonal_coordinates`; `focus` of elliptic and prolate spheroidal
    coordinates; `budget` in seconds.

    **Raises:** `InputError` for another kinetic energy, another dimension, an unknown name.
    """
    check_space(space)
    if isinstance(coordinates, str):
        coordinates = orthogonal_coordinates(coordinates, space.n, focus)
    instance_of(coordinates, OrthogonalCoordinates, "coordinates")
    found = separation(space, H, coordinates)
    verdicts = [_verdict(space, found, coordinates, budget)]
    if coordinates.name == "parabolic" and space.n == 2:  # they cover the half plane y > 0: what is below is turned up
        up: dict[sp.Expr, sp.Expr] = {space.q[1]: -space.q[1]}
        mirrored = space.with_domain(space.domain.substitute(up))
        below = separation(mirrored, replaced(as_expression(H), up), coordinates)
        verdicts.append(_verdict(mirrored, below, coordinates, budget))
    looked_at = [verdict for verdict in verdicts if verdict is not None]
    if not looked_at:
        raise EmptyDomain("no point of the domain was found", "domain")
    return Separability(coordinates.name, min(looked_at, key=lambda verdict: _WORST.index(verdict.status)), found)


def _verdict(space: PhaseSpace, found: Separation, coordinates: OrthogonalCoordinates, budget: float) -> Verdict | None:
    """The verdict on the parts that were found where the coordinates are defined; None where that is nowhere."""
    u, stated = coordinates.u, _in_coordinates(space, coordinates)
    free = as_declared(sorted(_parameters(found, stated, u), key=str))
    fresh = PhaseSpace(u, [f"p_{x}" for x in u], **free, functions=space.functions)
    inside = [Condition("positive", (h,)) for h in coordinates.squares if h.free_symbols & set(u)]
    claim = identity(fresh.with_domain(fresh.domain & inside & stated), found.residual(), 0)
    try:
        verdict = verify(claim, budget=budget)
    except EmptyDomain:
        return None
    if verdict.status == "refuted" and _spoken_of(stated) & set(u):
        return replace(verdict, status="undecided", witness=None, certificate=None, detail={"note": _ELSEWHERE})
    return verdict


def _in_coordinates(space: PhaseSpace, coordinates: OrthogonalCoordinates) -> Domain:
    """The space's domain in the new coordinates. **Raises** `InputError` where it speaks of momenta or of time."""
    for x in sorted(_spoken_of(space.domain) & {*space.p, *space.new, space.t} - {*space.q}, key=str):
        raise InputError(f"where a potential separates is a matter of coordinates, not of {x}", "domain")
    return space.domain.substitute(dict(zip(space.q, coordinates.cartesian, strict=True)))


def _spoken_of(domain: Domain) -> set[sp.Symbol]:
    terms = [*domain.surface, *(term for condition in domain.conditions for term in condition.terms)]
    return {s for term in terms for s in term.free_symbols if isinstance(s, sp.Symbol)}


def _parameters(found: Separation, stated: Domain, u: tuple[sp.Symbol, ...]) -> set[sp.Symbol]:
    residual = found.residual()
    return {s for s in residual.free_symbols if isinstance(s, sp.Symbol)}.union(_spoken_of(stated)) - set(u)


def separates_here(space: PhaseSpace, H: Expression, *, budget: float = 10.0) -> Separability:
    """Does H separate in the coordinates in which it is written? By Levi-Civita's conditions."""
    verdicts = [verify(identity(space, value, 0), budget=budget) for value in levi_civita(space, H).values() or (0,)]
    worst = min(verdicts, key=lambda verdict: _WORST.index(verdict.status))
    return Separability("its own", worst)
