"""Files that can't be read: each says why, and none is executed, waited for or read without bound."""

import os

import pytest

from canon.claims.document import BIGGEST
from canon.claims.reader import read_file


def fault_of(path) -> str:
    reading = read_file(path)
    assert reading.claims == []
    (problem,) = reading.problems
    return problem["message"]


def test_missing_directory_and_nul(tmp_path):
    assert fault_of(tmp_path / "absent.toml") == "there is no such file"
    assert fault_of(tmp_path) == "is a directory"
    assert "can't be read" in fault_of(str(tmp_path / "a\0b"))
    assert "can't be read" in fault_of(tmp_path / ("x" * 5000))


def test_not_text(tmp_path):
    file = tmp_path / "file.toml"
    file.write_bytes(b"title = 'x'\n\xff\xfe")
    assert fault_of(file) == "is not text in UTF-8: byte 0xff in line 2"
    file.write_bytes(b"\x00\x01")
    assert "not TOML" in fault_of(file)


def test_a_byte_order_mark_and_foreign_line_ends_are_taken(tmp_path):
    file = tmp_path / "file.toml"
    text = '[phase_space]\r\nq=["x"]\r\np=["p"]\r\n[[claim]]\r\nkind="bracket"\r\nf="x"\r\ng="p"\r\nequals=1\r\n'
    file.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert [claim.kind for claim in read_file(file).claims] == ["bracket"]


def test_too_big(tmp_path):
    file = tmp_path / "file.toml"
    with file.open("wb") as handle:
        handle.truncate(BIGGEST + 1)
    assert "is too big" in fault_of(file)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names here")
def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    assert fault_of(tmp_path / "pipe.toml") == "is not a regular file"


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device here")
def test_a_device_is_not_read():
    assert fault_of("/dev/zero") == "is not a regular file"


@pytest.mark.parametrize("text", ["a=" + "9" * 5000, "a=1e" + "9" * 30, "a." * 9999 + "a=1", "a=" + "{b=" * 3000])
def test_toml_at_its_limits(tmp_path, text):
    file = tmp_path / "file.toml"
    file.write_text(text)
    assert "not readable" in fault_of(file)
