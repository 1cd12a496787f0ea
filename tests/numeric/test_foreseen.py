"""What a search for a step will do, foreseen from short runs: its runs, their steps, and what they take."""

import math

import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.candidates import predicted
from canon.numeric.foreseen import Costs, costs_of, runs_to_come
from canon.numeric.integrate import LONG_RUN
from canon.numeric.integrators import catalogue, separable
from canon.numeric.planner import run_for_accuracy
from canon.numeric.progress import Trial
from canon.numeric.step_search import Task

PENDULUM = separable(lambda p: p, lambda q: -jnp.sin(q))
STATE = (np.array([1.0]), np.array([0.3]))
LONG = 20_000.0
FREE = Costs(0.0, 1e-6)


def runs(*rows: tuple[int, float]) -> list[Trial]:
    return [Trial(steps, math.inf, seconds) for steps, seconds in rows]


@pytest.mark.parametrize(
    ("rows", "per_run", "per_step"),
    [
        ([(100, 3.0), (200, 5.0), (400, 9.0)], 1.0, 0.02),
        ([(100, 3.0), (200, 50.0), (400, 9.0), (800, 17.0)], 1.0, 0.02),  # one was slow by chance
        ([(100, 2.0), (200, 2.0), (400, 1.9)], 2.0, 0.0),  # nothing is seen of the steps
        ([(100, 1.0), (200, 2.0), (400, 4.0)], 0.0, 0.01),
    ],
)
def test_what_every_run_takes_and_what_every_step_takes(
    rows: list[tuple[int, float]], per_run: float, per_step: float
) -> None:
    found = costs_of(runs(*rows))
    assert found.per_run == pytest.approx(per_run)
    assert found.per_step == pytest.approx(per_step, abs=1e-12)


def test_of_a_single_run_twice_the_steps_take_half_way_between_once_and_twice_its_time() -> None:
    assert costs_of(runs((100, 3.0))).seconds(200) == pytest.approx(3 * math.sqrt(2))


def test_steps_of_a_long_run_keep_their_rounding_and_take_longer() -> None:
    costs = Costs(1.0, 1e-6, kept=1.5)
    assert costs.seconds(LONG_RUN - 1) == pytest.approx(2.0, rel=1e-5)
    assert costs.seconds(10 * LONG_RUN) == pytest.approx(16.0)
    assert costs.steps(16.0) == pytest.approx(10 * LONG_RUN)
    assert costs.steps(1.5) == pytest.approx(LONG_RUN / 2)


@pytest.mark.parametrize("whole", [1.0, 16.0])
def test_of_an_order_the_runs_are_foreseen_to_the_first_that_is_fine_enough(whole: float) -> None:
    # e(n) = C n^-4 over a window; over so many windows as make the whole with n steps in all: C whole (n/whole)^-4
    window = [Trial(n, 15 * 2.0**20 * n**-4, 0.0) for n in (64, 128, 256)]
    found = runs_to_come(window, whole, 4, 1e-9, first=64, samples=65, costs=FREE)
    needed = whole * (whole * 2.0**20 / 0.5e-9) ** (1 / 4)
    assert found[-1].steps == 64 * 2 ** math.ceil(math.log2(needed / 64))
    assert [run.steps for run in found] == [64 * 2**k for k in range(len(found))]
    assert sum(run.seconds for run in found) == pytest.approx(1e-6 * (2 * found[-1].steps - 64))


def test_what_takes_too_many_steps_is_not_foreseen() -> None:
    window = [Trial(n, n**-2.0, 0.0) for n in (64, 128)]
    assert not runs_to_come(window, 1.0, 2, 1e-30, first=64, samples=65, costs=FREE)


def test_a_search_makes_the_runs_that_were_foreseen() -> None:
    method = catalogue.method("nystrom6a")
    task = Task(PENDULUM, method, STATE, LONG, 5, 0.0)
    (foreseen,) = predicted(task, [method], 1e-9)
    made = run_for_accuracy(PENDULUM, method, STATE, duration=LONG, samples=5, accuracy=1e-9).trials
    assert foreseen.runs == len(made)
    assert foreseen.steps == made[-1].steps > 2 * 16_384  # more than a short run may have


def test_runs_that_blow_up_are_no_plateau_of_rounding() -> None:
    """With few steps a quartic oscillator is lost at once, in every run at the same sample: they agree, in nothing."""
    quartic = separable(lambda p: p, lambda q: -(q**3))
    found = run_for_accuracy(
        quartic, catalogue.method("nystrom6a"), STATE, duration=1000.0, samples=5, accuracy=1e-8
    )  # fmt: skip
    assert [trial.difference for trial in found.trials[:4]] == [math.inf, 0.0, 0.0, 0.0]
    assert found.reached
    assert not found.run.compensated
