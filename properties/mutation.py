"""Mutation testing: do the tests notice it? `python -m properties.mutation canon/mechanics/poisson.py tests/mechanics`.

A mutant is the module with one change of its text: a comparison (< and <=, == and !=, is and is not, in and not in), an
operation (+ and -, * and /), a whole number by one, `and` and `or`, a `not` left out, True and False, a returned value
replaced by None. Each is imported in a process of its own, which runs the tests; a mutant that they pass is a survivor.
"""

from __future__ import annotations

import argparse
import ast
import copy
import importlib
import importlib.abc
import importlib.machinery
import io
import json
import os
import random
import signal
import sys
import time
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any, Final

SWAPPED: Final[dict[type, type]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
SECONDS: Final = 60
"""After which a mutant is taken for killed: it does not end."""


def changes(node: ast.AST) -> list[ast.AST]:
    """The nodes that may stand in a node's place."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in SWAPPED:
        return [_with(node, ops=[SWAPPED[type(node.ops[0])]()])]
    if isinstance(node, (ast.BinOp, ast.BoolOp)) and type(node.op) in SWAPPED:
        return [_with(node, op=SWAPPED[type(node.op)]())]
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        return [_with(node, value=not node.value)]
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return [_with(node, value=node.value + 1)]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.Not, ast.USub)):
        return [node.operand]
    if isinstance(node, ast.Return) and node.value is not None and not isinstance(node.value, ast.Constant):
        return [_with(node, value=ast.Constant(None))]
    return []


def _with(node: Any, **parts: Any) -> ast.AST:
    other = copy.copy(node)
    for name, part in parts.items():
        setattr(other, name, part)
    return ast.copy_location(other, node)


class _At(ast.NodeTransformer):
    """Puts a change into the place of the node that comes `number`-th."""

    def __init__(self, number: int) -> None:
        self.number, self.seen, self.said = number, -1, ""

    def visit(self, node: ast.AST) -> Any:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            node.decorator_list, kept = [], node.decorator_list
            self.generic_visit(node)
            node.decorator_list = kept
            return node
        if isinstance(node, ast.AnnAssign):
            node.value = self.visit(node.value) if node.value else None
            return node
        for change in changes(node):
            self.seen += 1
            if self.seen == self.number:
                self.said = f"line {node.lineno}: {ast.unparse(node)[:70]} -> {ast.unparse(change)[:70]}"  # type: ignore[attr-defined]
                return change
        return self.generic_visit(node)


def mutant(text: str, number: int) -> tuple[ast.Module, str]:
    """The module with its change of this number, and what it is; the words are empty where there is none."""
    at = _At(number)
    tree = ast.fix_missing_locations(at.visit(ast.parse(text)))
    return tree, at.said


class _Instead(importlib.abc.MetaPathFinder, importlib.abc.InspectLoader):
    """Imports one module from a tree."""

    def __init__(self, name: str, path: Path, tree: ast.Module) -> None:
        self.name, self.path, self.tree = name, path, tree

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> Any:
        if fullname != self.name:
            return None
        return importlib.machinery.ModuleSpec(fullname, self, origin=str(self.path))

    def get_source(self, fullname: str) -> str:
        return self.path.read_text(encoding="utf-8")

    def get_code(self, fullname: str) -> Any:
        return compile(self.tree, str(self.path), "exec")

    def exec_module(self, module: Any) -> None:
        exec(self.get_code(self.name), module.__dict__)  # noqa: S102 - our own module, changed on purpose


def killed(name: str, path: Path, tree: ast.Module, tests: list[str]) -> bool:
    """Whether the tests notice the mutant."""
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        sys.meta_path.insert(0, _Instead(name, path, tree))
        status = 1
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            try:
                importlib.import_module(name)  # before pytest's own importer, which would read the file
                import pytest

                status = int(
                    pytest.main(
                        [
                            "-x",
                            "-q",
                            "-n",
                            "0",
                            "-p",
                            "no:cacheprovider",
                            "-W",
                            "ignore::pytest.PytestAssertRewriteWarning",
                            *tests,
                        ]
                    )
                )
            finally:
                os._exit(status)
    return os.waitpid(child, 0)[1] != 0


def main() -> int:
    """Try mutants of a module, and list those that its tests don't notice."""
    parser = argparse.ArgumentParser(prog="python -m properties.mutation", description=__doc__)
    parser.add_argument("module", type=Path)
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--most", type=int, default=40, help="mutants, chosen at random")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0)
    options = parser.parse_args()
    import mpmath  # noqa: F401  loaded once, for all mutants
    import numpy  # noqa: F401
    import pytest  # noqa: F401
    import sympy  # noqa: F401

    text, name = options.module.read_text(encoding="utf-8"), ".".join(options.module.with_suffix("").parts)
    if killed(name, options.module, ast.parse(text), options.tests):
        sys.exit("the tests fail on the module as it is")
    count = 0
    while mutant(text, count)[1]:
        count += 1
    chosen = sorted(random.Random(options.seed).sample(range(count), min(count, options.most)))
    until, tried, survivors = time.monotonic() + 60 * options.minutes, 0, []
    for number in chosen:
        if time.monotonic() > until:
            break
        tree, said = mutant(text, number)
        tried += 1
        if not killed(name, options.module, tree, options.tests):
            survivors.append(said)
            print(f"survives: {said}", file=sys.stderr, flush=True)
    figures = {
        "module": name,
        "places": count,
        "tried": tried,
        "killed": tried - len(survivors),
        "survivors": survivors,
    }
    print(json.dumps(figures, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
