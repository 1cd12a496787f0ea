"""Point bodies and rigid bodies in one scene move as they do in scenes of their own."""

from dataclasses import replace

import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.integrators.side_by_side import SideBySide
from canon.scenes.monitors.beside import put_together
from canon.scenes.monitors.reading import Reading
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.states import named_states

POINTS = """
[[body]]
name = "bob"
mass = 2.0
position = [0.0, -1.0]
velocity = [0.8, 0.0]
"""
TOP = """
[[rigid_body]]
name = "top"
moments = [1.0, 1.0, 0.5]
euler = [0.1, 0.7, 0.3]
angular_velocity = [0.3, 0.2, 8.0]
"""
ROD = """
[[effect]]
kind = "rod"
length = 1.0
[[effect]]
kind = "uniform_gravity"
g = 9.81
"""
DAMPED = '[[effect]]\nkind = "damping"\nrate = 0.1\n'
WEIGHT = '[[effect]]\nkind = "gravity_torque"\nm = 2.0\ng = 9.81\nl = 0.3\n'
RUN = "[run]\nduration = 1.0\nstep = 0.01\nsamples = 5\nmonitor = {}\n"
ALL = ["energy", "angular_momentum", "casimir", "constraint", "volume"]


@pytest.mark.slow
def test_each_moves_as_alone_and_the_monitors_know_of_both() -> None:
    """A pendulum on a rod with friction beside a heavy top, to the last bit; det M is the product of both."""
    both = simulate(read_scene_text(POINTS + TOP + ROD + WEIGHT + DAMPED + RUN.format(ALL)))
    assert both.ok, both.messages
    bob = simulate(read_scene_text(POINTS + ROD + DAMPED + RUN.format(["angular_momentum"])))
    top = simulate(read_scene_text(TOP + WEIGHT + RUN.format(["angular_momentum"])))
    assert np.array_equal(np.hstack([both.q[:, :2], both.p[:, :2]]), np.hstack([bob.q, bob.p]))
    assert np.allclose(np.hstack([both.q[:, 2:], both.p[:, 2:]]), np.hstack([top.q, top.p]), atol=1e-12)
    states, alone = named_states(both), {**named_states(bob), **named_states(top)}
    assert states.keys() == alone.keys()
    for word, table in alone.items():
        for name, rows in table.items():
            assert np.allclose(states[word][name], rows, atol=1e-12)
    found = {reading.name: reading for reading in both.monitors}
    assert found["volume"].extra["predicted"] == pytest.approx(np.expm1(-0.2), rel=1e-6)
    M = [each.monitors[0].final for each in (bob, top)]
    assert found["angular_momentum"].final == pytest.approx([*M[1][:2], M[1][2] + M[0]])
    assert found["casimir"].expected == "broken by gravity_torque"


def test_what_is_computed_is_both_and_no_more() -> None:
    scene = read_scene_text(POINTS + TOP + RUN.format([]))
    result = simulate(scene)
    assert isinstance(result.problem.value, SideBySide)
    assert result.problem.exact
    assert (result.q.shape, result.p.shape) == ((5, 2 + 4), (5, 2 + 3))
    apart = [simulate(read_scene_text(text + RUN.format([]))).operations for text in (POINTS, TOP)]
    assert result.operations == sum(apart)


def test_readings_are_put_together() -> None:
    """Loops add up, volumes multiply, the largest defect counts; an alarm of one part is one of the whole."""
    loops = [
        Reading("loop", "conserved", 1.0, 1.5, 0.5, 0.1, "drifted"),
        Reading("loop", "broken by x", 2.0, 1.0, 0.1, 0.2),
    ]
    loop = put_together([replace(loops[0], max_drift=0.01, alarm=""), replace(loops[1], extra={"predicted": 1.1})])
    assert (loop.initial, loop.final, loop.expected, loop.alarm) == (3.0, 2.5, "broken by x", "")
    assert (loop.max_drift, loop.bound) == pytest.approx((0.11, 0.3))
    assert loop.extra == {"predicted": pytest.approx(2.1)}
    assert put_together(loops).alarm == "drifted"
    volumes = [Reading("volume", "conserved", 0.0, -0.5, 0.5, 1.0), Reading("volume", "conserved", 0.0, 0.2, 0.2, 1.0)]
    assert put_together(volumes).final == pytest.approx(0.5 * 1.2 - 1)
    assert put_together([*volumes, Reading("volume", "conserved", 0.0, None, None)]).final is None
    defects = [Reading("symplecticity", "conserved", x, x, x, 1.0) for x in (1e-3, 1e-9)]
    assert put_together(defects).max_drift == 1e-3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('dynamics = "relativistic"\n' + POINTS + TOP, "relativistic dynamics are those of point bodies"),
        (POINTS.replace("bob", "top") + TOP, "a body and a rigid body are both called 'top'"),
        (POINTS + TOP + WEIGHT + 'bodies = ["bob"]\n', "there is no body 'bob'"),
        (POINTS + TOP + ROD.replace("length = 1.0", 'length = 1.0\nbodies = ["top"]', 1), "there is no body 'top'"),
        (POINTS + TOP + '[[effect]]\nkind = "refractive_index"\nn = "1.5"\n', "give each its own scene"),
    ],
)
def test_what_does_not_go_together_is_said(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message.replace("(", r"\(")):
        read_scene_text(text + RUN.format([]))
