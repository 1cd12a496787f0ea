"""Hamilton's characteristic function of a separated system, where its integrals are elementary: W = Σ ∫ pᵢ duᵢ.

The integrals are those of √Q and √Q/u for a quadratic Q (Goldstein, Poole and Safko 2002, section 3.8), and that of the
polar angle, each written for a motion between two turning points. Nothing is trusted: the complete integral that is
returned states itself as a claim, whose residual the decider looks at.
"""

from typing import Any

import sympy as sp

from canon.expected import instance_of
from canon.mechanics.formulas import as_formula
from canon.mechanics.hamilton_jacobi import CompleteIntegral
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.separation.actions import RANGES
from canon.mechanics.separation.staeckel import Separation
from canon.mechanics.stated_names import as_declared
from canon.sign import known_sign


def characteristic_function(separated: Separation) -> CompleteIntegral | None:
    """W(u, E, α₂, …) with its phase space in the separating coordinates; None where an integral isn't elementary."""
    instance_of(separated, Separation, "separated")
    coordinates, constants = separated.coordinates, separated.constants()
    u = coordinates.u
    parts = [root_integral(square, x) for x, square in zip(u, separated.momentum_squares(), strict=True)]
    if any(part is None for part in parts):
        return None
    W = sp.Add(*(part for part in parts if part is not None))
    names = [f"p_{x}" for x in u]
    free = sorted((W.free_symbols | {*constants} | separated.potential.free_symbols) - {*u}, key=str)
    space = PhaseSpace(u, names, **as_declared(s for s in free if isinstance(s, sp.Symbol)))
    for x in u:
        if x.name in RANGES:
            low, high = RANGES[x.name]
            space = space.where(x > low, x < high)
    kinetic = sp.Add(*(p**2 / h for p, h in zip(space.p, coordinates.squares, strict=True)))
    H = as_formula((kinetic / 2 + separated.potential) / separated.mass)
    return CompleteIntegral(space, H, W, constants, energy=constants[0])


def root_integral(square: Any, u: sp.Symbol) -> Any | None:
    """∫ √square du, of a constant, a polynomial of degree 1 or 2, one in u or u² over u², or A − B/sin²u; else None."""
    expanded: Any = sp.expand(square)
    if not expanded.has(u):
        return sp.sqrt(expanded) * u
    if expanded.is_polynomial(u) and sp.Poly(expanded, u).degree() <= 2:
        return _root(sp.Poly(expanded, u), u)
    over = sp.expand(expanded * u**2)
    if known_sign(u) == "positive" and over.is_polynomial(u):
        polynomial = sp.Poly(over, u)
        if polynomial.degree() <= 2:
            return _root_over_u(polynomial, u)
        if polynomial.degree() == 4 and not any(e[0] % 2 for e in polynomial.monoms()):
            s = sp.Dummy("s", positive=True)  # of u**2
            Q = sp.Poly([polynomial.coeff_monomial(u**k) for k in (4, 2, 0)], s)
            return _root_over_u(Q, s).xreplace({s: u**2}) / 2
    wave = sp.expand(expanded * sp.sin(u) ** 2)
    A = wave.coeff(sp.sin(u), 2)
    B = -(wave - A * sp.sin(u) ** 2)
    if not (A.has(u) or B.has(u)):
        R, c = sp.sqrt(A - B), sp.cos(u)
        return sp.sqrt(B) * sp.asin(sp.sqrt(B) * c / (sp.sin(u) * R)) - sp.sqrt(A) * sp.asin(sp.sqrt(A) * c / R)
    return None


def _root(Q: sp.Poly, u: sp.Symbol) -> Any:
    """∫ √(αu² + βu + γ) du, for α < 0 or α = 0."""
    alpha, beta, gamma = (Q.coeff_monomial(u**k) for k in (2, 1, 0))
    root = sp.sqrt(Q.as_expr())
    if alpha == 0:
        return 2 * root**3 / (3 * beta)
    return (2 * alpha * u + beta) * root / (4 * alpha) + (4 * alpha * gamma - beta**2) / (8 * alpha) * _inverse(Q, u)


def _root_over_u(Q: sp.Poly, u: sp.Symbol) -> Any:
    """∫ √(αu² + βu + γ)/u du, for u > 0, α < 0 and γ < 0 (or γ = 0)."""
    alpha, beta, gamma = (Q.coeff_monomial(u**k) for k in (2, 1, 0))
    total = sp.sqrt(Q.as_expr())
    if beta != 0:
        total = total + beta / 2 * (2 * sp.sqrt(Q.as_expr()) / beta if alpha == 0 else _inverse(Q, u))
    if gamma != 0:
        size = sp.sqrt(beta**2 - 4 * alpha * gamma)
        total = total + gamma / sp.sqrt(-gamma) * sp.asin((beta * u + 2 * gamma) / (u * size))
    return total


def _inverse(Q: sp.Poly, u: sp.Symbol) -> Any:
    """∫ du/√(αu² + βu + γ), for α < 0."""
    alpha, beta, gamma = (Q.coeff_monomial(u**k) for k in (2, 1, 0))
    return -sp.asin((2 * alpha * u + beta) / sp.sqrt(beta**2 - 4 * alpha * gamma)) / sp.sqrt(-alpha)
