"""What the command imports, counted by module, not by the clock: what is not imported costs nothing."""

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

HEAVY = {"sympy", "flint", "numpy", "jax", "scipy", "matplotlib", "rich", "hypothesis", "IPython", "mpmath"}

OSCILLATOR = (Path(__file__).parents[2] / "docs" / "performance" / "oscillator.toml").read_text(encoding="utf-8")


def loaded_by(statement: str) -> set[str]:
    """Return the top-level packages that a program has loaded after a statement."""
    program = f"import sys, json\n{statement}\nprint('\\n' + json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return {module.partition(".")[0] for module in json.loads(done.stdout.splitlines()[-1])}


def command(*arguments: str) -> str:
    return f"from canon.cli.main import main\ntry: main({list(arguments)!r})\nexcept SystemExit: pass"


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["verify", "--help"], ["verfy"], []])
def test_help_and_errors_import_nothing_heavy(arguments: Sequence[str]) -> None:
    loaded = loaded_by(command(*arguments))
    assert not loaded & (HEAVY | {"multiprocessing", "asyncio", "tomllib"})
    assert len(loaded) < 100


def test_import_canon_is_light() -> None:
    assert not loaded_by("import canon") & HEAVY


def test_one_claim_imports_only_what_decides_it(tmp_path: Path) -> None:
    file = tmp_path / "oscillator.toml"
    file.write_text(OSCILLATOR)
    for arguments in (["verify", str(file)], ["verify", "--json", str(file)]):
        assert loaded_by(command(*arguments)) & HEAVY <= {"sympy", "mpmath", "flint"}
