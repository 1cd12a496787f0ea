"""tan(x + nπ + π/2) isn't tan x, though sympy 1.14 says so: beside integers tangents are read as quotients."""

import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.functions import applied
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.statements import frequency
from canon.mechanics.transformation import Transformation
from canon.substitution import QUOTIENTS, replaced

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


@pytest.mark.parametrize("function", QUOTIENTS)
def test_what_is_put_into_an_expression_of_sympys_is_no_other(function):
    over, under = QUOTIENTS[function]
    angle = (x + sp.pi * n + sp.pi / 2) * (sp.I if over in (sp.sinh, sp.cosh) else 1)
    there = sp.expand(angle.xreplace(AT))
    value = over(there) / under(there)
    for found in (replaced(function(u), {u: sp.expand(angle)}), replaced(function(angle, evaluate=False), {x: x})):
        assert abs(sp.N(found.xreplace(AT) - value)) < 1e-9
    assert replaced(function(u), {u: x}) == function(x)


def test_a_canonical_map_after_a_shift_by_whole_turns():
    space = PhaseSpace("q", "p", integer="k", new=("Q", "P"))
    (q,), (p,), (k,) = space.q, space.p, space.parameters
    shift = Transformation(space, Q=q + sp.pi * k + sp.pi / 2, P=p)
    for momentum, expected in ((p * sp.cos(q) ** 2, "proved"), (-p * sp.cos(q) ** 2, "refuted")):
        composite = Transformation(space, Q=sp.tan(q), P=momentum).after(shift)
        assert verify(composite.canonical()).status == expected


def test_a_frequency_where_an_angle_is_held_at_odd_quarter_turns():
    space = PhaseSpace("q", "p", positive="E", integer="n", real="c d").where("0 < d", "d < pi/2")
    q, p, E, n, c, d = (space.symbol(name) for name in ("q", "p", "E", "n", "c", "d"))
    H, odd = p**2 / 2 + sp.tan(c + d) ** 2 * q**2 / 2, {c: sp.pi * n + sp.pi / 2}
    for rate, expected in ((sp.cot(d), "proved"), (sp.tan(d), "refuted")):
        assert verify(frequency(space, H, q, E, rate / (2 * sp.pi), fixed=odd)).status == expected
