"""Actions, frequencies and angles of the isochrone −a/(b + √(b² + r²)), and of Kepler's −a/r at b = 0, in closed form.

With k = am, s = √(b² + r²), λ = ½(L + √(L² + 4kb)) and β = −2mE, J_r/2π = k/√β − λ. Near a circle the two terms agree
in all but their last digits; but k² − βλ² = λ² p_r² + (λ² − ks)²/r² is a sum of squares, and λ² − ks, which vanishes on
the circle, is taken in double-double arithmetic. So is β, which vanishes for an orbit that is hardly bound.
Conditioning: next to a circle J_r is as the square of the eccentricity e, so that relative errors ε of a state are
errors of some ε/e of J_r; the energy of a hardly bound orbit is known to ε of its two terms, and J_r with it.
Hénon (1959), Ann. Astrophys. 22, 126; Binney and Tremaine (2008), Galactic Dynamics, 3.5.2.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from canon.numeric.compensated import sum_of_products, two_product, two_sum
from canon.numeric.precision import doubles

_UNIT: Final = 2.0**-53


class CentralActions(NamedTuple):
    """Of each orbit: J_r and J_φ = 2πL, their frequencies in cycles, and a bound of the error of J_r.

    The inputs are taken as exact. J_φ and the frequencies of a closed form are right to a few units in the last place;
    frequencies by quadrature have no bound: far inside of a core, where V hardly differs from V(0), digits are lost.
    """

    radial: Any
    azimuthal: Any
    radial_frequency: Any
    azimuthal_frequency: Any
    bound: Any


class _Scales(NamedTuple):
    """Intermediate quantities, some of them with what their rounding lost."""

    k: Any
    s: Any
    binding: Any
    lam: Any
    gap: Any
    root: Any


def isochrone_actions(r: Any, p_r: Any, L: Any, *, m: Any = 1.0, a: Any = 1.0, b: Any = 0.0) -> CentralActions:
    """The actions of orbits given by radius, radial momentum and angular momentum L ≥ 0, elementwise.

    It is a function of arrays that jax can trace, batch and differentiate; nan where the orbit is not bound, and
    where r isn't positive or L is negative.

    **Arguments:** `m`, the mass; the potential energy is −a/(b + √(b² + r²)), with `b` = 0 for Kepler's.
    """
    import jax.numpy as jnp

    r, p_r, L, m, a, b = doubles(r=r, p_r=p_r, L=L, m=m, a=a, b=b)
    L = jnp.where((r > 0) & (L >= 0), L, jnp.nan)
    k, s, beta, lam, gap, root = _scales(r, p_r, L, m, a, b)
    scale = k / jnp.sqrt(beta)
    square = (lam * p_r) ** 2 + gap * gap
    radial = 2 * jnp.pi * square / (beta * (scale + lam))
    rate = beta * jnp.sqrt(beta) / (2 * jnp.pi * k * m)
    share = jnp.where(root > 0, L / jnp.where(root > 0, root, 1.0), 1.0)
    # what double-double arithmetic leaves of the difference, against its size and that of β's terms
    second = 64 * _UNIT**2 * (lam * lam + k * s) / r
    slack = 64 * _UNIT**2 * k / ((b + s) * beta)
    bound = radial * (24 * _UNIT + slack) + 2 * jnp.pi * second * (2 * jnp.abs(gap) + second) / (beta * scale)
    return CentralActions(radial, 2 * jnp.pi * L, rate, rate * (1 + share) / 2, bound)


def isochrone_angle(r: Any, p_r: Any, L: Any, *, m: Any = 1.0, a: Any = 1.0, b: Any = 0.0) -> Any:
    """The radial angle w_r in [0, 1), 0 at the least radius, elementwise: 2πw_r = η − r p_r √β/k.

    The eccentric anomaly has tan η = r p_r √β/(k − βs), and with g = (λ² − ks)/r, k − βs = s p_r² + g (r/(b + s) +
    bL/λr), which is small on a nearly circular orbit because g and p_r are: λ² = Lλ + kb. Binney and Tremaine (2008),
    (3.226).
    """
    import jax.numpy as jnp

    r, p_r, L, m, a, b = doubles(r=r, p_r=p_r, L=L, m=m, a=a, b=b)
    k, s, beta, lam, gap, _ = _scales(r, p_r, L, m, a, b)
    across = r * p_r * jnp.sqrt(beta)
    # not (k r + s g)/λ², which for Kepler's problem with a small L is a difference over what is smaller
    share = jnp.where(lam > 0, L / jnp.where(lam > 0, lam, 1.0), 1.0)
    along = s * p_r * p_r + gap * (r / (b + s) + b * share / r)
    w = (jnp.arctan2(across, along) - across / k) / (2 * jnp.pi)
    return w - jnp.floor(w)


def _scales(r: Any, p: Any, L: Any, m: Any, a: Any, b: Any) -> _Scales:
    """Of each root and quotient, what its rounding lost is put back to first order where differences are taken."""
    import jax.numpy as jnp
    from jax import lax

    # XLA takes (x + c) − c for x where c is a constant, which is what error-free sums must not be: it may not know one
    m, a, b = lax.optimization_barrier((m, a, b))
    k, k_lost = two_product(a, m)
    s = jnp.sqrt(b * b + r * r)
    s_lost = _sum([(b, b), (r, r), (s, -s)]) / (2 * s)
    whole, whole_lost = two_sum(b, s)
    depth, across = 2 * k / whole, L / r
    depth_lost = (_sum([(2 * k, 1.0), (-depth, whole)]) + 2 * k_lost - depth * (whole_lost + s_lost)) / whole
    across_lost = _sum([(L, 1.0), (-across, r)]) / r
    high, low = sum_of_products([(depth, 1.0), (p, -p), (across, -across)])
    beta = high + (low + depth_lost - 2 * across * across_lost)
    root = jnp.sqrt(L * L + 4 * k * b)
    root_lost = (_sum([(L, L), (4 * k, b), (root, -root)]) + 4 * k_lost * b) / jnp.where(root > 0, 2 * root, 1.0)
    lam, lam_lost = two_sum(L, root)
    lam, lam_lost = lam / 2, (lam_lost + root_lost) / 2
    high, low = sum_of_products([(lam, lam), (-k, s)])
    gap = (high + (low + 2 * lam * lam_lost - k * s_lost - k_lost * s)) / r
    return _Scales(k, s, jnp.where(beta > 0, beta, jnp.nan), lam, gap, root)


def _sum(pairs: Any) -> Any:
    high, low = sum_of_products(pairs)
    return high + low
