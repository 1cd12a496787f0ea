"""Loops at a double root, and momenta that are solved for: areas, and what is no loop has none."""

from typing import Any

import mpmath
import pytest
import sympy as sp

from canon.domain import Condition
from canon.mechanics.action_angle import NotQuadratic
from canon.mechanics.separatrix_actions import separatrix
from canon.mechanics.solved_momentum import solved_momentum
from canon.mechanics.substitutions import integrands
from tests.mechanics.areas import HALF, E, allowed, c, orbit, p, q, sure

LOOPS: list[tuple[Any, Any, Any, Any, Any, Any]] = [
    # p², the range, a point inside, the ends of the loop
    ((q - 2) ** 2 * (q + 1), -sp.oo, sp.oo, None, -1, 2),
    ((q + 2) ** 2 * (1 - q), -sp.oo, sp.oo, None, -2, 1),
    (3 * (q - 1) ** 2 * (q + 1) * (q + 4), -sp.oo, sp.oo, None, -1, 1),
    ((q - 1) ** 2 * (q - 3) * (q - 4), -sp.oo, sp.oo, None, 1, 3),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 2, 1, 4),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, -1, -2, 1),
    ((q - 1) ** 2 * (4 - q) * (q + 2), 1, sp.oo, None, 1, 4),
    ((q - 1) ** 2 * (4 - q) * (q + 2), -3, 1, None, -2, 1),
    ((q - 2) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 3, 2, 4),
    (3 * (q - 2) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, 0, -2, 2),
    ((q - 1) ** 4 * (4 - q) * (q + 2), 1, sp.oo, None, 1, 4),
    ((q - 1) ** 6 * (4 - q), -sp.oo, sp.oo, None, 1, 4),
]


@pytest.mark.parametrize(("square", "low", "high", "well", "left", "right"), LOOPS)
def test_loops_at_a_double_root_give_the_area(
    square: Any, low: Any, high: Any, well: Any, left: Any, right: Any
) -> None:
    motion = orbit(square, q, low, high)
    closed = next(separatrix(motion, integrands(motion), allowed, None if well is None else sp.Integer(well)))
    assert all(sure(need) for need in closed.needs)
    with mpmath.workdps(25):
        root = sp.lambdify(q, square, "mpmath")
        half = mpmath.mpf(right - left) / 2
        f = lambda x: 2 * mpmath.sqrt(abs(root(left + x)))  # noqa: E731
        value = mpmath.quad(f, [0, half, 2 * half])
        assert abs(mpmath.mpf(sp.N(closed.value, 25)) - value) < 1e-9 * value
    for _, zero in closed.vanishes:
        assert sp.expand(zero) == 0


@pytest.mark.parametrize(
    ("square", "low", "high", "well"),
    [
        ((q - 1) ** 2 * (4 - q) * (q + 2), -sp.oo, sp.oo, None),  # two loops
        ((q - 1) ** 2 * (4 - q) * (q + 2), -3, 5, None),
        ((q - 1) ** 2 * (4 - q) * (q + 2), 1, 3, None),  # the range cuts it
        ((q - 1) ** 2 * (4 - q) * (q + 2), -1, 1, None),
        ((q - 2) ** 2 * (q + 1), 0, sp.oo, None),
        ((q - 2) ** 2 * (q + 1), -sp.oo, sp.oo, 3),  # a point outside of the loop
        ((q - 1) ** 2 * (q**2 + 1), -sp.oo, sp.oo, None),  # no other root
        ((q - 1) ** 2 * (q - 4) * (q + 2), -sp.oo, sp.oo, None),  # the double root lies in a hill
        ((q - 1) ** 2 * (q - 2) ** 2 * (4 - q), -sp.oo, sp.oo, None),  # two double roots
    ],
)
def test_loops_that_are_none(square: Any, low: Any, high: Any, well: Any) -> None:
    motion = orbit(square, q, low, high)
    assert not list(separatrix(motion, integrands(motion), allowed, None if well is None else sp.Integer(well)))


def test_no_loop_where_the_point_lies_beyond_the_other_root() -> None:
    """Right of 4, and of 1, where p² = (q − 1)²(q − 3)(q − 4) is positive, its loop is not."""
    motion = orbit((q - 1) ** 2 * (q - 3) * (q - 4))
    assert not list(separatrix(motion, integrands(motion), allowed, sp.Integer(5)))
    assert not list(separatrix(motion, integrands(motion), allowed, sp.Integer(0)))


@pytest.mark.parametrize(
    "H",
    [
        sp.sqrt(p**2 + c**2) + q**2,
        sp.cosh(p) - sp.cos(q),
        sp.exp(p**2 / 2) / 3 + q**4,
        p**4 / 4 + c * p**2 + q**2,
        2 * p**4 + q**2,
        (c * p**2 + 2 * p**2) / 3 + q,
        c * (p**2 + 1) ** sp.Rational(3, 2) + q**2,
        3 * sp.cosh(sp.sqrt(2) * p) * c + q**2,
        sp.sqrt(1 + sp.exp(p**2)) + sp.Abs(q),
    ],
)
def test_a_solved_momentum_lies_on_the_orbit(H: Any) -> None:
    """H(q, √(p²)) = E, where the guards are positive; the level stands for the energy."""
    found = solved_momentum(H, q, p, E)
    at = {q: sp.Rational(1, 3), c: sp.Rational(1, 2), E: 5}
    assert all(guard.xreplace(at) > 0 for guard in found.guards)
    square = found.motion.square.xreplace(at)
    assert square > 0
    assert abs(sp.N(H.xreplace(at).xreplace({p: sp.sqrt(square)}) - 5, 20)) < 1e-15
    assert found.of_level.xreplace({found.level: E}) == found.motion.square
    assert found.motion.mean == 0


def test_a_guard_that_fails_says_that_there_is_no_motion() -> None:
    """√(p² + 1) = E has none for E < 0, cosh p = E none for E < 1, exp(p²) = E none for E ≤ 0."""
    for H, energy in ((sp.sqrt(p**2 + 1), -2), (sp.cosh(p), HALF), (sp.exp(p**2), -1)):
        found = solved_momentum(H + 0 * q, q, p, sp.sympify(energy))
        assert any(guard <= 0 for guard in found.guards)


@pytest.mark.parametrize(
    "H", [p**3 + q, p**4 - p**2 + q**2, p**4 + p**2 * q, p**6 + p**2, p**6 + p**4 + p**2, sp.cos(p), -(p**4), c - p]
)
def test_momenta_that_are_not_solved_for(H: Any) -> None:
    """Odd in p, several branches, or none that is known to be one."""
    with pytest.raises(NotQuadratic):
        solved_momentum(H, q, p, E)


def test_the_range_of_a_solved_momentum() -> None:
    found = solved_momentum(sp.cosh(p) + q, q, p, E, [Condition("positive", (q - 1,))])
    assert (found.motion.low, found.motion.high) == (1, sp.oo)
