"""Vanishing on a surface, with fractions as coefficients."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide import ladder
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.domain import Domain

x, y = sp.symbols("x y", real=True)


@pytest.mark.parametrize("factor", [sp.Rational(1, 3), 7, sp.Rational(1001, 1000) * x])
@pytest.mark.parametrize("equation", [x**2 - y**2, x * y - sp.Rational(2, 3)])
def test_a_multiple_of_the_equation_vanishes_on_it(factor, equation):
    tape = Tape()
    node = tape.load(sp.sin(x) + factor * equation - sp.sin(x) * (sp.sin(y) ** 2 + sp.cos(y) ** 2))
    region = Region.of(tape, Domain((), (equation,)), [x, y])
    (answer,) = ladder.vanish(tape, [node], region, budget=Budget(20))
    assert answer.status == "proved"


RELATED = [
    ("x - y", "V(x)", "V(y)", "proved"),
    ("x**2 - y**2", "V(x**2)", "V(y**2)", "proved"),
    ("x**2 - y**2", "V(x)", "V(y)", "refuted"),
    ("x**2 + y**2 - 1", "V(x**2 + y**2)", "V(1)", "proved"),
    ("x**2 + y**2 - 1", "V(x**2 + y**2)", "V(2)", "refuted"),
    ("x - y", "V(x)*V(y)", "V(x)**2", "proved"),
    ("x + y", "V(x)*V(y)", "V(x)**2", "refuted"),
    ("x - y**2", "log(x)", "2*log(abs(y))", "proved"),
    ("x - y**2", "log(x)", "2*log(y) + 1e-12", "refuted"),
    ("x + y - pi/2", "sin(x)", "cos(y)", "proved"),
    ("x + y", "exp(x)*exp(y)", "1", "proved"),
    ("x - y", "atan(x) + atan(1/y)", "pi/2*sign(x)", "proved"),
    ("x - y", "atan(x) + atan(1/y)", "pi/2", "refuted"),
    ("2*x - y - 1", "sin(2*x - 1)", "sin(y)", "proved"),
]


@pytest.mark.parametrize(("on", "left", "right", "expected"), RELATED)
def test_functions_whose_arguments_the_surface_relates(on, left, right, expected):
    text = f'''[phase_space]\nq = ["x"]\np = ["y"]\n[symbols]\nV = "function"\n[domain]\non = ["{on}"]
[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'''
    (claim,) = read_text(text).claims
    assert verify(claim).status == expected
