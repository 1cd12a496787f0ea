"""Studies of work and precision: fronts, orders and choices, on points whose answers are known."""

import csv
import json
import math
from dataclasses import replace

import pytest

from canon.cost.clock import LEAST, timed
from canon.cost.study import Point, Study, cheapest, measured_order, next_digit, pareto, record
from canon.report.cost_text import as_csv


def study(*points: Point, floor: float = 1e-15) -> Study:
    return Study("simulate", "a title", "steps", "relative", "by hand", floor, points, {"fourth": 4})


def falling(order: int, plateau: float = 0.0) -> list[Point]:
    return [Point("fourth", n, max(3.0 * n**-order, plateau), 1e-3 * n) for n in (10.0, 20, 40, 80, 160, 320)]


def test_the_front_holds_what_nothing_beats_in_both():
    points = (
        Point("a", 1, 1e-3, 1.0),
        Point("a", 2, 1e-6, 2.0),
        Point("b", 1, 1e-3, 1.5),  # as exact as the first, and slower
        Point("b", 2, 1e-5, 3.0),
        Point("c", None, 0.0, 4.0),
        Point("d", 1, None, 0.1),  # of unknown error
    )
    assert pareto(points) == {0, 1, 4}


@pytest.mark.parametrize("order", [1, 2, 4, 8])
def test_the_order_is_the_slope(order):
    assert measured_order(study(*falling(order), floor=1e-30), "fourth") == pytest.approx(order, rel=1e-9)


def test_rounding_is_no_part_of_the_order():
    found = measured_order(study(*falling(4, plateau=1e-9), floor=1e-16), "fourth")
    assert found == pytest.approx(4, rel=1e-9)


def test_no_order_where_nothing_falls():
    assert measured_order(study(*(Point("fourth", n, 0.01, n) for n in (1.0, 2, 4, 8))), "fourth") is None


def test_a_digit_of_a_method_of_fourth_order_costs_the_fourth_root_of_ten():
    assert next_digit(study(*falling(4), floor=1e-30), "fourth") == pytest.approx(10**0.25)


def test_the_cheapest_for_an_accuracy():
    found = study(*falling(4))
    assert cheapest(found, 1e-4) == found.points[1]
    assert cheapest(found, 1e-30) is None


def test_its_record_is_plain_json():
    points = (*falling(4), Point("broken", 1, math.inf, 1.0, measures={"energy": math.nan}))
    data = json.loads(json.dumps(record(study(*points)), allow_nan=False))
    assert [point["pareto"] for point in data["points"]] == [True] * 6 + [False]
    assert data["points"][-1]["error"] is None
    assert data["methods"][0]["claimed_order"] == 4


def test_the_clock_repeats_and_keeps_the_first_apart():
    calls = []
    result, timing = timed(lambda: calls.append(0) or len(calls))
    assert timing.runs >= LEAST
    assert len(calls) == result == timing.runs + 1
    assert 0 < timing.least <= timing.median


def test_the_clock_does_nothing_again_that_takes_too_long():
    calls = []
    _, timing = timed(lambda: calls.append(sum(range(1000))), cap=1e-12)
    assert len(calls) == timing.runs == 1


def test_a_title_is_no_formula_of_a_spreadsheet() -> None:
    """What begins with =, +, - or @ is one; and what has colours in it would set those of a terminal."""
    for title, cell in (("=HYPERLINK(1)", "'=HYPERLINK(1)"), ("@x\x1b[31m", "'@x\ufffd[31m"), ("a = b", "a = b")):
        rows = list(csv.DictReader(as_csv([replace(study(*falling(4)), title=title)]).splitlines()))
        assert {row["title"] for row in rows} == {cell}
