"""`canon.audit` of integrators' steps and of scenes: symplectic or not, and friction's contraction."""

from pathlib import Path

import jax.numpy as jnp
import numpy as np
import pytest

import canon
from canon.errors import InputError
from canon.numeric.integrate import flow_map
from canon.numeric.integrators import separable
from canon.numeric.integrators.catalogue import method
from canon.scenes.reader import read_scene_text

DAMPED = """
[[body]]
mass = 2.0
position = [1.0, 0.2]
velocity = [0.1, 0.9]
[[effect]]
kind = "power_law"
a = 0.3
n = 4
{more}
[run]
duration = 5.0
step = 0.05
samples = 21
integrator = "{integrator}"
"""
FRICTION = '[[effect]]\nkind = "damping"\nrate = 0.05\n'


def scene(more: str = "", integrator: str = "blanes_moan4") -> str:
    return DAMPED.format(more=more, integrator=integrator)


@pytest.mark.parametrize(("name", "verdict"), [("verlet", "supported"), ("kahan_li6", "supported"), ("rk4", "refuted")])
def test_a_step_of_an_integrator(name: str, verdict: str) -> None:
    problem = separable(lambda p: p, lambda q: -jnp.sin(q))
    report = canon.audit(flow_map(problem, method(name), steps=1, h=0.1), dimension=2, samples=100)
    assert report.verdict == verdict


def test_a_scene_is_audited_by_its_own_step(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(scene())
    report = canon.audit(path)
    assert report.verdict == "supported"
    assert report.samples == 21
    assert canon.audit(read_scene_text(scene(integrator="rk4"))).verdict == "refuted"


def test_friction_contracts_as_it_should() -> None:
    """M J Mᵀ = exp(−2λh) J, and det M = exp(−4λh) of two degrees of freedom."""
    damped, valence = read_scene_text(scene(FRICTION)), np.exp(-2 * 0.05 * 0.05)
    report = canon.audit(damped)
    assert report.verdict == "refuted"
    assert report.valence == pytest.approx(valence, rel=1e-13)
    assert report.determinant[0] == pytest.approx(valence**2, rel=1e-13)
    assert canon.audit(damped, scale=valence).verdict == "supported"
    assert canon.audit(damped, scale=valence * (1 + 1e-9)).verdict == "refuted"


def test_what_is_no_map_of_q_and_p() -> None:
    rod = '[[effect]]\nkind = "rod"\nanchor = [0.0, 0.0]\nlength = "sqrt(1.04)"\n'
    with pytest.raises(InputError, match="fill no phase space"):
        canon.audit(read_scene_text(scene(rod)))
    with pytest.raises(InputError, match="has its own variables"):
        canon.audit(read_scene_text(scene()), dimension=4)
    with pytest.raises(InputError, match="there is no such file"):
        canon.audit("absent.toml")
