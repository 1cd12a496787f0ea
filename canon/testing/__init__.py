"""For test suites: assertions about maps, Hypothesis strategies of mechanics' objects, and its laws as data.

    from hypothesis import given
    from canon.testing import assert_symplectic, canonical_maps, phase_spaces

Names are loaded when they are first used. The strategies and laws need Hypothesis, the assertions don't.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from canon.testing.assertions import (
        assert_canonical,
        assert_reversible,
        assert_symplectic,
        assert_volume_preserving,
    )
    from canon.testing.checking import check_laws
    from canon.testing.curves import Loop, Surface, loops, surfaces
    from canon.testing.energies import hamiltonians, waves
    from canon.testing.flows import assert_hamiltonian_flow
    from canon.testing.laws import (
        BRACKET_LAWS,
        GENERATING_LAWS,
        GROUP_LAWS,
        Law,
        assert_law,
        bracket_laws,
        group_laws,
    )
    from canon.testing.maps import Mutant, canonical_maps, mutants
    from canon.testing.matrices import MatrixMutant, matrix_mutants, symplectic_matrices
    from canon.testing.order import assert_order
    from canon.testing.points import UNITS, phase_points
    from canon.testing.strategies import functions, generating_functions, phase_spaces, polynomials, rationals

_HOMES = {
    "assertions": ("assert_canonical", "assert_reversible", "assert_symplectic", "assert_volume_preserving"),
    "checking": ("check_laws",),
    "curves": ("Loop", "Surface", "loops", "surfaces"),
    "flows": ("assert_hamiltonian_flow",),
    "energies": ("hamiltonians", "waves"),
    "laws": (
        "BRACKET_LAWS",
        "GENERATING_LAWS",
        "GROUP_LAWS",
        "Law",
        "assert_law",
        "bracket_laws",
        "group_laws",
    ),
    "maps": ("Mutant", "canonical_maps", "mutants"),
    "matrices": ("MatrixMutant", "matrix_mutants", "symplectic_matrices"),
    "order": ("assert_order",),
    "points": ("UNITS", "phase_points"),
    "strategies": ("functions", "generating_functions", "phase_spaces", "polynomials", "rationals"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "BRACKET_LAWS",
    "GENERATING_LAWS",
    "GROUP_LAWS",
    "UNITS",
    "Law",
    "Loop",
    "MatrixMutant",
    "Mutant",
    "Surface",
    "assert_canonical",
    "assert_hamiltonian_flow",
    "assert_law",
    "assert_order",
    "assert_reversible",
    "assert_symplectic",
    "assert_volume_preserving",
    "bracket_laws",
    "canonical_maps",
    "check_laws",
    "functions",
    "generating_functions",
    "group_laws",
    "hamiltonians",
    "loops",
    "matrix_mutants",
    "mutants",
    "phase_points",
    "phase_spaces",
    "polynomials",
    "rationals",
    "surfaces",
    "symplectic_matrices",
    "waves",
]


def __getattr__(name: str) -> object:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'canon.testing' has no attribute {name!r}")
    value = getattr(import_module(f"canon.testing.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
