"""Scenes beside an integrator that shares no line with this package; skipped where it isn't installed."""

import sys

import numpy as np
import pytest
import sympy as sp

from canon.errors import InputError
from canon.numeric.external import external_orbit
from canon.scenes.examples import scene_text
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.systems import load_system

q, p, t = (sp.Symbol(name, real=True) for name in "qpt")


def test_without_the_package_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(InputError, match="heyoka"):
        external_orbit(p**2 + q**2, ((q,), (p,), t), [1.0], [0.0], [0.0, 1.0])


def test_a_driven_and_damped_oscillator() -> None:
    pytest.importorskip("heyoka")
    times = np.linspace(0, 3, 7)
    found, _ = external_orbit(p**2 / 2 + q**2 / 2 - q, ((q,), (p,), t), [1.0], [1.0], times, [-p / 5 + sp.exp(-t)])
    x = sp.Function("x")
    t0 = sp.Symbol("t0")
    equation = x(t0).diff(t0, 2) + x(t0).diff(t0) / 5 + x(t0) - 1 - sp.exp(-t0)
    exact = sp.dsolve(equation, x(t0), ics={x(0): 1, x(t0).diff(t0).subs(t0, 0): 1}).rhs
    assert found[:, 0] == pytest.approx([float(exact.subs(t0, time)) for time in times], abs=1e-13)


@pytest.mark.parametrize("name", ["pendulum", "kepler", "three_body", "spherical_pendulum", "charge_in_uniform_fields"])
def test_scenes_agree_with_it(name: str) -> None:
    pytest.importorskip("heyoka")
    scene = read_scene_text(scene_text(load_system(name)))
    result = simulate(scene)
    model = scene.model
    places, momenta = external_orbit(model.H, (model.q, model.p, model.t), scene.q, scene.p, result.times)
    for ours, theirs in ((result.q, places), (result.p, momenta)):
        assert np.abs(ours - theirs).max() < 10 * (scene.settings.accuracy or 1e-9) * np.abs(theirs).max()
