"""`canon verify` from files to exit status: what is printed, by example, and what JSON holds."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from canon.cli.main import main

MAP = """\
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]

[symbols]
a = "real"

[hamiltonian]
H = "p**2/2 + q**4"

[transformation]
Q = ["2*q"]
P = ["p"]
"""
CLAIM = {
    "canonical": '[[claim]]\nkind = "canonical"\n',
    "scaled": '[[claim]]\nkind = "canonical"\ntitle = "with valence 2"\nscale = "2"\n',
    "false": '[[claim]]\nkind = "canonical"\nexpect = "fails"\n',
    "bracket": '[[claim]]\nkind = "bracket"\nf = "q**2"\ng = "p"\nequals = "2*q"\n',
    "typo": '[[claim]]\nkind = "bracket"\nf = "qq"\ng = "p"\nequals = "0"\n',
    "new variable": '[[claim]]\nkind = "bracket"\nf = "Q"\ng = "p"\nequals = "2"\n',
    "kind": '[[claim]]\nkind = "canonicl"\n',
}


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Writes a claim file, with the claims of these names, in the current folder."""
    monkeypatch.chdir(tmp_path)

    def write(name: str, *claims: str) -> str:
        Path(name).write_text(MAP + "\n".join(CLAIM[claim] for claim in claims), encoding="utf-8")
        return name

    return write


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, list[str]]:
    """The exit status and the lines on standard output, times masked; nothing may be on standard error."""
    status = main(["verify", "--jobs", "1", *arguments])
    out, err = capsys.readouterr()
    assert err == ""
    return status, [re.sub(r" +[\d.]+ m?s\b", " T", line) for line in out.splitlines()]


def record(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, dict[str, Any]]:
    """The exit status and the object that `--json` prints."""
    status = main(["verify", "--json", *arguments])
    out, err = capsys.readouterr()
    assert err == ""
    return status, json.loads(out)


def test_all_as_expected(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    status, lines = printed(capsys, file("map.toml", "scaled", "bracket"))
    assert status == 0
    assert lines[0].startswith("✓ proved                map.toml #1  with valence 2 T  ")
    assert lines[1].startswith("✓ proved                map.toml #2  bracket T  ")
    assert lines[-1] == "2 claims in 1 file: 2 proved in T"


def test_a_refutation_names_the_bracket_its_value_the_place_and_a_repair(
    file: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    status, lines = printed(capsys, file("map.toml", "canonical"))
    assert status == 1
    text = "\n".join(lines)
    assert "map.toml #1 (canonical) is refuted" in text
    assert "{Q, P} fails by 1 wherever the formulas are defined" in text  # at whatever point: none is shown
    assert "brackets: {Q, P} = 2" in text
    assert "repair: " in text
    assert lines[-1] == "1 claim in 1 file: 1 refuted in T"


def test_an_expected_refutation_is_fine(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    status, lines = printed(capsys, file("map.toml", "false"))
    assert status == 0
    assert lines[0].startswith("✗ refuted, as expected  map.toml #1  canonical T  ")
    assert lines[-1] == "1 claim in 1 file: 1 refuted (as expected) in T"


def test_errors_do_not_keep_other_claims_from_being_checked(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    name = file("map.toml", "typo", "bracket", "new variable", "kind")
    Path("broken.toml").write_text("a = [1,\n b = 3", encoding="utf-8")
    Path("noise.toml").write_bytes(b"\xff\xfe\x00")
    status, found = record(capsys, name, "broken.toml", "noise.toml", "absent.toml")
    assert status == 3
    assert found["summary"] == {"proved": 1, "refuted": 0, "supported": 0, "undecided": 0, "errors": 6}
    assert [(error["file"], error["where"]) for error in found["errors"]] == [
        ("absent.toml", ""),
        ("map.toml", "claim 1, key 'f'"),
        ("map.toml", "claim 3, key 'f'"),
        ("map.toml", "claim 4, key 'kind'"),
        ("broken.toml", ""),
        ("noise.toml", ""),
    ]
    messages = {(error["file"], error["where"]): error["message"] for error in found["errors"]}
    assert "line 2" in messages["broken.toml", ""]
    assert "'qq'" in messages["map.toml", "claim 1, key 'f'"]
    assert "did you mean 'canonical'" in messages["map.toml", "claim 4, key 'kind'"]
    assert "no such file" in messages["absent.toml", ""]


def test_a_folder_means_every_claim_file_below_it(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    Path("claims/inner").mkdir(parents=True)
    Path("claims/empty").mkdir()
    file("claims/b.toml", "bracket")
    file("claims/a.toml", "bracket")
    file("claims/inner/c.toml", "bracket")
    Path("claims/notes.txt").write_text("no claims", encoding="utf-8")
    status, found = record(capsys, "claims")
    assert status == 0
    assert [claim["file"] for claim in found["claims"]] == ["claims/a.toml", "claims/b.toml", "claims/inner/c.toml"]
    status, found = record(capsys, "claims/empty")
    assert status == 3
    assert found["errors"] == [
        {"file": "claims/empty", "where": "", "message": "no claim file (*.toml) in this folder or below it"}
    ]


def test_a_file_is_checked_once_by_whatever_path_it_is_reached(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    Path("claims").mkdir()
    name = file("claims/map.toml", "bracket")
    Path("claims/link.toml").symlink_to("map.toml")
    _, found = record(capsys, name, "claims", str(Path(name).resolve()), name, "absent.toml", "absent.toml")
    assert [claim["file"] for claim in found["claims"]] == [name]
    assert [error["file"] for error in found["errors"]] == ["absent.toml"]


def test_every_way_in_which_a_file_can_be_bad(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """One line each, exit status 3, the good file still checked; nothing hangs, nothing is executed."""
    Path("bad").mkdir()
    file("bad/good.toml", "bracket")
    folder, claim = Path("bad"), (MAP + CLAIM["bracket"]).encode()
    contents = {
        "binary": (bytes(range(256)), "is not text in UTF-8: byte 0x80 in line 2"),
        "empty": (b"", "the file makes no claim"),
        "huge": (claim + b"#" * 10_000_000, "is too big"),
        "latin": (claim + b"# \xe9", "is not text in UTF-8: byte 0xe9"),
        "malformed": (
            b"[[claim]\nkind = 3",
            "not TOML: Expected ']]' at the end of an array declaration (at line 1",
        ),
        "nul": (claim + b"# \0", "not TOML: Found invalid character '\\x00'"),
        "wide": (claim.decode().encode("utf-16"), "is not text in UTF-8"),
    }
    for name, (data, _) in contents.items():
        (folder / f"{name}.toml").write_bytes(data)
    (folder / "loop.toml").symlink_to("loop.toml")
    (folder / "nowhere.toml").symlink_to("absent.toml")
    os.mkfifo(folder / "pipe.toml")
    (folder / "folder.toml").mkdir()
    expected = {f"bad/{name}.toml": message for name, (_, message) in contents.items()} | {
        "bad/loop.toml": "can't be read: Too many levels of symbolic links",
        "bad/nowhere.toml": "there is no such file",
        "bad/pipe.toml": "is not a regular file",
        os.devnull: "is not a regular file",
        "bad/folder.toml": "no claim file (*.toml) in this folder or below it",
        "absent.toml": "no such file or folder",
    }
    status, found = record(capsys, "bad/loop.toml", os.devnull, "bad/folder.toml", "absent.toml", "bad")
    assert status == 3
    assert [(claim["file"], claim["verdict"]) for claim in found["claims"]] == [("bad/good.toml", "proved")]
    told = {error["file"]: error["message"] for error in found["errors"]}
    assert told.keys() == expected.keys()
    for name, message in expected.items():
        assert told[name].startswith(message), told[name]


def test_a_file_that_may_not_be_read(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    name = file("map.toml", "bracket")
    Path(name).chmod(0)
    if os.access(name, os.R_OK):
        pytest.skip("this user reads everything")
    status, found = record(capsys, name)
    assert (status, found["errors"][0]["message"]) == (3, "can't be read: Permission denied")


def test_json_for_a_terminal_without_the_letters(file: Any) -> None:
    title = "µ → Ω"
    Path("map.toml").write_text(MAP + CLAIM["bracket"] + f'title = "{title}"\n', encoding="utf-8")
    outputs = {}
    for encoding in ("ascii", "utf-8"):
        environment = {**os.environ, "PYTHONIOENCODING": encoding}
        command = [sys.executable, "-m", "canon", "verify", "map.toml", "--json", "--jobs", "1"]
        outputs[encoding] = subprocess.run(command, capture_output=True, env=environment, check=True).stdout
    assert json.loads(outputs["ascii"])["claims"][0]["title"] == title
    assert title.encode() in outputs["utf-8"]
    assert title.encode() not in outputs["ascii"]


def test_the_shape_of_the_json_record(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = record(capsys, file("map.toml", "canonical", "scaled"))
    assert status == 1
    assert list(found) == ["format", "claims", "errors", "summary"]
    assert found["format"] == 1
    refuted, proved = found["claims"]
    names = "file, index, kind, title, verdict, expected, method, seconds, numeric, witness, certificate, detail"
    assert ", ".join(refuted) == ", ".join(proved) == names
    assert (refuted["verdict"], refuted["expected"], refuted["index"]) == ("refuted", False, 0)
    assert set(refuted["witness"]) >= {"q", "p"}
    assert all(re.fullmatch(r"-?\d+(/\d+|\.\d+)?", text) for text in refuted["witness"].values())
    assert refuted["detail"]["scale"] == "2"
    assert (proved["verdict"], proved["title"], proved["witness"]) == ("proved", "with valence 2", None)


def test_the_numeric_method_never_proves(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = record(capsys, file("map.toml", "scaled", "false"), "--method", "numeric")
    assert status == 0
    supported, refuted = found["claims"]
    assert (supported["verdict"], refuted["verdict"]) == ("supported", "refuted")
    assert supported["numeric"]["points"] > 0
    assert supported["numeric"]["max_residual"] <= supported["numeric"]["bound"]


def test_the_same_seed_gives_the_same_answer(file: Any, capsys: pytest.CaptureFixture[str]) -> None:
    def answer(seed: str) -> list[dict[str, Any]]:
        found = record(capsys, file("map.toml", "canonical", "bracket"), "--seed", seed, "--budget", "60")[1]
        return [claim | {"seconds": 0} for claim in found["claims"]]

    assert answer("3") == answer("3")


def test_people_see_what_a_refutation_depends_on_and_programs_the_whole_point(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """{q, p} = q + 1 fails where q isn't 0, whatever p is."""
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "q + 1"\n'
    (tmp_path / "a.toml").write_text(text, encoding="utf-8")
    assert main(["verify", str(tmp_path / "a.toml"), "--jobs", "1"]) == 1
    shown = capsys.readouterr().out
    assert re.search(r"at q = \S+\n", shown), shown
    assert main(["verify", str(tmp_path / "a.toml"), "--jobs", "1", "--json"]) == 1
    (claim,) = json.loads(capsys.readouterr().out)["claims"]
    assert claim["witness"].keys() == {"q", "p"}
    assert "matters" not in claim
