from itertools import combinations

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, Transformation
from canon.mechanics.integral_invariant import (
    cartan_form,
    cartan_residuals,
    index_sets,
    invariant_residuals,
    minor_sum,
    pfaffian,
)
from canon.mechanics.poisson import standard_j

SPACE = PhaseSpace("x y", "px py", new=("X Y", "PX PY"))
(x, y), (px, py) = SPACE.q, SPACE.p
MAP = Transformation(SPACE, Q=(x, y + px), P=(px + x**2 + sp.sin(x), py))
CANONICAL = Transformation(SPACE, Q=(x + y**2, y), P=(px, py - 2 * y * px))


def test_the_pfaffian_squares_to_the_determinant(vanishes):
    a = sp.symbols("a:6", real=True)
    entries = dict(zip(combinations(range(4), 2), a, strict=True))
    matrix = [[entries.get((i, j), 0) - entries.get((j, i), 0) for j in range(4)] for i in range(4)]
    assert vanishes(pfaffian(matrix) ** 2 - sp.Matrix(matrix).det())


@pytest.mark.parametrize("order", [1, 2])
def test_minors_are_pfaffians(order, vanishes):
    jacobian = MAP.jacobian()
    form = jacobian.T * standard_j(2) * jacobian
    sign = (-1) ** (order * (order - 1) // 2)
    for columns in index_sets(2, order):
        chosen = [[form[i, j] for j in columns] for i in columns]
        assert vanishes(minor_sum(MAP, order, columns) - sign * pfaffian(chosen))


def test_all_orders_are_preserved_by_a_canonical_map(vanishes):
    assert vanishes(invariant_residuals(CANONICAL, 1))
    assert vanishes(invariant_residuals(CANONICAL, 2))


def test_volume_alone_is_less(vanishes):
    stretched = Transformation(SPACE, Q=(2 * x, y / 2), P=(px, py))
    assert not vanishes(invariant_residuals(stretched, 1))
    assert vanishes(invariant_residuals(stretched, 2))


def test_an_order_beyond_n_is_refused():
    with pytest.raises(InputError, match="between 1 and 2"):
        list(invariant_residuals(MAP, 3))


def test_the_form_of_poincare_and_cartan(vanishes):
    space = PhaseSpace("q", "p", new=("Q", "P"), real="v")
    (q, p), (Q, P), v, t = space.old, space.new, space.symbols("v"), space.t
    moving = Transformation(space, Q=q - v * t, P=p - v)
    H, K = p**2 / 2, P**2 / 2 - v**2 / 2
    assert vanishes(cartan_residuals(moving, H, K))
    assert vanishes(cartan_residuals(moving.backward(), H, K))
    assert not vanishes(cartan_residuals(moving, H, K + Q))
    assert cartan_form(moving, H, K)[1] == 0
