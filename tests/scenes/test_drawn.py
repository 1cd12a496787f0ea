"""A figure's lines have no corners: states between the stored ones, of the same motion."""

import numpy as np

from canon.report.drawn import drawn
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate

SPRING = """
[[body]]
mass = 1.0
position = [1.0, 0.0]
velocity = [0.0, 0.5]

[[effect]]
kind = "spring"
k = 1.0
length = 0.2

[run]
"""


def test_a_coarse_run_is_drawn_with_the_states_between() -> None:
    result = simulate(read_scene_text(SPRING + "duration = 40.0\nsamples = 21\nstep = 0.1\nmonitor = []\n"))
    shown = drawn(result)
    finer = (len(shown.times) - 1) // 20
    assert finer >= 10
    assert np.allclose(shown.times[::finer], result.times)
    assert np.allclose(shown.q[::finer], result.q, atol=1e-12)
    assert np.abs(np.diff(shown.q, axis=0)).max() < 0.2, "a tenth of a unit of time between two of them"


def test_a_smooth_run_is_drawn_as_it_is() -> None:
    result = simulate(read_scene_text(SPRING + "duration = 2.0\nsamples = 81\nstep = 0.01\nmonitor = []\n"))
    assert drawn(result) is result
