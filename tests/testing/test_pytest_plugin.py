"""Claim files are collected by pytest where a project opts in, and nothing is imported where it doesn't."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
KICK = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]

[transformation]
Q = ["q"]
P = ["p - sin(q){mistake}"]

[[claim]]
kind = "canonical"

[[claim]]
kind = "canonical"
title = "not with this valence"
scale = "2"
expect = "fails"

[[claim]]
kind = "bracket"
f = "q*pp"
g = "p"
equals = "p"
"""
OPTED_IN = '[tool.pytest.ini_options]\ncanon_claims = ["claims/*.toml"]\n'


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-p", "canon.testing.pytest_plugin", "-p", "no:cacheprovider"]
    alone = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONPATH": str(ROOT)}
    return subprocess.run([*command, *arguments], cwd=folder, capture_output=True, text=True, env=alone)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "claims").mkdir()
    (tmp_path / "claims" / "kick.toml").write_text(KICK.format(mistake=""))
    (tmp_path / "claims" / "swap.toml").write_text(KICK.format(mistake=" - p/2"))
    (tmp_path / "pyproject.toml").write_text(OPTED_IN)
    (tmp_path / "test_other.py").write_text("def test_other(): pass\n")
    return tmp_path


def test_claims_are_tests(project: Path) -> None:
    done = run(project, "-v", "claims/kick.toml", "claims/swap.toml")
    assert "claims/kick.toml::1 canonical PASSED" in done.stdout
    assert "claims/kick.toml::2 not with this valence PASSED" in done.stdout
    assert "claims/kick.toml::input: claim 3, key 'f' FAILED" in done.stdout
    assert "unknown name 'pp' at column 3: did you mean 'p'?" in done.stdout
    assert "claims/swap.toml::1 canonical FAILED" in done.stdout
    assert "claim 1 was expected to hold" in done.stdout
    assert "refuted: canonical" in done.stdout
    assert "scale: 1/2" in done.stdout
    assert "Traceback" not in done.stdout
    assert "3 failed, 3 passed" in done.stdout


def test_patterns_choose_among_the_files_of_a_folder(project: Path) -> None:
    done = run(project, "--collect-only", "-q")
    assert "claims/kick.toml::1 canonical" in done.stdout
    assert "pyproject.toml" not in done.stdout
    assert "test_other.py::test_other" in done.stdout


def test_one_claim_can_be_named(project: Path) -> None:
    done = run(project, "-q", "claims/kick.toml::1 canonical")
    assert "1 passed" in done.stdout


def test_a_budget_that_is_none_is_refused(project: Path) -> None:
    (project / "pyproject.toml").write_text(OPTED_IN + 'canon_budget = "soon"\n')
    done = run(project, "-q", "claims/kick.toml::1 canonical")
    assert "canon_budget is a number of seconds greater than 0, not 'soon'" in done.stdout + done.stderr


def test_off_until_a_project_opts_in(project: Path) -> None:
    (project / "pyproject.toml").write_text("[tool.pytest.ini_options]\n")
    (project / "test_other.py").write_text(
        "import sys, json\ndef test_other(): print('loaded', json.dumps(sorted(sys.modules)))\n"
    )
    done = run(project, "-q", "-s")
    (line,) = (line for line in done.stdout.splitlines() if "loaded" in line)
    loaded = set(json.loads(line[line.index("[") : line.index("]") + 1]))
    assert "canon.testing.pytest_plugin" in loaded
    assert not loaded & {"sympy", "numpy", "jax", "flint", "hypothesis", "canon.claims"}
    assert "1 passed" in done.stdout


def test_a_title_is_no_line_of_the_report(project: Path) -> None:
    """Nor does it colour the terminal; and what is no file, or waits, is not read."""
    title = 'title = "a\\u001b[31m\\nfake.toml::1 PASSED\\u0000::' + "x" * 300 + '"'
    odd = KICK.format(mistake="").replace("[[claim]]", f"[[claim]]\n{title}", 1)
    (project / "claims" / "odd.toml").write_text(odd)
    (project / "claims" / "waits.toml").symlink_to("/proc/kmsg")  # where there is none, a link to nothing
    shown = run(project, "-v", "claims/odd.toml", *["claims/waits.toml"] * Path("/proc/kmsg").exists()).stdout
    assert "claims/odd.toml::1 a\N{REPLACEMENT CHARACTER}[31m fake.toml:1 PASSED\N{REPLACEMENT CHARACTER}:xxx" in shown
    assert not any(line.startswith("fake") for line in shown.splitlines())
    assert not {"\x1b", "\0"} & {*shown}
