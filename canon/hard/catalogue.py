"""The catalogue of hard cases, family by family."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

from canon.errors import InputError
from canon.hard import (
    angles,
    boosts,
    brackets,
    caustics,
    elements,
    integrators,
    kepler,
    loops,
    modes,
    relativity,
    resonance,
    rotations,
    scattering,
    separatrix,
    series,
    units,
)
from canon.hard.case import HardCase

FAMILIES = (
    kepler,
    elements,
    separatrix,
    resonance,
    modes,
    rotations,
    boosts,
    relativity,
    scattering,
    angles,
    caustics,
    series,
    brackets,
    loops,
    integrators,
    units,
)


def cases(names: Sequence[str] = (), *, slow: bool = False) -> tuple[HardCase, ...]:
    """The cases whose name or family holds one of `names`; all without any. Slow ones only where they are asked for.

    **Raises:** `InputError` for a name that no case has.
    """
    found = tuple(case for family in FAMILIES for case in family.CASES)
    for name in names:
        if not any(_is_meant(case, name) for case in found):
            known = [*dict.fromkeys(case.family for case in found), *(case.name for case in found)]
            near = get_close_matches(name, known, 1) or [", ".join(known[: len({case.family for case in found})])]
            raise InputError(f"no hard case is called {name!r}; there is {near[0]}", "NAME")
    chosen = [case for case in found if not names or any(_is_meant(case, name) for name in names)]
    return tuple(case for case in chosen if slow or not case.slow)


def _is_meant(case: HardCase, name: str) -> bool:
    return name.casefold() in case.name.casefold() or name.casefold() == case.family.casefold()
