"""What `properties.broken` takes out is there: a line that reads otherwise by now would be tried no more."""

from __future__ import annotations

from pathlib import Path

import pytest

import canon
from properties.broken import BREAKS, Break

PACKAGE = Path(canon.__file__).parent
TESTS = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize("taken", BREAKS, ids=lambda taken: f"{taken.fault}: {taken.how}")
def test_what_is_taken_out_is_there(taken: Break) -> None:
    assert taken.old in (PACKAGE / taken.file).read_text(encoding="utf-8")
    file, _, name = taken.test.partition("::")
    assert f"def {name.partition('[')[0]}(" in (TESTS / file).read_text(encoding="utf-8")
