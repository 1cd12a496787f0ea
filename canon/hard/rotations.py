"""Rotations near 0 and π, Euler angles at gimbal lock, tops at their limits."""

from __future__ import annotations

import math
from typing import Any

from canon.hard.case import HardCase, Number, Quantities, compiled, each

VECTOR = ("x", "y", "z")


def _itself(m: Any, x: Number, y: Number, z: Number) -> Quantities:
    return ((x, y, z),)


def _our_turn(x: Any, y: Any, z: Any) -> Any:
    """log exp v on SO(3), by the matrix."""
    import jax.numpy as jnp

    from canon.numeric.groups import so3

    return jnp.moveaxis(so3.log(so3.exp(jnp.stack([x, y, z], -1))), -1, 0)


def _naive_turn(x: float, y: float, z: float) -> Quantities:
    """Rodrigues' matrix; the angle from its trace, the axis from its antisymmetric part."""
    import numpy as np

    angle = math.sqrt(x * x + y * y + z * z)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) / angle
    R = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)
    found = np.arccos((np.trace(R) - 1) / 2)
    w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return (tuple(float(u) for u in found / (2 * np.sin(found)) * w),)


def _scipy_rotation(x: float, y: float, z: float) -> Quantities:
    from scipy.spatial.transform import Rotation

    v = Rotation.from_matrix(Rotation.from_rotvec([x, y, z]).as_matrix()).as_rotvec()
    return (tuple(float(u) for u in v),)


def _scipy_logm(x: float, y: float, z: float) -> Quantities:
    from scipy.linalg import expm, logm

    L: Any = logm(expm([[0, -z, y], [z, 0, -x], [-y, x, 0]]))
    return (tuple(float(u.real) for u in (L[2, 1], L[0, 2], L[1, 0])),)


def _euler(m: Any, w: Number, x: Number, y: Number, z: Number) -> Quantities:
    """(φ), (θ), (ψ) of z-x-z from the rotation's matrix: θ = acos R₃₃, tan φ = −R₁₃/R₂₃, tan ψ = R₃₁/R₃₂.

    Goldstein, Poole and Safko (2002), 4.46.
    """
    size = w * w + x * x + y * y + z * z
    R13, R23 = 2 * (x * z + w * y) / size, 2 * (y * z - w * x) / size
    R31, R32 = 2 * (x * z - w * y) / size, 2 * (y * z + w * x) / size
    R33 = 1 - 2 * (x * x + y * y) / size
    return (m.atan2(R13, -R23),), (m.acos(R33),), (m.atan2(R31, R32),)


def _our_euler(w: Any, x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    import jax.numpy as jnp

    from canon.numeric.rotations import to_euler

    return to_euler(jnp.stack([w, x, y, z]))


def _scipy_euler(w: float, x: float, y: float, z: float) -> Quantities:
    from scipy.spatial.transform import Rotation

    phi, theta, psi = Rotation.from_quat([x, y, z, w]).as_euler("ZXZ")
    return (float(phi),), (float(theta),), (float(psi),)


def _tilted(theta: float, phi: float, psi: float) -> tuple[float, ...]:
    c, s = math.cos(theta / 2), math.sin(theta / 2)
    across, along = (phi - psi) / 2, (phi + psi) / 2
    return (c * math.cos(along), s * math.cos(across), s * math.sin(across), c * math.sin(along))


def _body_momentum(m: Any, theta: Number, psi: Number, p_phi: Number, p_theta: Number, p_psi: Number) -> Quantities:
    """M₁ and M₂ of Euler's momenta, (p_φ − p_ψ cos θ)/sin θ as it stands. Goldstein, Poole and Safko (2002), 5.7."""
    along = (p_phi - p_psi * m.cos(theta)) / m.sin(theta)
    return ((along * m.sin(psi) + p_theta * m.cos(psi), along * m.cos(psi) - p_theta * m.sin(psi)),)


def _our_body_momentum(theta: Any, psi: Any, p_phi: Any, p_theta: Any, p_psi: Any) -> Any:
    from canon.numeric.rotations import momentum_in_body

    return momentum_in_body(theta, psi, p_phi, p_theta, p_psi)[:2]


def _sympy_body_momentum(*values: float) -> Quantities:
    """sympy's lambdified formula."""
    import sympy as sp

    theta, psi, p_phi, p_theta, p_psi = names = sp.symbols("theta psi p_phi p_theta p_psi")
    along = (p_phi - p_psi * sp.cos(theta)) / sp.sin(theta)
    formulas = [along * sp.sin(psi) + p_theta * sp.cos(psi), along * sp.cos(psi) - p_theta * sp.sin(psi)]
    return (tuple(sp.lambdify(names, formulas, "math")(*values)),)


def along(length: float) -> tuple[float, float, float]:
    """A vector of this length in a direction whose components are fractions."""
    return (length * 2 / 7, length * 3 / 7, length * 6 / 7)


NEARLY = {"nearly spherical body": (1.0, 1 + 2.0**-40, 1 + 2.0**-38), "nearly planar body": (1.0, 2.0, 3 - 2.0**-40)}


def _body(moments: tuple[float, float, float], times: tuple[float, ...], name: str, states: str) -> HardCase:
    from canon.hard.separatrix import _tumble

    def reference(m: Any, small: Number, t: Number) -> Quantities:
        return _tumble(m, small, t, moments)

    def ours(small: Any, t: Any) -> Any:
        import jax.numpy as jnp

        from canon.numeric.exact.free_top import free_momentum

        return free_momentum(jnp.stack([small, 1.0 + 0.0 * small, 0.0 * small]), moments, t)

    points = tuple((small, t) for small in (0.6, 0.01) for t in times)
    return HardCase(name, "rotations", states, ("M1", "t"), points, reference, compiled(ours), digits=80)


TURNS = {"scipy.spatial": each(_scipy_rotation), "scipy.linalg.logm": each(_scipy_logm)}
CASES = (
    HardCase(
        "SO(3) logarithm near 0",
        "rotations",
        "the vector of a rotation by 1e-4 to 1e-150, from its matrix",
        VECTOR,
        tuple(along(10.0**-k) for k in (4, 8, 12, 150)),
        _itself,
        compiled(_our_turn),
        each(_naive_turn),
        TURNS,
    ),
    HardCase(
        "SO(3) logarithm near π",
        "rotations",
        "the vector of a rotation by π less 1e-4 to 1e-15, from its matrix",
        VECTOR,
        tuple(along(math.pi - 10.0**-k) for k in (4, 8, 12, 15)),
        _itself,
        compiled(_our_turn),
        each(_naive_turn),
        TURNS,
    ),
    HardCase(
        "Euler angles at gimbal lock",
        "rotations",
        "φ, θ and ψ of an attitude with θ = 1e-6 to 1e-150",
        ("w", "x", "y", "z"),
        tuple(_tilted(10.0**-k, 0.7, 0.4) for k in (6, 9, 12, 150)),
        _euler,
        compiled(_our_euler),
        peers={"scipy.spatial": each(_scipy_euler)},
        digits=360,
    ),
    HardCase(
        "a top with p_φ = p_ψ, θ → 0",
        "rotations",
        "its angular momentum across its axis",
        ("theta", "psi", "p_phi", "p_theta", "p_psi"),
        tuple((10.0**-k, 0.4, 1.3, 0.5 * 10.0**-k, 1.3) for k in (3, 6, 9, 150)),
        _body_momentum,
        compiled(_our_body_momentum),
        peers={"sympy": each(_sympy_body_momentum)},
        digits=360,
        held=frozenset({2, 4}),
    ),
    _body((1.0, 1 + 2.0**-40, 1 + 2.0**-38), (1e12, 1e13), "nearly spherical body", "its tumbling after 1e12 radians"),
    _body((1.0, 2.0, 3 - 2.0**-40), (30.0, 1000.0), "nearly planar body", "its tumbling, I₃ = I₁ + I₂ but for 1e-12"),
)
