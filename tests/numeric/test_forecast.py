"""Forecasts of a run from those before it: what every run takes apart from what every step takes."""

import pytest

from canon.numeric.forecast import forecast_of
from canon.numeric.progress import Trial


def trials(*rows: tuple[int, float], order: int = 4) -> list[Trial]:
    """Runs with these steps and seconds, whose error is steps^(-order)."""
    found, before = list[Trial](), None
    for steps, seconds in rows:
        difference = float("inf") if before is None else before**-order - steps**-order
        found.append(Trial(steps=steps, difference=difference, seconds=seconds))
        before = steps
    return found


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ([(100, 0.1), (200, 0.2), (400, 9.0)], 0.4),  # nothing but steps
        ([(100, 0.2), (200, 0.3), (400, 9.0)], 0.5),  # 0.1 whatever the steps
        ([(100, 0.3), (200, 0.3), (400, 9.0)], 0.45),  # no growth is seen: half of it is taken for the steps'
        ([(100, 0.9), (200, 0.3), (400, 9.0)], 0.45),  # the first was slow by chance
        ([(100, 0.1), (400, 9.0)], 0.2),  # from one run: between 0.1 and 0.4
    ],
)
def test_seconds(rows: list[tuple[int, float]], expected: float):
    told = forecast_of(trials(*rows), 4)
    assert told is not None
    assert told.seconds == pytest.approx(expected)


def test_errors_fall_as_the_order_says():
    told = forecast_of(trials((100, 0.1), (200, 0.2), (400, 0.4)), 4)
    assert told is not None
    assert told.error == pytest.approx(400**-4, rel=1e-3)
    assert forecast_of(trials((100, 0.1), (200, 0.2)), 4).error is None  # type: ignore[union-attr]
    assert forecast_of(trials((100, 0.1)), 4) is None
