"""Foreign data by grammar: scenes, certificates, journals, command lines. Whatever comes, an answer or an error."""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from canon.checker.check import check, checksum
from canon.checker.functions import Unreadable
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.document import parse
from canon.claims.journal import Journal, answered
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from canon.claims.worker import Entry
from canon.cli.main import main
from canon.errors import InputError
from canon.scenes.reader import read_scene_text
from properties.test_reader import texts

CLAIM = """
[phase_space]
q = ["x", "y"]
p = ["px", "py"]
[[claim]]
kind = "bracket"
f = "sqrt(x**2 + y**2)"
g = "x*py - y*px"
equals = "0"
"""
TABLES = parse(CLAIM)
(SUBJECT,) = read_tables(TABLES).claims
CERTIFICATE = json.loads(json.dumps(certificate(SUBJECT, verify(SUBJECT), statement_tables(TABLES, 0))))
FALSE_CLAIM = read_tables(parse(CLAIM.replace('"0"', '"x"'))).claims[0]

words = st.sampled_from(
    ("x", "y", "px", "g1", "g2^2", "1", "-1/2", "sqrt(x)", "x**2", "positive", "proved", "", "1e999", "[0]")
)
scalars = st.none() | st.booleans() | st.integers(-(10**30), 10**30) | st.floats() | words | texts(depth=2)
values = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(words, inner, max_size=3), max_leaves=8
)


def places(data: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The ways to every part of nested data."""
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    return [path, *(way for key, value in inner for way in places(value, (*path, key)))]


def changed(data: Any, path: tuple[Any, ...], value: Any) -> Any:
    """The data with another value at the end of a way."""
    if not path:
        return value
    key, *rest = path
    copy = dict(data) if isinstance(data, dict) else list(data)
    copy[key] = changed(copy[key], tuple(rest), value)
    return copy


@st.composite
def spoiled(draw: st.DrawFn) -> Any:
    """A certificate with something else in some of its places, and a checksum that is right."""
    data = CERTIFICATE
    for _ in range(draw(st.integers(1, 3))):
        data = changed(data, draw(st.sampled_from(places(data))), draw(values))
        if not isinstance(data, dict):
            return data
    with contextlib.suppress(ValueError):
        data = {**data, "checksum": checksum(data)}
    return data


@given(spoiled())
def test_a_certificate_that_is_spoiled_proves_nothing_else(data: Any):
    """It may be confirmed only of the claim that is true: the residual of another one doesn't vanish."""
    try:
        answer = check(data)
    except Unreadable:
        return
    if answer.status.startswith("confirmed"):
        tables = data["tables"]
        (claim,) = read_tables({**tables, "claim": [tables["claim"]]}).claims
        assert verify(claim, budget=3.0).status == data["verdict"]


@given(st.lists(st.sampled_from(("cases", "points", "known", "method", "domain", "witness")), max_size=4), values)
def test_a_false_claim_is_confirmed_by_nothing(keys: list[str], value: Any):
    data = {
        **CERTIFICATE,
        "tables": statement_tables(parse(CLAIM.replace('"0"', '"x"')), 0),
        **dict.fromkeys(keys, value),
    }
    data = json.loads(json.dumps(data, default=str))
    data["checksum"] = checksum(data)
    with contextlib.suppress(Unreadable):
        assert not check(data).status.startswith("confirmed")


@given(st.lists(values, max_size=4), st.binary(max_size=60))
def test_lines_that_are_no_answers_are_none(bodies: list[Any], tail: bytes):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "journal"
        kept = Journal(path, "settings")
        entry = Entry("claims.toml", 0, SUBJECT, str(path))
        name = kept.name(entry)
        lines = [json.dumps({"check": "0", "body": {"name": name, "kind": "claim", "record": body}}) for body in bodies]
        path.write_bytes("\n".join(lines).encode() + tail)
        with contextlib.suppress(InputError):
            assert answered(kept, [entry]) == {}


LINES = (
    "[[body]]", "[[rigid_body]]", "[system]", "[run]", "[[effect]]", "[constants]", "mass = 1", "position = [1, 0]",
    'name = "a"', 'name = "pendulum"', 'kind = "potential"', 'kind = "damping"', 'V = "x**2"', "rate = 0.1", "G = 1",
    'kind = "mutual_gravity"', "duration = 1", "samples = 3", "step = 0.1", 'monitor = ["energy"]',
    'q_names = ["q"]', 'p_names = ["p"]', 'H = "p**2"', "q = [0.1]", "p = [1]", "charge = 1", "velocity = [0, 1e400]",
    'kind = "rod"', "length = 1", 'kind = "magnetic_field"', "B = [0, 0, 1]", 'bodies = ["a"]', "c = nan", "= 3", "[[",
    'dynamics = "relativistic"', 'kind = "skate"', 'kind = "scatterer"', 'potential = "1/r"', "moments = [1, 2, 3]",
)  # fmt: skip


@given(st.lists(st.sampled_from(LINES), max_size=25))
def test_near_scenes(lines: list[str]):
    with contextlib.suppress(InputError):
        read_scene_text("\n".join(lines))


COMMANDS = ("verify", "simulate", "algebra", "actions", "scenes", "certificate", "coverage", "")
OPTIONS = (
    "--json", "--budget", "--seed", "--jobs", "--method", "--accuracy", "--step", "--integrator", "--explain", "--help",
    "--version", "--energy", "--well", "--q", "--p", "--parameter", "check", "--", "-", "--latex", "--fresh", "-x",
)  # fmt: skip
WORDS = (
    "none.toml",
    "0",
    "-1",
    "1e999",
    "nan",
    "abc",
    "\x00",
    "ß",
    "9" * 400,
    "all",
    "q=1",
    "",
    " ",
    "../none",
    "%s",
    "{0}",
)


@given(
    st.sampled_from(COMMANDS),
    st.lists(st.sampled_from((*OPTIONS, *WORDS)) | st.text(max_size=6), min_size=1, max_size=6),
)
def test_command_lines(command: str, more: list[str]):
    """A file that isn't there is named throughout, so that nothing long is begun."""
    arguments = [word for word in (command, "none.toml") if word] + [
        word for word in more if "/" not in word and word != "."
    ]
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main(arguments)
        except SystemExit as done:
            status = done.code
    assert status in (0, 3), (arguments, status)
    assert status == 0 or out.getvalue() or err.getvalue()


@pytest.mark.parametrize("status", ["proved", "refuted"])
def test_what_is_spoiled_is_read_at_all(status: str):
    """The grammar would be idle if the certificate were none, or the false claim true."""
    claim = SUBJECT if status == "proved" else FALSE_CLAIM
    assert verify(claim).status == status
    assert check(CERTIFICATE).status == "confirmed"
