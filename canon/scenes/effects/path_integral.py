"""Potentials of polynomial fields, by integration along rays from the origin."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from canon.scenes.model import Formula


def along_rays(integrand: Formula, x: Sequence[sp.Symbol], weight: int) -> Formula | None:
    """∫₀¹ s^(weight − 1) f(s x) ds of a polynomial f without a constant term: a term of degree d over d + weight.

    With f = E·x and weight 0 it is the work along the ray to x; with f = B × x and weight 1 the Poincaré gauge's
    potential. None where f is no polynomial in x.
    """
    expanded = sp.expand(integrand)
    if not expanded.is_polynomial(*x):
        return None
    terms = sp.Poly(expanded, *x).terms()
    return sp.Add(
        *(
            coefficient * sp.Mul(*(y**k for y, k in zip(x, powers, strict=True))) / (sum(powers) + weight)
            for powers, coefficient in terms
            if coefficient != 0
        )
    )
