"""Cases whose truth is known by construction, in exact arithmetic: cheap, a campaign has them by the ten thousand."""

from __future__ import annotations

import random
from collections.abc import Callable

from properties.soundness.branches import branch
from properties.soundness.cases import equation_file
from properties.soundness.exact import brackets, linear, near
from properties.soundness.identities import Equation
from properties.soundness.truth import Case, gap
from properties.soundness.turns import turned


def _equation(family: str, made: tuple[Equation, bool] | None) -> Case | None:
    if made is None:
        return None
    found, truth = made
    return Case(family, equation_file(found), truth, found.template, gap(found))


def _text(family: str, made: tuple[str, bool, str]) -> Case:
    text, truth, note = made
    return Case(family, text, truth, note)


FAMILIES: dict[str, Callable[[random.Random], Case | None]] = {
    "branch": lambda rng: _equation("branch", branch(rng)),
    "turn": lambda rng: _equation("turn", turned(rng)),
    "near": lambda rng: _equation("near", near(rng)),
    "linear": lambda rng: _text("linear", linear(rng)),
    "polynomial bracket": lambda rng: _text("polynomial bracket", brackets(rng)),
}
SHARES = ("branch",) * 4 + ("turn",) * 2 + ("near",) * 2 + ("linear", "polynomial bracket")


def known_case(seed: int) -> Case | None:
    """The case of a seed; None where the draw is no claim."""
    rng = random.Random(seed)
    return FAMILIES[rng.choice(SHARES)](rng)
