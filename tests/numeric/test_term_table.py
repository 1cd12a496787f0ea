"""Long polynomials: their table has the values that their formulas have, in numpy, in jax and under its derivatives."""

import random

import jax
import numpy as np
import pytest
import sympy as sp

from canon.numeric import term_table
from canon.numeric.lower import lower
from canon.numeric.precision import double

X = sp.symbols("x y k", real=True)
x, y, k = X
AT = (0.7, -1.1, 0.4)
Row = list[tuple[float, int, int, int]]


def polynomials(terms: int) -> tuple[list[sp.Expr], list[Row]]:
    draw = random.Random(3)
    rows = [
        [(draw.uniform(-2, 2), draw.randrange(1, 30), draw.randrange(20), draw.randrange(5)) for _ in range(terms)]
        for _ in range(2)
    ]
    return [sp.Add(*(c * x**a * y**b * k**d for c, a, b, d in row)) for row in rows], rows


def total(row: Row) -> float:
    return sum(c * AT[0] ** a * AT[1] ** b * AT[2] ** d for c, a, b, d in row)


def test_a_table_has_the_values_of_what_was_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(term_table, "MANY", 80)
    formulas, rows = polynomials(50)
    assert term_table.term_table([formulas[0]], X) is None
    formulas = [formulas[0] + sp.sin(x * y) + 1 / x + 3, formulas[1], y]
    assert term_table.term_table(formulas, X) is not None
    said = [total(rows[0]) + np.sin(AT[0] * AT[1]) + 1 / AT[0] + 3, total(rows[1]), AT[1]]
    function = lower(tuple(formulas), X)
    assert np.allclose(function(*AT, numbers=np), said, rtol=1e-13)
    many = function(np.full(3, AT[0]), np.full(3, AT[1]), AT[2], numbers=np)
    assert all(np.allclose(row, value, rtol=1e-13) for row, value in zip(many[:2], said[:2], strict=True))
    slope = total([(a * c / AT[0], a, b, d) for c, a, b, d in rows[1]])
    with double():
        assert np.allclose(function(*AT)[1], said[1], rtol=1e-13)
        assert np.allclose(jax.grad(lambda z: function(z, *AT[1:])[1])(AT[0]), slope, rtol=1e-12)
