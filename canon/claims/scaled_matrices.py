"""Matrices as real scales times Gaussian rationals: their structure constants are exact, and quickly found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp

from canon.claims.scale import never_zero
from canon.mechanics.algebra.coefficients import exact as exact_number
from canon.mechanics.algebra.coefficients import times as product
from canon.mechanics.algebra.from_matrices import Entry
from canon.mechanics.algebra.lie_algebra import LieAlgebra


def scaled_matrices(
    matrices: Mapping[str, list[list[Any]]],
) -> tuple[dict[str, sp.Expr], dict[str, list[list[Entry]]]] | None:
    """Each matrix as a scale that is real and never 0 times one of Gaussian rationals; None where one isn't."""
    scales: dict[str, sp.Expr] = {}
    plain: dict[str, list[list[Entry]]] = {}
    for name, rows in matrices.items():
        scale = sp.S.One
        table = _gaussian(rows)
        if table is None:
            scale = _real_factor(next(e for row in rows for e in row if e != 0 and _entry(e) is None))
            if not scale.is_real or not never_zero(scale):
                return None
            table = _gaussian([[sp.radsimp(sp.cancel(e / scale)) for e in row] for row in rows])
        if table is None:
            return None
        scales[name], plain[name] = scale, table
    return scales, plain


def _real_factor(entry: Any) -> Any:
    """The entry without its rational number and without i."""
    factors = [f for f in sp.Mul.make_args(sp.factor_terms(entry)) if not f.is_Rational and f is not sp.I]
    return sp.Mul(*factors)


def _gaussian(rows: Sequence[Sequence[Any]]) -> list[list[Entry]] | None:
    table: list[list[Entry]] = []
    for row in rows:
        values = [_entry(e) for e in row]
        if None in values:
            return None
        table.append([v for v in values if v is not None])
    return table


def _entry(value: Any) -> Entry | None:
    """A Gaussian rational, or None."""
    if value.is_Rational:
        return Fraction(int(value.p), int(value.q))
    expanded: Any = sp.expand(value)
    imaginary = expanded.coeff(sp.I)
    real = expanded - imaginary * sp.I
    if real.is_Rational and imaginary.is_Rational:
        return Fraction(int(real.p), int(real.q)), Fraction(int(imaginary.p), int(imaginary.q))
    return None


def unscaled(algebra: LieAlgebra, scales: Mapping[str, sp.Expr]) -> LieAlgebra:
    """The constants of the given matrices s_a X_a, from those of the X_a."""
    if all(scale == 1 for scale in scales.values()):
        return algebra
    s = [scales[name] for name in algebra.names]
    constants = {
        (a, b): {c: product(value, exact_number(sp.radsimp(s[a] * s[b] / s[c]))) for c, value in row.items()}
        for (a, b), row in algebra.constants.items()
    }
    return LieAlgebra(algebra.names, constants)
