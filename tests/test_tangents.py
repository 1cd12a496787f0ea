"""tan(x + nπ + π/2) isn't tan x, though sympy 1.14 says so: beside integers tangents are read as quotients."""

import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.functions import QUOTIENTS, applied

x, u = sp.symbols("x u", real=True)
n, m = sp.symbols("n m", integer=True)
TURNS = [n, -n, 2 * n, 3 * n, n * m, n**2]
RESTS = [sp.Rational(k, 12) for k in (-9, -6, -3, 3, 4, 6, 8, 14, 18)]
AT = {x: sp.Rational(3, 8), n: sp.Integer(3), m: sp.Integer(2)}


@pytest.mark.parametrize("function", QUOTIENTS)
@pytest.mark.parametrize("shift", [sp.S.Zero, x, -x, 2 * x])
def test_whole_turns_and_a_part_are_added_to_an_angle(function, shift):
    over, under = QUOTIENTS[function]
    imaginary = sp.I if over in (sp.sinh, sp.cosh) else 1
    for whole in TURNS:
        for rest in RESTS:
            angle = sp.expand((shift + (whole + rest) * sp.pi) * imaginary)
            there = sp.expand(angle.xreplace(AT))
            if under(there) == 0:
                continue
            value = over(there) / under(there)
            written = applied(function, [angle], is_complex=False, beside_integers=True)
            put_in = applied(function, [u], is_complex=False, beside_integers=True).xreplace({u: angle})
            for found in (written, put_in):
                assert abs(sp.N(found.xreplace(AT) - value)) < 1e-9, angle


def test_without_integers_a_tangent_stays_one():
    assert applied(sp.tan, [x], is_complex=False) == sp.tan(x)
    assert applied(sp.tan, [sp.pi / 4], is_complex=False, beside_integers=True) == 1


CLAIMS = [
    ("tan(x + n*pi + pi/2)", "tan(x)", "refuted"),
    ("tan(x + n*pi + pi/2)", "-cot(x)", "proved"),
    ("tan(x - pi/2 + n*pi)", "tan(x - pi/2)", "proved"),
    ("atan(tan(x - pi/4 + 3*n*pi))", "atan(tan(x - pi/4))", "proved"),
    ("tan(n*pi - pi/4)", "-1", "proved"),
    ("tan(n*pi - pi/4)", "1", "refuted"),
    ("sec(x + n*pi + pi/2)**2", "csc(x)**2", "proved"),
    ("cot(x + n*pi + pi/2)", "-tan(x)", "proved"),
]


@pytest.mark.parametrize(("left", "right", "expected"), CLAIMS)
def test_claims_of_whole_turns(left: str, right: str, expected: str):
    text = f'''[phase_space]\nq = ["x"]\np = ["y"]\n[symbols]\nn = "integer"
[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'''
    assert verify(read_text(text).claims[0]).status == expected


MAPPED = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["x"]
P = ["y"]
[symbols]
n = "integer"
[transformation]
q = ["x + n*pi + pi/2"]
p = ["y"]
[[claim]]
kind = "identity"
lhs = "tan(q)"
rhs = "tan(x)"
[[claim]]
kind = "identity"
lhs = "cot(q + pi/2)"
rhs = "-tan(x + pi/2)"
"""


def test_what_a_map_puts_in_is_no_other():
    false, true = (verify(claim).status for claim in read_text(MAPPED).claims)
    assert false == "refuted"
    assert true != "refuted"
