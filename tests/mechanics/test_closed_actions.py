"""Actions in closed form against quadrature of the same integrand, with another program and other digits."""

import mpmath
import pytest
import sympy as sp

from canon.domain import Condition
from canon.errors import InputError
from canon.mechanics.action_angle import NotQuadratic, coordinate_range, one_degree
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.residues import by_residues
from canon.mechanics.standard_actions import cosine, pendulum_like, power_well, rotation

m, w, a, b, L, D, k = sp.symbols("m w a b L D k", positive=True)
E, q, p = sp.symbols("E q p", real=True)
r = sp.Symbol("r", positive=True)
VALUES = {m: sp.Rational(7, 5), w: sp.Rational(3, 2), a: 2, b: sp.Rational(1, 2), L: sp.Rational(1, 3), D: 3, k: 1}
WAYS = (by_residues, pendulum_like, power_well, quartic_wells)
CENTRAL = (p**2 + L**2 / r**2) / 2


def _step_inside(edge, step, ends):
    low, high = ends
    if edge + step <= low:
        return (low - edge) / 2
    return (high - edge) / 2 if edge + step >= high else step


def _within(low, high):
    return tuple(Condition("positive", (e,)) for e in (q - low, high - q))


@pytest.mark.parametrize(
    ("H", "x", "conditions", "energy", "near"),
    [
        (p**2 / (2 * m) + m * w**2 * q**2 / 2, q, (), 1, 0),
        (p**2 / (2 * m) + D * (1 - sp.exp(-a * q)) ** 2, q, (), 2, 0),
        (p**2 / (2 * m) - D / sp.cosh(a * q) ** 2, q, (), -1, 0),
        (p**2 / (2 * m) + D * sp.tan(a * q) ** 2, q, _within(-sp.pi / (2 * a), sp.pi / (2 * a)), 2, 0),
        (p**2 / 2 + k / sp.sin(q) ** 2 + D / sp.cos(q) ** 2, q, _within(0, sp.pi / 2), 9, 0.7),
        (CENTRAL - k / r, r, (), sp.Rational(-1, 2), 0.5),
        (CENTRAL + w**2 * r**2 / 2, r, (), 2, 0.5),
        (CENTRAL - k / (b + sp.sqrt(b**2 + r**2)), r, (), sp.Rational(-1, 5), 0.7),
        (CENTRAL - k / r + b / r**2, r, (), sp.Rational(-1, 10), 2),
        ((p - a * q) ** 2 / (2 * m) + w * q**2 / 2 + q, q, (), 3, 0),
        (p**2 + L**2 / sp.sin(q) ** 2, q, _within(0, sp.pi), 2, 1.5),
        (p**2 / 2 - k * sp.cos(q), q, (), sp.Rational(1, 2), 0),
        (p**2 / 2 + k * sp.cos(2 * q), q, (), 0, 1.5),
        (p**2 / 2 + D * sp.sin(q / 2) ** 2, q, (), 1, 0),
        (p**2 / 2 + k * q**6, q, (), 2, 0),
        (p**2 / 2 + k * q**2 + D * q**4, q, (), 2, 0),
        (p**2 / 2 + k * q**2 - a * q**4 / 100, q, (), 2, 0),
        (p**2 / 2 - D * r**2 + k * r**4, r, (), sp.Rational(-3, 2), 1),
        (p**2 / (2 * m * (1 + a**2 * q**2)) + m * w * q**2, q, (), 2, 0),
        (p**2 / 2 + k * sp.Abs(q), q, (), 2, 0),
    ],
)
def test_closed_forms_are_the_integrals(H, x, conditions, energy, near):
    motion = one_degree(H, x, p, E, conditions)
    closed = next(form for way in WAYS for form in way(motion))
    at = VALUES | {E: sp.sympify(energy)}
    assert all(value.xreplace(at).evalf() > 0 for value in closed.exists)
    square = sp.lambdify(x, motion.square.xreplace(at), "mpmath")
    with mpmath.workdps(20):
        bounds = [mpmath.mpf(float(e.xreplace(at))) for e in coordinate_range(x, conditions)]
        ends = []
        for direction in (-1, 1):
            step = mpmath.mpf("0.001") * direction
            edge = mpmath.mpf(near) + (1e-9 if x is q and near == 0 else 0)
            while square(edge + step) > 0:
                edge, step = edge + step, step * mpmath.mpf("1.1")
                step = _step_inside(edge, step, bounds)
            ends.append(mpmath.findroot(square, (edge, edge + step), solver="anderson", tol=1e-25))
        middle = sum(ends) / 2
        value = 2 * mpmath.quad(lambda z: mpmath.sqrt(abs(square(z))), [ends[0], middle, ends[1]])
        assert abs(value - mpmath.mpf(sp.N(closed.value.xreplace(at), 25))) < 1e-8 * value


def test_a_rotation_and_the_separatrix():
    motion = one_degree(p**2 / (2 * m) - k * sp.cos(q), q, p, E)
    (turn,) = rotation(motion, None)
    at = VALUES | {E: 2}
    with mpmath.workdps(20):
        square = sp.lambdify(q, motion.square.xreplace(at), "mpmath")
        value = mpmath.quad(lambda z: mpmath.sqrt(square(z)), [0, mpmath.pi, 2 * mpmath.pi])
        assert abs(value - mpmath.mpf(sp.N(turn.value.xreplace(at), 25))) < 1e-15
    (three,) = rotation(motion, 6 * sp.pi)
    assert sp.simplify(three.value / turn.value) == 3
    edge = one_degree(p**2 / (2 * m) - k * sp.cos(q), q, p, k)
    ((whole,), (half,)) = pendulum_like(edge), rotation(edge, None)
    assert sp.simplify(whole.value / half.value) == 2
    with pytest.raises(InputError, match="not a period of H, whose least one is 2"):
        next(rotation(motion, sp.Integer(3)))


def test_what_is_not_recognised():
    def found(H, x=q):
        motion = one_degree(H, x, p, E)
        return [form for way in WAYS for form in way(motion)]

    assert not found(p**2 / 2 + q**4 + q**3 + q**2)
    assert not found(p**2 / 2 + q**4 - q**2)  # below the barrier there are two wells
    assert not found(p**2 / 2 + q**3)
    assert not found(p**2 / 2 + 1 / q**2 + q**2)  # a pole inside of the range: two wells
    assert not found(p**2 * (1 + q**2) / 2 + q**4)
    assert not found(CENTRAL + r**2 + 1 / r, r)
    assert cosine(sp.cos(q) + q, q) is None
    with pytest.raises(NotQuadratic, match="isn't quadratic in p"):
        one_degree(p**4 + q**2, q, p, E)


def test_the_range_of_a_coordinate():
    conditions = (*_within(-1, 3), Condition("positive", (5 - 2 * q,)), Condition("positive", (1 - q**2,)))
    assert coordinate_range(q, conditions) == (-1, sp.Rational(5, 2))
    assert coordinate_range(r, ()) == (0, sp.oo)
    assert coordinate_range(q, (Condition("positive", (sp.pi / 2 - a * q,)),)) == (-sp.oo, sp.pi / (2 * a))
