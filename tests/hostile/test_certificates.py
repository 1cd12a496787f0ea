"""Certificates of whoever: none of the corpus is believed, and none keeps the checker busy."""

from __future__ import annotations

import copy
import json
import os
import time
from contextlib import suppress
from pathlib import Path

import pytest

from canon.checker.check import check, checksum
from canon.checker.files import load
from canon.checker.functions import Unreadable
from canon.cli.main import main
from tests.hostile.attacks import CERTIFICATES, DEFINITIONS, FORMULAS
from tests.hostile.measured import DEAR, HEAD, SECONDS, spent, writable

LATER = [pytest.mark.thorough]
DEFINED = [pytest.param(name, marks=LATER if "of" in name else []) for name in DEFINITIONS]


def test_no_certificate_of_the_corpus_is_believed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "certificate.json"
    for name, data in CERTIFICATES.items():
        path.write_bytes(data)
        status: list[int] = []
        assert spent(lambda status=status: status.append(main(["certificate", "check", str(path)]))) < SECONDS, name
        assert status[0] in (1, 3), name
        assert capsys.readouterr().out.startswith(("unreadable", "rejected")), name


@pytest.fixture(scope="module")
def certificate() -> dict:
    from tests.checker.test_check import made

    return made("bracket")


def sealed(certificate: dict, /, **changed) -> dict:
    """A certificate with other entries, and a checksum that is right."""
    data = {**copy.deepcopy(certificate), **changed}
    data["checksum"] = checksum(data)
    return data


@pytest.mark.parametrize("name", DEFINED)
def test_a_certificate_cant_keep_the_checker_busy(name: str, certificate: dict) -> None:
    tables = copy.deepcopy(certificate["tables"])
    tables["definitions"], tables["claim"]["equals"] = DEFINITIONS[name], "a59"
    start = time.process_time()
    try:
        status = check(sealed(certificate, tables=tables)).status
    except Unreadable:
        status = "unreadable"
    assert status in ("unreadable", "rejected", "not confirmed")
    assert time.process_time() - start < 2 * SECONDS


def test_a_certificate_with_attacks_for_formulas_is_refused(certificate: dict) -> None:
    for name, formula in FORMULAS.items():
        tables = copy.deepcopy(certificate["tables"])
        tables["claim"]["equals"] = formula
        start = time.process_time()
        with suppress(Unreadable):
            if writable(formula) and name not in DEAR:
                assert check(sealed(certificate, tables=tables)).status != "confirmed", name
        assert time.process_time() - start < 2 * SECONDS, name


def test_parts_of_a_certificate_that_are_anything(certificate: dict) -> None:
    strange = (None, 3, [], {}, "x", [[[[]]]], {"a": {"a": 1}}, 1e308, [3] * 1000)
    for key in ("certificate", "tables", "verdict", "cases"):
        for value in strange:
            with suppress(Unreadable):
                nothing = key == "cases" and value == []  # shows nothing, and lies about nothing
                expected = "not confirmed" if nothing else "rejected"
                assert check(sealed(certificate, **{key: value})).status == expected, (key, value)
    for key in certificate["cases"][0]:
        for value in strange:
            case = {**certificate["cases"][0], key: value}
            with suppress(Unreadable):
                assert check(sealed(certificate, cases=[case])).status != "confirmed", (key, value)


def test_what_is_no_file_is_not_read_as_a_certificate(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.json")
    (tmp_path / "loop.json").symlink_to("loop.json")
    for path in (tmp_path / "pipe.json", tmp_path / "loop.json", tmp_path / "absent.json", tmp_path):
        with pytest.raises(Unreadable):
            load(str(path))


SPOOF = "q\x1b[31m\nconfirmed          everything\u202e"


def test_nothing_in_a_file_writes_a_line_of_its_own(
    tmp_path: Path, certificate: dict, capsys: pytest.CaptureFixture[str]
) -> None:
    """What quotes a file can't set a colour, move the cursor or look like another line of the report."""
    tables = copy.deepcopy(certificate["tables"])
    tables["claim"]["equals"] = SPOOF
    path = tmp_path / "one\nconfirmed          two.json"
    path.write_text(json.dumps(sealed(certificate, tables=tables)), encoding="utf-8")
    algebra = f'{HEAD}[[claim]]\nkind = "algebra"\ntitle = {json.dumps(SPOOF)}\nequals = "so(3)"\n[claim.basis]\n'
    (tmp_path / "a.toml").write_text(algebra + 'a = "q"\nb = "p"\nc = "1"\n', encoding="utf-8")
    (tmp_path / "b.toml").write_text(algebra + f"a = {json.dumps(SPOOF)}\n", encoding="utf-8")
    for command in (["certificate", "check", str(path)], ["algebra", str(tmp_path)], ["simulate", str(path)]):
        assert main(command) != 0
        out, err = capsys.readouterr()
        assert not any(line.startswith("confirmed") for line in (out + err).splitlines()), command
        assert not {"\x1b", "\u202e"} & {*out, *err}, command
