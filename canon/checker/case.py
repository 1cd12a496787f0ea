"""What a kind of claim asks for, as a list of obligations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from canon.checker.functions import Unreadable


@dataclass
class Case:
    """What must vanish, and groups of which a member must not vanish everywhere.

    `images` are values of names that it is about; `trusted`, what would have to be shown besides; `labels`, what the
    zeros are called, where they have names. `independent` are functions that must be linearly independent over the
    reals, whatever the parameters are; `positive`, formulas that must be positive throughout the domain (or, with
    False, nowhere negative). `found` is what exact arithmetic says of the rest of the claim, if anything, and
    `measured` gives further values that must vanish at a point, to so many `digits`: they are evidence, never a proof.
    Where one of the groups `outside` is independent, the claim fails.
    Names that stand in `mentions` get values too. `against` is what a refutation by a point takes on
    trust; it says nothing of the claim where one of `granted` isn't identically 0. `enclosed` gives intervals of what
    is measured: one without 0 in it refutes the claim. All that is `somewhere` is positive at a point of the domain:
    what the claim takes for granted is so at least there. `algebra` has the brackets of what is independent, where
    they are numbers; whatever they are, the algebra may be known to be simple. A point that is `elsewhere` than the
    witness may refute it, too: the witness may lie beside the image of a map. What is `granted_by_all` is no part of
    the claim: where it fails there is none, so that a refutation without a point needs it as a proof does.
    """

    zeros: list[int]
    nonzeros: list[list[int]] = field(default_factory=list)
    images: dict[str, int] = field(default_factory=dict)
    trusted: str = ""
    labels: list[str] = field(default_factory=list)
    independent: list[int] = field(default_factory=list)
    positive: list[tuple[int, bool]] = field(default_factory=list)
    found: bool | None = None
    measured: Callable[[Any, Mapping[str, Any]], list[Any]] | None = None
    digits: int = 20
    outside: list[list[int]] = field(default_factory=list)
    mentions: list[int] = field(default_factory=list)
    against: str = ""
    granted: list[int] = field(default_factory=list)
    enclosed: Callable[[Any, Mapping[str, Any]], Iterable[Any]] | None = None
    somewhere: list[int] = field(default_factory=list)
    algebra: Any = None
    is_simple: bool = False
    elsewhere: bool = False
    granted_by_all: bool = False

    @property
    def fails_alone(self) -> bool:
        """Whether exact arithmetic says that the claim fails, and nothing besides has to be shown for it."""
        return self.found is False and not (self.zeros or self.independent or self.images)

    def shown(self, verdict: str) -> list[int]:
        """What a certificate of this verdict has to show to be 0; of a refutation without a point, its grounds."""
        if verdict == "proved" or self.found is False:
            return self.zeros
        return self.nonzeros[0] if self.nonzeros else []


def whole(value: Any, least: int = 0) -> int:
    """A whole number. Raises Unreadable."""
    if not isinstance(value, int) or isinstance(value, bool) or value < least:
        raise Unreadable(f"{str(value)[:40]} is no whole number from {least} on")
    return value
