"""Frequencies of chains against their closed form and fifty digits; Poincaré's pairs are canonical."""

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest

from canon import InputError, chain_frequencies
from canon.numeric.poincare_pairs import poincare_pairs, tilt
from canon.numeric.precision import double
from canon.numeric.symplectic_matrix import unit_form


@pytest.mark.parametrize("n", [1, 2, 7, 40])
def test_equal_masses_and_springs(n: int) -> None:
    found = chain_frequencies([0.7] * n, [1.3] * (n + 1))
    with mp.workdps(30):
        exact = [2 * mp.sqrt(mp.mpf(1.3) / mp.mpf(0.7)) * mp.sin(j * mp.pi / (2 * (n + 1))) for j in range(1, n + 1)]
    assert np.abs(found / np.array(exact, dtype=float) - 1).max() < 3e-16


def test_springs_of_any_ratio_keep_all_digits() -> None:
    masses, springs = (1.0, 2.0, 0.3, 1e-3), (1e-9, 1e12, 3.0, 1e20, 0.0)
    with mp.workdps(60):
        m, k = [mp.mpf(x) for x in masses], [mp.mpf(x) for x in springs]
        K = mp.matrix(4)
        for i in range(4):
            K[i, i] = (k[i] + k[i + 1]) / m[i]
            if i < 3:
                K[i, i + 1] = K[i + 1, i] = -k[i + 1] / mp.sqrt(m[i] * m[i + 1])
        exact = [float(mp.sqrt(x)) for x in mp.eigsy(K, eigvals_only=True)]
    assert chain_frequencies(masses, springs) == pytest.approx(exact, rel=3e-16)


def test_a_free_chain_moves_as_a_whole() -> None:
    found = chain_frequencies((1.0, 1.0, 1.0), (0.0, 1.0, 1.0, 0.0))
    assert found[0] == 0
    assert found[1:] == pytest.approx([1.0, 3**0.5], rel=3e-16)
    assert chain_frequencies((1.0,), (0.0, 0.0)).tolist() == [0.0]


@pytest.mark.parametrize(
    ("masses", "springs"), [((1.0,), (1.0,)), ((0.0,), (1.0, 1.0)), ((1.0,), (-1.0, 1.0)), ((np.inf,), (1.0, 1.0))]
)
def test_what_is_no_chain(masses: tuple[float, ...], springs: tuple[float, ...]) -> None:
    with pytest.raises(InputError):
        chain_frequencies(masses, springs)


def pairs(z: np.ndarray, mu: float = 1.3) -> jax.Array:
    """(coordinates, momenta) of z = (x, v)."""
    return jnp.concatenate(poincare_pairs(z[:3], z[3:], mu))


JACOBIAN = jax.jit(jax.jacfwd(pairs))


@pytest.mark.parametrize(
    "z",
    [
        (1.0, 0.3, 0.2, -0.2, 0.9, 0.3),
        (1.0, 0.0, 1e-12, 0.0, 1.3**0.5, 0.0),  # round, and in the plane but for 1e-12
        (0.2, 1.1, -0.4, -0.8, 0.1, 0.5),
    ],
)
def test_poincare_pairs_are_canonical_also_on_circles_in_the_plane(z: tuple[float, ...]) -> None:
    with double():
        M = np.asarray(JACOBIAN(jnp.array(z)))
    J = unit_form(3)
    assert np.abs(M @ J @ M.T - J).max() < 1e-13


def test_poincare_pairs_of_the_classical_elements() -> None:
    """a = 1, e = 0.2, i = 0.3, Ω = 0.5, ω = 0.7, at the pericentre: λ = Ω + ω."""
    a, e, i, node, pericentre, mu = 1.0, 0.2, 0.3, 0.5, 0.7, 1.3

    def turned(vector: np.ndarray) -> np.ndarray:
        for angle, k, j in ((pericentre, 0, 1), (i, 1, 2), (node, 0, 1)):
            c, s = np.cos(angle), np.sin(angle)
            vector = vector.copy()
            vector[k], vector[j] = c * vector[k] - s * vector[j], s * vector[k] + c * vector[j]
        return vector

    x = turned(np.array([a * (1 - e), 0.0, 0.0]))
    v = turned(np.array([0.0, np.sqrt(mu / a * (1 + e) / (1 - e)), 0.0]))
    with double():
        coordinates, momenta = (np.asarray(each) for each in poincare_pairs(x, v, mu))
        found, rest = (float(angle) for angle in tilt(x, v))
    scale = np.sqrt(mu * a)
    G = scale * np.sqrt(1 - e * e)
    round_, flat = np.sqrt(2 * (scale - G)), np.sqrt(2 * G * (1 - np.cos(i)))
    whole = node + pericentre
    assert coordinates == pytest.approx([whole, -round_ * np.sin(whole), -flat * np.sin(node)], rel=1e-14)
    assert momenta == pytest.approx([scale, round_ * np.cos(whole), flat * np.cos(node)], rel=1e-14)
    assert (found, rest) == (pytest.approx(i, rel=1e-15), pytest.approx(np.pi - i, rel=1e-15))
