"""Jacobi's elliptic functions sn, cn, dn of argument u and parameter m = k², which sympy lacks.

Kept as written: nothing is rewritten at construction. Derivatives in u are those of DLMF 22.13(i);
the one in m isn't elementary in sn, cn and dn and is refused.
"""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import ArgumentIndexError


class _Jacobi(sp.Function):
    """What the three have in common: two arguments (u, m)."""

    nargs = 2

    def _in_u(self) -> Any:
        raise ArgumentIndexError(self, 1)

    def fdiff(self, argindex: int = 1) -> Any:
        """The derivative in u (`argindex` 1)."""
        if argindex != 1:
            raise ArgumentIndexError(self, argindex)
        return self._in_u()


class JacobiSN(_Jacobi):
    """sn(u | m): sn' = cn dn."""

    def _in_u(self) -> Any:
        u_and_m: Any = self.args
        cn: Any = JacobiCN(*u_and_m)
        return cn * JacobiDN(*u_and_m)


class JacobiCN(_Jacobi):
    """cn(u | m): cn' = −sn dn."""

    def _in_u(self) -> Any:
        u_and_m: Any = self.args
        sn: Any = JacobiSN(*u_and_m)
        return -sn * JacobiDN(*u_and_m)


class JacobiDN(_Jacobi):
    """dn(u | m): dn' = −m sn cn."""

    def _in_u(self) -> Any:
        u_and_m: Any = self.args
        sn: Any = JacobiSN(*u_and_m)
        return -u_and_m[1] * sn * JacobiCN(*u_and_m)
