"""Mutation testing: do the tests notice it?

    python -m properties.mutation canon/mechanics/poisson.py --tests tests/mechanics

A mutant is the module with one change of its text: a comparison (< and <=, == and !=, is and is not, in and not in), an
operation (+ and -, * and /), a whole number by one, `and` and `or`, a `not` left out, True and False, a returned value
replaced by None. Each is imported in a process of its own, which runs those of the tests that call into the module, the
quickest first; a mutant that they pass is a survivor.
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
import multiprocessing
import os
import random
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import redirect_stderr, redirect_stdout
from itertools import accumulate
from pathlib import Path
from typing import Any, Final

SWAPPED: Final[dict[type, type]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip


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


class _Calls:
    """A plugin of pytest that finds out which tests call into which of some modules, and how long each takes."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = {str(path.resolve()): path for path in paths}
        self.called = set[str]()
        self.seconds: dict[Path, dict[str, float]] = {path: {} for path in paths}

    def _profile(self, frame: Any, event: str, _: Any) -> None:
        if event == "call" and frame.f_code.co_filename in self.paths:
            self.called.add(frame.f_code.co_filename)

    def pytest_runtest_protocol(self, item: Any, nextitem: Any) -> None:
        """Before a test."""
        self.called.clear()
        self.start = time.process_time()
        sys.setprofile(self._profile)

    def pytest_runtest_logfinish(self, nodeid: str, location: Any) -> None:
        """After it."""
        sys.setprofile(None)
        for name in self.called:
            self.seconds[self.paths[name]][nodeid] = time.process_time() - self.start


class _Only:
    """A plugin of pytest that runs some tests, in an order."""

    def __init__(self, chosen: list[str]) -> None:
        self.order = {nodeid: k for k, nodeid in enumerate(chosen)}

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        """What is left of all of them."""
        items[:] = sorted((i for i in items if i.nodeid in self.order), key=lambda i: self.order[i.nodeid])


def _tests(plugin: Any, tests: list[str], *options: str) -> int:
    import pytest

    always = [
        "-q",
        "-n",
        "0",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:randomly",
        "-W",
        "ignore::pytest.PytestAssertRewriteWarning",
    ]
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        return int(pytest.main([*always, *options, *tests], plugins=[plugin]))


def relevant(paths: list[Path], tests: list[str], most: float) -> dict[Path, list[str]]:
    """The tests that call into each module, the quickest first, as many as fit into so many seconds of a processor."""
    mine, its = multiprocessing.Pipe(duplex=False)
    child = os.fork()
    if child == 0:
        calls = _Calls(paths)
        status = _tests(calls, tests)
        its.send((status, calls.seconds))
        os._exit(0)
    its.close()
    status, found = mine.recv()
    os.waitpid(child, 0)
    if status:
        sys.exit("the tests fail on the modules as they are")
    chosen: dict[Path, list[str]] = {}
    for path, seconds in found.items():
        order = sorted(seconds, key=lambda n: seconds[n])
        spent = list(accumulate(seconds[n] for n in order))
        chosen[path] = order[: sum(total <= most for total in spent)]
    return chosen


def killed(name: str, path: Path, tree: ast.Module, tests: list[str], chosen: list[str], limit: float) -> bool:
    """Whether the tests notice the mutant, or don't end in so many seconds of a processor."""
    child = os.fork()
    if child == 0:
        signal.setitimer(signal.ITIMER_PROF, limit)  # ends the process: nobody handles it
        sys.meta_path.insert(0, _Instead(name, path, tree))
        status = 1
        try:
            importlib.import_module(name)  # before pytest's own importer, which would read the file
            status = _tests(_Only(chosen), tests, "-x")
        finally:
            os._exit(status)
    return os.waitpid(child, 0)[1] != 0


def figures(
    path: Path, chosen: list[str], most: int, seed: int, jobs: int, limit: float, until: float
) -> dict[str, Any]:
    """What became of some mutants of a module, chosen at random."""
    text, name = path.read_text(encoding="utf-8"), ".".join(path.with_suffix("").parts)
    files = sorted({nodeid.partition("::")[0] for nodeid in chosen})
    count = 0
    while mutant(text, count)[1]:
        count += 1
    if not chosen or killed(name, path, ast.parse(text), files, chosen, limit):
        return {"module": name, "places": count, "tests": len(chosen), "tried": 0, "why": "no tests that pass"}
    numbers = random.Random(seed).sample(range(count), min(count, most))

    def tried(number: int) -> str | None:
        if time.monotonic() > until:
            return None
        tree, said = mutant(text, number)
        if killed(name, path, tree, files, chosen, limit):
            return ""
        print(f"survives: {path.name}, {said}", file=sys.stderr, flush=True)
        return said

    with ThreadPoolExecutor(jobs) as pool:
        found = [said for said in pool.map(tried, numbers) if said is not None]
    survivors = sorted(filter(None, found))
    kept = {"tests": len(chosen), "places": count, "tried": len(found), "killed": len(found) - len(survivors)}
    return {"module": name, **kept, "survivors": survivors}


def main() -> int:
    """Try mutants of modules, and list those that the tests don't notice: one JSON object a line for each module."""
    parser = argparse.ArgumentParser(prog="python -m properties.mutation", description=__doc__)
    parser.add_argument("modules", type=Path, nargs="+")
    parser.add_argument("--tests", nargs="+", required=True)
    parser.add_argument("--most", type=int, default=40, help="mutants of each module, chosen at random")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0, help="after which no mutant is begun")
    parser.add_argument("--seconds", type=float, default=10.0, help="of a processor, for the tests of a mutant")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    import flint  # noqa: F401  loaded once, for all mutants
    import mpmath  # noqa: F401
    import numpy  # noqa: F401
    import pytest  # noqa: F401
    import sympy  # noqa: F401

    until = time.monotonic() + 60 * options.minutes
    chosen = relevant(options.modules, options.tests, options.seconds)
    for path in options.modules:
        limit = 20 + 5 * options.seconds
        found = figures(path, chosen[path], options.most, options.seed, options.jobs, limit, until)
        print(json.dumps(found), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
