"""The documentation does what it says: every program and every `canon verify` in it is run, every public name is in it.

A page is read from top to bottom. A `toml` block whose first line is `# name.toml` is that file, a `python` block whose
first line is `# test_name.py` is a test file, whose tests are called; any other `python` block is run, all of a page in
one namespace. A `text` block after it is what it prints. In a `console` block, what follows `$ canon …` or `$ echo $?`
is what is printed. Times are left open, so are a witness's digits; a line `…` stands for any lines.
(README has a test of its own, `test_readme.py`; the notebooks in `docs/proofs` are executed when the site is built.)
"""

import contextlib
import importlib
import io
import re
import shlex
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import canon
import canon.testing
from canon.claims.keys import KEYS
from canon.claims.verify import verify
from canon.claims.worker import Entry, Record, Recorder, Settings
from canon.cli.main import main
from canon.cli.parser import Parser
from canon.domain import ConditionKind
from canon.errors import InputError
from canon.scenes.effects import EFFECTS
from canon.scenes.scene import MONITORS
from canon.scenes.settings import KEYS as KEYS_OF_RUN
from canon.vocabulary import CALLABLE

DOCS = Path(__file__).parents[1] / "docs"
FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = re.compile(r"^```(python|console)$", re.MULTILINE)
PAGES = sorted(page for page in DOCS.rglob("*.md") if RUN.search(page.read_text(encoding="utf-8")))
TOCTREE = re.compile(r"^```\{toctree\}\n((?::[^\n]*\n)*)\n(.*?)^```", re.MULTILINE | re.DOTALL)


class Block(NamedTuple):
    """A fenced block: what it says it is, and its text."""

    kind: str
    text: str


def blocks(page: Path) -> list[Block]:
    """The fenced blocks of a page, in order."""
    return [Block(kind.strip(), text) for kind, text in FENCE.findall(page.read_text(encoding="utf-8"))]


def masked(text: str) -> list[str]:
    """The lines of a text, without times and a witness's digits, spaces counted as one."""
    lines = []
    for line in text.splitlines():
        if "mixed hessian: -" in line:
            continue
        line = re.sub(r"\b[\d.]+ m?s\b", "T", line)
        line = re.sub(r"\bball at \d+ bits", "ball", line)
        line = re.sub(r'"seconds": [\d.]+', '"seconds": T', line)
        if re.search(r"(?:fails by|^ *at) ", line):
            line = re.sub(r"-?\d+(?:[./]\d+)?(?:e-?\d+)?", "N", line)
        if re.match(r"  (?:[✓·✗] |integrator|error|final)", line):
            line = re.sub(r"(?<!\w)-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", "N", line)
        lines.append(" ".join(line.split()))
    while lines and not lines[-1]:
        lines.pop()
    return lines


def agrees(shown: Sequence[str], printed: Sequence[str]) -> bool:
    """Whether what is shown was printed; `…` stands for any number of lines."""
    if not shown:
        return not printed
    if shown[0] == "…":
        return any(agrees(shown[1:], printed[k:]) for k in range(len(printed) + 1))
    return bool(printed) and shown[0] == printed[0] and agrees(shown[1:], printed[1:])


def check(shown: str, printed: str) -> None:
    """Fail with both texts unless they agree."""
    if not agrees(masked(shown), masked(printed)):
        pytest.fail(f"the page shows\n{shown}\nbut this is printed\n{printed}", pytrace=False)


def run_here(
    entries: Sequence[Entry], settings: Settings, recorder: Recorder, **options: object
) -> Iterator[tuple[int, Record]]:
    """What `canon.claims.run.run` does, without worker processes."""
    usual = settings.budget == Settings().budget
    for position, entry in enumerate(entries):
        assert entry.claim is not None
        try:  # with more time than a page's reader has, since this machine may be slow, or busy
            verdict = verify(
                entry.claim, budget=120.0 if usual else settings.budget, seed=settings.seed, method=settings.method
            )
        except InputError as error:
            where = error.where or f"claim {entry.index + 1}"
            yield position, {"error": {"file": entry.file, "where": where, "message": error.message}}
        else:
            yield position, {"claim": recorder(entry, entry.claim, verdict)}


def printed_by(action: Callable[[], Any]) -> tuple[str, Any]:
    """What an action prints, and what it returns or the status with which it exits."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            result = action()
        except SystemExit as ending:
            result = ending.code
    return out.getvalue(), result


def console(text: str) -> None:
    """Run the commands of a console block and compare what they print."""
    status: Any = None
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition("\n")
        words = shlex.split(command)
        if words == ["echo", "$?"]:
            check(shown, f"{status}\n")
        else:
            assert words[0] == "canon", f"only canon is run here, not {command}"
            printed, status = printed_by(lambda words=words: main(words[1:]))
            check(shown, printed)


LONG = {
    "reference/scenes.md",
    "how-to/simulate-tops-skates-and-strings.md",
    "how-to/compute-actions.md",
    "tutorial-scenes.md",
}
"""Pages that take seconds: others, and the README's scene, run the same commands."""


def marked(page: Path) -> Any:
    name = page.relative_to(DOCS).as_posix()
    return pytest.param(page, id=name, marks=[pytest.mark.slow] if name in LONG else [])


@pytest.mark.parametrize("page", [marked(page) for page in PAGES])
def test_a_page_is_true(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("canon.claims.run.run", run_here)
    names: dict[str, Any] = {"__name__": "page"}
    printed = ""
    for block in blocks(page):
        first = block.text.partition("\n")[0]
        named = re.fullmatch(r"# ([\w/.-]+\.(?:toml|py))", first)
        if named:
            file = Path(named[1])
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block.text, encoding="utf-8")
        if block.kind == "console":
            console(block.text)
        elif block.kind == "python" and named:
            tests: dict[str, Any] = {"__name__": "tests"}
            exec(compile(block.text, first, "exec"), tests)  # noqa: S102 - our own page
            for name, test in tests.items():
                if name.startswith("test_"):
                    test()
        elif block.kind == "python":
            code = compile(block.text, page.name, "exec")
            printed, _ = printed_by(lambda code=code: exec(code, names))  # noqa: S102 - our own page
        elif block.kind == "text" and printed:
            check(block.text, printed)
            printed = ""


def reference(name: str) -> str:
    return (DOCS / "reference" / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("module", ["canon", "canon.mechanics", "canon.testing"])
def test_every_public_name_is_in_the_reference(module: str) -> None:
    text = reference("python.md")
    missing = [name for name in importlib.import_module(module).__all__ if f"`{name}`" not in text]
    assert not missing


def test_every_public_method_is_in_the_reference() -> None:
    text = reference("python.md")
    missing = [
        f"{name}.{method}"
        for name in canon.__all__
        if isinstance(value := getattr(canon, name), type) and not issubclass(value, Exception)
        for method in vars(value)
        if not method.startswith("_") and f"`{method}`" not in text and f"`.{method}" not in text
    ]
    assert not missing


def test_every_kind_and_key_is_in_the_reference() -> None:
    text = reference("claim-files.md")
    assert not [word for word in KEYS if f"`{word}`" not in text]
    assert not [word for spec in KEYS.values() for word in spec.keys if f"`{word}`" not in text]


def test_every_built_in_function_is_in_the_reference() -> None:
    text = reference("expressions.md")
    assert not [word for word in CALLABLE if f"`{word}" not in text]
    assert not [word for word in ConditionKind.__args__ if f"`{word}`" not in text]


def test_every_option_is_in_the_reference() -> None:
    from canon.cli import actions, simulate
    from canon.cli import verify as command

    parser = Parser(prog="canon verify")
    command.declare(parser)
    text = reference("command-line.md")
    for module in (simulate, actions):
        module.declare(parser := Parser(prog="canon", parents=[parser], conflict_handler="resolve"))
    options = [option for action in parser._actions for option in action.option_strings]
    assert not [option for option in options if f"`{option}" not in text]


def test_every_effect_parameter_and_monitor_is_in_the_reference() -> None:
    text = reference("scenes.md")
    words = [*EFFECTS, *MONITORS, *KEYS_OF_RUN, *(word for e in EFFECTS.values() for word in e.parameters)]
    assert not [word for word in words if f"`{word}`" not in text]


def test_every_file_of_the_decider_says_what_it_rests_on() -> None:
    page = (DOCS / "explanation" / "decider-rules.md").read_text(encoding="utf-8")
    files = {path.stem for path in (Path(canon.__file__).parent / "decide").glob("[a-z]*.py")}
    assert files <= set(re.findall(r"`(\w+)`", page))


def test_links_lead_somewhere() -> None:
    for page in DOCS.rglob("*.md"):
        for target in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.relative_to(DOCS)} links to {target}"


def test_every_page_is_in_the_table_of_contents_of_one_other() -> None:
    listed: list[Path] = []
    for page in DOCS.rglob("*.md"):
        for options, entries in TOCTREE.findall(page.read_text(encoding="utf-8")):
            for entry in entries.split():
                pages = page.parent.glob(f"{entry}.md") if ":glob:" in options else [page.parent / f"{entry}.md"]
                listed += [found.resolve() for found in pages if found != page]
    pages = {page.resolve() for page in DOCS.rglob("*.md")} - {DOCS / "index.md"}
    assert not sorted(pages.symmetric_difference(listed)), "these aren't there, or not in the index.md of their folder"
    assert len(listed) == len(set(listed))


def test_every_public_name_has_its_docstring_on_the_site() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "reference" / "api").glob("*.md"))
    shown = re.findall(r"^\.\. (?:auto|py:)\w+:: (\w+)$", text, re.MULTILINE)
    names = {name for module in (canon, canon.testing) for name in module.__all__ if not name.startswith("_")}
    assert not names.symmetric_difference(shown), "these aren't there, or not in docs/reference/api"
    assert len(shown) == len(names)
