"""Jacobi's elliptic functions sn, cn, dn and epsilon of argument u and parameter m = k², which sympy lacks.

Kept as written: nothing is rewritten at construction. The derivatives in u are those of DLMF 22.13(i) and 22.16.14.
Those in m follow from am(u, m) with E(am) = ε at fixed u (Byrd & Friedman 710.51-53, in m instead of k); with
a = [dn·((1−m)u − ε) + m sn cn] / (2m(1−m)) they are ∂sn = a cn, ∂cn = −a sn and
∂dn = −sn·[cn·((1−m)u − ε) + sn dn] / (2(1−m)), ∂ε = [sn cn dn − (1−m)u sn² − ε cn²] / (2(1−m)).
"""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import ArgumentIndexError


class _Jacobi(sp.Function):
    """What the four have in common: two arguments (u, m)."""

    nargs = 2

    def _in_u(self, sn: Any, cn: Any, dn: Any) -> Any:
        raise ArgumentIndexError(self, 1)

    def _in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        raise ArgumentIndexError(self, 2)

    def fdiff(self, argindex: int = 1) -> Any:
        """The derivative in u (`argindex` 1) or in m (`argindex` 2)."""
        if argindex not in (1, 2):
            raise ArgumentIndexError(self, argindex)
        others = (JacobiSN(*self.args), JacobiCN(*self.args), JacobiDN(*self.args))
        return self._in_u(*others) if argindex == 1 else self._in_m(*others)

    def _fall(self) -> Any:
        """(1−m)u − ε(u | m)."""
        u, m = self._u_and_m()
        epsilon: Any = JacobiEpsilon(u, m)
        return (1 - m) * u - epsilon

    def _amplitude_in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        """∂am(u | m)/∂m."""
        _, m = self._u_and_m()
        return (dn * self._fall() + m * sn * cn) / (2 * m * (1 - m))

    def _u_and_m(self) -> Any:
        return self.args


class JacobiSN(_Jacobi):
    """sn(u | m): sn' = cn dn."""

    def _in_u(self, sn: Any, cn: Any, dn: Any) -> Any:
        return cn * dn

    def _in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        return cn * self._amplitude_in_m(sn, cn, dn)


class JacobiCN(_Jacobi):
    """cn(u | m): cn' = −sn dn."""

    def _in_u(self, sn: Any, cn: Any, dn: Any) -> Any:
        return -sn * dn

    def _in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        return -sn * self._amplitude_in_m(sn, cn, dn)


class JacobiDN(_Jacobi):
    """dn(u | m): dn' = −m sn cn."""

    def _in_u(self, sn: Any, cn: Any, dn: Any) -> Any:
        return -self._u_and_m()[1] * sn * cn

    def _in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        return -sn * (cn * self._fall() + sn * dn) / (2 * (1 - self._u_and_m()[1]))


class JacobiEpsilon(_Jacobi):
    """ε(u | m), the integral of dn² from 0 to u (DLMF 22.16.14): ε' = dn². It arises from derivatives in m."""

    def _in_u(self, sn: Any, cn: Any, dn: Any) -> Any:
        return dn**2

    def _in_m(self, sn: Any, cn: Any, dn: Any) -> Any:
        u, m = self._u_and_m()
        return (sn * cn * dn - (1 - m) * u * sn**2 - self * cn**2) / (2 * (1 - m))
