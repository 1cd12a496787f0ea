"""Summing sum_k s^k f_k / k! where the f_k repeat themselves up to constants."""

from collections.abc import Sequence
from random import Random
from typing import Any

import sympy as sp

from canon.mechanics.formulas import replaced
from canon.mechanics.one_form import tidy


def periodic_sum(terms: Sequence[sp.Expr], start: int, ratio: sp.Expr, s: sp.Symbol) -> sp.Expr:
    """The sum where f_{k + r} = ratio f_k for k >= `start`, r = len(terms) - start being 1 or 2.

    With r = 1 exponentials, with r = 2 cosines and sines (hyperbolic ones for a positive ratio).
    """
    head = [s**k / sp.factorial(k) * term for k, term in enumerate(terms[:start])]
    if len(terms) - start == 1:
        missing = sp.Add(*((ratio * s) ** k / sp.factorial(k) for k in range(start)))
        return sp.Add(*head, (sp.exp(ratio * s) - missing) / ratio**start * terms[start])
    even, odd = _cosine_and_sine(ratio, s)
    tail = []
    for index in (start, start + 1):
        series, parity = (even, 0) if index % 2 == 0 else (odd, 1)
        missing = sp.Add(*(ratio ** ((k - parity) // 2) * s**k / sp.factorial(k) for k in range(parity, index, 2)))
        tail.append((series - missing) / ratio ** ((index - parity) // 2) * terms[index])
    return sp.Add(*head, *tail)


def _cosine_and_sine(square: sp.Expr, s: sp.Symbol) -> tuple[sp.Expr, sp.Expr]:
    """The solutions of y'' = square y with (y, y') = (1, 0) and (0, 1) at s = 0."""
    if square.is_positive or (not square.is_negative and not square.could_extract_minus_sign()):
        rate = root_of(square)
        return sp.cosh(rate * s), sp.sinh(rate * s) / rate
    rate = root_of(-square)
    return sp.cos(rate * s), sp.sin(rate * s) / rate


def root_of(square: sp.Expr) -> Any:
    """A square root, of whichever sign: absolute values are dropped, since only even functions of it are taken."""
    root = sp.sqrt(sp.factor(square) if sp.count_ops(square) < 100 else square)
    return root.replace(sp.Abs, lambda inner: inner)


def constant_recurrence(terms: Sequence[sp.Expr], variables: Sequence[sp.Symbol]) -> tuple[sp.Expr, ...] | None:
    """Coefficients c_j free of `variables` with f_n = sum_{j < n} c_j f_j, or `None`.

    They are determined at sample points of the variables, and then the equation is compared as a whole.
    """
    *basis, last = terms
    random = Random(len(basis))
    rows, sides = [], []
    for _ in basis:
        point = {x: sp.Rational(random.randint(1, 40), random.randint(3, 11)) for x in variables}
        rows.append([replaced(term, point) for term in basis])
        sides.append(replaced(last, point))
    matrix, side = sp.Matrix(rows), sp.Matrix(sides)
    if matrix.has(sp.zoo, sp.nan) or side.has(sp.zoo, sp.nan):
        return None
    determinant = tidy(matrix.det(method="berkowitz"))
    if determinant == 0:
        return None
    solution = tuple(tidy(entry / determinant) for entry in matrix.adjugate() * side)
    rest = tidy(last - sp.Add(*(c * term for c, term in zip(solution, basis, strict=True))))
    return solution if rest == 0 else None


def recurrent_sum(terms: Sequence[sp.Expr], coefficients: Sequence[sp.Expr], s: sp.Symbol) -> sp.Expr | None:
    """The sum where f_n = sum_{j < n} c_j f_j for all later ones too, n = len(terms).

    As a function of s it solves y^(n) = sum c_j y^(j) with y^(j)(0) = f_j. `None` when the roots are not found.
    """
    size = len(terms)
    x = sp.Dummy("root")
    polynomial = x**size - sp.Add(*(c * x**j for j, c in enumerate(coefficients)))
    roots = sp.roots(sp.factor(polynomial), x)
    if sum(roots.values()) != size:
        return None
    basis = _solutions(roots, s)
    start = sp.Matrix(size, size, lambda i, j: basis[int(j)].diff(s, int(i)).subs(s, 0))
    determinant = tidy(start.det(method="berkowitz"))
    if determinant == 0:
        return None
    weights = start.adjugate() * sp.Matrix(terms) / determinant
    return sp.Add(*(tidy(weight) * solution for weight, solution in zip(weights, basis, strict=True)))


def _solutions(roots: dict[sp.Expr, int], s: sp.Symbol) -> list[sp.Expr]:
    """A basis of solutions, real where the roots are real or come in opposite imaginary pairs."""
    basis: list[sp.Expr] = []
    left = dict(roots)
    while left:
        root, times = left.popitem()
        square = tidy(root**2)
        opposite = next((other for other in left if tidy(other + root) == 0), None)
        if opposite is not None and root != 0 and left[opposite] == times:
            del left[opposite]
            pair = _cosine_and_sine(square, s)
            basis.extend(s**k * solution for k in range(times) for solution in pair)
        else:
            basis.extend(s**k * sp.exp(root * s) for k in range(times))
    return basis
