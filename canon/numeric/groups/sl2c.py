"""SL(2,C), the double cover of SO(3,1): where boosts and rotations of any size are known to all digits.

A = exp(½ (ζ − iω)·σ) with Pauli's matrices σ, and x → A x A† on x = t + r·σ is the boost and rotation of `lorentz`, the
same for A and −A. A boost of rapidity ζ has entries of e^(ζ/2), whose rounding loses nothing of the rotation beside
it; those of Λ = A ⊗ Ā are of e^ζ, and the phase of A, which det A = 1 fixes, is lost in theirs. So what is composed of
large boosts and rotations is composed here. Conditioning: `exp` is off by roundings of its largest entry, at any
rapidity; of `log`, `log_error` says it. Penrose and Rindler, Spinors and Space-Time 1 (1984), 1.2.
"""

from __future__ import annotations

from typing import Any

SMALL = 0.05
"""Below this modulus functions are taken from their series."""
_SERIES = 7


def exp(omega: Any, zeta: Any) -> Any:
    """The matrix (…, 2, 2), of determinant 1, of a rotation vector ω and a rapidity ζ (…, 3).

    It is cosh √f + ½ z·σ sinh √f/√f with z = ζ − iω and f = z·z/4, whose root is found to twice the working precision,
    so that the result is off by a few roundings of its largest entry at any rapidity.
    """
    import jax.numpy as jnp

    c, s = cosh_sinh(-omega, zeta)
    v = s[..., None] * (zeta - 1j * omega) / 2
    return matrix(jnp.concatenate([c[..., None], v], -1))


def log(A: Any) -> tuple[Any, Any]:
    """(ω, ζ) of the Lorentz transformation that A and −A cover, with |ω| ≤ π where ζ is along ω (or 0).

    Off by a few roundings of |z| where A is known so, and its trace isn't small beside its entries: see `log_error`.
    """
    import jax.numpy as jnp

    m = components(A)
    m = jnp.where(jnp.real(m[..., :1]) < 0, -m, m)
    m0, vector = m[..., 0], m[..., 1:]
    z = 2 * arc(m0, jnp.sum(vector * vector, -1))[..., None] * vector
    return -jnp.imag(z), jnp.real(z)


def log_error(A: Any) -> Any:
    """How far (ω, ζ) of `log` may be off, in each component, for a matrix with rounded entries.

    The condition of acosh(m₀) m/√(m·m) in m₀ = ½ tr A and the rest m of A, times some roundings: about |z| where m₀ is
    as large as A, and more by |A|/|m₀| for null rotations and for turns by nearly π seen from a moving frame.
    """
    import jax.numpy as jnp

    m = components(A)
    m = jnp.where(jnp.real(m[..., :1]) < 0, -m, m)
    m0, vector = m[..., 0], m[..., 1:]
    square = jnp.sum(vector * vector, -1)
    length = jnp.sqrt(jnp.sum(jnp.abs(vector) ** 2, -1))
    size = jnp.sqrt(jnp.sum(jnp.abs(m) ** 2, -1))
    small = jnp.abs(square) < SMALL
    far = jnp.where(small, 1.0, square)
    root = jnp.abs(jnp.sqrt(far))
    value = jnp.abs(arc(m0, square))
    slope = jnp.where(small, 0.2, (value + 1 / jnp.maximum(jnp.abs(m0), 1e-300)) / (2 * jnp.abs(far)))
    sideways = jnp.where(small, 0.0, length / (root * jnp.maximum(jnp.abs(m0 + jnp.sqrt(far)), 0.5)))
    slope = jnp.where(small, slope, jnp.minimum(slope, (value * root + 2) / root**3))
    return 8 * jnp.finfo(jnp.real(A).dtype).eps * size * (value + 2 * length**2 * slope + sideways)


def lorentz(A: Any) -> Any:
    """The Lorentz matrix (…, 4, 4) of x → A x A† on components (t, x, y, z): ½ tr(σ_i A σ_j A†)."""
    import jax.numpy as jnp
    import numpy as np

    sigma = np.array([np.eye(2), [[0, 1], [1, 0]], [[0, -1j], [1j, 0]], [[1, 0], [0, -1]]])
    table = jnp.asarray(np.einsum("iba,jcd->ijacbd", sigma, sigma) / 2)
    return jnp.real(jnp.einsum("ijacbd,...ac,...bd->...ij", table, A, jnp.conj(A)))


def components(A: Any) -> Any:
    """(m₀, m₁, m₂, m₃) (…, 4) of A = m₀ + m·σ."""
    import jax.numpy as jnp

    a, b, c, d = A[..., 0, 0], A[..., 0, 1], A[..., 1, 0], A[..., 1, 1]
    return jnp.stack([(a + d) / 2, (b + c) / 2, 1j * (b - c) / 2, (a - d) / 2], -1)


def matrix(m: Any) -> Any:
    """m₀ + m·σ (…, 2, 2) of its components (…, 4)."""
    import jax.numpy as jnp

    first = jnp.stack([m[..., 0] + m[..., 3], m[..., 1] - 1j * m[..., 2]], -1)
    second = jnp.stack([m[..., 1] + 1j * m[..., 2], m[..., 0] - m[..., 3]], -1)
    return jnp.stack([first, second], -2)


def cosh_sinh(omega: Any, zeta: Any) -> tuple[Any, Any]:
    """cosh √f and sinh √f/√f of f = (ζ + iω)²/4.

    f and √f = r + δ, with r rounded and δ = (f − r²)/2r, come from products whose rounding is kept: an error of the
    root would be one of the exponent, twenty times as large at the largest boosts of 64 bits, and of null rotations f
    is a small difference.
    """
    import jax
    import jax.numpy as jnp

    from canon.numeric.compensated import sum_of_products

    x, y = [zeta[..., k] / 2 for k in range(3)], [omega[..., k] / 2 for k in range(3)]
    squares = [*((v, v) for v in x), *((-v, v) for v in y)]
    mixed = [(2 * v, w) for v, w in zip(x, y, strict=True)]
    f = jnp.sum((zeta + 1j * omega) ** 2, -1) / 4
    f = f + jax.lax.stop_gradient(sum_of_products(squares)[0] + 1j * sum_of_products(mixed)[0] - f)
    small = jnp.abs(f) < SMALL
    root = jnp.sqrt(jnp.where(small, 1.0 + 0j, f))
    a, b = jnp.real(root), jnp.imag(root)
    rest = [sum(sum_of_products([*squares, (-a, a), (b, b)])), sum(sum_of_products([*mixed, (-2 * a, b)]))]
    delta = jax.lax.stop_gradient(jnp.where(small, 0.0, (rest[0] + 1j * rest[1]) / (2 * root)))
    cosh = jnp.cosh(a) * jnp.cos(b) + 1j * jnp.sinh(a) * jnp.sin(b)
    sinh = jnp.sinh(a) * jnp.cos(b) + 1j * jnp.cosh(a) * jnp.sin(b)
    c, s = cosh + delta * sinh, (sinh + delta * cosh) / root
    series = jnp.ones_like(f)
    first = jnp.ones_like(f)
    near = jnp.where(small, f, 0)
    for k in range(_SERIES, 0, -1):
        series = 1 + near * series / ((2 * k) * (2 * k + 1))
        first = 1 + near * first / ((2 * k - 1) * (2 * k))
    return jnp.where(small, first, c), jnp.where(small, series, s)


def arc(m0: Any, square: Any) -> Any:
    """acosh(m₀)/√(m₀² − 1) with Re m₀ ≥ 0, where `square` is m₀² − 1."""
    import jax.numpy as jnp

    small = jnp.abs(square) < SMALL
    near = jnp.where(small, square, 0)
    total = jnp.zeros_like(near)
    for k in range(2 * _SERIES, -1, -1):  # asinh(s)/s = Σ (−1)^k (2k)!/(4^k k!² (2k+1)) s^2k
        total = total * near * (-((2 * k + 1) ** 2)) / ((2 * k + 2) * (2 * k + 3)) + 1
    root = jnp.sqrt(jnp.where(small, 1.0 + 0j, square))
    root = jnp.where(jnp.real(root * jnp.conj(m0)) < 0, -root, root)
    return jnp.where(small, total, jnp.log(m0 + root) / root)
