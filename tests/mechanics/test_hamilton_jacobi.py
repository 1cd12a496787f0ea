"""Complete integrals: the equation, Jacobi's constants, and the motion that they give, against known motions."""

from dataclasses import replace
from typing import Any

import pytest
import sympy as sp

from canon import verify
from canon.errors import InputError
from canon.mechanics.formulas import as_formula
from canon.mechanics.hamilton_jacobi import CompleteIntegral
from canon.mechanics.phase_space import PhaseSpace

SPACE = PhaseSpace("q", "p", real="alpha g", positive="m")
q, p, t = SPACE.q[0], SPACE.p[0], SPACE.t
alpha, g, m = SPACE.symbols("alpha g m")
FALL = p**2 / (2 * m) + m * g * q
AT: Any = {q: sp.Rational(1, 3), p: 2, alpha: 5, g: sp.Rational(3, 7), m: sp.Rational(6, 5), t: sp.Rational(1, 4)}


def falling(function: Any = None, energy: Any = alpha) -> CompleteIntegral:
    """W = −(2m(α − mgq))^(3/2)/(3m²g), with p > 0."""
    W = -((2 * m * (alpha - m * g * q)) ** sp.Rational(3, 2)) / (3 * m**2 * g)
    return CompleteIntegral(SPACE, FALL, W if function is None else function, alpha, energy)


def zero(expression: Any) -> bool:
    return abs(sp.N(sp.sympify(expression).xreplace(AT), 20)) < 1e-15


def test_a_fall_by_its_characteristic_function() -> None:
    made = falling()
    assert zero(made.residual())
    assert not zero(falling(made.function.expr * sp.Rational(1001, 1000)).residual())
    assert zero(made.S - made.function.expr + alpha * t)
    (momentum,) = made.momenta()
    assert zero(momentum - sp.sqrt(2 * m * (alpha - m * g * q)))
    (beta,) = made.constants_of_motion()
    assert zero(beta + momentum / (m * g) + t)  # dW/dalpha = -p/(m g)
    assert zero(made.hessian()[0, 0] - m / momentum)
    assert made.complete().kind == "hamilton_jacobi"
    assert set(made.complete().keys) == {"W", "constants", "energy"}


def test_its_orbit_falls() -> None:
    """q = α/mg − g(β + t)²/2, p = −mg(β + t): β is minus the time at which p is 0."""
    orbit = falling().orbit("beta")
    beta = orbit.space.Q[0]
    there = AT | {beta: -4}
    for found, wanted in zip(
        orbit.expressions, (alpha / (m * g) - g * (beta + t) ** 2 / 2, -m * g * (beta + t)), strict=True
    ):
        assert abs(sp.N((found - wanted).xreplace(there), 20)) < 1e-15


def test_a_principal_function_has_the_time_in_it() -> None:
    """A free particle: S = αq − α²t/2m, and m(q − q₀)²/2t."""
    free = p**2 / (2 * m)
    for S in (alpha * q - alpha**2 * t / (2 * m), m * (q - alpha) ** 2 / (2 * t)):
        made = CompleteIntegral(SPACE, free, S, alpha)
        assert zero(made.residual())
        assert made.S == S
        assert made.energy is None
        assert set(made.complete().keys) == {"S", "constants"}
        assert not zero(made.hessian().det())
    F = CompleteIntegral(SPACE, free, alpha * q - alpha**2 * t / (2 * m), alpha).generating_function("beta")
    assert [str(x) for x in F.space.new] == ["beta", "alpha"]
    forward = F.transformation().forward()
    beta = forward.Q[0].expr
    assert zero(beta - (q - p * t / m))
    assert zero(forward.P[0].expr - p)


@pytest.mark.parametrize(
    ("function", "constants", "energy", "message"),
    [
        (alpha * q, (alpha, g), None, "1 constants are expected"),
        (alpha * q, (), None, "1 constants are expected"),
        (p * q, alpha, None, "not of p"),
        (alpha * q * t, alpha, alpha, "not of t"),
        # of p²/2 = αq this W was proved, and S = W − αqt is no solution
        ((2 * alpha * q) ** sp.Rational(3, 2) / (3 * alpha), alpha, alpha * q, "energy: .* not of q"),
        (alpha * q, alpha, alpha * t, "energy: .* not of t"),
        (alpha * q, alpha, p**2 / 2, "energy: .* not of p"),
    ],
)
def test_what_is_out_of_place(function: Any, constants: Any, energy: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        CompleteIntegral(SPACE, FALL, function, constants, energy)


def test_a_claim_whose_energy_moves() -> None:
    made = CompleteIntegral(SPACE, p**2 / 2, alpha * q, alpha, alpha**2 / 2).complete()
    assert verify(made).status == "proved"
    moving = replace(made, keys={**made.keys, "energy": as_formula(alpha * q)})
    with pytest.raises(InputError, match="key 'energy': q is out of place: this is an expression of the constants"):
        verify(moving)


def test_constants_are_counted_once_each() -> None:
    plane = PhaseSpace("x y", "a b", real="c1 c2")
    x, y = plane.q
    c1, c2 = plane.symbols("c1 c2")
    H = (plane.p[0] ** 2 + plane.p[1] ** 2) / 2
    made = CompleteIntegral(plane, H, c1 * x + c2 * y, (c1, c2), (c1**2 + c2**2) / 2)
    assert sp.expand(made.residual()) == 0
    assert made.hessian() == sp.eye(2)
    with pytest.raises(InputError, match="2 constants are expected, each once"):
        CompleteIntegral(plane, H, c1 * x, (c1, c1))
