"""tan(x + nπ + π/2) isn't tan x, though sympy 1.14 says so."""

import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.domain import conditions_of

x, u = sp.symbols("x u", real=True)
n, m = sp.symbols("n m", integer=True)
TURNS = [n, -n, 2 * n, 3 * n, n * m, n**2]
RESTS = [sp.Rational(k, 12) for k in (-9, -6, -3, 3, 4, 6, 8, 14, 18)]
AT = {x: sp.Rational(3, 8), n: sp.Integer(3), m: sp.Integer(2)}


@pytest.mark.parametrize("shift", [sp.S.Zero, x, -x, 2 * x])
def test_whole_turns_and_a_part_are_added_to_an_angle(shift):
    assert conditions_of(x) == ()
    for whole in TURNS:
        for rest in RESTS:
            angle = shift + (whole + rest) * sp.pi
            expanded = sp.expand(angle)
            there = sp.expand(angle.xreplace(AT))
            value = sp.sin(there) / sp.cos(there)
            for tangent in (sp.tan(expanded), sp.tan(u).xreplace({u: expanded}), -sp.tan(-expanded)):
                if sp.cos(there) != 0:
                    assert abs(sp.N(tangent.xreplace(AT) - value)) < 1e-9, expanded


def test_what_sympy_gets_right_it_still_does():
    assert sp.tan(x + sp.pi / 2) == -sp.cot(x)
    assert sp.tan(x + 3 * sp.pi) == sp.tan(x)
    assert sp.tan(sp.pi * n) == 0
    assert sp.tan(sp.pi * x + sp.pi) == sp.tan(sp.pi * x)


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
