"""All rules by name: `SAME` makes claims that are true exactly when the first one is, `WEAKER` what follows from a true
claim, `STRONGER` what a false one follows from; `KINDS` what follows of another kind,
and what is false then: all of them whose name begins with `as_not`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from properties.metamorphic import (
    analysis,
    assumptions,
    conditions,
    coordinates,
    equations,
    formulas,
    kinds,
    naming,
    weaker,
)
from properties.metamorphic.parts import Rule


def _by_name(*rules: Rule) -> Mapping[str, Rule]:
    return {rule.__name__: rule for rule in rules}


SAME: Final = _by_name(
    naming.renamed, naming.reordered, naming.abbreviated, naming.written_out, naming.with_more,
    coordinates.in_other_coordinates, coordinates.to_other_coordinates, coordinates.read_backward,
    coordinates.with_another_pair, coordinates.in_curved_coordinates, coordinates.at_another_time,
    conditions.by_conditions, conditions.by_a_word, conditions.by_a_domain, conditions.by_a_surface,
    conditions.with_other_parameters, conditions.by_a_function,
    assumptions.with_other_functions, assumptions.as_real_and_imaginary, assumptions.with_other_integers,
    assumptions.by_another_equation,
    analysis.with_a_function_of_the_energy, analysis.round_another_orbit, analysis.in_another_variable,
    analysis.by_another_lagrangian, analysis.in_another_basis, analysis.by_other_constraints,
    analysis.with_more_of_an_average,
    formulas.rewritten, formulas.multiplied, formulas.with_another_hamiltonian, formulas.by_derivatives,
)  # fmt: skip
WEAKER: Final = _by_name(
    weaker.at_a_number, weaker.at_an_integer, weaker.with_a_condition, weaker.with_a_stronger_word,
    weaker.with_a_function, weaker.identified, weaker.on_a_surface, assumptions.with_a_hole,
)  # fmt: skip
STRONGER: Final = _by_name(
    weaker.without_a_condition, weaker.with_a_free_number, weaker.with_a_free_function, weaker.with_a_free_name
)
KINDS: Final = _by_name(kinds.as_another_kind, kinds.as_not, equations.as_an_equation, equations.as_not_quite)
