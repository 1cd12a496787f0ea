"""Jacobi's elliptic functions sn, cn, dn and epsilon of argument u and parameter m = k², which sympy lacks; Π.

Kept as written: nothing is rewritten at construction. The derivatives in u are those of DLMF 22.13(i) and 22.16.14.
Those in m follow from am(u, m) with E(am) = ε at fixed u (Byrd & Friedman 710.51-53, in m instead of k); with
a = [dn·((1−m)u − ε) + m sn cn] / (2m(1−m)) they are ∂sn = a cn, ∂cn = −a sn and
∂dn = −sn·[cn·((1−m)u − ε) + sn dn] / (2(1−m)), ∂ε = [sn cn dn − (1−m)u sn² − ε cn²] / (2(1−m)).
"""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import ArgumentIndexError


class EllipticPi(sp.Function):
    """Legendre's elliptic integral of the third kind, complete Π(n, m) or incomplete Π(n, φ, m).

    Π(n, φ, m) = ∫ dθ/((1 − n sin²θ)√(1 − m sin²θ)) from 0 to φ, and Π(n, m) = Π(n, π/2, m): the arguments of sympy's
    elliptic_pi. That class writes Π(n, φ, 0) as an atanh with an imaginary argument, which is right up to φ = π/2 only;
    this one is kept as written. Derivatives: DLMF 19.4.4-5 (Byrd and Friedman 1971, 710.12, 733.01).
    """

    nargs = (2, 3)

    def fdiff(self, argindex: int = 1) -> Any:
        """The derivative in n (`argindex` 1), in m (the last argument), or in φ (2 of 3)."""
        if argindex not in range(1, len(self.args) + 1):
            raise ArgumentIndexError(self, argindex)
        n, m = self._ends()
        first: Any
        second: Any
        if len(self.args) == 2:
            first, second, arc, bend = sp.elliptic_k(m), sp.elliptic_e(m), sp.S.Zero, sp.S.Zero
        else:
            phi: Any = self.args[1]
            first, second = sp.elliptic_f(phi, m), sp.elliptic_e(phi, m)
            root, under = sp.sqrt(1 - m * sp.sin(phi) ** 2), 1 - n * sp.sin(phi) ** 2
            if argindex == 2:
                return 1 / (root * under)
            arc = n * root * sp.sin(phi) * sp.cos(phi) / under
            bend = m * sp.sin(phi) * sp.cos(phi) / root
        if argindex == 1:
            inner = second - arc + (n**2 - m) * self / n  # type: ignore[operator]
            return inner / (2 * (m - n) * (n - 1)) + first / (2 * n * (n - 1))
        return ((second - bend) / (m - 1) + self) / (2 * (n - m))

    def _eval_derivative(self, s: Any) -> Any:
        n, m = self._ends()
        if n != m:
            return super()._eval_derivative(s)  # type: ignore[misc]
        if len(self.args) == 2:
            return (sp.elliptic_e(m) / (1 - m)).diff(s)
        phi: Any = self.args[1]  # DLMF 19.6.13
        arc = m * sp.sin(phi) * sp.cos(phi) / sp.sqrt(1 - m * sp.sin(phi) ** 2)
        return ((sp.elliptic_e(phi, m) - arc) / (1 - m)).diff(s)

    def _ends(self) -> Any:
        return self.args[0], self.args[-1]

    def _latex(self, printer: Any, exp: str | None = None) -> str:
        *upper, m = map(printer.doprint, self.args)
        text = rf"\Pi\left({'; '.join(upper)}\middle| {m}\right)"
        return text if exp is None else f"{text}^{{{exp}}}"


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
