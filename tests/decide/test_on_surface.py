"""Vanishing on a surface, with fractions as coefficients."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide import ladder
from canon.decide.derivative import derivative
from canon.decide.on_surface import _in_ideal, _in_radical, vanishes_on_surface
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.decide.tower import Tower
from canon.domain import Domain, positive

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
    ("3*x - y", "V(y)", "V(3*x)", "proved"),
    ("3*x - y", "V(x)", "V(3*y)", "refuted"),
    ("x**2 - y**2", "V(x**2, x*y)", "V(y**2, x*y)", "proved"),
    ("x**2 - y**2", "V(x**2, x)", "V(y**2, y)", "refuted"),
    ("x**2 - y**2", "V(x, x**2)", "V(y, y**2)", "refuted"),
]


@pytest.mark.parametrize(("on", "left", "right", "expected"), RELATED)
def test_functions_whose_arguments_the_surface_relates(on, left, right, expected):
    text = f'''[phase_space]\nq = ["x"]\np = ["y"]\n[symbols]\nV = "function"\n[domain]\non = ["{on}"]
[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'''
    (claim,) = read_text(text).claims
    assert verify(claim).status == expected


def test_what_is_too_long_to_look_at_is_in_no_ideal():
    """And what is short is looked at: 1 and x aren't in (x², xy), x is in its radical; y isn't."""
    tape = Tape()
    tower = Tower(tape, [tape.load(x * y)], budget=Budget(20))
    ring, budget = tower.ring, Budget(20)
    p, q = ring.generators[:2]
    equations = [p**2, p * q]
    assert [_in_ideal(tower, f, equations, budget) for f in (p * q * q, p, ring.one)] == [True, False, False]
    assert [_in_radical(tower, f, equations, budget) for f in (p * q * q, p, q)] == [True, True, False]
    long = sum((ring.constant(k + 1) * p**k * q for k in range(80)), ring.zero)
    assert not _in_radical(tower, p, [*equations, long], budget)
    longer = sum((ring.constant(k + 1) * p**k * q**j for k in range(30) for j in range(30)), ring.zero)
    assert not _in_ideal(tower, p**2, [*equations, longer], budget)


THIRD = sp.Rational(1, 3)
ON = [  # equations, a function, whether it vanishes there
    ((x**2 + y**2 - 1,), x**4 - y**4 + 2 * y**2 - 1, True),
    ((x**2 + y**2 - 1,), x**4 - y**4 + 2 * y**2 - sp.Rational(1001, 1000), False),
    ((x**2 - y**2, x - 1), y**2 - 1, True),
    ((x**2 - y**2, x - 1), y - 1, False),
    (((x - y) ** 2,), x - y, True),
    ((x**2 * y, x * y**2), x * y, True),
    ((x**2 * y, x * y**2), x, False),
    ((x**2 - y - 1,), sp.sqrt(1 + y) - sp.Abs(x), True),
    ((x**2 - y - 1,), sp.sqrt(1 + y) - x, False),
    ((sp.exp(x) - y,), sp.exp(2 * x) - y**2, True),
    ((sp.exp(x) - y,), sp.exp(2 * x) - y, False),
    ((x**3 - y**3,), x - y, False),
    ((sp.elliptic_k(x) - y,), 1 / x - 1 / x, True),
]


@pytest.mark.parametrize(("equations", "function", "vanishes"), ON, ids=str)
def test_what_vanishes_on_a_surface(equations, function, vanishes):
    tape = Tape()
    region = Region.of(tape, Domain((), equations), [x, y])
    found = vanishes_on_surface(tape, tape.load(function), region, Budget(20))
    assert (found is not None) == vanishes
    if found is not None:
        assert "ideal" in found["argument"]


a = sp.Symbol("a", nonnegative=True)
b = sp.Symbol("b", nonnegative=True)
n = sp.Symbol("n", integer=True, nonnegative=True)


@pytest.mark.parametrize(
    ("equation", "condition", "shown"),
    [
        (a * (x - 1), 5 - a, False),
        ((a + b) * (x - 1), 5 - a, False),
        (n * (x - 1), 5 - n, False),
        (sp.sin(a) * (x - 1), 3 - a, False),
        ((a + 1) * (x - 1), 5 - a, True),
        ((sp.exp(a) + b) * (x - 1), 5 - a, True),
        (a * (x - 1), a, True),
        (sp.sin(a) * (x - 1), a * (3 - a), False),
    ],
    ids=str,
)
def test_a_name_that_may_be_0_makes_a_piece_of_its_own(equation, condition, shown):
    """Where a(x − 1) = 0 is x = 1, or a = 0, which a name that is only said to be nonnegative may be."""
    tape = Tape()
    region = Region.of(tape, Domain(positive(condition), (equation,)), [x, a, b, n])
    assert (vanishes_on_surface(tape, tape.load(x - 1), region, Budget(20)) is not None) == shown


@pytest.mark.parametrize(
    ("equation", "function", "shown"),
    [
        (x + 1, sp.gamma(x + 2), False),
        (sp.sin(sp.pi * x), 1 / sp.gamma(-x), False),
        (x - 1, (x - 1) * sp.gamma(x**2 + 2), True),
        (x - y, sp.gamma(x) - sp.gamma(y), False),
    ],
    ids=str,
)
def test_what_stands_for_a_gamma_function_has_to_be_finite_on_the_surface(equation, function, shown):
    """Γ(x + 2) is (x + 1) Γ(x + 1): at x = −1 that is 0·∞, and Γ(1) is 1."""
    tape = Tape()
    region = Region.of(tape, Domain((), (equation,)), [x, y])
    assert (vanishes_on_surface(tape, tape.load(function), region, Budget(20)) is not None) == shown


def test_what_is_divided_by_on_the_surface_is_no_proof():
    """y·K′(x) at x = y = 0: K′ is written with x below, though the singularity is removable."""
    tape = Tape()
    slope = derivative(tape, tape.load(sp.elliptic_k(x)), tape.symbol(x))
    on = {equations: Region.of(tape, Domain((), equations), [x, y]) for equations in ((x, y), (y,), (x - 1, y))}
    found = {e: vanishes_on_surface(tape, tape.times(tape.symbol(y), slope), r, Budget(20)) for e, r in on.items()}
    assert found[(x, y)] is None
    assert found[(y,)] is None, "x may be 0 there too"
    assert found[(x - 1, y)] is None
    beside = Region.of(tape, Domain((), (x + 1, y)), [x, y])
    assert vanishes_on_surface(tape, tape.times(tape.symbol(y), slope), beside, Budget(20)) is not None
