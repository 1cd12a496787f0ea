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
        assert_order,
        assert_reversible,
        assert_symplectic,
        assert_volume_preserving,
    )
    from canon.testing.laws import BRACKET_LAWS, GENERATING_LAWS, GROUP_LAWS, Law, assert_law
    from canon.testing.maps import Mutant, canonical_maps, mutants
    from canon.testing.strategies import functions, generating_functions, phase_spaces, polynomials, rationals

_HOMES = {
    "assertions": (
        "assert_canonical",
        "assert_order",
        "assert_reversible",
        "assert_symplectic",
        "assert_volume_preserving",
    ),
    "laws": ("BRACKET_LAWS", "GENERATING_LAWS", "GROUP_LAWS", "Law", "assert_law"),
    "maps": ("Mutant", "canonical_maps", "mutants"),
    "strategies": ("functions", "generating_functions", "phase_spaces", "polynomials", "rationals"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "BRACKET_LAWS",
    "GENERATING_LAWS",
    "GROUP_LAWS",
    "Law",
    "Mutant",
    "assert_canonical",
    "assert_law",
    "assert_order",
    "assert_reversible",
    "assert_symplectic",
    "assert_volume_preserving",
    "canonical_maps",
    "functions",
    "generating_functions",
    "mutants",
    "phase_spaces",
    "polynomials",
    "rationals",
]


def __getattr__(name: str) -> object:
    if name not in _HOME_OF:
        raise AttributeError(f"module 'canon.testing' has no attribute {name!r}")
    value = getattr(import_module(f"canon.testing.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
