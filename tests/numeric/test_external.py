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
from tests.short_scenes import HENON

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


CHAOS = f"""{HENON}duration = 20.0
samples = 6
integrator = "heyoka"
monitor = ["energy", "volume"]
"""


def test_as_an_integrator_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(InputError, match=r"integrator: this needs the package heyoka: pip install"):
        simulate(read_scene_text(CHAOS))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (CHAOS.replace("samples", "step = 0.1\nsamples"), "chooses each step by itself"),
        (
            '[[body]]\nmass = 1\nposition = [1, 0]\n[[effect]]\nkind = "rod"\nlength = 1\n'
            '[run]\nduration = 1\nintegrator = "heyoka"\n',
            "no rigid bodies, skates, rods",
        ),
    ],
)
def test_what_it_does_not_run(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        simulate(read_scene_text(text))


def test_as_an_integrator() -> None:
    """The same interface: states, an estimate of the error that holds, monitors of the state, reasons for others."""
    pytest.importorskip("heyoka")
    theirs = simulate(read_scene_text(CHAOS))
    ours = simulate(read_scene_text(CHAOS.replace('integrator = "heyoka"', "accuracy = 1e-12")))
    assert theirs.ok
    assert np.abs(theirs.q - ours.q).max() < 1e-11
    assert 0 < theirs.planned.error < 1e-12
    assert theirs.operations is None
    energy, volume = theirs.monitors
    assert energy.max_drift < energy.bound < 1e-10
    assert "not ours to follow" in volume.extra["note"]
    fall = '[[body]]\nmass = 1\nposition = [-1.0]\n[[effect]]\nkind = "inverse_distance"\na = 1.0\n'
    ended = simulate(read_scene_text(fall + '[run]\nduration = 3.0\nsamples = 31\nintegrator = "heyoka"\n'))
    assert "singularity" in ended.messages[0]
    # a fall from rest at 1 takes π/√8
    assert ended.times[-1] == pytest.approx(1.1, abs=0.11)


def test_interrupted_it_keeps_what_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("heyoka")
    looks = iter([False] * 5 + [True] * 1000)
    monkeypatch.setattr("canon.numeric.external.underway", lambda: lambda: next(looks))
    found = simulate(read_scene_text(CHAOS))
    assert not found.ok
    assert 1 <= len(found.q) < found.scene.settings.samples
    assert "interrupted at t" in found.messages[0]
