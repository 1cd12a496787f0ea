"""What is printed moves no terminal's cursor, wherever it comes from; no file that is read is written over."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from canon.cli.main import main
from canon.cli.spoken import notation
from tests.hostile.test_faults import CLAIMS
from tests.short_scenes import PENDULUM

COLOUR = "\x1b]0;a\x07\x1b[31m\u202e\x9b31m"
MOVING = {"\x1b", "\x07", "\u202e", "\x9b"}


@pytest.mark.parametrize(
    "words",
    [
        ["verify", "claims.toml", "--resume", "{}"],
        ["verify", "claims.toml", "--proof", "{}.md/x.md"],
        ["verify", "claims.toml", "--certificate", "claims.toml/{}"],
        ["verify", "claims.toml", "--nonsense", "{}"],
        ["verify", "{}", "--json"],
        ["{}"],
        ["scenes", "{}"],
        ["hard", "{}"],
        ["simulate", "{}"],
        ["simulate", "{}", "--json"],
        ["actions", "{}.toml", "--json"],
        ["algebra", "{}", "--json"],
        ["algebra", "{}"],
        ["certificate", "check", "{}", "--json"],
        ["certificate", "export", "{}", "--coq", "x.v"],
        ["cost", "verify", "{}", "--json"],
    ],
)
def test_names_move_no_cursor(words: list[str], tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("claims.toml").write_text(CLAIMS, encoding="utf-8")
    Path(COLOUR).mkdir()
    try:
        status = main([word.replace("{}", COLOUR) for word in words])
    except SystemExit as done:
        status = done.code
    out, err = capsys.readouterr()
    assert status == 3
    assert not MOVING & {*out, *err}
    if "--json" in words:
        assert "errors" in json.loads(out) or "certificates" in json.loads(out)


def test_json_says_all_of_it_in_any_alphabet(monkeypatch: pytest.MonkeyPatch) -> None:
    record = {"ϑ": COLOUR + "é\u2028", "value": [1.5, None]}
    for encoding in ("utf-8", "ascii", "latin-1"):
        monkeypatch.setattr(sys, "stdout", SimpleNamespace(encoding=encoding))
        text = notation(record)
        assert json.loads(text) == record
        assert not MOVING & {*text}
        assert text.encode(encoding)
    with pytest.raises(ValueError, match="not JSON compliant"):
        notation([float("nan")])


SAME = {
    "simulate": ["scene.png", "--out", "./scene.png"],
    "simulate the figure": ["scene.png", "--plot", "link.png"],
    "simulate both": ["scene.png", "--plot", "new.png", "--out", "new.png"],
    "simulate gone on with": ["scene.png", "--plot", "kept.png", "--resume", "kept.png"],
    "actions": ["scene.png", "--plot", "scene.png"],
    "cost loop": ["scene.png", "--csv", "scene.png"],
    "certificate export": ["scene.png", "--coq", "scene.png"],
    "verify": ["claims.md", "--proof", "./claims.md"],
    "verify the journal": ["claims.md", "--proof", "journal.md", "--resume", "journal.md"],
}


@pytest.mark.parametrize("name", SAME)
def test_no_file_that_is_read_is_written_over(name: str, tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("scene.png").write_text(PENDULUM)
    Path("claims.md").write_text(CLAIMS, encoding="utf-8")
    Path("link.png").symlink_to("scene.png")
    command = name.split()[: 2 if name.startswith(("cost", "certificate")) else 1]
    if command[-1] == "export":
        monkeypatch.setattr("canon.checker.files.load", lambda _: {})
        monkeypatch.setattr("canon.checker.check.check", lambda _: SimpleNamespace(status="confirmed"))
    assert main([*command, *SAME[name]]) == 3
    assert "would be written over" in capsys.readouterr().err
    assert Path("scene.png").read_text() == PENDULUM
    assert Path("claims.md").read_text(encoding="utf-8") == CLAIMS
