"""Laws checked of random objects, in one call."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from canon.claims.well_formed import check_budget
from canon.errors import InputError
from canon.expected import instance_of, listed, table, whole_number, yes_or_no
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation
from canon.testing.laws import Law, assert_law
from canon.testing.maps import canonical_maps, drift, exchange, hyperbolic, kick, linear
from canon.testing.strategies import functions, generating_functions, phase_spaces

Maker = Callable[[PhaseSpace], st.SearchStrategy[Any]]


def simple_functions(space: PhaseSpace) -> st.SearchStrategy[Any]:
    """Polynomials of the old variables: three of them may stand in one law."""
    return functions(space.old, transcendental=False)


def short_maps(space: PhaseSpace) -> st.SearchStrategy[Transformation]:
    """Canonical maps of at most two factors."""
    return canonical_maps(space, max_factors=2)


def elementary_maps(space: PhaseSpace) -> st.SearchStrategy[Transformation]:
    """Canonical maps of at most two factors, whose equations have one solution that is found at once."""
    return canonical_maps(space, max_factors=2, factors=(kick, drift, linear, exchange, hyperbolic))


def single_factors(space: PhaseSpace) -> st.SearchStrategy[Transformation]:
    """Canonical maps of one elementary factor: products of two of them and their inverses stay short."""
    return canonical_maps(space, max_factors=1, factors=(kick, drift, linear, exchange, hyperbolic))


MAKERS: Mapping[str, Maker] = {
    "function": simple_functions,
    "map": short_maps,
    "elementary map": elementary_maps,
    "factor": single_factors,
    "generating function": generating_functions,
}
"""For each kind of object that a law may take, a strategy of such objects on a phase space."""


MOST_EXAMPLES = 10**6


def check_laws(
    laws: Iterable[Law],
    *,
    spaces: st.SearchStrategy[PhaseSpace] | None = None,
    makers: Mapping[str, Maker] | None = None,
    max_examples: int = 10,
    budget: float = 10.0,
    derandomize: bool = True,
) -> int:
    """Check each law of random objects; objects for which a law can't be written down are passed over.

    **Arguments:** the `laws`; a strategy of phase `spaces` (default: one or two degrees of freedom); `makers`, for each
    kind of object a function from a phase space to a strategy, in place of canon's own ("function", "map", "elementary
    map", "factor", "generating function"); `max_examples` for each law; `budget`, seconds for each residual. With
    `derandomize` each call draws the same objects.

    **Returns:** how many laws were checked. **Raises:** `AssertionError` for the first that fails, at a simple example.
    """
    max_examples = whole_number(max_examples, "max_examples", 1, MOST_EXAMPLES)
    check_budget(budget)
    yes_or_no(derandomize, "derandomize")
    derandomize = bool(derandomize)
    if makers is not None:
        table(makers, "functions from a phase space to a strategy", "makers")
    if spaces is not None:
        instance_of(spaces, st.SearchStrategy, "spaces")
    chosen = {**MAKERS, **(makers or {})}
    homes = phase_spaces(max_degrees=2) if spaces is None else spaces
    count = 0
    for law in listed(laws, "laws", "laws"):
        instance_of(law, Law, "laws")
        unknown = [kind for kind in law.takes if kind not in chosen]
        if unknown:
            raise InputError(f"no strategy for {unknown[0]!r}, which the law {law.name!r} takes: give one in `makers`")
        _check(law, homes, chosen, max_examples, budget, derandomize)
        count += 1
    if not count:
        raise InputError("there is no law to check", "laws")
    return count


def _check(
    law: Law,
    homes: st.SearchStrategy[PhaseSpace],
    makers: Mapping[str, Maker],
    max_examples: int,
    budget: float,
    derandomize: bool,
) -> None:
    @settings(
        max_examples=max_examples if law.takes else 3,
        deadline=None,
        database=None,
        derandomize=derandomize,
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
    )
    @given(st.data())
    def holds(data: st.DataObject) -> None:
        space = data.draw(homes)
        objects = [_apart(data.draw(makers[kind](space)), k) for k, kind in enumerate(law.takes)]
        try:
            residuals = [*law.residuals(space, *objects)]
        except InputError:
            assume(False)
            return
        fixed = Law(law.name, law.says, law.takes, lambda *_: residuals)
        assert_law(fixed, space, *objects, budget=budget)

    holds()


def _apart(made: Any, k: int) -> Any:
    """The k-th map with new variables of its own, so that maps of one space can be composed."""
    if not isinstance(made, Transformation) or made.direction != "forward":
        return made
    space = made.space
    names = ([f"{x.name}_{k}" for x in side] for side in (space.Q, space.P))
    return Transformation(space.with_new(tuple(names)), Q=made.Q, P=made.P)  # type: ignore[arg-type]
