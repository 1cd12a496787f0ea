"""Rays of light in a medium: Snell's law, a graded fibre, and what is no ray."""

from pathlib import Path

import numpy as np
import pytest

from canon.cli.main import main
from canon.errors import InputError
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.states import named_states

RAY = '[[body]]\nname = "ray"\nposition = [0.3, 0.1, 2.0]\nvelocity = [0.0, 0.1, 1.0]\n'
FIBRE = '[[effect]]\nkind = "refractive_index"\nn = "sqrt(2.25 - 0.1*(x**2 + y**2))"\n'
RUN = '[run]\nduration = 30.0\nsamples = 31\nmonitor = ["energy", "angular_momentum", "symplecticity", "loop"]\n'


def run(text: str) -> Result:
    return simulate(read_scene_text(text))


@pytest.mark.slow
def test_a_graded_fibre_is_an_oscillator_along_its_axis() -> None:
    """n² = n₀² − a r²: with h = −H = n cos(angle) conserved, d²x/dz² = −a x/h². Ledger S25."""
    result = run(RAY + FIBRE + RUN)
    assert result.ok
    assert {reading.expected for reading in result.monitors} == {"conserved"}
    position, slope = (named_states(result)[word]["ray"] for word in ("position", "velocity"))
    assert np.allclose(position[:, 2], 2.0 + np.arange(31), rtol=0, atol=1e-14)
    assert np.array_equal(slope[:, 2], np.ones(31))
    n = np.sqrt(2.25 - 0.1 * 0.1)
    h = n / np.sqrt(1.01)
    w, z = np.sqrt(0.1) / h, np.arange(31)
    assert np.allclose(position[:, 0], 0.3 * np.cos(w * z), rtol=0, atol=1e-9)
    assert np.allclose(position[:, 1], 0.1 * np.cos(w * z) + 0.1 / w * np.sin(w * z), rtol=0, atol=1e-9)
    assert np.allclose(slope[0], [0, 0.1, 1], rtol=0, atol=1e-15)
    assert result.q.shape == (31, 2)


def test_snells_law() -> None:
    """In layers across the axis n sin(angle) is conserved, and the energy −n cos(angle) isn't. Ledger 2.28."""
    layers = '[[effect]]\nkind = "refractive_index"\nn = "1.25 + 0.25*tanh(4*y)"\n'
    plane = '[[body]]\nname = "ray"\nposition = [0.0, -3.0]\nvelocity = [1.0, 1.0]\n'
    result = run(plane + layers + '[run]\nduration = 6.0\nmonitor = ["momentum", "energy"]\n')
    momentum, energy = result.monitors
    assert result.ok
    assert momentum.expected == "conserved"
    assert energy.expected == "broken by refractive_index"
    slope = named_states(result)["velocity"]["ray"][:, 0]
    sine = slope / np.hypot(slope, 1.0)
    assert 1.0 * sine[0] == pytest.approx(1.5 * sine[-1], rel=1e-8)


def test_a_ray_that_turns_round_ends_the_run() -> None:
    """Total reflection on a medium that thins out along the axis."""
    thin = '[[effect]]\nkind = "refractive_index"\nn = "1.5 - 0.1*z"\n'
    result = run(RAY.replace("[0.0, 0.1, 1.0]", "[1.0, 0.0, 1.0]") + thin + "[run]\nduration = 8.0\n")
    assert not result.ok
    assert np.isfinite(result.q).all()
    assert result.times[-1] == pytest.approx(2 + (1.5 - 0.1 * 2 - 1.3 / np.sqrt(2)) / 0.1, abs=0.1)


def test_rays_in_a_plane_are_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, figure = tmp_path / "plane.toml", tmp_path / "plane.svg"
    body = '[[body]]\nname = "{}"\nposition = [{}, 0.0]\n'
    rays = "".join(body.format(name, x) for name, x in (("a", 0.1), ("b", -0.2)))
    scene.write_text(rays + '[[effect]]\nkind = "refractive_index"\nn = "1.5 - x**2/10"\n[run]\nduration = 3.0\n')
    assert main(["simulate", str(scene), "--plot", str(figure)]) == 0
    assert "from y = 0 to 3" in capsys.readouterr().out
    assert figure.read_text().startswith("<?xml")


def test_a_momentum_may_be_given() -> None:
    along = RAY.replace("velocity = [0.0, 0.1, 1.0]", "momentum = [0.0, 0.9, 1.2]") + RUN
    scene = read_scene_text('[[effect]]\nkind = "refractive_index"\nn = 1.5\n' + along)
    assert scene.p == (0.0, 0.9)
    assert scene.settings.start == 2.0
    straight = run('[[effect]]\nkind = "refractive_index"\nn = 1.5\n' + along)
    assert np.allclose(straight.q[:, 1], 0.1 + 0.75 * np.arange(31), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (RAY + FIBRE.replace("x**2", "t**2") + RUN, "depends on the place alone"),
        (RAY + FIBRE.replace("2.25", "0.001") + RUN, "not above 0 where the ray begins"),
        (RAY + FIBRE + '[[effect]]\nkind = "uniform_gravity"\ng = 1\n' + RUN, "acts on bodies, and these are rays"),
        (RAY + RAY.replace('"ray"', '"b"') + FIBRE + 'bodies = ["ray"]\n' + RUN, "no refractive index for 'b'"),
        (RAY + FIBRE + FIBRE + RUN, "two refractive indices for 'ray'"),
        (RAY + RAY.replace('"ray"', '"b"').replace("2.0]", "2.1]") + FIBRE + RUN, "begin at the same place"),
        (RAY.replace("0.1, 1.0", "0.1, -1.0") + FIBRE + RUN, "forwards along the last axis"),
        (RAY.replace("velocity", "momentum") + FIBRE + RUN, "has the length n = 1.4966"),
        ("[[body]]\nposition = [0.1]\n" + FIBRE.replace("y**2", "0") + RUN, "a ray has 2 or 3 components"),
        ('dynamics = "relativistic"\n' + RAY + FIBRE + RUN, "rays have no kinetic energy"),
        (RAY + RUN, "the key 'mass' is missing"),
    ],
)
def test_what_is_no_ray(text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert says in str(caught.value)
