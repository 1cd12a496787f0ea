"""A search for a step that is stopped anywhere, and gone on with, has every bit of one that wasn't."""

import json
from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError
from canon.numeric import integrate, step_search
from canon.numeric.integrators import separable
from canon.numeric.integrators.compositions import KAHAN_LI_6
from canon.numeric.planner import Planned, run_for_accuracy, run_with_step
from canon.numeric.progress import Packed, Progress, pack, unpack
from canon.numeric.step_search import Task

PENDULUM = separable(lambda p: p, lambda q: -jnp.sin(q))
STATE = (np.array([1.0]), np.array([0.3]))
SHARED = {"duration": 40.0, "samples": 41}


def stop_in(run: int):
    """A watch that presses Ctrl-C at its first look at the run of this number, of whose 40 chunks it is the first."""
    begun = 0

    def watch(part: float) -> None:
        nonlocal begun
        begun += part == 1 / 40
        if begun == run:
            raise KeyboardInterrupt

    return watch


def stop_at_the_end(part: float) -> None:
    """Presses Ctrl-C after the last step."""
    if part == 1:
        raise KeyboardInterrupt


def stored(progress: Progress) -> Packed:
    """What is left of a progress on disk."""
    packed = pack(progress)
    return Packed(json.loads(json.dumps(packed.figures)), {name: array.copy() for name, array in packed.arrays.items()})


def same_bits(one: Planned, other: Planned) -> bool:
    pairs = zip((*one.run.states, one.run.times), (*other.run.states, other.run.times), strict=True)
    figures = [(each.error, each.reached, each.run.steps, [t.difference for t in each.trials]) for each in (one, other)]
    return figures[0] == figures[1] and all(np.array_equal(a, b) for a, b in pairs)


@pytest.mark.parametrize("number", [1, 2, 4])
def test_a_search_for_an_accuracy(number: int) -> None:
    search = lambda **more: run_for_accuracy(PENDULUM, KAHAN_LI_6, STATE, accuracy=1e-10, **SHARED, **more)
    whole, part = search(), search(watch=stop_in(number))
    assert part.interrupted
    assert not part.reached
    packed = stored(part.progress)
    resumed = search(resume=lambda task: unpack(packed, task.begin))
    assert same_bits(whole, resumed)
    again = stored(resumed.progress)
    assert same_bits(whole, search(resume=lambda task: unpack(again, task.begin)))


@pytest.mark.parametrize("number", [1, 2])
def test_a_run_with_a_fixed_step(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """With what its additions round away, which is kept as in long runs."""
    monkeypatch.setattr(integrate, "LONG_RUN", 1000)
    run = lambda **more: run_with_step(PENDULUM, KAHAN_LI_6, STATE, step=0.01, **SHARED, **more)
    whole, part = run(), run(watch=stop_in(number))
    assert part.run.compensated
    assert part.progress.current is not None
    assert any(np.any(np.asarray(leaf)) for leaf in jax.tree.leaves(part.progress.current.carry[1]))
    packed = stored(part.progress)
    assert same_bits(whole, run(resume=lambda task: unpack(packed, task.begin)))


def test_a_run_that_is_stopped_at_its_very_end_is_whole() -> None:
    """What was stopped is the estimate of its error, which is made when it is gone on with."""
    part = run_with_step(PENDULUM, KAHAN_LI_6, STATE, step=0.01, **SHARED, watch=stop_at_the_end)
    assert part.run.completed == 41
    assert not part.interrupted
    assert part.error is None


def test_what_is_kept_on_the_way_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    """As after a process that was killed: only what was kept last is left."""
    monkeypatch.setattr(step_search, "KEEP_EVERY", 0.0)
    monkeypatch.setattr(step_search, "KEEP_SHARE", 0.0)
    kept: list[Packed] = []
    search = lambda **more: run_for_accuracy(PENDULUM, KAHAN_LI_6, STATE, accuracy=1e-8, **SHARED, **more)
    whole = search(keep=lambda progress: kept.append(stored(progress)))
    assert len(kept) > len(whole.trials)
    for packed in (kept[0], kept[len(kept) // 2], kept[-1]):
        assert same_bits(whole, search(resume=lambda task, packed=packed: unpack(packed, task.begin)))


def test_a_budget_ends_a_run_and_a_new_one_goes_on_with_it() -> None:
    search = lambda **more: run_for_accuracy(PENDULUM, KAHAN_LI_6, STATE, accuracy=None, **SHARED, **more)
    part = search(budget=-1.0)
    assert part.reason == step_search.BUDGET_USED
    assert part.progress.current is not None
    packed = stored(part.progress)
    further = search(budget=100.0, resume=lambda task: unpack(packed, task.begin))
    assert further.error is not None
    assert further.error < 1e-9
    assert same_bits(replace(further, trials=()), replace(search(budget=100.0), trials=()))


def test_a_budget_leaves_time_for_what_comes_after_the_run() -> None:
    search = lambda **more: run_for_accuracy(PENDULUM, KAHAN_LI_6, STATE, accuracy=None, **SHARED, **more)
    found = search(budget=100.0, reserve=lambda seconds: 1000.0)
    assert found.reason == step_search.BUDGET_USED
    assert len(found.trials) == 1
    assert found.run.completed == 41


def test_what_is_damaged_is_refused() -> None:
    part = run_for_accuracy(PENDULUM, KAHAN_LI_6, STATE, accuracy=1e-10, watch=stop_in(3), **SHARED)
    task = Task(PENDULUM, KAHAN_LI_6, STATE, 40.0, 41, 0.0)
    sound = stored(part.progress)
    assert unpack(sound, task.begin).trials
    name = next(iter(sound.arrays))
    runs = sound.figures["runs"]
    for figures, arrays in (
        ({}, sound.arrays),
        (sound.figures, {}),
        (sound.figures, {**sound.arrays, name: np.zeros(7)}),
        (sound.figures, {**sound.arrays, name: sound.arrays[name].astype(np.float32)}),
        ({**sound.figures, "finished": 7}, sound.arrays),
        ({**sound.figures, "runs": [{**runs[0], "done": 10**9}, *runs[1:]]}, sound.arrays),
        ({**sound.figures, "runs": [{**runs[0], "steps": 1.5}, *runs[1:]]}, sound.arrays),
        ({**sound.figures, "trials": "none"}, sound.arrays),
        ({**sound.figures, "agreed": []}, sound.arrays),
    ):
        with pytest.raises(InputError, match="damaged"):
            unpack(Packed(figures, arrays), task.begin)
