"""The mutants are those that are described, and functions that are in memory become them."""

import sys
from pathlib import Path

from properties.mutants import marked, mutants, mutated
from properties.mutation import Module

TEXT = """
MOST = 400
TABLE = {"a": 1}

def area(width, height=2, *, scale: int = 3):
    if width < 0 or height > MOST:
        raise ValueError("negative" + str(1))
    return round(width * height, 1)

def first(items):
    return [x for x in items if x.ready]

TWICE = {"twice": lambda x: x + x}
"""


def test_what_is_changed_and_what_is_left_alone() -> None:
    said = [place.said for place in mutants(TEXT)]
    assert said == [
        "line 3: 1 -> 2",
        "line 6: width < 0 or height > MOST -> width < 0 and height > MOST",
        "line 6: width < 0 -> width <= 0",
        "line 6: 0 -> 1",
        "line 8: return round(width * height, 1) -> return None",
        "line 8: width * height -> width / height",
        "line 8: 1 -> 2",
        "line 11: return [x for x in items if x.ready] -> return None",
        "line 11: for x in items if x.ready -> for x in items if not x.ready",
        "line 13: x + x -> x - x",
    ]
    assert [place.outside for place in mutants(TEXT)] == [True, *[False] * 8, True]


def test_functions_in_memory_become_a_mutant(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "measured.py").write_text(TEXT)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    module = Module(Path("measured.py"))
    area, table, twice = module.module.area, module.module.TABLE, module.module.TWICE["twice"]
    by_words = {place.said: number for number, place in enumerate(mutants(TEXT))}
    module.becomes(mutated(TEXT, by_words["line 8: width * height -> width / height"]))
    assert area(6, 2) == 3
    module.becomes(mutated(TEXT, by_words["line 13: x + x -> x - x"]))
    assert twice(5) == 0
    module.assigns(mutated(TEXT, by_words["line 3: 1 -> 2"]), 3)
    assert module.module.TABLE == {"a": 2} != table
    reached: list[int] = []
    module.module.__reached__ = reached.append
    module.becomes(marked(TEXT))
    assert area(6, 2) == 12
    assert reached == [6, 8]
    del sys.modules["measured"]
