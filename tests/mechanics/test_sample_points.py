"""Points of a map: they lie in the domain, the equations hold there, and a wrong formula is seen at them."""

import pytest
import sympy as sp

from canon.domain import Domain, positive
from canon.mechanics import PhaseSpace
from canon.mechanics.map_points import agree, gives, points_of
from canon.mechanics.multiplied import counted
from canon.mechanics.right_inverse import angles_of, right_inverses
from canon.mechanics.solution_points import SAMPLES, sample_points
from canon.mechanics.transformation import Transformation

q, p, Q, P = sp.symbols("q p Q P", real=True)


def test_points_lie_where_all_conditions_hold() -> None:
    """Those of what is chosen, those of what is computed, and what is assumed of either's name."""
    r = sp.Symbol("r", positive=True)
    domain = Domain((*positive(q - 2), *positive(5 - q), *positive(r - q)), ())
    found = list(sample_points({r: q + p}, [q, p], {}, domain.conditions))
    assert len(found) == SAMPLES
    for point in found:
        assert 2 < point[q] < 5
        assert point[r] > point[q] > 0
        assert point[r] == pytest.approx(float(point[q] + point[p]))


def test_no_point_where_a_value_does_not_exist_or_does_not_suit_its_name() -> None:
    r = sp.Symbol("r", positive=True)
    assert list(sample_points({r: -(q**2)}, [q], {})) == []
    assert list(sample_points({Q: sp.sqrt(-(q**2))}, [q], {})) == []
    assert list(sample_points({Q: 1 / (q - q**1.0)}, [q], {})) == []


@pytest.mark.parametrize("backward", [False, True])
def test_a_formula_is_right_where_it_has_all_values_of_a_map(backward: bool) -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    old, new = ((Q, P), (q, p)) if backward else ((q, p), (Q, P))
    sides = {new[0].name: old[0] ** 3, new[1].name: old[1] / (3 * old[0] ** 2)}
    found = list(points_of(Transformation(space, **sides)))
    assert found
    for point in found:
        assert gives({new[0]: old[0] ** 3, new[1]: old[1] / (3 * old[0] ** 2)}, point)
        assert not gives({new[0]: old[0] ** 3, new[1]: old[1] / (2 * old[0] ** 2)}, point)
        assert not gives({new[0]: -(old[0] ** 3), new[1]: old[1] / (3 * old[0] ** 2)}, point)


def test_values_agree_to_nine_digits() -> None:
    assert agree(-1e6, -1e6 - 1e-4)
    assert not agree(-1e6, -1e6 - 1e-2)
    assert not agree(2.0, -2.0)
    assert agree(None, 1.0)


@pytest.mark.parametrize(
    ("equations", "unknown"),
    [
        ([2 * Q + 3 * P - q, Q - P - p], [Q, P]),
        ([Q * sp.cos(P) - q, Q * sp.sin(P) - p], [Q, P]),
        ([sp.cos(P) * 2 + sp.sin(P) - q, Q + sp.cos(P) - p], [Q, P]),
        ([Q / sp.cos(P) - q, Q * sp.tan(P) - p], [Q, P]),
    ],
)
def test_right_inverses_satisfy_the_equations(equations: list[sp.Expr], unknown: list[sp.Symbol]) -> None:
    angles = angles_of(equations, unknown)
    first = next(right_inverses([angles[0].put_in(e) for e in equations] if angles else equations, unknown, angles))
    for equation in equations:
        left = angles[0].put_in(equation) if angles else equation
        value = left.xreplace(first).subs({q: 0.7, p: 0.4})
        assert abs(sp.N(value)) < 1e-12


@pytest.mark.parametrize(
    ("formula", "terms"),
    [
        ((1 + q) ** 4, 5),
        ((q + p + Q) ** 3, 10),
        ((1 + q) * (1 + p) * (1 + Q), 8),
        ((1 + q) ** 2 * (p + Q) + 3 * q, 7),
        (1 / (q + p) ** 2, 3),
    ],
)
def test_no_more_terms_than_are_counted(formula: sp.Expr, terms: int) -> None:
    *_, (whole, most) = counted(formula)
    assert whole == formula
    assert most == terms
