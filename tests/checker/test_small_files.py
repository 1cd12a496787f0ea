"""Each file of the small checkers is less than 300 lines of code, of Python's standard library and of each other."""

import ast
import sys
from pathlib import Path

import pytest

from canon.checker import alone_together

FOLDER = Path(alone_together.__file__).parent
PATTERNS = ("alone*.py", "counterexample*.py", "refutations.py", "lie_invariants.py")
FILES = tuple(sorted(file for pattern in PATTERNS for file in FOLDER.glob(pattern)))
NAMES = {file.stem for file in FILES}


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_it_has_less_than_300_lines_of_code(file: Path) -> None:
    """Lines but for empty ones, comments and docstrings, none longer than the house's."""
    text = file.read_text(encoding="utf-8")
    docs = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Expr)]
    said = {line for node in docs for line in range(node.lineno, (node.end_lineno or 0) + 1)
            if isinstance(node.value, ast.Constant)}  # fmt: skip
    lines = [line for number, line in enumerate(text.splitlines(), 1) if number not in said]
    assert len([line for line in lines if line.strip() and not line.strip().startswith("#")]) < 300
    assert max(map(len, lines)) <= 120


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_it_needs_nothing_but_python_and_files_beside_it(file: Path) -> None:
    """As a part of canon it names these files by canon's name, as a program by their own."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "canon.checker":
            assert {alias.name for alias in node.names} <= NAMES
        elif isinstance(node, ast.ImportFrom):
            assert (node.module or "").removeprefix("canon.checker.").partition(".")[
                0
            ] in NAMES | sys.stdlib_module_names
        elif isinstance(node, ast.Import):
            assert {alias.name.partition(".")[0] for alias in node.names} <= NAMES | sys.stdlib_module_names


def test_they_are_those_that_are_there() -> None:
    assert {"alone", "alone_lie", "alone_table", "counterexample", "refutations"} < NAMES
    assert len(NAMES) == len(FILES)


def test_what_is_asked_besides_is_there() -> None:
    """And every small file of proofs is asked, or used by one that is."""
    asked = {f"alone_{name}" for names in alone_together.BESIDES.values() for name in names.split()}
    assert asked <= NAMES
    used = {"alone", "alone_together", "alone_wider", "alone_complex", *asked}
    texts = {file.stem: file.read_text(encoding="utf-8") for file in FILES}
    while more := {name for name in NAMES - used if any(name in texts[other] for other in used)}:
        used |= more
    assert {name for name in NAMES if name.startswith("alone")} <= used
