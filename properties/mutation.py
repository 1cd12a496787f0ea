"""Mutation testing: do the tests notice a change of the code?

    python -m properties.mutation canon/decide/tower.py --tests tests/decide --seed 7 --most 20

The changes are those of `properties.mutants`, as many of each module as asked for, drawn by chance. The tests are
collected once, in a process that runs none of them; each mutant is a copy of that process (a fork), in which the
functions of the module are given their changed code. It runs those of the tests that reach the changed statement, the
ones that noticed a mutant of this module first, then the quickest. A mutant that they pass is a survivor; one whose
test doesn't end in three times its own time and two seconds of a processor counts as noticed, by the clock. Which test
reaches which statement is found once, and kept in the file given by `--reached`.
"""

from __future__ import annotations

import argparse
import ast
import functools
import gc
import hashlib
import importlib
import io
import json
import os
import random
import resource
import signal
import sys
import tempfile
import time
import types
from contextlib import redirect_stderr, redirect_stdout, suppress
from pathlib import Path
from typing import Any

from properties.mutants import Mutant, marked, mutants, mutated

SPARE_MEMORY = 3 * 2**30
LIBRARIES = ("canon", "sympy", "mpmath", "flint", "numpy")
"""What tests import on their way: loaded once, before the mutants."""


class Module:
    """A module under test: its text, its functions as they are in memory."""

    def __init__(self, path: Path) -> None:
        self.path, self.name = path, ".".join(path.with_suffix("").parts)
        self.text = path.read_text(encoding="utf-8")
        self.module = importlib.import_module(self.name)
        self.own = _codes(compile(self.text, str(path), "exec", dont_inherit=True))
        where = str(path.resolve())
        functions = [f for f in gc.get_objects() if isinstance(f, types.FunctionType)]
        self.functions = [(f, f.__code__) for f in functions if f.__code__.co_filename == where]

    def becomes(self, tree: ast.Module) -> None:
        """Give the functions the code of another text of the module."""
        other = _codes(compile(tree, str(self.path.resolve()), "exec", dont_inherit=True))
        same = {code: other[key] for key, code in self.own.items() if key in other}
        for function, code in self.functions:
            function.__code__ = same.get(code, code)

    def assigns(self, tree: ast.Module, line: int) -> None:
        """Carry out the statement of this line outside of functions, and put its values wherever the old ones are."""
        statement = next(s for s in tree.body if s.lineno == line)
        before = dict(vars(self.module))
        exec(compile(ast.Module([statement], []), str(self.path), "exec", dont_inherit=True), vars(self.module))  # noqa: S102 - our own text
        changed = {k: v for k, v in vars(self.module).items() if k in before and before[k] is not v}
        for holder in list(sys.modules.values()):
            for name, value in changed.items():
                if vars(holder).get(name) is before[name]:
                    setattr(holder, name, value)


def _codes(code: types.CodeType) -> dict[tuple[str, int, int], types.CodeType]:
    """The code of each function in a module's, by its name, line, and place among those of the same name and line."""
    found: dict[tuple[str, int, int], types.CodeType] = {}

    def walk(outer: types.CodeType) -> None:
        for inner in outer.co_consts:
            if isinstance(inner, types.CodeType):
                place = 0
                while (inner.co_qualname, inner.co_firstlineno, place) in found:
                    place += 1
                found[inner.co_qualname, inner.co_firstlineno, place] = inner
                walk(inner)

    walk(code)
    return found


class Campaign:
    """A plugin of pytest: it runs none of the tests that were collected, but tries mutants on copies of the process."""

    def __init__(self, options: argparse.Namespace, out: Any) -> None:
        self.options, self.out = options, out
        self.until = time.monotonic() + 60 * options.minutes

    def pytest_runtestloop(self, session: Any) -> bool:
        """With all tests at hand."""
        self.session, self.items = session, {item.nodeid: item for item in session.items}
        self.modules = [Module(path) for path in self.options.modules]
        self.passing = set[str]()
        earlier = self.options.again.read_text().splitlines() if self.options.again else ()
        self.again = {found["module"]: set(found["survivors"]) for found in map(json.loads, earlier)}
        self.reached = self._reached()
        gc.collect()
        gc.freeze()
        for module in self.modules:
            print(json.dumps(self._figures(module)), file=self.out, flush=True)
        return True

    def _reached(self) -> dict[str, Any]:
        """What each test reaches, and how long it takes: of those that pass."""
        kept = self.options.reached
        digest = {m.name: hashlib.sha256(m.text.encode()).hexdigest() for m in self.modules}
        known: dict[str, Any] = json.loads(kept.read_text()) if kept and kept.exists() else {}
        if any(known.get("digest", {}).get(name) != value for name, value in digest.items()):
            known = {"digest": digest, "tests": {}, "imported": []}
        fresh = [item for name, item in self.items.items() if name not in known["tests"]]
        with tempfile.TemporaryDirectory() as folder:
            answer = Path(folder) / "reached.json"
            child = os.fork()
            if child == 0:
                self._measure(fresh, answer)
            os.waitpid(child, 0)
            found = json.loads(answer.read_text())
        known["tests"] |= found["tests"]
        known["imported"] = sorted({*known["imported"], *found["imported"]})
        if kept:
            kept.write_text(json.dumps(known))
        for name in known["imported"]:
            with suppress(Exception), redirect_stdout(io.StringIO()):
                importlib.import_module(name)
        return known["tests"]

    def _measure(self, items: list[Any], answer: Path) -> None:
        """Run tests on modules that say what is reached; ends this process."""
        _quiet()
        before, lines = set(sys.modules), set[str]()
        for module in self.modules:
            vars(module.module)["__reached__"] = lambda line, name=module.name: lines.add(f"{name}:{line}")
            module.becomes(marked(module.text))
        cached = [
            f for f in gc.get_objects() if isinstance(f, functools._lru_cache_wrapper) and "canon" in f.__module__
        ]
        found: dict[str, Any] = {}
        for item in items:
            for function in cached:
                function.cache_clear()
            lines.clear()
            start, failed = time.process_time(), self.session.testsfailed
            self._run(item, None)
            if self.session.testsfailed == failed:
                found[item.nodeid] = {"seconds": time.process_time() - start, "lines": sorted(lines)}
            else:
                found[item.nodeid] = {"seconds": 0.0, "lines": [], "fails": True}
        new = [
            n for n in set(sys.modules) - before if n.split(".")[0] in ("canon", "sympy", "mpmath", "flint", "numpy")
        ]
        answer.write_text(json.dumps({"tests": found, "imported": new}))
        os._exit(0)

    def _run(self, item: Any, following: Any) -> None:
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)

    def _figures(self, module: Module) -> dict[str, Any]:
        places = mutants(module.text)
        numbers = random.Random(self.options.seed).sample(range(len(places)), min(len(places), self.options.most))
        noticing: dict[str, int] = {}
        survivors, tried, late = list[str](), 0, 0
        if module.name in self.again:
            numbers = [k for k, place in enumerate(places) if place.said in self.again[module.name]]
        for number in sorted(numbers):
            if time.monotonic() > self.until:
                break
            place = places[number]
            chosen = self._chosen(module, place, noticing)
            by = self._noticed_by(module, number, place, chosen)
            while by in self.items and not self._passes(module, by):
                chosen.remove(by)
                by = self._noticed_by(module, number, place, chosen)
            tried += 1
            late += by == "the clock"
            if by is None:
                survivors.append(place.said)
                print(
                    f"survives {len(chosen)} tests: {module.path.name}, {place.said}", file=sys.__stderr__, flush=True
                )
            elif by in self.items:
                noticing[by] = noticing.get(by, 0) + 1
        counts = {"places": len(places), "tried": tried, "noticed": tried - len(survivors), "by the clock": late}
        return {"module": module.name, **counts, "survivors": survivors}

    def _chosen(self, module: Module, place: Mutant, noticing: dict[str, int]) -> list[str]:
        """The tests of a mutant, as many as take so many seconds together."""
        where = f"{module.name}:" if place.outside else f"{module.name}:{place.line}"
        hit = str.startswith if place.outside else str.__eq__
        asked = [n for n in self.items if n in self.reached]
        found = [n for n in asked if any(hit(line, where) for line in self.reached[n]["lines"])]
        order = sorted(found, key=lambda n: (-noticing.get(n, 0), self.reached[n]["seconds"]))
        chosen, spent = list[str](), 0.0
        for name in order:
            spent += self.reached[name]["seconds"]
            if chosen and spent > self.options.seconds:
                break
            chosen.append(name)
        return chosen

    def _passes(self, module: Module, name: str) -> bool:
        """Whether a test by itself passes on the modules as they are; where not, it is no longer asked."""
        if name not in self.passing and self._noticed_by(module, None, None, [name]):
            del self.reached[name]
            return False
        self.passing.add(name)
        return True

    def _noticed_by(self, module: Module, number: int | None, place: Mutant | None, chosen: list[str]) -> str | None:
        """The test that notices a mutant, or "the clock"."""
        if not chosen:
            return None
        theirs, ours = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(theirs)
            try:
                self._try(module, number, place, chosen, ours)
            finally:
                os._exit(70)  # not a mutant that could be made
        os.close(ours)
        with os.fdopen(theirs) as stream:
            said = stream.read()
        status = os.waitpid(child, 0)[1]
        if os.WIFSIGNALED(status):
            return "the clock"
        if os.WEXITSTATUS(status) == 70:
            sys.exit(f"could not be made: {module.name}, {place}")
        return said or None

    def _try(self, module: Module, number: int | None, place: Mutant | None, chosen: list[str], ours: int) -> None:
        """Run tests on a mutant (or on the module as it is), until one fails; ends this process."""
        _quiet()
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + SPARE_MEMORY,) * 2)
        if number is not None and place is not None:
            tree = mutated(module.text, number)
            if place.outside:
                try:
                    module.assigns(tree, place.line)
                except Exception:
                    os.write(ours, b"the import")
                    os._exit(0)
            else:
                module.becomes(tree)
        for name, following in zip(chosen, [*chosen[1:], None], strict=True):
            # ends the process: nobody hears the signal
            signal.setitimer(signal.ITIMER_PROF, 2 + 3 * self.reached[name]["seconds"])
            self._run(self.items[name], self.items.get(following) if following else None)
            if self.session.testsfailed:
                os.write(ours, name.encode())
                break
        os._exit(0)


def _quiet() -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nothing, number)


def main() -> int:
    """Try mutants of modules, and list those that the tests don't notice: one JSON object a line for each module."""
    parser = argparse.ArgumentParser(prog="python -m properties.mutation", description=__doc__)
    parser.add_argument("modules", type=Path, nargs="+")
    parser.add_argument("--tests", nargs="+", required=True)
    parser.add_argument("--most", type=int, default=40, help="mutants of each module, chosen at random")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0, help="after which no mutant is begun")
    parser.add_argument("--seconds", type=float, default=10.0, help="of a processor, for the tests of a mutant")
    parser.add_argument("--reached", type=Path, help="a file that keeps which test reaches which statement")
    parser.add_argument("--again", type=Path, help="what an earlier campaign printed: only its survivors are tried")
    options = parser.parse_args()
    os.environ.setdefault("CANON_PROFILE", "ci")  # examples are the same each time

    import pytest
    from hypothesis import Phase, settings

    import properties.profiles  # noqa: F401  the profile that the next one is made from

    # an example that fails isn't made small
    settings.register_profile("mutation", settings(), phases=(Phase.explicit, Phase.generate))
    settings.load_profile("mutation")
    always = ["-q", "-n", "0", "-s", "--tb=no", "--assert=plain", "-W", "ignore::pytest.PytestAssertRewriteWarning"]
    plugins = ["-p", "no:cacheprovider", "-p", "no:randomly"]
    out = sys.stdout
    with redirect_stdout(io.StringIO()) as said, redirect_stderr(said):
        status = pytest.main([*always, *plugins, *options.tests], plugins=[Campaign(options, out)])
    if status not in (0, 5):
        print(said.getvalue(), file=sys.stderr)
    return int(status)


if __name__ == "__main__":
    sys.exit(main())
