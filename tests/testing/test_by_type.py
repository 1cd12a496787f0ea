"""`st.from_type` knows canon's types, by an entry point: canon doesn't import Hypothesis, nor Hypothesis canon."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def installed(tmp_path: Path) -> Path:
    """A folder that says, as an installed package's does, which entry point Hypothesis is to call."""
    info = tmp_path / "canon_by_type-0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: canon-by-type\nVersion: 0\n")
    (info / "entry_points.txt").write_text("[hypothesis]\ncanon = canon.testing.hypothesis_entry:register\n")
    return tmp_path


def run(program: str, installed: Path) -> list[str]:
    path = os.pathsep.join([str(installed), str(ROOT)])
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": path}
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


DRAW = """
from hypothesis import Phase, find, settings, strategies as st
quick = settings(max_examples=5, database=None, derandomize=True, phases=[Phase.generate])
for type in (PhaseSpace, GeneratingFunction, Transformation, Hamiltonian):
    print(type.__name__, isinstance(find(st.from_type(type), lambda made: True, settings=quick), type))
"""
NAMES = "from canon import GeneratingFunction, Hamiltonian, PhaseSpace, Transformation\n"
EXPECTED = ["PhaseSpace True", "GeneratingFunction True", "Transformation True", "Hamiltonian True"]


def test_types_that_are_loaded_after_hypothesis(installed: Path) -> None:
    first = "import sys, hypothesis\nprint(sorted({'sympy', 'canon.mechanics'} & set(sys.modules)))\n"
    assert run(first + NAMES + DRAW, installed) == ["[]", *EXPECTED]


def test_types_that_are_loaded_before_hypothesis(installed: Path) -> None:
    first = NAMES + "import sys\nPhaseSpace('q', 'p'); Transformation\nprint('hypothesis' in sys.modules)\n"
    assert run(first + DRAW, installed) == ["False", *EXPECTED]


def test_the_entry_points_are_declared() -> None:
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["entry-points"]
    assert project["hypothesis"] == {"canon": "canon.testing.hypothesis_entry:register"}
    assert project["pytest11"] == {"canon": "canon.testing.pytest_plugin"}


def test_a_loader_that_modules_share_is_left_as_it_is(installed: Path) -> None:
    """pytest loads all modules of a plugin's package by one object."""
    program = """
import sys, hypothesis
from importlib.machinery import PathFinder
from importlib.abc import Loader

class Shared(Loader):
    specs = {}
    def find_spec(self, name, path=None, target=None):
        spec = PathFinder.find_spec(name, path) if name.startswith("canon.mechanics") else None
        if spec is not None and not spec.submodule_search_locations:
            self.specs[name], spec.loader = spec.loader, self
            return spec
    def create_module(self, spec): return None
    def exec_module(self, module): self.specs[module.__name__].exec_module(module)

sys.meta_path.insert(1, Shared())
"""
    assert run(program + NAMES + DRAW, installed) == EXPECTED
