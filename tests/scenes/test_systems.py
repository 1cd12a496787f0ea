"""Every system of the catalogue runs from its scene file, and its monitors behave as the ledger says."""

import json
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from canon.cli.main import main
from canon.errors import InputError
from canon.numeric import engines
from canon.scenes.examples import scene_text
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.systems import load_system, system_names
from tests.scenes.ledger import REFERENCES, deviations
from tests.short_scenes import PENDULUM

SYSTEMS = sorted(REFERENCES)
LEDGER = {f"S{k:02}" for k in range(1, 32)} | {"S33", "S39"}
Capture = pytest.CaptureFixture[str]
BROKEN = {
    ("damped_oscillator", "energy"): "broken by kinetic, spring",
    ("forced_oscillator", "energy"): "broken by driving",
    ("spring_on_a_cart", "energy"): "broken by spring",
}


def test_the_ledgers_systems_are_there() -> None:
    assert {load_system(name).ledger for name in system_names()} == LEDGER
    assert len(system_names()) == len(LEDGER)
    assert [*system_names()] == SYSTEMS


@pytest.mark.slow
@pytest.mark.parametrize("name", system_names())
def test_a_system_runs_and_conserves_what_it_should(name: str, tmp_path: Path, capsys: Capture) -> None:
    """From the file that `canon scenes` prints, by the command line; and the states agree with textbook formulas."""
    assert main(["scenes", name]) == 0
    path = tmp_path / f"{name}.toml"
    path.write_text(capsys.readouterr().out.replace("accuracy = 1e-9", "accuracy = 1e-8\nsamples = 30"))
    status = main(["simulate", str(path), "--json"])
    record = json.loads(capsys.readouterr().out)
    assert status == 0, record["messages"]
    assert record["error_estimate"] <= 1e-8
    for monitor, reading in record["monitors"].items():
        assert reading["expected"] == BROKEN.get((name, monitor), "conserved")
    off = deviations(name, record)
    assert max(off.values()) < 2e-7, off
    assert all(len(record[word]) == 30 for word in ("times", "q", "p", *load_system(name).own))


@pytest.mark.parametrize(
    ("name", "degrees"), [("pendulum", 1), pytest.param("linear_chain", 3, marks=pytest.mark.slow)]
)
def test_friction_contracts_as_the_ledger_says(name: str, degrees: int) -> None:
    """det M = exp(−2 n λ t), a loop by exp(−2λt), of n degrees of freedom, each with the force −2λp."""
    text = scene_text(load_system(name)).replace("samples = 200", "").split("monitor =")[0]
    text = text.replace("duration = 20.0", "duration = 2.0").replace("duration = 30.0", "duration = 2.0")
    text += 'samples = 5\nmonitor = ["energy", "volume", "loop"]\n[[effect]]\nkind = "damping"\nrate = 0.3\n'
    result = simulate(read_scene_text(text))
    energy, volume, loop = result.monitors
    assert result.ok, result.messages
    assert energy.expected == volume.expected == loop.expected == "broken by damping"
    assert volume.final is not None
    assert loop.initial is not None
    assert 1 + volume.final == pytest.approx(np.exp(-2 * degrees * 0.3 * 2.0), rel=1e-9)
    assert loop.final == pytest.approx(loop.initial * np.exp(-2 * 0.3 * 2.0), rel=1e-6)


def kepler(parameters: str) -> str:
    return scene_text(load_system("kepler")).replace("{ m = 1.0, a = 1.0 }", parameters)


def test_parameters_and_functions_are_read() -> None:
    scene = read_scene_text(kepler('{ m = 2, a = "pi/4" }'))
    assert str(scene.model.H.free_symbols and scene.model.terms[1].expr).startswith("-pi/(4*sqrt(")
    text = scene_text(load_system("central_potential")).replace('"-1/r"', '"r**4"')
    assert "r**4" in str(read_scene_text(text).model.H)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (kepler("{ mass = 1.0 }"), "unknown key 'mass'"),
        (kepler("{ m = -1.0 }"), "a number above 0"),
        (kepler("{}").replace('"kepler"', '"keppler"'), "there is no system 'keppler': did you mean 'kepler'?"),
        (kepler("{}").replace("q = [0.4, 0, 0]", "q = [0.4, 0]"), "2 components where 3 are expected"),
        (kepler("{}").replace("q = [0.4, 0, 0]", ""), "the key 'q' is missing"),
        (scene_text(load_system("central_potential")).replace('"-1/r"', '"theta"'), "unknown name 'theta'"),
        (kepler("{}") + "[[effect]]\nkind = 'spring'\nk = 1\n", "acts on bodies, not on a system"),
    ],
)
def test_bad_input_is_told_from_good(text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert says in str(caught.value)


def test_the_damped_oscillator_twice() -> None:
    """Caldirola and Kanai: the same places as with the effect, and exp(2λt) between the momenta."""
    one = simulate(read_scene_text(scene_text(load_system("damped_oscillator"))))
    text = scene_text(load_system("harmonic_oscillator")) + '[[effect]]\nkind = "damping"\nrate = 0.1\n'
    other = simulate(read_scene_text(text))
    w = np.sqrt(1 - 0.01)
    exact = np.exp(-0.1 * one.times) * (np.cos(w * one.times) + 0.1 / w * np.sin(w * one.times))
    assert np.allclose(one.q[:, 0], exact, atol=1e-9)
    assert np.allclose(other.q[:, 0], exact, atol=1e-9)
    assert np.allclose(np.exp(-0.2 * one.times) * one.p[:, 0], other.p[:, 0], atol=1e-9)
    assert other.monitors[0].expected == "broken by damping"


def test_resonance_and_the_separatrix() -> None:
    """The forced oscillator at resonance from rest: q = f t sin(t)/2; a pendulum on its separatrix climbs for ever."""
    text = scene_text(load_system("forced_oscillator")).replace("gam = 0.9", "gam = 1")
    result = simulate(read_scene_text(text))
    assert np.allclose(result.q[:, 0], 0.25 * result.times * np.sin(result.times), atol=2e-8)
    text = scene_text(load_system("pendulum")).replace("g = 9.81", "g = 1.0")
    text = text.replace("[3.1]", "[0]").replace("p = [0]", "p = [2]").replace("20.0", "6.0")
    result = simulate(read_scene_text(text))
    assert np.allclose(np.tan((result.q[:, 0] + np.pi) / 4), np.exp(result.times), rtol=1e-6)


def test_what_an_engine_costs_to_load_is_counted_with_compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = read_scene_text(PENDULUM)
    usual = simulate(scene).seconds[0]

    def slowly(engine: Any, *rest: Any) -> Any:
        until = time.process_time() + usual + 0.1
        while time.process_time() < until:
            pass
        return engines.settled(engine, *rest)

    monkeypatch.setattr("canon.scenes.simulate.settled", slowly)
    assert simulate(scene).seconds[0] > usual + 0.1
