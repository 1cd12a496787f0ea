"""A scatterer reports deflections, and a beam's cross-section: Rutherford's formulas against the orbits themselves."""

import json
from math import pi

import numpy as np
import pytest

from canon.cli.main import main
from canon.errors import InputError
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate

BODY = '[[body]]\nname = "{name}"\nmass = 2.0\nposition = [-{far}, {b}]\nvelocity = [1.5, 0.0]\n'
EFFECT = '[[effect]]\nkind = "scatterer"\npotential = "{V}"\n'
RUN = "[run]\nduration = {duration}\nsamples = 3\naccuracy = 1e-9\n"


def beam(V: str, places: tuple[float, ...], far: float = 100.0, more: str = "") -> str:
    bodies = "".join(BODY.format(name=f"n{k}", far=far, b=b) for k, b in enumerate(places))
    return bodies + EFFECT.format(V=V) + more + RUN.format(duration=2 * far / 1.5)


def run(*given: object) -> Result:
    return simulate(read_scene_text(beam(*given)))  # pyright: ignore[reportArgumentType]


def test_orbits_turn_as_is_said() -> None:
    """A Yukawa potential has no far tail: what was seen in the run is the whole deflection."""
    result = run("exp(-r)/r", (0.3, 1.0), 30.0)
    assert result.ok
    for seen in result.scattering.values():
        assert seen.deflection is not None
        assert seen.turned == pytest.approx(seen.deflection.angle, abs=1e-7)
        assert seen.cross_section is not None
    assert result.scattering["n0"].impact_parameter == pytest.approx(0.3, rel=1e-11)
    assert result.scattering["n0"].energy == pytest.approx(2.25, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("k", [1.0, -1.0])
def test_coulomb_scattering_is_rutherfords(k: float) -> None:
    """The state at a finite distance has the energy and moment of the asymptotic one."""
    result = run(f"{k}/r", (0.4,), 1e4)
    seen = result.scattering["n0"]
    E = 2.25 + k / np.hypot(1e4, 0.4)
    b = 2.0 * 0.4 * 1.5 / np.sqrt(4 * E)
    assert seen.deflection is not None
    assert seen.deflection.angle == pytest.approx(2 * np.arctan(k / (2 * E * b)), rel=1e-14)
    assert seen.turned == pytest.approx(abs(seen.deflection.angle), abs=2e-4)
    assert seen.cross_section is None
    assert seen.angle == pytest.approx(abs(seen.deflection.angle))


@pytest.mark.slow
def test_where_nothing_is_known_nothing_is_said() -> None:
    other = '[[effect]]\nkind = "damping"\nrate = 0.001\n'
    result = run("1/r", (0.4,), 20.0, other)
    assert result.scattering["n0"].deflection is None
    assert 0 < result.scattering["n0"].turned < pi
    bound = beam("-1/r", (0.4,), 1.0).replace("velocity = [1.5, 0.0]", "velocity = [0.1, 0.0]")
    assert simulate(read_scene_text(bound)).scattering["n0"].deflection is None


def test_the_report(tmp_path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "beam.toml"
    path.write_text(beam("1/r", (0.01, 0.5)))
    assert main(["simulate", str(path)]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line.startswith("  scattering")]
    assert len(lines) == 2
    assert "deflected by π − 0.0" in lines[0]
    assert main(["simulate", str(path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)["scattering"]["n0"]
    assert record["from_backward"] == pytest.approx(pi - record["deflection"], abs=1e-12)
    assert record["cross_section"] > 0


@pytest.mark.parametrize(
    ("V", "says"),
    [
        ("log(r)", "vanishes far away"),
        ("1 + 1/r", "vanishes far away"),
        ("1/x", "unknown name 'x'"),
    ],
)
def test_bad_potentials(V: str, says: str) -> None:
    with pytest.raises(InputError, match=says):
        read_scene_text(beam(V, (0.5,)))
