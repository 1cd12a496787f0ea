"""The catalogue of hard cases: ours within a digit of what conditioning allows, and the measuring itself."""

from __future__ import annotations

import json
import os
from dataclasses import replace

import mpmath as mp
import pytest

from canon.cli.main import main
from canon.hard.case import Answer, HardCase, each
from canon.hard.catalogue import cases
from canon.hard.digits import FULL, allowed, condition, exactly, kept
from canon.hard.run import Row, run
from canon.report.hard_table import closing_lines, hard_csv

PROFILE = os.environ.get("CANON_PROFILE")
QUICK = ("Rutherford", "stiff springs", "all but vanishes", "at the edge", "loops")
"""What is run in the ordinary profile: nothing to compile, and some that state bounds of their errors. `ci` runs all
that isn't slow, some twenty seconds, since a case may be lost by a change far from it."""

ALL = cases(slow=True)


@pytest.fixture(scope="module")
def found() -> tuple[Row, ...]:
    chosen = ALL if PROFILE == "thorough" else cases() if PROFILE == "ci" else cases(QUICK)
    return tuple(run(case) for case in chosen)


def test_ours_is_within_a_digit_of_what_conditioning_allows(found: tuple[Row, ...]) -> None:
    assert [line for line in closing_lines(found) if " is lost: " in line] == []


def test_the_naive_formula_fails_in_the_same_run(found: tuple[Row, ...]) -> None:
    assert [row.case.name for row in found if not row.naive_fails] == []


def test_bounds_contain_the_truth(found: tuple[Row, ...]) -> None:
    assert all(row.bound_holds for row in found if row.bound_holds is not None)
    assert any(row.bound_holds for row in found)


def test_names_are_one_case_each_and_open_ones_give_a_reason() -> None:
    names = [(case.family, case.name) for case in ALL]
    assert len(set(names)) == len(names)
    assert all(len(case.inputs) == len(point) for case in ALL for point in case.points)


@pytest.mark.parametrize("case", ALL, ids=lambda case: case.name)
def test_references_have_their_digits(case: HardCase) -> None:
    """Forty digits more change nothing in the first thirty."""
    point = case.points[0]
    once, again = exactly(case, point), exactly(case, point, case.digits + 40)
    with mp.workdps(case.digits + 40):
        for one, other in zip(once, again, strict=True):
            off = mp.sqrt(mp.fsum([(a - b) ** 2 for a, b in zip(one, other, strict=True)]))
            assert off <= mp.mpf(10) ** -30 * mp.sqrt(mp.fsum([b * b for b in other]))


DIFFERENCE = HardCase(
    "difference",
    "test",
    "x − 1",
    ("x",),
    ((1 + 2.0**-20,),),
    lambda m, x: (((x * x - 1) / (x + 1),),),
    each(lambda x: x - 1),
    each(lambda x: 1 - 1 / x),
    peers={"numpy": each(lambda x: x - 1), "no_such_package": each(lambda x: x)},
)


def test_what_is_measured() -> None:
    (point,) = DIFFERENCE.points
    (found,) = condition(DIFFERENCE, point)
    assert found == pytest.approx(2.0**20, rel=1e-5)
    assert allowed(found) == pytest.approx(FULL - 6.02, abs=0.01)
    assert kept([1.001], [mp.mpf(1)]) == pytest.approx(3)
    assert kept([float("nan")], [mp.mpf(1)]) == kept([1j], [mp.mpf(1)]) == kept([1.0, 2.0], [mp.mpf(1)]) == 0
    assert kept([3.0], [mp.mpf(1)]) == 0
    row = run(DIFFERENCE)
    assert row.verdict == "kept"
    assert row.shown.ours.digits == FULL
    assert row.naive_fails is True
    assert row.failing == ()
    assert row.shown.peers["no_such_package"] is None
    assert "no_such_package absent" in hard_csv([row])[1][7]


def test_digits_that_are_lost_are_seen() -> None:
    off = replace(DIFFERENCE, ours=each(lambda x: (x - 1) * (1 + 1e-7)))
    assert run(off).verdict == "lost"
    assert any("is lost: 7.0 digits at x = 1.0" in line for line in closing_lines([run(off)]))
    assert run(replace(off, open="because")).verdict == "open"
    wrong = replace(DIFFERENCE, ours=lambda points: [Answer((((x - 1) * (1 + 1e-15),),), (1e-30,)) for (x,) in points])
    assert run(wrong).verdict == "lost"
    raising = replace(DIFFERENCE, naive=each(lambda x: 1 / 0))
    assert run(raising).shown.naive.digits == 0


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["hard", "backward", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert [case["name"] for case in record["cases"]] == ["Rutherford, backward"]
    assert record["cases"][0]["verdict"] == "kept"
    assert record["cases"][0]["naive_fails"]
    assert main(["hard", "backward"]) == 0
    shown = capsys.readouterr().out
    assert "1 case: 1 kept; the naive formula loses digits in 1" in shown
    assert main(["hard", "--list", "kepler"]) == 0
    assert capsys.readouterr().out.startswith("kepler: E → 0 from below (")
    assert main(["hard", "keppler"]) == 3
    assert "there is kepler" in capsys.readouterr().err
