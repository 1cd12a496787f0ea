"""`canon verify --certificate` and `canon certificate check`, from claim files to exit status."""

import json
import os
from pathlib import Path

import pytest

from canon.claims.certificate_path import certificate_path
from canon.claims.worker import Entry
from canon.cli.main import main

FILE = """\
[phase_space]
q = ["q"]
p = ["p"]

[[claim]]
kind = "bracket"
f = "q**2"
g = "p"
equals = "2*q"

[[claim]]
kind = "bracket"
f = "q**2"
g = "p"
equals = "3*q"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    """A folder with one proof and one refutation, certified."""
    monkeypatch.chdir(tmp_path)
    Path("claims").mkdir()
    Path("claims/two.toml").write_text(FILE, encoding="utf-8")
    assert main(["verify", "claims", "--jobs", "1", "--json", "--certificate", "out"]) == 1
    record = json.loads(capsys.readouterr().out)
    assert [claim["certificate"] for claim in record["claims"]] == ["out/claims/two.1.json", "out/claims/two.2.json"]
    return tmp_path / "out" / "claims"


def test_each_proof_and_refutation_has_a_file_that_is_confirmed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert sorted(os.listdir(folder)) == ["two.1.json", "two.2.json"]
    assert main(["certificate", "check", "out"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["confirmed,", "shown", "out/claims/two.1.json"]
    assert lines[-1] == "2 certificates: 2 confirmed, 2 shown"


def test_a_file_without_a_phase_space_has_certificates_and_proofs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    claim = "[[claim]]\nkind = 'invariant_interval'\nmatrix = [[-1]]\nmetric = [[2]]\n"
    Path("bare.toml").write_text(claim, encoding="utf-8")
    assert main(["verify", "bare.toml", "--certificate", "out", "--proof", "bare.html"]) == 0
    assert main(["certificate", "check", "out"]) == 0
    assert "confirmed, shown" in capsys.readouterr().out


def test_what_one_file_cannot_show_is_no_fault_and_what_it_finds_wrong_is_one(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for file in ("alone_together", "refutations"):
        monkeypatch.setattr(f"canon.checker.{file}.checked", lambda data: ("not shown", "what it says"))
    assert main(["certificate", "check", "out"]) == 0
    assert "shown" not in capsys.readouterr().out
    assert main(["certificate", "check", "--alone", "out"]) == 2
    assert "not shown" in capsys.readouterr().out
    monkeypatch.setattr("canon.checker.alone_together.checked", lambda data: ("wrong", "a numerator"))
    assert main(["certificate", "check", "out"]) == 1
    assert "confirmed, wrong   out/claims/two.1.json: a numerator" in capsys.readouterr().out
    assert main(["certificate", "check", "--json", "out"]) == 1
    row = json.loads(capsys.readouterr().out)["certificates"][0]
    assert (row["status"], row["in_one_file"]) == ("confirmed", {"status": "wrong", "reasons": ["a numerator"]})


def test_proofs_and_refutations_are_shown_by_a_file_each(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for file, answer in (("alone_together", "not shown"), ("refutations", "wrong")):
        monkeypatch.setattr(f"canon.checker.{file}.checked", lambda data, answer=answer: (answer, ""))
    assert main(["certificate", "check", "--alone", "--json", "out"]) == 1
    rows = json.loads(capsys.readouterr().out)["certificates"]
    assert [row["status"] for row in rows] == ["not shown", "wrong"]


def test_the_gravest_answer_is_the_exit_status(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    proof, refutation = folder / "two.1.json", folder / "two.2.json"
    proof.write_text(proof.read_text().replace('"2*q"', '"4*q"'), encoding="utf-8")
    assert main(["certificate", "check", str(proof), str(refutation)]) == 1
    assert "rejected           " in capsys.readouterr().out
    (folder / "none.json").write_text('{"certificate": 1, "certificate": 1}', encoding="utf-8")
    (folder / "deep.json").write_text("[" * 200_000, encoding="utf-8")
    assert main(["certificate", "check", "--json", str(folder), "missing.json"]) == 3
    rows = {Path(row["file"]).name: row for row in json.loads(capsys.readouterr().out)["certificates"]}
    assert rows["none.json"]["reasons"] == ["a key stands twice in one table"]
    assert rows["deep.json"]["reasons"] == ["not JSON in UTF-8"]
    assert rows["missing.json"]["reasons"] == ["no such file"]
    assert [rows[name]["status"] for name in ("two.1.json", "two.2.json")] == ["rejected", "confirmed"]


def test_a_kind_that_is_not_known_is_exit_status_2(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from canon.checker.check import checksum

    data = json.loads((folder / "two.1.json").read_text())
    data["tables"]["claim"]["kind"] = "marvellous"
    (folder / "two.1.json").write_text(json.dumps({**data, "checksum": checksum(data)}), encoding="utf-8")
    assert main(["certificate", "check", str(folder / "two.1.json")]) == 2
    assert "not confirmed" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("all_kinds", "small", "status"),
    [
        ("confirmed in part", "shown", 0),
        ("not confirmed", "shown", 0),
        ("not confirmed", "not shown", 2),
        ("confirmed in part", "not shown", 2),
        ("confirmed in part", "wrong", 1),
        ("rejected", "shown", 1),
    ],
)
def test_one_checker_that_shows_it_is_enough(
    all_kinds: str, small: str, status: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from canon.checker.check import Answer

    monkeypatch.setattr("canon.checker.limits.checked", lambda data: Answer(all_kinds, ("why",)))
    monkeypatch.setattr("canon.checker.limits.checked_alone", lambda data: Answer(small, ("why",)))
    assert main(["certificate", "check", str(folder / "two.1.json")]) == status


def test_a_folder_that_cannot_be_made_is_bad_input(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "claims", "--certificate", "claims/two.toml"]) == 3
    assert "is no folder" in capsys.readouterr().err
    assert main(["certificate"]) == 3


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("a.toml", "out/a.3.json"),
        ("errata/a-b.toml", "out/errata/a-b.3.json"),
        ("/etc/a.toml", "out/a-"),
        ("../a.toml", "out/a-"),
        ("x/../../a.toml", "out/a-"),
        ("\n.toml", "out/--"),
    ],
)
def test_certificates_stay_in_their_folder(file: str, expected: str) -> None:
    path = str(certificate_path("out", Entry(file, 2, None)))
    assert path.startswith(expected)
    assert os.path.normpath(path).startswith("out/")


@pytest.mark.parametrize(("file", "fit"), [("two-1.v", "two_1.v"), ("1.v", "proof_1.v"), ("two.txt", "two.v")])
def test_a_name_that_coq_refuses_is_named(
    file: str, fit: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["certificate", "export", str(folder / "two.1.json"), "--coq", file]) == 0
    assert capsys.readouterr().out.endswith(f"that end in .v: rename it, `coqc {fit}`\n")


def test_a_certificate_is_exported_to_coq(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["certificate", "export", str(folder / "two.1.json"), "--coq", "two.v"]) == 0
    assert capsys.readouterr().out == "two.v: 1 theorem; check with `coqc two.v`\n"
    assert "Theorem residual_1 :" in Path("two.v").read_text(encoding="utf-8")
    proof = folder / "two.1.json"
    proof.write_text(proof.read_text().replace('"2*q"', '"4*q"'), encoding="utf-8")
    assert main(["certificate", "export", str(proof), "--coq", "other.v"]) == 3
    assert "rejected: the checksum is wrong" in capsys.readouterr().err
    assert not Path("other.v").exists()
    assert main(["certificate", "export", str(folder / "two.2.json"), "--coq", "no/two.v"]) == 3
    assert "there is no folder 'no'" in capsys.readouterr().err
    os.mkfifo("pipe.v")  # for which it would wait
    assert main(["certificate", "export", str(folder / "two.2.json"), "--coq", "pipe.v"]) == 3
    assert "'pipe.v' can't be written, or is no regular file" in capsys.readouterr().err
