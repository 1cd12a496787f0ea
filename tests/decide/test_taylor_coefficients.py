"""Taylor's coefficients at wide balls enclose those at each of their points, and stay finite."""

import random
from collections.abc import Callable
from fractions import Fraction

import pytest
from flint import arb, ctx

from canon.decide.taylor_coefficients import TAYLOR, Unenclosed, binomial

Rule = Callable[[arb, int], list[arb]]
DEGREE = 9

# a function, and a range in which it is smooth
CASES: list[tuple[str, Rule, float, float]] = [
    *((name, TAYLOR[name], low, high) for name, low, high in [
        ("atan", -3, 3), ("log", 0.05, 4), ("log1p", -0.9, 3), ("sin", -2, 2), ("exp", -2, 2), ("tanh", -1, 1),
        ("asin", -0.8, 0.8), ("acosh", 1.1, 3), ("atanh", -0.8, 0.8),
    ]),
    *((f"x**({s})", lambda x, degree, s=s: binomial(x, s, degree), 0.05, 4) for s in [
        Fraction(-1), Fraction(1, 2), Fraction(-7, 3), Fraction(3),
    ]),
    ("x**(-2), x < 0", lambda x, degree: binomial(x, Fraction(-2), degree), -4, -0.05),
]  # fmt: skip


@pytest.mark.parametrize(("name", "rule", "low", "high"), CASES, ids=[case[0] for case in CASES])
def test_the_coefficients_at_a_ball_enclose_those_at_its_points(name: str, rule: Rule, low: float, high: float) -> None:
    rng = random.Random(name)
    before, ctx.prec = ctx.prec, 128
    try:
        for _ in range(20):
            a, b = sorted(rng.uniform(low, high) for _ in range(2))
            if rng.random() < 0.5:
                b = a + (b - a) / 50
            over = rule(arb(a).union(arb(b)), DEGREE)
            for x in (a, b, (a + b) / 2, rng.uniform(a, b)):
                assert all(wide.overlaps(fine) for wide, fine in zip(over, rule(arb(x), DEGREE), strict=True))
    finally:
        ctx.prec = before


@pytest.mark.parametrize("exponent", [Fraction(-1), Fraction(1, 2), Fraction(-5, 3)])
def test_powers_of_a_wide_ball_stay_finite_and_of_one_with_zero_are_refused(exponent: Fraction) -> None:
    """(1 ± 0.1)⁹ by multiplication of balls would contain 0, and what is divided by it would be infinite."""
    assert all(c.is_finite() for c in binomial(arb(1, 0.9), exponent, DEGREE))
    assert not any(c.contains(0) for c in binomial(arb(1, 0.1), exponent, DEGREE))
    with pytest.raises(Unenclosed):
        binomial(arb(1, 1.1), exponent, DEGREE)


def test_coefficients_of_the_arctangent() -> None:
    """1 − x² + x⁴ − … integrated at 0; and at 1 the derivatives π/4, 1/2, −1/4, 1/12, 0, −1/40."""
    at_zero, at_one = (TAYLOR["atan"](arb(x), 5) for x in (0, 1))
    for found, expected in (
        (at_zero, [0, 1, 0, Fraction(-1, 3), 0, Fraction(1, 5)]),
        (at_one[1:], [Fraction(1, 2), Fraction(-1, 4), Fraction(1, 12), 0, Fraction(-1, 40)]),
    ):
        for ball, value in zip(found, expected, strict=True):
            assert ball.overlaps(arb(Fraction(value).numerator) / Fraction(value).denominator)
            assert float(ball.rad()) < 1e-14
