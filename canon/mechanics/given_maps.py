"""What a map is given by: types of generating functions, and formulas in the variables of one side alone."""

from collections.abc import Iterable, Sequence
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import listed
from canon.expression import Formula
from canon.mechanics.formulas import check_symbols
from canon.mechanics.phase_space import PhaseSpace


def listed_types(kinds: int | Sequence[int]) -> int | tuple[int, ...]:
    """One type, or several in a tuple; **raises** `InputError` for what is no whole number."""
    several = (kinds,) if isinstance(kinds, int) else _several(kinds)
    for kind in several:
        if not isinstance(kind, int) or isinstance(kind, bool):
            raise InputError(f"there is no type {kind!r}; types are 1, 2, 3 and 4", "generating_function, type")
    return kinds if isinstance(kinds, int) else several


def _several(kinds: Any) -> tuple[Any, ...]:
    return listed(kinds, "types", "generating_function, type") if isinstance(kinds, Iterable) else (kinds,)


def check_sides(
    formulas: Sequence[Formula],
    targets: Sequence[sp.Symbol],
    space: PhaseSpace,
    forward: bool,
    where: str,
) -> None:
    """Raise unless there is a formula for each target, in the variables of the other side alone."""
    if formulas and not targets:
        said = "the phase space has no new variables: name them, as in PhaseSpace('q', 'p', new=('Q', 'P'))"
        raise InputError(said, where)
    if len(formulas) != len(targets):
        raise InputError(f"{len(formulas)} formulas for {len(targets)} variables", where)
    check_symbols(formulas, space.vocabulary, where)
    side, other = (space.old, space.new) if forward else (space.new, space.old)
    strangers = {*other} - {*side}
    for formula in formulas:
        for symbol in sorted(formula.symbols & strangers, key=str):
            raise InputError(f"{symbol} cannot occur here: the formula is one in {', '.join(map(str, side))}", where)
