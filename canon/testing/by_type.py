"""What `st.from_type` draws for canon's types: a phase space first, and something on it."""

from __future__ import annotations

from hypothesis import strategies as st

from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.hamiltonian import Hamiltonian
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation
from canon.testing.energies import hamiltonians
from canon.testing.maps import canonical_maps
from canon.testing.strategies import generating_functions, phase_spaces


def any_phase_space() -> st.SearchStrategy[PhaseSpace]:
    """Phase spaces of one to three degrees of freedom."""
    return phase_spaces()


def any_generating_function() -> st.SearchStrategy[GeneratingFunction]:
    """Generating functions of all types, with a regular mixed Hessian."""
    return phase_spaces().flatmap(generating_functions)


def any_canonical_map() -> st.SearchStrategy[Transformation]:
    """Transformations that are canonical."""
    return phase_spaces().flatmap(canonical_maps)


def any_hamiltonian() -> st.SearchStrategy[Hamiltonian]:
    """Polynomial and trigonometric Hamiltonians."""
    return phase_spaces(new=False).flatmap(hamiltonians)
