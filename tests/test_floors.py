"""The floors of imports: the contract is kept, and it is seen to break where a module imports from above."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def lint(folder: Path) -> subprocess.CompletedProcess[str]:
    command = "import sys; from importlinter.cli import lint_imports_command; lint_imports_command()"
    return subprocess.run(
        [sys.executable, "-c", command, "--no-cache", "--no-logo"], cwd=folder, capture_output=True, text=True
    )


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of the package that can be broken."""
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    shutil.copytree(ROOT / "canon", tmp_path / "canon", ignore=shutil.ignore_patterns("__pycache__", "*.toml"))
    return tmp_path


@pytest.mark.slow
def test_the_floors_are_kept(copy: Path) -> None:
    done = lint(copy)
    assert done.returncode == 0, done.stdout
    assert "0 broken" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("canon/verdict.py", "import canon.mechanics"),
        ("canon/mechanics/poisson.py", "import canon.decide.tape"),
        ("canon/decide/tape.py", "import canon.claims.run"),
        ("canon/claims/run.py", "import canon.report.record"),
        ("canon/report/record.py", "import canon.cli.main"),
        ("canon/claims/run.py", "import hypothesis"),
        ("canon/numeric/loops.py", "import canon.decide.tape"),
        ("canon/claims/audit.py", "import jax"),
        ("canon/checker/check.py", "import flint"),
    ],
)
def test_an_import_from_above_is_seen(copy: Path, module: str, line: str) -> None:
    with (copy / module).open("a") as file:
        file.write(f"\n{line}\n")
    done = lint(copy)
    assert done.returncode == 1
    assert "1 broken" in done.stdout
