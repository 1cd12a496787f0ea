"""Coordinates, velocities and accelerations of claims about motions."""

from __future__ import annotations

from collections.abc import Sequence

from canon.checker.functions import Unreadable
from canon.checker.statement import Statement

OF_MOTIONS = (
    "L", "dissipation", "forces", "equations", "qddot", "dq", "dt", "f", "charge", "forms", "functions", "integrals",
    "possible", "virtual", "multipliers",
)  # fmt: skip
"""Keys of formulas of coordinates and velocities."""


class Motion:
    """Coordinates, velocities and accelerations by name, and rates of change along any motion."""

    def __init__(self, s: Statement) -> None:
        if s.direction in ("implicit", "backward"):
            s.on_old_side()
        self.f, self.q, self.t = s.f, s.q, s.time
        self.v = list(s.claim["velocities"])
        taken = {*s.declared, *self.v, *s.names}
        self.a = list(s.claim.get("accelerations", [unused(f"{x}_tt", taken) for x in self.q]))
        s.declared |= {*self.a}
        if not len(self.q) == len(self.v) == len(self.a):
            raise Unreadable("so many velocities as coordinates are needed")
        _check_variables(s, self.v, self.a)

    def rate(self, f: int) -> int:
        """∂f/∂t + Σ v ∂f/∂q + Σ a ∂f/∂v."""
        steps = (*zip(self.q, self.v, strict=True), *zip(self.v, self.a, strict=True))
        moved = (self.f.mul(self.f.slope(f, x), self.f.node("s", dx)) for x, dx in steps)
        return self.f.add(self.f.slope(f, self.t), *moved)


def _check_variables(s: Statement, v: Sequence[str], a: Sequence[str]) -> None:
    """Refuse formulas of momenta, of accelerations but for equations, and integrals of velocities."""
    for key, value in dict.items(s.claim):
        if key in OF_MOTIONS:
            closed = {*s.p, *(a if key != "equations" else []), *(v if key == "integrals" else [])}
            for text in value if isinstance(value, list) else [value]:
                s.without(s.f.read(text, s.names), closed)


def unused(name: str, taken: set[str]) -> str:
    """The name, or one like it that isn't among those that are taken."""
    return unused(f"{name}_", taken) if name in taken else name


def formulas(s: Statement, word: str) -> list[int]:
    """A key with one formula for each coordinate: a list, or a single one."""
    return s.keys(word) if isinstance(s.claim[word], list) else [s.key(word)]
