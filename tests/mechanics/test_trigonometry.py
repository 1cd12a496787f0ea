import pytest
import sympy as sp

from canon.mechanics.trigonometry import contracted

a, b, x, y = sp.symbols("a b x y", real=True)


@pytest.mark.parametrize(
    ("long", "short"),
    [
        (sp.sin(a) ** 2 + sp.cos(a) ** 2, 1),
        (1 / sp.sqrt(sp.tan(a) ** 2 + 1), sp.Abs(sp.cos(a))),
        (sp.cosh(a) ** 2 - sp.sinh(a) ** 2, 1),
        (x * sp.sin(a) ** 2 * sp.cos(b) ** 2 + x * sp.cos(a) ** 2 * sp.cos(b) ** 2, x * sp.cos(b) ** 2),
        ((x * sp.cos(a) + y * sp.sin(a)) ** 2 + (x * sp.sin(a) - y * sp.cos(a)) ** 2, x**2 + y**2),
        (x + y, x + y),
    ],
)
def test_pythagoras_shortens(long, short):
    assert contracted(long) == short


def test_what_it_cannot_shorten_it_leaves():
    left = sp.sin(sp.sin(a) ** 2) + sp.cos(2 * a)
    assert contracted(left) == left
