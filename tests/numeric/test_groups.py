"""Exponential and logarithm on groups: against 50 digits, at 0, at π and for large boosts, and their derivatives.

Each map is compiled once, for a batch of all cases.
"""

import mpmath
import numpy as np
import pytest

from canon.numeric.groups import lorentz, se3, sl2c, so3, so4, symplectic
from canon.numeric.precision import double

Array = np.ndarray
FEW = 8 * 2.0**-53
DIRECTION = np.array([0.36, -0.48, 0.8])
OTHER = np.array([0.6, 0.64, 0.48])


def reference(A: Array) -> Array:
    """exp A in 50 digits, rounded."""
    with mpmath.workdps(50):
        return np.array(mpmath.expm(mpmath.matrix(A.tolist())).tolist(), dtype=float)


def error(found: Array, expected: Array) -> float:
    """The largest error relative to the largest entry."""
    return float(np.max(np.abs(np.asarray(found) - expected)) / max(1e-300, np.max(np.abs(expected))))


def compiled(function, *arguments) -> list[Array]:
    """The values of a function of arrays, compiled."""
    import jax

    with double():
        return [np.asarray(value) for value in jax.tree.leaves(jax.jit(function)(*arguments))]


def test_rotations_and_motions():
    angles = [0.0, 1e-9, 1e-3, 1.0, 3.0, np.pi - 1e-7, np.pi]
    omegas = np.array([angle * DIRECTION for angle in angles])
    shifts = np.array([OTHER] * len(angles))

    def there_and_back(omega, v):
        R, b = se3.exp(omega, v)
        return R, b, *se3.log(R, b), so3.hat(omega)

    for R, b, omega, v, hat, angle in zip(*compiled(there_and_back, omegas, shifts), angles, strict=True):
        A = np.zeros((4, 4))
        A[:3, :3], A[:3, 3] = hat, OTHER
        expected = reference(A)
        assert error(R, expected[:3, :3]) < FEW
        assert error(b, expected[:3, 3]) < FEW
        sign = np.sign(omega @ DIRECTION) or 1.0  # at π both vectors are right
        assert error(sign * omega, angle * DIRECTION) < FEW or angle == 0
        assert sign == 1 or angle == np.pi
        assert error(v, OTHER) < FEW or sign < 0


def test_the_convention_is_active():
    def turned(v, zeta):
        return so3.exp(v), lorentz.exp(0 * v, zeta)

    R, L = compiled(turned, np.array([0.0, 0.0, np.pi / 2]), np.array([1.0, 0.0, 0.0]))
    assert pytest.approx(np.array([0.0, 1.0, 0.0]), abs=1e-15) == R @ np.array([1.0, 0.0, 0.0])
    assert pytest.approx([np.cosh(1), np.sinh(1), 0, 0]) == L @ np.array([1.0, 0.0, 0.0, 0.0])


def test_rotations_of_four_dimensions():
    sizes = np.array([0.0, 1e-8, 0.5, 2.0, 3.1])[:, None]
    m, d = 0.7 * sizes * DIRECTION, 0.3 * sizes * OTHER

    def there_and_back(m, d):
        R = so4.exp(m, d)
        return R, so4.generator(m, d), *so4.log(R)

    for k, (R, A, back_m, back_d) in enumerate(zip(*compiled(there_and_back, m, d), strict=True)):
        assert error(R, reference(A)) < FEW
        assert np.max(np.abs([back_m - m[k], back_d - d[k]])) < FEW * max(1e-8, sizes[k, 0])


def test_boosts_of_any_size():
    """Pure boosts there and back to a few roundings; with a rotation, as far as the rounded matrix knows it.

    The stated error holds the truth, to which it is close: at rapidity 30 ω comes back to three digits.
    """
    sizes = np.array([0.0, 1e-9, 0.1, 1.0, 5.0, 15.0, 30.0])[:, None]
    zeta, omega = np.tile(sizes * DIRECTION, (2, 1)), np.repeat([[0.0], [0.9]], len(sizes), 0) * OTHER
    rng = np.random.default_rng(0)
    some = rng.normal(size=(2, 20, 3))
    some /= np.linalg.norm(some, axis=2)[:, :, None]
    zeta = np.concatenate([zeta, rng.uniform(0, 34, (20, 1)) * some[0]])
    omega = np.concatenate([omega, rng.uniform(0, 3, (20, 1)) * np.concatenate([some[1, :14], some[0, 14:]])])

    def there_and_back(omega, zeta):
        L = lorentz.exp(omega, zeta)
        return L, lorentz.generator(omega, zeta), *lorentz.log(L), lorentz.log_error(L)

    found = compiled(there_and_back, omega, zeta)
    for k, (L, A, back_omega, back, known) in enumerate(zip(*found, strict=True)):
        rapidity = float(np.linalg.norm(zeta[k]))
        assert error(L, reference(A)) < 8 * FEW
        assert np.max(np.abs([back_omega - omega[k], back - zeta[k]])) <= known
        assert known < 64 * 2.0**-53 * np.exp(rapidity)
        assert error(back, zeta[k]) < FEW or rapidity == 0 or np.any(omega[k])
    assert 1e-6 < np.max(np.abs(found[2][13] - omega[13])) < 1e-2


def spinor(omega: Array, zeta: Array) -> Array:
    """exp ½ (ζ − iω)·σ in 50 digits, rounded."""
    with mpmath.workdps(50):
        x, y, z = (mpmath.mpc(float(a), -float(b)) / 2 for a, b in zip(zeta, omega, strict=True))
        f = mpmath.sqrt(x * x + y * y + z * z)
        c, s = mpmath.cosh(f), mpmath.sinh(f) / f if f else mpmath.mpf(1)
        entries = [[c + s * z, s * (x - 1j * y)], [s * (x + 1j * y), c - s * z]]
        return np.array([[complex(e) for e in row] for row in entries])


@pytest.mark.slow
def test_mixed_boosts_and_rotations_keep_15_digits_in_sl2c():
    """Rapidities up to acosh 1e8 with rotations up to 3 in other directions; null rotations, turns seen in motion.

    Of the vector ζ − iω as a whole; the Lorentz matrices of the same lose digits of ω as e^ζ, and are right themselves.
    """
    rng = np.random.default_rng(2)
    some = rng.normal(size=(2, 60, 3))
    some /= np.linalg.norm(some, axis=2)[:, :, None]
    zeta = rng.uniform(0, np.arccosh(1e8), (60, 1)) * some[0]
    omega = rng.uniform(0, 3, (60, 1)) * some[1]
    across = np.cross(some[0], some[1])[40:]
    sizes = 10 ** rng.uniform(-1, 4, (20, 1))
    zeta[40:] = sizes * some[0, 40:]
    turns = np.repeat([[0.0], [0.3], [3.0], [3.14]], 5, 0)
    omega[40:] = np.sqrt(sizes**2 + turns**2) * across / np.linalg.norm(across, axis=1)[:, None]
    rounded = np.array([spinor(*pair) for pair in zip(omega, zeta, strict=True)])

    def both(omega, zeta, rounded):
        A = sl2c.exp(omega, zeta)
        return A, lorentz.exp(omega, zeta), sl2c.lorentz(A), *sl2c.log(rounded), sl2c.log_error(rounded)

    for k, (A, L, covered, back_omega, back, known) in enumerate(
        zip(*compiled(both, omega, zeta, rounded), strict=True)
    ):
        assert error(A, rounded[k]) < 2 * FEW
        assert error(covered, L) < 2 * FEW
        off = max(np.max(np.abs(back_omega - omega[k])), np.max(np.abs(back - zeta[k])))
        assert off <= known
        if k < 40:
            assert error(A, rounded[k]) < FEW
            assert off < FEW * max(1.0, float(np.hypot(np.linalg.norm(zeta[k]), np.linalg.norm(omega[k]))))
            assert known < 200 * FEW


@pytest.mark.slow
def test_flows_of_quadratic_hamiltonians():
    import jax.numpy as jnp

    rng = np.random.default_rng(1)
    S = rng.normal(size=(2, 4, 4)) * np.array([0.02, 0.6])[:, None, None]
    S = S + S.swapaxes(1, 2)

    without = np.array([np.diag([-2.0, 1.0, -0.5, 1.0]), -np.eye(4)])  # negative eigenvalues: no principal logarithm

    def there_and_back(S):
        M = symplectic.exp(S)
        logs = symplectic.log(jnp.concatenate([M, without]))
        return M, symplectic.generator(S), logs[:2], logs[2:]

    *found, nothing = compiled(there_and_back, S)
    for given, M, A, back in zip(S, *found, strict=True):
        assert error(M, reference(A)) < FEW
        assert error(back, given) < 8 * FEW
    assert np.isnan(nothing).all()


@pytest.mark.slow
def test_derivatives():
    """log after exp is the identity, at 0 and elsewhere: forward derivatives of boosts, reverse ones of rotations."""
    import jax
    import jax.numpy as jnp

    def boosts(v):
        by_matrices = jnp.concatenate(lorentz.log(lorentz.exp(v[..., :3], v[..., 3:])), -1)
        by_spinors = jnp.concatenate(sl2c.log(sl2c.exp(v[..., :3], v[..., 3:])), -1)
        return jnp.stack([by_matrices, by_spinors])

    def rotations(v):
        return jnp.concatenate(so4.log(so4.exp(v[..., :3], v[..., 3:])), -1)

    points = np.array([np.zeros(6), 0.8 * np.concatenate([DIRECTION, OTHER])])
    along = np.random.default_rng(0).normal(size=(2, 6))
    (_, slopes) = compiled(lambda v, w: jax.jvp(boosts, (v,), (w,)), points, along)
    (back,) = compiled(lambda v, w: jax.vjp(rotations, v)[1](w), points, along)
    assert np.max(np.abs(slopes - along)) < 4 * FEW
    assert np.max(np.abs(back - along)) < 4 * FEW
