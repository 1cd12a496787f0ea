"""Formulas of one shape are computed together, whatever shapes there are."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon.errors import InputError
from canon.numeric.lower import lower
from canon.numeric.precision import double
from canon.numeric.rows import lower_rows

x = sp.symbols("x0:8", real=True)
t, k = sp.symbols("t k", real=True)
FORMULAS = {
    "products": [a / (i + 1) for i, a in enumerate(x)],
    "chain": [k * (x[(i + 1) % 8] - 2 * x[i] + x[i - 1]) for i in range(8)],
    "mixed": [
        x[0] ** 2,
        sp.sin(x[3] - t),
        3 * x[1] ** 2,
        sp.Integer(2),
        x[2] ** -2,
        sp.sqrt(1 + x[4] ** 2),
        x[5],
        -x[6],
    ],
    "twice the same": [x[0] * x[1], x[2] * x[2], x[3] * x[3], x[1] * x[0]],
    "numbers": [sp.Integer(0), sp.pi, sp.Rational(1, 3)],
    "reversed": [*reversed(x)],
}


@pytest.mark.parametrize("name", FORMULAS)
def test_the_values_are_those_of_the_formulas_one_by_one(name: str) -> None:
    formulas = tuple(FORMULAS[name])
    z = np.random.default_rng(1).standard_normal((8, 3))
    wanted = [np.broadcast_to(value, 3) for value in lower(formulas, (*x, t, k))(*z, 0.3, 1.7, numbers=np)]
    program = lower_rows(formulas, x, (t, k))
    assert program(z, 0.3, 1.7, numbers=np) == pytest.approx(np.array(wanted), rel=1e-14, abs=1e-15)
    with double():
        assert np.asarray(jax.jit(program)(jnp.asarray(z[:, 1]), 0.3, 1.7)) == pytest.approx(
            np.array(wanted)[:, 1], rel=1e-14, abs=1e-15
        )


def test_one_shape_is_one_program_however_many_rows_have_it() -> None:
    lengths = []
    for count in (8, 200):
        y = sp.symbols(f"y0:{count}", real=True)
        program = lower_rows([sp.sin(a) / (i + 2) for i, a in enumerate(y)], y)
        lengths.append(len(jax.make_jaxpr(program)(np.ones(count)).eqns))
    assert lengths[0] == lengths[1] <= 4


def test_a_name_without_a_value_and_a_complex_number_are_refused() -> None:
    with pytest.raises(InputError, match="no value is given for k"):
        lower_rows([k * x[0]], x)
    with pytest.raises(InputError, match="no real number"):
        lower_rows([sp.I * x[0]], x)
