"""Scenes with close approaches, run in coordinates in which a collision is no singularity."""

import json
import re
from typing import Any

import numpy as np
import pytest

from canon.errors import InputError
from canon.scenes.reader import read_scene_text
from canon.scenes.regularised import _kepler
from canon.scenes.simulate import Result, simulate

COMET = """
[[body]]
name = "comet"
mass = 2.0
position = [0.05, 0.0]
velocity = [0.0, 6.0]
[[effect]]
kind = "inverse_distance"
a = 2.0
[[effect]]
kind = "potential"
V = "y/50"
[run]
duration = 9.0
samples = 5
accuracy = 1e-9
integrator = "regularised"
monitor = ["energy", "angular_momentum", "volume", "symplecticity", "loop", "cartan", "reversibility"]
"""


def of(text: str) -> Result:
    return simulate(read_scene_text(text))


def without(text: str = COMET, accuracy: str = "1e-9") -> str:
    """The same without monitors."""
    return re.sub("monitor = .*", "", text).replace("1e-9", accuracy)


@pytest.mark.slow
def test_it_agrees_with_steps_in_time_itself() -> None:
    found, other = of(COMET), of(COMET.replace('integrator = "regularised"', 'integrator = "sofroniou_spaletta10"'))
    assert found.ok
    assert found.choice.method.name == "regularised stormer12"
    assert 0 < found.planned.error <= 1e-9
    assert found.q == pytest.approx(other.q, abs=1e-6)
    assert found.p == pytest.approx(other.p, abs=1e-5)
    energy, turning, volume, symplecticity, loop, cartan, reversibility = found.monitors
    assert energy.max_drift < energy.bound < 1e-8
    assert turning.expected == "broken by potential"
    for reading, most in ((volume, 1e-9), (symplecticity, 1e-8), (loop, 1e-12), (cartan, 1e-12), (reversibility, 1e-9)):
        assert reading.expected == "conserved"
        assert not reading.alarm
        assert 0 <= reading.max_drift <= min(reading.bound, most)
    assert found.operations is None


def test_a_fall_into_the_centre_goes_on() -> None:
    """From rest at −1: thrown back after π/√8, and there again after π/√2."""
    fall = '[[body]]\nmass = 1\nposition = [-1.0]\n[[effect]]\nkind = "inverse_distance"\na = 1.0\n'
    run = f'[run]\nduration = {np.pi / 2**0.5!r}\nsamples = 4\nintegrator = "regularised"\n'
    found = of(fall + run)
    assert found.ok
    assert found.q[:, 0] == pytest.approx([-1, found.q[1, 0], found.q[1, 0], -1], abs=1e-8)
    assert found.p[1, 0] > 0.5
    assert found.p[2, 0] == pytest.approx(-found.p[1, 0], abs=1e-8)
    ended = of(fall + run.replace('"regularised"', '"verlet"\naccuracy = 1e-3'))
    assert '"regularised" goes through' in ended.messages[0]


@pytest.mark.slow
def test_a_centre_elsewhere() -> None:
    """Moved by (0.3, −7): the same orbit, moved."""
    moved = COMET.replace("[0.05, 0.0]", "[0.35, -7.0]").replace("a = 2.0", "a = 2.0\ncentre = [0.3, -7.0]")
    moved = moved.replace("y/50", "(y + 7)/50")
    here, there = of(without()), of(without(moved))
    assert there.ok
    assert there.q[0].tolist() == [0.35, -7.0]
    assert there.p[0].tolist() == [0.0, 12.0]
    assert there.q == pytest.approx(here.q + np.array([0.3, -7.0]), abs=1e-7)


def test_the_centre_is_found() -> None:
    moved = COMET.replace("[0.05, 0.0]", "[0.35, -7.0]").replace("a = 2.0", "a = 2.0\ncentre = [0.3, -7.0]")
    kepler, centre = _kepler(read_scene_text(moved))
    assert centre.tolist() == [0.3, -7.0]
    assert kepler.strength == kepler.mass == 2
    u1, _, b = kepler.coordinates
    assert float(kepler.K.coeff(b).coeff(u1, 2)) == 1


@pytest.mark.slow
def test_of_two_centres_the_nearest_is_gone_round() -> None:
    two = without().replace(
        "[[effect]]", '[[effect]]\nkind = "inverse_distance"\na = 0.3\ncentre = [3, 1]\n[[effect]]', 1
    )
    found = of(two.replace("duration = 9.0", "duration = 2.0"))
    other = of(two.replace("duration = 9.0", "duration = 2.0").replace("regularised", "sofroniou_spaletta10"))
    assert found.ok
    assert found.q == pytest.approx(other.q, abs=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("accuracy = 1e-9", "step = 0.1", "ask for an accuracy"),
        ('"potential"\nV = "y/50"', '"damping"\nrate = 0.1', "no friction"),
        ('"potential"\nV = "y/50"', '"rotating_frame"\nOmega = 0.1', "nothing else of the momenta"),
        ("a = 2.0", "a = -2.0", "k > 0"),
        ('"regularised"', '"regularized"', "there is regularised"),
    ],
)
def test_what_it_does_not_run(old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=f"integrator: .*{message}"):
        of(COMET.replace(old, new))


def test_what_is_interrupted_is_gone_on_with(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the first run, and in a later one: with every bit of a run that was left alone."""
    monkeypatch.setattr("canon.numeric.regularised_orbit.PIECE", 16)
    scene = read_scene_text(without())
    whole = simulate(scene)
    looks = list[float]()

    def pressing(at: int) -> Any:
        def watch(done: float) -> None:
            looks.append(done)
            if len(looks) == at:
                raise KeyboardInterrupt

        return watch

    saved = list[Any]()
    part = simulate(scene, watch=pressing(2), keep=saved.append)
    assert part.planned.interrupted
    assert set(saved[-1]) >= {"times", "q", "p", "resume"}
    for at in (9, 40):
        part = simulate(scene, watch=pressing(at), resume=part.resumable)
        assert part.planned.interrupted
        assert not part.ok
    found = simulate(scene, resume=part.resumable)
    assert found.ok
    assert np.array_equal(found.q, whole.q)
    assert np.array_equal(found.p, whole.p)
    assert found.planned.error == whole.planned.error
    assert [t.steps for t in found.planned.trials] == [t.steps for t in whole.planned.trials]
    again = simulate(scene, resume=found.resumable)
    assert np.array_equal(again.q, whole.q)
    with pytest.raises(InputError, match="accuracy"):
        simulate(read_scene_text(without(accuracy="1e-8")), resume=part.resumable)
    with pytest.raises(InputError, match="another scene"):
        simulate(read_scene_text(without().replace("y/50", "y/51")), resume=part.resumable)
    header = json.loads(str(part.resumable["resume"]))
    figures = header["regularised"]
    wrong = [
        {"step": "nan"},
        {"step": "0x1p-3000"},
        {"runs": []},
        {"runs": [{**each, "steps": 0} for each in figures["runs"]]},
        {"runs": [{**each, "ended": 1} for each in figures["runs"]]},
        {"runs": [{**each, "engine": "steam"} for each in figures["runs"]]},
        {"current": {"done": 10**9, "ended": False}},
        {"current": {"done": 1, "ended": "no"}},
        {"current": 7},
        {"trials": []},
        {"trials": [[0, "inf", 1.0], *figures["trials"][1:]]},
        {"over": True},
    ]
    for change in wrong:
        damaged = {**header, "regularised": {**figures, **change}}
        with pytest.raises(InputError, match="damaged"):
            simulate(scene, resume={**part.resumable, "resume": np.array(json.dumps(damaged))})
    for name in part.resumable.keys() - {"resume"}:
        with pytest.raises(InputError, match="damaged"):
            simulate(scene, resume={**part.resumable, name: np.zeros((3, 3))})


def test_interrupted_it_keeps_what_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("canon.scenes.regularised.underway", lambda: lambda: True)
    monkeypatch.setattr("canon.numeric.regularised_orbit.PIECE", 16)
    found = of(without())
    assert not found.ok
    assert 1 <= len(found.q) < 5
    assert "interrupted at t" in found.messages[0]
