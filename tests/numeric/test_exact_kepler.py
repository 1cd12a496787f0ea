"""Kepler's exact flow against 50 digits of mpmath, for every kind of orbit, and as a canonical map."""

from collections.abc import Sequence

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest

from canon.numeric.exact.kepler import kepler
from canon.numeric.precision import double

FLOW = jax.jit(kepler)


def reference(
    q: Sequence[float], v: Sequence[float], mu: float, t: float
) -> tuple[list[mp.mpf], list[mp.mpf]]:  # Danby (1988), 6.9, with bisection before Newton
    x, u, m, left = [mp.mpf(a) for a in q], [mp.mpf(a) for a in v], mp.mpf(mu), mp.mpf(t)
    r, eta = mp.sqrt(sum(a * a for a in x)), sum(a * b for a, b in zip(x, u, strict=True))
    beta = 2 * m / r - sum(a * a for a in u)
    if beta > 0:
        left -= mp.floor(left / (2 * mp.pi * m / beta ** mp.mpf("1.5"))) * (2 * mp.pi * m / beta ** mp.mpf("1.5"))

    def powers(s: mp.mpf) -> list[mp.mpf]:
        root = mp.sqrt(beta)
        if abs(beta) * s * s < mp.mpf(10) ** -12:
            return [s**k * sum((-beta * s * s) ** j / mp.factorial(2 * j + k) for j in range(6)) for k in range(4)]
        x = root * s
        terms = [mp.cos(x), mp.sin(x) / root, (1 - mp.cos(x)) / beta, (x - mp.sin(x)) / (root * beta)]
        return [mp.re(term) for term in terms]

    def time(s: mp.mpf) -> mp.mpf:
        g = powers(s)
        return r * g[1] + eta * g[2] + m * g[3]

    sign = 1 if left >= 0 else -1
    low, high = mp.mpf(0), mp.mpf(1)
    while abs(time(sign * high)) < abs(left):
        high *= 2
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if abs(time(sign * middle)) < abs(left) else (low, middle)
    s = sign * (low + high) / 2
    for _ in range(7):
        g = powers(s)
        s -= (time(s) - left) / (r + eta * g[1] + (m - beta * r) * g[2])
    g = powers(s)
    after = r + eta * g[1] + (m - beta * r) * g[2]
    f, h, df, dh = 1 - m * g[2] / r, left - m * g[3], -m * g[1] / (after * r), 1 - m * g[2] / after
    return [f * a + h * b for a, b in zip(x, u, strict=True)], [df * a + dh * b for a, b in zip(x, u, strict=True)]


def worst(q: Sequence[float], v: Sequence[float], mu: float, t: float) -> float:
    with mp.workdps(50), double():
        found = FLOW(np.array(q), np.array(v), mu, t)
        error = mp.mpf(0)
        for values, exact in zip(found, reference(q, v, mu, t), strict=True):
            miss = mp.sqrt(sum((mp.mpf(float(a)) - b) ** 2 for a, b in zip(values, exact, strict=True)))
            error = max(error, miss / mp.sqrt(sum(b * b for b in exact)))
        return float(error)


@pytest.mark.parametrize("e", [0.0, 1e-9, 0.3, 0.9, 0.99, 1.0, 1 + 1e-8, 1.5, 20.0])
def test_from_the_pericentre(e: float) -> None:
    near = 1 - e if e < 1 else 1.0
    start = [near, 0.0, 0.0], [0.0, ((1 + e) / near) ** 0.5, 0.0]
    for t in (1e-5, 0.7, 3.0, -4.0):
        assert worst(*start, 1.0, t) < 1e-14
    assert worst(*start, 1.0, 50.0) < 1e-13


@pytest.mark.parametrize(
    ("q", "v", "mu", "t", "bound"),
    [
        ((1.2, 0.5, 0.1), (-0.6, 0.3, 0.0), 1.0, 2.0, 1e-14),  # inwards first
        ((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), 1.0, 0.5, 1e-15),  # a fall
        ((1.0, 0.0, 0.0), (0.0, 1e-6, 0.0), 1.0, 1.5, 1e-14),  # past the centre, closely
        ((1.0, 0.0, 0.0), (-3.0, 1e-8, 0.0), 1.0, 1.5, 1e-13),  # the same on a hyperbola
        ((3.33, 2.7e-3, 0.1), (-1.49, 0.0, 0.0), 1.0, 3.8, 3e-15),  # from far away, past the centre, and off again
        ((2.0, 1e-8, 0.0), (-1.4, 0.0, 0.0), 1.0, 90.0, 3e-15),
        ((-2.0, 1e-3, 0.0), (-1.4, 0.2, 0.0), 1.0, -70.0, 3e-15),  # the same backwards
        ((1.0, 0.5, 0.0), (0.3, 0.2, 0.0), -2.0, 10.0, 1e-14),  # repulsion
        ((9.0, 1e-3, 0.0), (-2.0, 0.0, 0.0), -1.0, 12.0, 3e-15),
        ((1.0, 0.0, 0.0), (-3.0, 0.2, 0.0), -1.0, 1.5, 2e-13),
        ((1.0, 0.0, 0.0), (0.0, 2**0.5 * (1 - 1e-11), 0.0), 1.0, 1e4, 1e-14),  # E -> 0
        ((1.0, 0.0, 0.0), (0.0, 3.0, 0.0), 1.0, 1e6, 1e-14),
        ((1e-8, 0.0, 0.0), (0.0, 1.99999999e4, 0.0), 1.0, 3.0, 1e-12),  # e = 1 - 1e-8, from the pericentre
    ],
)
def test_hard_orbits(q: tuple[float, ...], v: tuple[float, ...], mu: float, t: float, bound: float) -> None:
    assert worst(q, v, mu, t) < bound


def test_no_force_is_uniform_motion() -> None:
    with double():
        q, v = FLOW(np.array([1.0, 0.0]), np.array([0.5, 3.0]), 0.0, 7.0)
    assert np.allclose(q, [4.5, 21.0], rtol=1e-15, atol=0)
    assert np.array_equal(v, [0.5, 3.0])


@pytest.mark.slow
@pytest.mark.parametrize("from_pericentre", [False, True])
def test_a_thousand_periods_keep_the_energy(from_pericentre: bool) -> None:
    """e = 0.99: the drift is some 1e-16 of the potential, which near the pericentre is 200 times the energy."""
    e = 0.99 if from_pericentre else -0.99
    with double():
        t = np.random.default_rng(0).uniform(0, 2000 * np.pi, 2000)
        q0, v0 = np.array([[1 - e], [0.0]]), np.array([[0.0], [((1 + e) / (1 - e)) ** 0.5]])
        q, v = map(np.asarray, FLOW(q0, v0, 1.0, t))
    with mp.workdps(40):
        states = np.vectorize(mp.mpf)([np.hstack([q0, q]), np.hstack([v0, v])])
        potential = 1 / np.vectorize(mp.sqrt)((states[0] ** 2).sum(axis=0))
        energy = (states[1] ** 2).sum(axis=0) / 2 - potential
        drift = np.abs((energy / energy[0] - 1)[1:].astype(float))
    assert np.quantile(drift, 0.98) < 1e-14
    assert (drift * 0.5 / np.maximum(potential[1:].astype(float), 1)).max() < 5e-16


@pytest.mark.slow
def test_its_jacobian_is_symplectic() -> None:
    """Also where the first guess already solves the equation, so that no iteration carries a derivative."""
    with double():
        rng = np.random.default_rng(1)
        J = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
        points = jnp.asarray(np.vstack([rng.normal(size=(20, 6)), [1, 0, 0, 0, 1, 0]]))
        M = np.asarray(jax.jit(jax.vmap(jax.jacfwd(lambda z: jnp.concatenate(kepler(z[:3], z[3:], 1.0, 0.4)))))(points))
    assert np.abs(M @ J @ M.transpose(0, 2, 1) - J).max() < 1e-9 * np.abs(M).max()
    assert np.abs(M[-1] @ J @ M[-1].T - J).max() < 1e-14
