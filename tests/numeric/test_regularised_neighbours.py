"""Neighbours of an orbit through a close approach, beside the exact flow of Kepler's problem."""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon.numeric.exact.kepler import kepler
from canon.numeric.integrators.catalogue import method
from canon.numeric.levi_civita import regularised
from canon.numeric.precision import double
from canon.numeric.regularised_neighbours import RegularisedNeighbours

TURN = 2 * np.pi
ELLIPSE = np.array([0.1, 0.0, 0.0, 19**0.5])
TILTED = np.array([0.06, -0.08, 0.0, 0.1, -0.05, 19**0.5])
TIME = 2.7 * TURN
"""Less than three turns: where the last state isn't one that is kept."""


def after(z: Any, time: Any) -> Any:
    d = z.shape[0] // 2
    return jnp.concatenate(kepler(z[:d], z[d:], 1.0, time))


EXACT = jax.jit(jax.vmap(after))
STENCIL = {
    k * sign: sign * weight for k, weight in enumerate((4 / 5, -1 / 5, 4 / 105, -1 / 280), 1) for sign in (1, -1)
}
"""Of a central difference of order 8."""
WIDTH = 2e-5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("z", "name", "centre"),
    [
        (ELLIPSE, "stormer12", (0.0, 0.0)),
        (TILTED, "sofroniou_spaletta10", (2.0, -1.0, 0.5)),
        (TILTED, "stormer12", (0.0, 0.0, 0.0)),
    ],
)
def test_neighbours_of_an_ellipse(z: np.ndarray, name: str, centre: tuple[float, ...]) -> None:
    d = len(centre)
    q, p = (sp.symbols(f"{x}:{d}", real=True) for x in "qp")
    made = regularised(sum(y**2 for y in p) / 2 - 1 / sp.sqrt(sum(x**2 for x in q)), q, p)
    begun, late = 0.25, np.array([0.1, -0.2, 0.0, 1e-3])
    flow = RegularisedNeighbours(made, method(name), centre, TURN / 400, begun, TIME)
    shift = np.concatenate([centre, np.zeros(d)])
    points = z * (1 + 1e-3 * np.random.default_rng(1).normal(size=(4, 2 * d)))
    beside = np.array([z + k * WIDTH * axis for axis in np.diag(z + 0.2) for k in STENCIL])
    moments = np.concatenate([np.repeat([0, TIME / 2, TIME], 4), TIME + late, np.full(len(beside), TIME)])
    with double():
        every = np.asarray(EXACT(np.concatenate([*[points] * 4, beside]), moments))
    expected, shifted = every[:12].reshape(3, 4, -1), every[12:16]
    M = np.einsum("ijk,j->ki", every[16:].reshape(2 * d, len(STENCIL), -1), np.array([*STENCIL.values()]) / WIDTH)
    M /= z + 0.2
    found = flow.jacobian(z[:d] + centre, z[d:])
    assert np.abs(found - M).max() < 1e-7 * np.abs(M).max()
    J = np.block([[np.zeros((d, d)), np.eye(d)], [-np.eye(d), np.zeros((d, d))]])
    assert np.abs(found @ J @ found.T - J).max() < 1e-14 * np.abs(M).max() ** 2
    along = flow.along(points + shift, 3)
    assert np.array_equal(along[0], points + shift)
    assert along == pytest.approx(expected + shift, abs=1e-11)
    assert flow.back(along[-1]) == pytest.approx(points + shift, abs=1e-8)
    there = flow.shifted(along[-1], late, 3)
    assert there == pytest.approx(shifted + shift, abs=1e-10)
    assert np.array_equal(there[2], along[-1][2])


def test_what_is_lost_is_said() -> None:
    """A neighbour at the centre itself has no direction of motion; those beside it have."""
    q, p = sp.symbols("q:2", real=True), sp.symbols("p:2", real=True)
    made = regularised(sum(y**2 for y in p) / 2 - 1 / sp.sqrt(sum(x**2 for x in q)), q, p)
    flow = RegularisedNeighbours(made, method("stormer12"), (0.0, 0.0), TURN / 400, 0.0, TIME)
    found = flow.along(np.array([ELLIPSE, [0.0, 0.0, 0.0, 1.0], ELLIPSE, ELLIPSE]), 3)
    assert np.isnan(found[1:, 1]).all()
    assert np.isfinite(found[:, [0, 2, 3]]).all()
    assert np.array_equal(found[:, 0], found[:, 3])
