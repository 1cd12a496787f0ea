"""Points of an algebraic set that Newton's method can't find: where equations depend on each other or touch.

By Gröbner bases over Q (Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, ch. 3 and 9): independent coordinates
keep their rational values, the others solve a system with finitely many solutions, root by root. Every basis generates
an ideal that contains the equations, so that a common zero of the basis lies on the set.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import arb, arb_poly, fmpq, fmpq_poly
from sympy.polys.orderings import grevlex

from canon.budget import Budget
from canon.deadline import within
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, precision

MOST_TERMS, MOST_NAMES, HIGHEST = 120, 7, 8
Terms = Mapping[tuple[int, ...], Fraction]


class NoZero(Exception):
    """The equations have no common zero, not even a complex one."""


Found = tuple[dict[int, Fraction], dict[int, Ball]]


def algebraic_point(
    equations: Sequence[Terms], values: Mapping[int, Fraction], rng: random.Random, bits: int, budget: Budget
) -> Found | None:
    """A real common zero near nothing in particular: exact coordinates, and balls of those that are irrational.

    Arguments:
      equations: polynomials as exponents → coefficient, all over the same coordinates 0, 1, ….
      values: rational values for coordinates that turn out to be free.
    Raises: NoZero where the equations contradict each other, BudgetExceeded where the time is over.
    """
    used = sorted({k for p in equations for m in p for k, e in enumerate(m) if e})
    degree = max((sum(m) for p in equations for m in p), default=0)
    if not used or len(used) > MOST_NAMES or sum(map(len, equations)) > MOST_TERMS or degree > HIGHEST:
        return None
    names = {k: sp.Symbol(f"x{k}") for k in used}
    polynomials = [_sympy(p, names) for p in equations]
    rng.shuffle(used)
    basis = _basis(polynomials, [names[k] for k in used], "grevlex", budget)
    if basis.exprs == [1]:
        raise NoZero
    free = _independent(basis, used)
    exact = {k: values[k] for k in free if k in values}
    if len(exact) < len(free):
        return None
    place = {names[k]: sp.Rational(v.numerator, v.denominator) for k, v in exact.items()}
    left = [k for k in used if k not in exact]
    return _solve([sp.expand(g.subs(place)) for g in basis.exprs], left, names, exact, bits, budget)


def _basis(polynomials: Sequence[Any], names: Sequence[sp.Symbol], order: str, budget: Budget) -> Any:
    return within(budget, lambda: sp.groebner(polynomials, *names, order=order, domain=sp.QQ))


def _sympy(terms: Terms, names: Mapping[int, sp.Symbol]) -> sp.Expr:
    out = []
    for monomial, c in terms.items():
        factors = [names[k] ** e for k, e in enumerate(monomial) if e]
        out.append(sp.Mul(sp.Rational(c.numerator, c.denominator), *factors))
    return sp.Add(*out)


def _independent(basis: Any, used: Sequence[int]) -> list[int]:
    """Coordinates in which no leading monomial of the basis is written: they can be chosen at will."""
    leading = [{used[i] for i, e in enumerate(p.monoms(order=grevlex)[0]) if e} for p in basis.polys]
    free: list[int] = []
    for k in used:
        if not any(support <= {*free, k} for support in leading):
            free.append(k)
    return free


def _solve(
    polynomials: Sequence[Any],
    left: Sequence[int],
    names: Mapping[int, Any],
    exact: dict[int, Fraction],
    bits: int,
    budget: Budget,
) -> Found | None:
    """The finitely many solutions in the coordinates that are left, one coordinate after the other."""
    polynomials = [p for p in polynomials if p != 0]
    if not left:
        return None if polynomials else (dict(exact), {})
    if any(p.is_number for p in polynomials):
        return None
    gens = [names[k] for k in left]
    basis = _basis(polynomials, gens, "lex", budget)
    last = [p for p in basis.exprs if p.free_symbols <= {gens[-1]}]
    if not last:
        return None
    factors: Any = within(budget, sp.Poly(last[0], gens[-1], domain=sp.QQ).factor_list)
    for factor, _ in factors[1]:
        root = _rational_root(factor)
        if root is not None:
            place = {gens[-1]: sp.Rational(root.numerator, root.denominator)}
            rest = [sp.expand(p.subs(place)) for p in basis.exprs]
            found = _solve(rest, left[:-1], names, {**exact, left[-1]: root}, bits, budget)
        else:
            found = _at_irrational_root(basis.exprs, factor, left, names, exact, bits, budget)
        if found is not None:
            return found
    return None


def _rational_root(factor: sp.Poly) -> Fraction | None:
    """The root of an irreducible polynomial of degree 1."""
    if factor.degree() != 1:
        return None
    a, b = factor.all_coeffs()
    root = -b / a
    return Fraction(int(root.p), int(root.q))


def _at_irrational_root(
    polynomials: Sequence[Any],
    factor: sp.Poly,
    left: Sequence[int],
    names: Mapping[int, Any],
    exact: Any,
    bits: int,
    budget: Budget,
) -> Found | None:
    """The other coordinates as polynomials in the last one, at a real root of its minimal polynomial."""
    gens = [names[k] for k in left]
    basis = _basis([*polynomials, factor.as_expr()], gens, "lex", budget)
    shapes: dict[int, fmpq_poly] = {}
    for k, x in zip(left[:-1], gens[:-1], strict=True):
        forms = [p for p in basis.exprs if sp.degree(p, x) == 1 and p.free_symbols <= {x, gens[-1]}]
        form = next((p for p in forms if sp.Poly(p, x).LC().is_number), None)
        if form is None:
            return None
        poly = sp.Poly(form, x)
        shapes[k] = _univariate(-poly.nth(0) / poly.LC(), gens[-1])
    with precision(bits):
        roots: Any = _univariate(factor.as_expr(), gens[-1]).complex_roots()
        for root, _ in roots:
            if isinstance(root, arb) or root.imag.is_zero():
                ball = root if isinstance(root, arb) else root.real
                return dict(exact), {left[-1]: ball} | {k: arb_poly(shape)(ball) for k, shape in shapes.items()}
    return None


def _univariate(expression: Any, x: Any) -> fmpq_poly:
    coefficients = sp.Poly(expression, x, domain=sp.QQ).all_coeffs()[::-1]
    return fmpq_poly([fmpq(int(c.p), int(c.q)) if c else rational(Fraction(0)) for c in coefficients])
