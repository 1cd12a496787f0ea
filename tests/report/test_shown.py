"""What a person sees: lines when piped, a table on a terminal, and explanations below, by example."""

import io
from typing import Any

import pytest
from rich.console import Console

from canon.report.console import print_record, progress
from canon.report.explain import error_line, explanation
from canon.report.plain import Columns, print_rest
from canon.report.record import error_record, run_record
from canon.report.words import closing, duration, value, verdict, visible


def claim(verdict: str = "proved", **changes: Any) -> dict[str, Any]:
    base = {
        "file": "maps.toml",
        "index": 0,
        "kind": "fundamental_brackets",
        "title": None,
        "verdict": verdict,
        "expected": True,
        "method": "normal form",
        "seconds": 0.0042,
        "numeric": None,
        "witness": None,
        "certificate": None,
        "detail": {},
    }
    return base | changes


REFUTED = claim(
    "refuted",
    index=1,
    kind="canonical",
    title="Q = q, P = 2 p",
    expected=False,
    method="ball",
    witness={"q": "3/2", "z": {"re": "1/2", "im": "1"}},
    detail={
        "fails": "{Q, P}",
        "residual": "1.00000000000",
        "brackets": {"{Q, P}": "2"},
        "repair": None,
        "sign": [1, 2],
    },
)


@pytest.mark.parametrize(
    ("status", "expected", "words"),
    [
        ("proved", True, "✓ proved"),
        ("proved", False, "✓ proved, not as expected"),
        ("refuted", True, "✗ refuted, as expected"),
        ("refuted", False, "✗ refuted"),
        ("supported", True, "≈ supported"),
        ("undecided", False, "? undecided"),
        ("undecided", True, "? undecided, as expected"),
    ],
)
def test_a_verdict_in_words(status: str, expected: bool, words: str) -> None:
    assert verdict(claim(status, expected=expected)) == words


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0, "0 ms"), (0.00042, "0.42 ms"), (0.0123, "12 ms"), (0.1, "100 ms"), (0.9994, "999 ms"), (1.2345, "1.23 s")],
)
def test_a_time_in_words(seconds: float, words: str) -> None:
    assert duration(seconds) == words


def test_nothing_from_a_file_reaches_the_terminal_as_a_command() -> None:
    assert visible(
        "a\x1b[31mb\nc\u202ed\ud800"
    ) == "a\N{REPLACEMENT CHARACTER}[31mb c" + "\N{REPLACEMENT CHARACTER}d" + ("\N{REPLACEMENT CHARACTER}")


def test_values_in_words() -> None:
    assert value({"re": "1/2", "im": "-1"}) == "1/2 - 1 i"
    assert value({"re": "1/2", "im": "x"}) == "1/2 + x i"
    assert value(["a", {"b": True}]) == "a; b = yes"
    assert value("x" * 1000).endswith("… (1000 characters)")


def test_a_refutation_teaches() -> None:
    assert list(explanation(REFUTED)) == [
        "maps.toml #2 (canonical, Q = q, P = 2 p) is refuted (ball)",
        "  {Q, P} fails by 1 at q = 3/2, z = 1/2 + 1 i",
        "  brackets: {Q, P} = 2",
        "  sign: 1; 2",
    ]


def test_a_refutation_without_a_point_says_so() -> None:
    lines = list(explanation(REFUTED | {"witness": None, "detail": {}}))
    assert lines[1:] == ["  it fails by an exact argument, wherever the formulas are defined"]


def test_evidence_and_indecision_in_words() -> None:
    numeric = {"points": 1000, "max_residual": 2e-16, "bound": 1e-14}
    lines = list(explanation(claim("undecided", numeric=numeric, detail={"note": "the budget is spent"}, seconds=10)))
    assert lines == [
        "maps.toml #1 (fundamental brackets) is undecided (normal form)",
        "  the budget is spent",
        "  1000 sample points: largest residual 2e-16, rounding bound 1e-14",
        "  undecided after 10 s; a larger --budget may help",
    ]


def test_an_error_in_one_line() -> None:
    assert error_line(error_record("bad.toml", "claim 2, key 'f'", "no\nsuch name")) == (
        "bad.toml, claim 2, key 'f': no such name"
    )
    assert error_line(error_record("bad.toml", "", "not text")) == "bad.toml: not text"


def test_lines_are_aligned() -> None:
    claims = [claim(), REFUTED | {"expected": True}]
    columns = Columns.of([(c["file"], c["index"]) for c in claims], ["fundamental brackets", "Q = q, P = 2 p"])
    assert [columns.line(c) for c in claims] == [
        "✓ proved                maps.toml #1  fundamental brackets   4.2 ms  normal form",
        "✗ refuted, as expected  maps.toml #2  Q = q, P = 2 p         4.2 ms  ball",
    ]


def test_what_follows_the_lines() -> None:
    out = io.StringIO()
    record = run_record([claim(), REFUTED], [error_record("bad.toml", "line 3, column 5", "no value")])
    print_rest(record, out, seconds=0.25)
    assert out.getvalue().splitlines()[-5:] == [
        "",
        "input errors:",
        "  ! bad.toml, line 3, column 5: no value",
        "",
        "2 claims in 1 file: 1 proved, 1 refuted, 1 input error in 250 ms",
    ]


@pytest.mark.parametrize(
    ("claims", "line"),
    [
        ([], "0 claims in 0 files: nothing to check in 1 s"),
        ([claim("refuted"), claim("refuted")], "2 claims in 1 file: 2 refuted (as expected) in 1 s"),
        ([claim("refuted"), REFUTED], "2 claims in 1 file: 2 refuted (1 not expected) in 1 s"),
        ([claim(expected=False), claim(file="b")], "2 claims in 2 files: 2 proved (1 not expected) in 1 s"),
        ([claim("supported"), claim("undecided")], "2 claims in 1 file: 1 supported, 1 undecided in 1 s"),
    ],
)
def test_the_closing_line(claims: list[dict[str, Any]], line: str) -> None:
    assert closing(run_record(claims, []), seconds=1) == line


def test_the_table_on_a_terminal() -> None:
    out = io.StringIO()
    console = Console(file=out, width=80, force_terminal=True, color_system=None, highlight=False)
    record = run_record([claim(title="[bold]markup[/bold]"), REFUTED], [error_record("bad.toml", "", "not text")])
    print_record(record, console, seconds=0.25)
    lines = [line.rstrip() for line in out.getvalue().splitlines()]
    assert lines[:4] == [
        "  verdict                 claim                             method          time",
        "maps.toml",
        "  ✓ proved                [bold]markup[/bold]               normal form   4.2 ms",
        "  ✗ refuted               Q = q, P = 2 p                    ball          4.2 ms",
    ]
    assert lines[-3:] == [
        "! bad.toml: not text",
        "",
        "2 claims in 1 file: 1 proved, 1 refuted, 1 input error in 250 ms",
    ]


def test_a_bar_appears_only_when_the_wait_is_long(monkeypatch: pytest.MonkeyPatch) -> None:
    out = io.StringIO()
    console = Console(file=out, width=80, force_terminal=True, color_system=None)
    with progress(10, console) as bar:
        bar.update(1, "maps.toml")
        assert out.getvalue() == ""
        monkeypatch.setattr("canon.report.console.PATIENCE", 0.0)
        bar.update(5, "maps.toml")
        assert "5/10" in out.getvalue()
        assert "maps.toml" in out.getvalue()
