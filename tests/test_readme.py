"""The README does what it says: its claim file, its Python example, and its set-up commands."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
TIME = re.compile(r"\s+[\d.]+ m?s\b")


def blocks(language: str) -> list[str]:
    """The code blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", README, flags=re.MULTILINE | re.DOTALL)


def timeless(text: str) -> list[str]:
    """The lines of a text, without the times in it."""
    return [TIME.sub(" …", line).rstrip() for line in text.splitlines()]


def run(*command: str, cwd: Path) -> str:
    return subprocess.run(command, cwd=cwd, capture_output=True, encoding="utf-8", check=True).stdout


def test_the_claim_file_is_answered_as_shown(tmp_path: Path) -> None:
    claims, _ = blocks("toml")
    (tmp_path / "oscillator.toml").write_text(claims, encoding="utf-8")
    out = run(sys.executable, "-m", "canon", "verify", "oscillator.toml", cwd=tmp_path)
    assert timeless(out) == timeless(blocks("text")[0])


def test_the_python_example_prints_what_is_shown(tmp_path: Path) -> None:
    program = blocks("python")[0]
    assert timeless(run(sys.executable, "-c", program, cwd=tmp_path)) == timeless(blocks("text")[1])


def without_rounding(text: str) -> list[str]:
    """The lines of an audit; of all but what fails, without digits, which depend on the machine's rounding."""
    return [line if "fails" in line else re.sub(r"\d+(?:\.\d+)?(?:e-\d+)?", "N", line) for line in text.splitlines()]


def test_the_audit_passes_a_leapfrog_and_fails_a_mistaken_one(tmp_path: Path) -> None:
    program = blocks("python")[1]
    assert len([line for line in program.splitlines() if line]) == 8
    shown, out = blocks("text")[2], run(sys.executable, "-c", program, cwd=tmp_path)
    assert without_rounding(out) == without_rounding(shown)
    first, second = (line for line in out.splitlines() if "symplectic, dimension" in line)
    assert first.startswith("supported")
    assert second.startswith("undecided")
    assert "} is off by 0.005, bound 2." in out


def test_every_output_that_is_shown_is_checked() -> None:
    """Each block of output belongs to a block above it that a test here runs."""
    languages = re.findall(r"^```(\w+)\n", README, flags=re.MULTILINE)
    assert languages == ["sh", "sh", "toml", "text", "python", "text", "python", "text", "toml", "sh"]


def test_the_scene_runs_as_shown(tmp_path: Path) -> None:
    (tmp_path / "planet.toml").write_text(blocks("toml")[1], encoding="utf-8")
    command, *options = blocks("sh")[2].split()
    assert command == ".venv/bin/canon"
    shown = run(sys.executable, "-m", "canon", *options, cwd=tmp_path)
    assert "✓ energy" in shown
    assert "· lrl               broken by inverse_square" in shown
    assert (tmp_path / "planet.png").stat().st_size > 10_000
    assert (tmp_path / "planet.npz").is_file()


def test_there_are_two_set_up_commands() -> None:
    install, test = (block.strip() for block in blocks("sh")[:2])
    assert install == "python3 -m venv .venv && .venv/bin/pip install . && .venv/bin/canon verify"
    assert test.startswith("python3 -m venv .venv && .venv/bin/pip install -e '.[test,native]' && ")
    assert "pytest" in test


def test_ci_runs_the_readmes_test_command() -> None:
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    (pattern,) = re.findall(r"grep -E '(.*?)' README.md", script)
    found = [line for line in README.splitlines() if re.search(pattern, line)]
    assert found == [blocks("sh")[1].strip()]
