"""Strings: when they go slack and taut, by the parabola between; what a jerk takes away; how they differ from rods."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from canon.cli.main import main
from canon.errors import InputError
from canon.numeric.integrators.catalogue import CONSTRAINED
from canon.numeric.integrators.yoshida import VERLET
from canon.numeric.operations import operations_per_step
from canon.scenes.monitors import Flow, Reading
from canon.scenes.monitors.arcs import read_arcs
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate

G = 9.81
BOB = """
[[body]]
name = "bob"
mass = 2.0
position = [0.0, -1.0]
velocity = [{speed}, 0.0]
[[effect]]
kind = "uniform_gravity"
g = 9.81
[[effect]]
kind = "{kind}"
length = 1.0
[run]
duration = {duration}
samples = 21
"""


def run(text: str, *monitors: str) -> tuple[Result, dict[str, Reading]]:
    scene = read_scene_text(text)
    result = simulate(replace(scene, settings=replace(scene.settings, monitors=monitors)))
    assert result.ok, result.messages
    return result, {reading.name: reading for reading in result.monitors}


def test_a_bob_that_is_thrown_too_slowly() -> None:
    """6.5, E18: the tension m v² + m g cos θ vanishes at cos θ = (2g − v²)/3g; the string is taut again after the
    time 4 v_y/g of the parabola, and takes the radial part of the velocity.
    """
    result, found = run(BOB.format(speed=6.5, kind="string", duration=1.5), "energy", "constraint", "volume")
    slack, taut = result.events
    assert (slack.taut, taut.taut, slack.lost) == (False, True, 0.0)
    c = (2 * G - 6.5**2) / (3 * G)
    s, v = np.sqrt(1 - c * c), np.sqrt(-G * c)
    assert taut.time - slack.time == pytest.approx(4 * v * s / G, abs=1e-9)
    span = 4 * v * s / G
    place = np.array([s + v * c * span, -c + v * s * span - G * span**2 / 2])
    velocity = np.array([v * c, v * s - G * span])
    assert np.linalg.norm(place) == pytest.approx(1, abs=1e-14)
    assert taut.lost == pytest.approx(2.0 / 2 * (place @ velocity) ** 2, abs=1e-7)
    flying = (result.times > slack.time) & (result.times < taut.time)
    t = result.times[flying] - slack.time
    assert np.allclose(result.q[flying, 1], -c + v * s * t - G * t * t / 2, atol=1e-8)
    assert np.hypot(*result.q[flying].T).max() < 1
    assert found["energy"].expected == "broken by string"
    assert found["energy"].extra["predicted"] == pytest.approx(found["energy"].initial - taut.lost)
    assert found["constraint"].max_drift < 1e-12
    assert found["volume"].expected == "broken by string"
    assert found["volume"].max_drift < found["volume"].bound < 1e-10
    assert "of 3 arcs without an event" in found["volume"].extra["note"]


@pytest.mark.slow
def test_an_arc_is_seen_by_itself() -> None:
    """The bound motion and the flight each have an own surface; a step that keeps neither is an alarm."""
    text = BOB.format(speed=6.5, kind="string", duration=1.2)
    result, _ = run(text.replace("samples = 21", "samples = 21\nstep = 0.02"))
    scene = result.scene
    times, q, p = result.times, result.q, result.p
    value = result.problem.value
    flow = Flow(scene.model, value, result.choice.method, result.planned.run, result.planned.good, 1e-9)
    arcs = []

    def read(part: Flow, *_: object) -> Reading:
        arcs.append((len(part.model.constraints), part.jacobian))
        return Reading(
            "volume", "conserved", 0.0, 0.0, 0.0 if len(arcs) == 1 else 2.0, 1.0, "" if len(arcs) == 1 else "!"
        )

    seen = read_arcs(read, flow, times, q, p)
    assert [held for held, _ in arcs] == [1, 0]
    assert (seen.alarm, seen.max_drift) == ("!", 2.0)
    # in flight q moves by p t/m, and gravity moves all neighbours alike
    flight = arcs[1][1]
    assert np.allclose(flight[:2, :2], np.eye(2), atol=1e-12)
    assert flight[0, 2] == pytest.approx((times[-1] - times[np.flatnonzero(times > result.events[0].time)[0]]) / 2.0)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [3.0, 7.5])
def test_a_string_that_is_never_slack_is_a_rod(speed: float) -> None:
    """Below the horizontal, and fast enough to go round."""
    text = BOB.format(speed=speed, kind="string", duration=1.0)
    string, found = run(text, "energy")
    assert string.events == ()
    assert found["energy"].expected == "conserved"
    rod, _ = run(text.replace('"string"', '"rod"'))
    assert np.allclose(string.q, rod.q, atol=1e-9)


@pytest.mark.slow
def test_a_jerk_at_the_very_beginning() -> None:
    """At full length outwards: the radial half of (1, 1) is lost at once, and the other goes on."""
    text = BOB.format(speed=1.0, kind="string", duration=0.5).replace("[1.0, 0.0]", "[1.0, -1.0]")
    result, found = run(text, "energy")
    (jerk,) = result.events
    assert (jerk.time, jerk.taut, jerk.lost) == (0.0, True, pytest.approx(1.0, abs=1e-14))
    rod, _ = run(BOB.format(speed=1.0, kind="rod", duration=0.5))
    assert np.allclose(result.q, rod.q, atol=1e-9)
    assert found["energy"].expected == "broken by string"


@pytest.mark.slow
def test_two_bodies_pull_each_other() -> None:
    """A string that is slack at first: the jerk is between the two, and keeps their momentum; then they turn."""
    text = """
[[body]]
mass = 1.0
position = [0, 0]
velocity = [0, 1]
[[body]]
mass = 3.0
position = [1.2, 0]
velocity = [1, 0]
[[effect]]
kind = "string"
length = 2.0
[run]
duration = 2.0
samples = 9
monitor = ["momentum", "angular_momentum", "energy"]
"""
    result = simulate(read_scene_text(text))
    assert result.ok, result.messages
    (taut,) = result.events
    found = {reading.name: reading for reading in result.monitors}
    assert found["momentum"].expected == found["angular_momentum"].expected == "conserved"
    # |(1.2 + t, −t)| = 2
    assert taut.time == pytest.approx((-2.4 + np.sqrt(2.4**2 + 8 * (4 - 1.44))) / 4, abs=1e-12)
    along = np.array([1.2 + taut.time, -taut.time]) / 2
    assert taut.lost == pytest.approx(0.75 / 2 * (along @ [1, -1]) ** 2, abs=1e-12)
    apart = np.linalg.norm(result.q[:, 2:] - result.q[:, :2], axis=1)
    assert np.allclose(apart[result.times > taut.time], 2, atol=1e-12)


def test_only_what_is_called_for() -> None:
    """Without a string there is no search for events; a rod beside none costs its multiplier alone."""

    def operations(text: str) -> int:
        scene = read_scene_text(text)
        method = next(each for each in CONSTRAINED if each.name == "rattle")
        problem = problem_of(scene.model).value
        method = method if scene.model.constraints else VERLET
        return operations_per_step(problem, method, (np.array(scene.q), np.array(scene.p)))

    string = BOB.format(speed=1.0, kind="string", duration=1.0)
    rod = string.replace('"string"', '"rod"')
    free = rod[: rod.index('[[effect]]\nkind = "rod"')] + "[run]\nduration = 1.0\n"
    pulled = free + '[[effect]]\nkind = "spring"\nk = 1\n'
    assert operations(free) < operations(rod) < operations(string) / 2
    assert operations(free) < operations(pulled) < operations(rod + '[[effect]]\nkind = "spring"\nk = 1\n')
    damped = operations(rod + '[[effect]]\nkind = "damping"\nrate = 0.1\n')
    assert operations(rod) < damped < operations(rod) + 120


@pytest.mark.slow
def test_the_record_and_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "string.toml"
    path.write_text(BOB.format(speed=0, kind="string", duration=0.3).replace("-1.0]", "-0.9]"))
    assert main(["simulate", str(path), "--json"]) == 0
    (event,) = json.loads(capsys.readouterr().out)["events"]
    assert event["becomes"] == "taut"
    assert event["time"] == pytest.approx(np.sqrt(0.2 / G), abs=1e-12)
    assert event["energy_lost"] == pytest.approx(2 * G * 0.1, abs=1e-10)
    stretched = BOB.format(speed=1, kind="string", duration=1).replace("-1.0]", "-1.1]")
    with pytest.raises(InputError, match="a string, is stretched by"):
        simulate(read_scene_text(stretched))
