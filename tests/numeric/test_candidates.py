"""What integrators are predicted to cost, beside what they do: the cheapest first, and no trials for short runs."""

import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.candidates import GAIN, WORTH, Prediction, most_accurate, predicted, within
from canon.numeric.integrate import integrate
from canon.numeric.integrators import catalogue, separable
from canon.numeric.run_difference import distance
from canon.numeric.step_search import Task
from canon.scenes.examples import scene_text
from canon.scenes.methods import choose, chosen_for
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text
from canon.scenes.systems import load_system

PENDULUM = separable(lambda p: p, lambda q: -jnp.sin(q))
STATE = (np.array([1.0]), np.array([0.3]))
METHODS = [catalogue.method(name) for name in ("nystrom6a", "yoshida4", "nystrom8")]
ACCURACY = 1e-9


def task(duration: float) -> Task:
    return Task(PENDULUM, METHODS[0], STATE, duration, 5, 0.0)


@pytest.fixture(scope="module")
def long() -> list[Prediction]:
    """A run of a million periods, long enough for all candidates to be tried."""
    return predicted(task(6e6), METHODS, ACCURACY)


def test_the_one_of_least_work_comes_first_and_the_others_say_by_how_much(long: list[Prediction]) -> None:
    assert {each.method.name for each in long} == {each.name for each in METHODS}
    taken, *others = long
    assert taken.work >= WORTH
    assert not taken.why
    assert all(each.why for each in others)
    assert all(taken.work < each.work / GAIN for each in others)
    fourth = next(each for each in others if each.method.name == "yoshida4")
    assert fourth.order == pytest.approx(4, abs=0.2)
    assert fourth.work > 10 * taken.work


def test_the_predicted_number_of_steps_reaches_what_is_aimed_at() -> None:
    for each in predicted(task(100.0), METHODS, ACCURACY, compare=True):
        found, fine = (
            integrate(PENDULUM, each.method, STATE, duration=100.0, steps=count, samples=5)
            for count in (round(each.steps or 0), 8 * round(each.steps or 0))
        )
        assert each.error is not None
        assert 0.1 < distance(found, fine) / each.error < 10


def test_within_a_budget_an_order_low_enough_is_hopeless() -> None:
    taken, *others = most_accurate(task(6e6), METHODS, 60.0)
    assert all(each.steps and each.error and each.seconds == 60.0 for each in (taken, *others))
    fourth = next(each for each in others if each.method.name == "yoshida4")
    assert (fourth.error or 0.0) > 100 * (taken.error or 0.0)
    assert "times the error" in fourth.why


@pytest.mark.parametrize(
    ("seconds", "error"), [(10.0, 1e-3), (20.0, 1e-3 / 16), (5.0, 16e-3), (1e7, 2**-53 * 1e9**0.75)]
)
def test_of_more_seconds_the_error_falls_as_the_order_says_down_to_rounding(seconds: float, error: float) -> None:
    fourth = Prediction(catalogue.method("yoshida4"), 100, 4.0, steps=1e3, error=1e-3, seconds=10.0)
    found = within(fourth, seconds)
    assert found.error == pytest.approx(error, rel=0.02)
    assert found.steps == pytest.approx(100 * seconds)


def test_nothing_else_is_tried_for_a_short_run() -> None:
    taken, *others = predicted(task(10.0), METHODS, ACCURACY)
    assert taken.method is METHODS[0]
    assert taken.steps is not None
    assert all(each.steps is None and "not tried" in each.why for each in others)


def test_a_run_that_is_gone_on_with_keeps_its_method() -> None:
    scene = read_scene_text(scene_text(load_system("three_body")))
    problem = problem_of(scene.model)
    rule = choose(problem, ACCURACY, None)
    began = chosen_for(problem, task(1.0), scene.settings, rule, began_with="nystrom8")
    assert began.method.name == "nystrom8"
    assert not began.candidates
