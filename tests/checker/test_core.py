"""What decides is small: the core is under 300 lines, and takes nothing from the rest but the names of its answers."""

import ast
import random
import sys
from fractions import Fraction
from pathlib import Path

import pytest

import canon.checker
from canon.checker import core
from canon.checker.core import Program
from canon.checker.functions import Rejected

HERE = Path(canon.checker.__file__).parent
CORE = ("core", "tower")
OUTSIDE = {"mpmath"}
"""What the checker takes from others than Python."""


SMALL = ("alone*.py", "counterexample*.py", "refutations.py", "lie_invariants.py")
"""The files that run in a folder of their own."""


def imported(path: Path) -> set[tuple[str, str]]:
    """The (module, name) pairs that a file imports, wherever in it; a name is "" where all of a module is."""
    found = set[tuple[str, str]]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {(alias.name, "") for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            found |= {("." * node.level + (node.module or ""), alias.name) for alias in node.names}
    return found


def strangers(path: Path) -> set[str]:
    """What a file of the checker imports that is neither Python's, nor the checker's, nor mpmath.

    Files that run where canon isn't installed name those that lie beside them.
    """
    small = any(path.match(pattern) for pattern in SMALL)
    beside = {file.stem for pattern in SMALL for file in HERE.glob(pattern)} if small else set()
    return {
        module
        for module, name in imported(path)
        if not (
            module.split(".")[0] in sys.stdlib_module_names | OUTSIDE | beside
            or module.startswith("canon.checker")
            or (module == "canon" and name == "checker")
        )
    }


def test_the_core_is_under_300_lines() -> None:
    assert sum(len((HERE / f"{name}.py").read_text(encoding="utf-8").splitlines()) for name in CORE) < 300


def test_the_core_knows_nothing_of_mechanics_or_functions() -> None:
    for name in CORE:
        own = {(m, n) for m, n in imported(HERE / f"{name}.py") if m.split(".")[0] not in sys.stdlib_module_names}
        names = {("canon.checker.functions", n) for n in ("Rejected", "Unknown", "Unreadable")}
        assert own <= names | {("canon.checker", "core")}


def test_the_checker_shares_no_code_with_anything() -> None:
    """Any import but of Python, mpmath and itself, at the top or in a function, of modules not yet written too."""
    files = sorted(HERE.glob("**/*.py"))
    assert len(files) > 20
    assert {file.name: strangers(file) for file in files if strangers(file)} == {}


@pytest.mark.parametrize(
    "line",
    [
        "import canon.decide.tower",
        "from canon.slope import slopes",
        "def f():\n    import sympy",
        "from .. import x",
        "import alone",
    ],
)
def test_a_shared_import_is_seen(tmp_path: Path, line: str) -> None:
    file = tmp_path / "values.py"
    file.write_text(f"from canon.checker import core\n{line}\n", encoding="utf-8")
    assert strangers(file)


G = {(("g", 1),): Fraction(1)}


def identity(cofactor: str, numerator: dict[str, str]) -> None:
    """g² − x = 0 by the relation of g = √x."""
    minus_x = {(("x", 1),): Fraction(-1)}
    program = Program(2, [(1, ("^", 0, 2), [0]), (2, ("+", 1, 3), [1, 3])], {0: (G, core.ONE), 3: (minus_x, core.ONE)})
    entry = {"numerator": numerator, "denominator": {"": "1"}, "cofactors": {"g": {"": cofactor}}}
    primes = [core.random_prime(random.Random(1))]
    core.identity(program, entry, {"g": core.read({"g^2": "1", "x": "-1"})}, primes)


def test_the_core_alone_checks_an_identity() -> None:
    identity("1", {"g^2": "1", "x": "-1"})
    for cofactor, numerator in (("2", {"g^2": "1", "x": "-1"}), ("1", {"g^2": "1"}), ("2", {"g^2": "2", "x": "-2"})):
        with pytest.raises(Rejected):
            identity(cofactor, numerator)
