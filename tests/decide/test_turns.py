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
    ],
)
def test_turns(where, lhs, rhs, expected):
    claim = f'[[claim]]\nkind = "identity"\nlhs = "{lhs}"\nrhs = "{rhs}"\n'
    (asked,) = read_text(FILE.format(where=where) + claim).claims
    assert verify(asked).status == expected
