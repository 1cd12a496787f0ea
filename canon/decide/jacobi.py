"""Balls of Jacobi's elliptic functions sn, cn, dn and epsilon at real argument and any real parameter.

They are real-analytic for all real u and m: with sn² + cn² = 1 their equations have bounded right-hand sides.
For 0 < m < 1 by theta functions (DLMF 22.2.4-6; ε from Jacobi's zeta, 22.16.32 and 22.16.26); m < 0 and m > 1 by the
transformations of Abramowitz & Stegun 16.10 and 16.11 (DLMF 22.17); at m = 0 and m = 1 elementary (DLMF 22.5(ii)).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from flint import acb, arb

Ball = Any  # flint.arb or flint.acb; the package has no type stubs


def jacobi(which: str) -> Callable[[Ball, Ball], Ball | None]:
    """The function (u, m) → ball of sn, cn, dn or epsilon, for real balls.

    Its value is None where a wide m lies on both sides of 0 or of 1.
    """

    def rule(u: Ball, m: Ball) -> Ball | None:
        if m > 0 and m < 1:
            return _between(which, u, m)
        if m < 0:
            return _below(which, u, -m)
        if m > 1:
            return _above(which, u, m)
        if m.is_exact() and m == 0:
            return {"sn": u.sin, "cn": u.cos, "dn": lambda: arb(1), "epsilon": lambda: u}[which]()
        if m.is_exact() and m == 1:
            return u.tanh() if which in ("sn", "epsilon") else u.sech()
        return None

    return rule


def _between(which: str, u: Ball, m: Ball) -> Ball:
    """0 < m < 1, with z = u/2K in the periods of flint's theta functions."""
    period, other = acb(m).elliptic_k(), acb(1 - m).elliptic_k()
    tau, z = acb(0, 1) * other / period, acb(u) / (2 * period)
    s1, s2, s3, s4 = acb.modular_theta(z, tau)
    if which == "epsilon":
        slope = acb.modular_theta(z, tau, 1)[3]
        return (acb(u) * acb(m).elliptic_e() / period + slope / (2 * period * s4)).real
    _, t2, t3, t4 = acb.modular_theta(acb(0), tau)
    if which == "sn":
        return (t3 * s1 / (t2 * s4)).real
    return (t4 * s2 / (t2 * s4)).real if which == "cn" else (t4 * s3 / (t3 * s4)).real


def _below(which: str, u: Ball, n: Ball) -> Ball:
    """m = −n < 0: sn(u | −n) = sd(v | μ)/√(1+n), cn = cd, dn = nd, with v = √(1+n)·u and μ = n/(1+n)."""
    stretch, mu = (1 + n).sqrt(), n / (1 + n)
    v = stretch * u
    dn = _between("dn", v, mu)
    if which == "dn":
        return 1 / dn
    if which == "cn":
        return _between("cn", v, mu) / dn
    if which == "sn":
        return _between("sn", v, mu) / (stretch * dn)
    bend = mu * _between("sn", v, mu) * _between("cn", v, mu) / dn
    return stretch * (_between("epsilon", v, mu) - bend)


def _above(which: str, u: Ball, m: Ball) -> Ball:
    """m > 1: sn(u | m) = sn(v | 1/m)/√m, cn = dn(v | 1/m), dn = cn(v | 1/m), with v = √m·u."""
    stretch, mu = m.sqrt(), 1 / m
    v = stretch * u
    if which == "epsilon":
        return stretch * (_between("epsilon", v, mu) - (1 - mu) * v)
    value = _between({"sn": "sn", "cn": "dn", "dn": "cn"}[which], v, mu)
    return value / stretch if which == "sn" else value
