"""Angles counted in turns: π in an interval's slope, and below an arctangent."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

FILE = '[phase_space]\nq = ["x"]\np = ["p"]\n[symbols]\na = "positive"\n[domain]\nwhere = ["{where}"]\n'


@pytest.mark.parametrize(
    ("where", "lhs", "rhs", "expected"),
    [
        ("0 < x < 1/4", "atan2(sin(2*pi*x), cos(2*pi*x))", "2*pi*x", "proved"),
        ("0 < x < 1/4", "atan2(a*sin(2*pi*x), a*cos(2*pi*x))/(2*pi)", "x", "proved"),
        ("0 < x < 1/4", "asin(sin(2*pi*x))/pi", "2*x", "proved"),
        ("1/4 < x < 1/2", "asin(sin(2*pi*x))/pi", "2*x", "refuted"),
        ("1/4 < x < 1/2", "asin(sin(2*pi*x))/pi", "1 - 2*x", "proved"),
        ("0 < x < 1/4", "atan2(sin(2*pi*x), cos(2*pi*x))/(2*pi)", "x + 1", "refuted"),
        ("0 < x < 1/4", "sqrt(sin(2*pi*x)**2)", "sin(2*pi*x)", "proved"),
        ("1/2 < x < 1", "sqrt(sin(2*pi*x)**2)", "-sin(2*pi*x)", "proved"),
        ("0 < x < 1", "sqrt(sin(2*pi*x)**2)", "sin(2*pi*x)", "refuted"),
        ("-pi < x < pi", "atan2(a*sin(x), a*cos(x))", "x", "proved"),
        ("-pi < x < 3.15", "atan2(a*sin(x), a*cos(x))", "x", "refuted"),
        ("-pi < x < pi", "atan2(p*sin(x), p*cos(x))", "x", "refuted"),
        ("pi < x < 3*pi", "atan2(-2*sin(x), -2*cos(x))", "x - pi", "refuted"),
        ("2*pi < x < 4*pi", "atan2(-2*sin(x), -2*cos(x))", "x - 3*pi", "proved"),
        ("-pi/2 < x < pi/2", "log(tan(x/2 + pi/4))", "asinh(tan(x))", "proved"),
        ("-pi/2 < x < pi/2", "log(tan(x/2 + pi/4))", "asinh(tan(x)) + 1e-30", "refuted"),
        ("-pi/2 < x < pi/2", "elliptic_e(x, 1)", "sin(x)", "proved"),
        ("-pi/2 < x < 3", "elliptic_e(x, 1)", "sin(x)", "supported"),  # E is greater than 1 beyond π/2
        ("-pi/2 < x < pi/2", "elliptic_f(x, 1)", "asinh(tan(x))", "proved"),
        ("-pi/2 < x < pi/2", "elliptic_f(x, 1)", "asinh(tan(x)) + a*1e-30", "refuted"),
    ],
)
def test_turns(where, lhs, rhs, expected):
    claim = f'[[claim]]\nkind = "identity"\nlhs = "{lhs}"\nrhs = "{rhs}"\n'
    (asked,) = read_text(FILE.format(where=where) + claim).claims
    assert verify(asked).status == expected
