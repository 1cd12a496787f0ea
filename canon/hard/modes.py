"""Normal modes: stiff springs beside soft ones, many degrees of freedom, frequencies that nearly coincide."""

from __future__ import annotations

from typing import Any

from canon.hard.case import HardCase, Number, Quantities, compiled, each


def _stiff(m: Any, k: Number, K: Number, mass: Number) -> Quantities:
    """ω² of wall–k–m–K–m: (k + 2K ∓ √(k² + 4K²))/2m. Goldstein, Poole and Safko (2002), chapter 6."""
    root = m.sqrt(k * k + 4 * K * K)
    return (m.sqrt((k + 2 * K - root) / (2 * mass)),), (m.sqrt((k + 2 * K + root) / (2 * mass)),)


def _our_stiff(k: float, K: float, mass: float) -> Quantities:
    from canon.numeric.chains import chain_frequencies

    slow, fast = chain_frequencies((mass, mass), (k, K, 0.0))
    return (float(slow),), (float(fast),)


def _eigh(solver: str) -> Any:
    def route(k: float, K: float, mass: float) -> Quantities:
        import numpy as np
        from scipy import linalg

        matrix, masses = np.array([[k + K, -K], [-K, K]]), mass * np.eye(2)
        squares = np.linalg.eigvalsh(matrix / mass) if solver == "numpy" else linalg.eigvalsh(matrix, masses)
        return (float(np.sqrt(squares[0])),), (float(np.sqrt(squares[1])),)

    return route


def _long(m: Any, n: Number, k: Number, mass: Number) -> Quantities:
    """The slowest and the fastest of 2√(k/m) sin(jπ/2(n + 1)), j = 1, …, n. Goldstein, Poole and Safko (2002), 13.1."""
    scale = 2 * m.sqrt(k / mass)
    return (scale * m.sin(m.pi / (2 * (n + 1))),), (scale * m.sin(n * m.pi / (2 * (n + 1))),)


def _our_long(n: float, k: float, mass: float) -> Quantities:
    from canon.numeric.chains import chain_frequencies

    found = chain_frequencies([mass] * int(n), [k] * (int(n) + 1))
    return (float(found[0]),), (float(found[-1]),)


def _naive_long(n: float, k: float, mass: float) -> Quantities:
    """The roots of the eigenvalues of K/m."""
    import numpy as np

    count = int(n)
    matrix = (2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)) * (k / mass)
    squares = np.linalg.eigvalsh(matrix)
    return (float(np.sqrt(squares[0])),), (float(np.sqrt(squares[-1])),)


def _scipy_long(n: float, k: float, mass: float) -> Quantities:
    import numpy as np
    from scipy.linalg import eigvalsh_tridiagonal

    count = int(n)
    squares = eigvalsh_tridiagonal(np.full(count, 2 * k / mass), np.full(count - 1, -k / mass))
    return (float(np.sqrt(squares[0])),), (float(np.sqrt(squares[-1])),)


def _pair(m: Any, q: Number, k: Number, c: Number, t: Number) -> Quantities:
    """Two equal oscillators, coupled by c (q₁ − q₂)²/2, of which the first begins at q: their sum has ω² = k, their
    difference ω² = k + 2c.
    """
    even, odd = m.cos(m.sqrt(k) * t), m.cos(m.sqrt(k + 2 * c) * t)
    return (q * (even + odd) / 2,), (q * (even - odd) / 2,)


def _our_pair(q: Any, k: Any, c: Any, t: Any) -> tuple[Any, Any]:
    """The flow of zᵀSz/2 to time t, z = (q₁, q₂, p₁, p₂)."""
    import jax.numpy as jnp

    from canon.numeric.groups import symplectic

    zero, one = 0.0 * k, 1.0 + 0.0 * k
    rows = ((k + c, -c, zero, zero), (-c, k + c, zero, zero), (zero, zero, one, zero), (zero, zero, zero, one))
    S = jnp.moveaxis(jnp.stack([jnp.stack(row) for row in rows]), -1, 0)
    flow = symplectic.exp(S * t[:, None, None])
    return flow[:, 0, 0] * q, flow[:, 1, 0] * q


def _numpy_pair(q: float, k: float, c: float, t: float) -> Quantities:
    """By numpy's eigenvectors of the stiffness matrix."""
    import numpy as np

    squares, vectors = np.linalg.eigh(np.array([[k + c, -c], [-c, k + c]]))
    found = vectors @ (np.cos(np.sqrt(squares) * t) * (vectors.T @ np.array([q, 0.0])))
    return (float(found[0]),), (float(found[1]),)


CASES = (
    HardCase(
        "stiff springs",
        "modes",
        "both frequencies of two masses whose springs differ by 1e6 to 1e24",
        ("k", "K", "m"),
        tuple((1.0, 10.0**j, 0.7) for j in (6, 12, 15, 24)),
        _stiff,
        each(_our_stiff),
        peers={"numpy.linalg.eigvalsh": each(_eigh("numpy")), "scipy.linalg.eigh": each(_eigh("scipy"))},
        digits=120,
    ),
    HardCase(
        "1 to 1000 degrees of freedom",
        "modes",
        "the slowest and the fastest mode of a chain",
        ("n", "k", "m"),
        tuple((float(n), 1.3, 0.7) for n in (1, 10, 100, 1000)),
        _long,
        each(_our_long),
        each(_naive_long),
        {"scipy.linalg": each(_scipy_long)},
        held=frozenset({0}),
    ),
    HardCase(
        "frequencies that nearly coincide",
        "modes",
        "what one of two equal oscillators gives to the other, coupled by 1e-4 to 1e-15",
        ("q", "k", "c", "t"),
        tuple((1.0, 1.0, 10.0**-j, 5.0) for j in (4, 8, 12, 15)),
        _pair,
        compiled(_our_pair),
        peers={"numpy.linalg.eigh": each(_numpy_pair)},
        digits=80,
    ),
)
