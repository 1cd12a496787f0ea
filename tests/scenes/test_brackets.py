"""Brackets of integrals along the orbit: Kepler's algebra, and what a perturbation breaks."""

import numpy as np
import pytest

from canon.errors import InputError
from canon.scenes.brackets import brackets_along
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate

PLANET = """
[[body]]
mass = 1.0
position = [1.0, 0.0]
velocity = [0.1, 1.2]
[[effect]]
kind = "inverse_distance"
a = 1.0
{more}
[run]
duration = 5.0
samples = 11
"""
ROD = '[[effect]]\nkind = "rod"\nanchor = [0.0, 0.0]\nlength = 1.0\n'


def test_keplers_algebra() -> None:
    """{H, M} = {H, A} = 0, {M, A_x} = A_y, {M, A_y} = −A_x, {A_x, A_y} = −2mH M. Goldstein, 9.7."""
    result = simulate(read_scene_text(PLANET.format(more="")))
    found = brackets_along(result)
    x, p = result.q.T, result.p.T
    r, M = np.hypot(*x), x[0] * p[1] - x[1] * p[0]
    A = np.array([p[1], -p[0]]) * M - x / r
    H = (p**2).sum(axis=0) / 2 - 1 / r
    for name in ("M", "A_x", "A_y"):
        assert np.abs(found["H", name]).max() < 1e-14
    assert np.allclose(found["M", "A_x"], A[1], rtol=0, atol=1e-13)
    assert np.allclose(found["M", "A_y"], -A[0], rtol=0, atol=1e-13)
    assert np.allclose(found["A_x", "A_y"], -2 * H * M, rtol=0, atol=1e-13)


def test_a_perturbation_shows() -> None:
    result = simulate(read_scene_text(PLANET.format(more='[[effect]]\nkind = "inverse_square"\nc = 0.01\n')))
    found = brackets_along(result)
    assert np.abs(found["H", "M"]).max() < 1e-14
    assert np.abs(found["H", "A_x"]).max() > 1e-3


def test_no_brackets_on_a_constraint_surface() -> None:
    swinging = PLANET.format(more=ROD).replace("[0.1, 1.2]", "[0.0, 1.2]")
    with pytest.raises(InputError, match="canonical variables"):
        brackets_along(simulate(read_scene_text(swinging)))
