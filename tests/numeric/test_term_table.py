"""Long polynomials: their table has the values that their formulas have, in numpy, in jax and under its derivatives."""

import random

import jax
import numpy as np
import sympy as sp

from canon.numeric.lower import lower
from canon.numeric.precision import double
from canon.numeric.term_table import MANY, term_table

X = sp.symbols("x y k", real=True)
x, y, k = X


def polynomials(terms: int) -> tuple[list[sp.Expr], list[list[tuple[float, int, int, int]]]]:
    draw = random.Random(3)
    rows = [
        [(draw.uniform(-2, 2), draw.randrange(13), draw.randrange(9), draw.randrange(3)) for _ in range(terms)]
        for _ in range(2)
    ]
    return [sp.Add(*(c * x**a * y**b * k**d for c, a, b, d in row)) for row in rows], rows


def test_a_table_has_the_values_of_what_was_written() -> None:
    formulas, rows = polynomials(MANY)
    formulas = [formulas[0] + sp.sin(x * y) + 1 / x + 3, formulas[1], y]
    assert term_table(formulas, X) is not None
    at = (0.7, -1.1, 0.4)
    said = [sum(c * at[0] ** a * at[1] ** b * at[2] ** d for c, a, b, d in row) for row in rows]
    said = [said[0] + np.sin(at[0] * at[1]) + 1 / at[0] + 3, said[1], at[1]]
    function = lower(tuple(formulas), X)
    assert np.allclose(function(*at, numbers=np), said, rtol=1e-13)
    many = function(np.full(3, at[0]), np.full(3, at[1]), at[2], numbers=np)
    assert all(np.allclose(row, value, rtol=1e-13) for row, value in zip(many[:2], said[:2], strict=True))
    slope = sp.lambdify(X, formulas[0].diff(x), "math")(*at)
    with double():
        assert np.allclose(function(*at)[0], said[0], rtol=1e-13)
        assert np.allclose(jax.grad(lambda z: function(z, *at[1:])[0])(at[0]), slope, rtol=1e-12)


def test_few_terms_are_written_out() -> None:
    assert term_table(polynomials(40)[0], X) is None
