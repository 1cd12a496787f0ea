"""∫ R(s)/√W ds from 0 to 1 for a rational R, W = s(1 − s)(1 − ms), by Legendre's three complete integrals.

As partial fractions R is a sum of powers of s and of 1/(1 − ns). With (s^k √W)' and (√W/(1 − ns)^i)', whose integrals
are 0, all but 1, s and 1/(1 − ns) are removed; and ∫ds/√W = 2K(m), ∫s ds/√W = 2(K(m) − E(m))/m,
∫ds/((1 − ns)√W) = 2Π(n, m) (Byrd and Friedman 1971, 310 and 336; s = sn²).
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from canon.mechanics.action_angle import degree
from canon.mechanics.residues import factored
from canon.special import EllipticPi

S = sp.Symbol("s(q)", real=True)  # no name of a file


def decomposed(shape: dict[Any, int], m: Any) -> tuple[dict[Any, Any], Any] | None:
    """∫ R/√W ds from 0 to 1 as {function: coefficient}, and what vanishes if R is what it was taken for."""
    R = sp.Mul(*(f**e for f, e in shape.items()))
    W = sp.expand(S * (1 - S) * (1 - m * S))
    slope = sp.diff(W, S)
    first, second = sp.elliptic_k(m), sp.elliptic_e(m)
    powers: dict[int, Any] = {}
    poles: dict[Any, dict[int, Any]] = {}
    for term in sp.Add.make_args(sp.apart(R, S)):
        if term.is_polynomial(S):
            for k, coefficient in enumerate(reversed(sp.Poly(term, S).all_coeffs())):
                powers[k] = powers.get(k, 0) + coefficient
            continue
        above, below = sp.fraction(sp.together(term))
        number, found = factored(below, S)
        (linear, order) = next((pair for pair in found if pair[0].has(S)), (None, 0))
        if linear is None or above.has(S) or sum(f.has(S) for f, _ in found) != 1 or degree(linear, S) != 1:
            return None
        rest = sp.Mul(*(f**e for f, e in found if not f.has(S))) * number
        constant = linear.xreplace({S: sp.S.Zero})
        n = sp.cancel(-linear.coeff(S, 1) / constant)
        entry = poles.setdefault(n, {})
        entry[order] = entry.get(order, 0) + above / (rest * constant**order)
    h: Any = sp.S.Zero
    for n, entry in poles.items():
        h = h + _lower_poles(n, entry, W, m, powers)
    for k in range(max(powers, default=0), 1, -1):  # (s^(k−2)·√W)' has s^k on top, with the factor m(k − 1/2)
        lead = powers.pop(k, sp.S.Zero)
        if lead == 0:
            continue
        g = sp.cancel(lead / (m * (k - sp.Rational(1, 2))))
        j = k - 2
        h = h + g * S**j
        powers[k - 1] = sp.cancel(powers.get(k - 1, 0) + g * (1 + m) * (j + 1))
        powers[j] = sp.cancel(powers.get(j, 0) - g * (j + sp.Rational(1, 2)))
    alpha, beta = powers.get(0, sp.S.Zero), powers.get(1, sp.S.Zero)
    parts: dict[Any, Any] = {first: 2 * alpha + 2 * beta / m, second: -2 * beta / m}
    plain = alpha + beta * S
    for n, entry in poles.items():
        parts[EllipticPi(n, m)] = 2 * entry.get(1, sp.S.Zero)
        plain = plain + entry.get(1, sp.S.Zero) / (1 - n * S)
    return parts, R - plain - h * slope / 2 - sp.diff(h, S) * W


def _lower_poles(n: Any, entry: dict[int, Any], W: Any, m: Any, powers: dict[int, Any]) -> Any:
    """h for the poles of higher order at 1/n: (√W t^−i)' with t = 1 − ns; changes `entry` and `powers`."""
    t = sp.Symbol("t(q)", real=True)
    w = [sp.cancel(sp.expand(W.xreplace({S: (1 - t) / n})).coeff(t, k)) for k in range(4)]
    at_root = w[0] == 0  # the pole is a root of W, the image of d or c: then already the first order is reduced
    h: Any = sp.S.Zero
    for order in range(max(entry), 0 if at_root else 1, -1):
        lead = entry.pop(order, sp.S.Zero)
        if lead == 0:
            continue
        i = order if at_root else order - 1
        top = n * (i - sp.Rational(1, 2)) * w[1] if at_root else n * i * w[0]
        g = sp.cancel(lead / top)
        h = h + g / (1 - n * S) ** i
        lower = {i: (i - sp.Rational(1, 2)) * w[1], i - 1: (i - 1) * w[2], i - 2: (i - sp.Rational(3, 2)) * w[3]}
        for k, coefficient in lower.items():
            if k == order:
                continue
            change = -g * n * coefficient
            if k >= 1:
                entry[k] = sp.cancel(entry.get(k, 0) + change)
            elif k == 0:
                powers[0] = powers.get(0, 0) + change
            else:  # t = 1 − ns
                powers[0] = powers.get(0, 0) + change
                powers[1] = powers.get(1, 0) - n * change
    return h
