"""What `st.from_type` gives for canon's types, registered by Hypothesis itself when it is imported.

Hypothesis calls `register` through the entry point of the package; canon imports nothing of Hypothesis for that. And
importing Hypothesis must not cost anybody the import of sympy, so a type is registered when its own module is loaded:
at once if it is already, else by a finder that waits for it.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import ModuleType
from typing import Any, Final

TYPES: Final[Mapping[str, tuple[str, str]]] = {
    "canon.mechanics.phase_space": ("PhaseSpace", "any_phase_space"),
    "canon.mechanics.generating_function": ("GeneratingFunction", "any_generating_function"),
    "canon.mechanics.transformation": ("Transformation", "any_canonical_map"),
    "canon.mechanics.hamiltonian": ("Hamiltonian", "any_hamiltonian"),
}
"""For each module: the type that it defines, and the function in `canon.testing.by_type` that makes its strategy."""


def register() -> None:
    """Register the types whose modules are loaded, and wait for the others."""
    waiting = set()
    for name in TYPES:
        module = sys.modules.get(name)
        if module is not None and hasattr(module, TYPES[name][0]):
            _register(module)
        else:
            waiting.add(name)
    if waiting and not any(isinstance(finder, _Waiting) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Waiting(waiting))


class _Waiting(MetaPathFinder):
    """Finds nothing itself; it sees to it that a module's type is registered after the module was executed."""

    def __init__(self, names: set[str]) -> None:
        self.names = names

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The module's own spec, with a loader that registers the type in the end."""
        if fullname not in self.names:
            return None
        self.names.discard(fullname)
        spec = find_spec(fullname)
        if spec is None or spec.loader is None:
            return None
        spec.loader = _ThenRegister(spec.loader)
        return spec


class _ThenRegister(Loader):
    """A module's own loader, and afterwards the registration of its type. (Loaders may be shared: none is changed.)"""

    def __init__(self, loader: Any) -> None:
        self.loader = loader

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """What the module's own loader creates."""
        return self.loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        """Execute the module and register its type."""
        self.loader.exec_module(module)
        _register(module)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.loader, name)


def _register(module: ModuleType) -> None:
    from hypothesis import strategies as st

    type_name, strategy_name = TYPES[module.__name__]

    def strategy(_: type) -> st.SearchStrategy[Any]:
        from canon.testing import by_type

        return getattr(by_type, strategy_name)()

    st.register_type_strategy(getattr(module, type_name), strategy)
