"""The tape: one node for equal operations, derivatives as sympy's, brackets with only what they need."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide import ladder
from canon.decide.derivative import derivative, poisson_bracket, substitute
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.domain import Domain, conditions_of
from canon.errors import InputError

x, y = sp.symbols("x y", real=True)
FUNCTIONS = [
    sp.sin(x * y) ** 3 / (1 + x**2), sp.sqrt(1 + x**2) * sp.log(2 + sp.sin(x)), sp.atan2(x, 1 + y**2), sp.asin(x / 3),
    sp.acos(x / 3) ** 2, sp.exp(-(x**2)) * sp.cosh(x), sp.tan(x), sp.atan(x / y), sp.Abs(x) ** 3,
    sp.asinh(x), sp.acosh(2 + x**2),
    sp.atanh(x / 4), sp.elliptic_f(x, sp.Rational(1, 3)), sp.elliptic_e(x / 5), sp.elliptic_k(x / 5),
    sp.LambertW(1 + x**2),
    sp.Function("V")(x * y), x ** sp.Rational(5, 3), sp.sin(x) ** x,
]  # fmt: skip


def test_equal_operations_are_one_node():
    tape = Tape()
    a, b = tape.load((x + y) ** 2), tape.load(sp.Mul(x + y, x + y, evaluate=False))
    assert a == b
    assert tape.minus(a, b) == tape.zero
    assert tape.times(tape.constant("I"), tape.constant("I")) == tape.number(-1)


@pytest.mark.parametrize("f", FUNCTIONS, ids=str)
def test_derivatives_agree_with_sympy(f: sp.Expr):
    tape = Tape()
    own = derivative(tape, tape.load(f), tape.symbol(x))
    residual = tape.minus(own, tape.load(f.diff(x).doit()))
    region = Region.of(tape, Domain(conditions_of(f)), [x, y])
    answer = ladder.vanish(tape, [residual], region, budget=Budget(20))[0]
    assert answer.status in ("proved", "supported"), answer


def test_a_wrong_derivative_is_refuted():
    tape = Tape()
    own = derivative(tape, tape.load(sp.sin(x) * y), tape.symbol(x))
    residual = tape.minus(own, tape.load(sp.cos(x) * y * sp.Rational(1001, 1000)))
    assert ladder.vanish(tape, [residual], Region((), (), ()), budget=Budget(20))[0].status == "refuted"


def test_a_bracket_takes_only_the_derivatives_that_it_needs():
    tape = Tape()
    q, p = sp.symbols("q1:5", real=True), sp.symbols("p1:5", real=True)
    f, g = tape.load(q[0] * p[1]), tape.load(sp.sin(p[0]))
    poisson_bracket(tape, f, g, [tape.symbol(s) for s in q], [tape.symbol(s) for s in p])
    assert {str(tape.symbol_at(n)) for n in tape.derivatives} == {"q1", "p1"}


def test_substitution_is_simultaneous():
    tape = Tape()
    node = tape.load(x - y)
    swapped = substitute(tape, node, {tape.symbol(x): tape.symbol(y), tape.symbol(y): tape.symbol(x)})
    assert swapped == tape.load(y - x)


def test_division_by_nothing_is_an_input_error():
    tape = Tape()
    with pytest.raises(InputError, match="denominator"):
        tape.mul([(tape.zero, -1)])
    with pytest.raises(InputError, match="denominator"):
        tape.root(tape.zero, Fraction(-1, 2))


def test_to_sympy_comes_back():
    tape = Tape()
    for f in FUNCTIONS[:7]:
        back = tape.minus(tape.load(tape.to_sympy(tape.load(f))), tape.load(f))
        region = Region.of(tape, Domain(conditions_of(f)), [x, y])
        assert ladder.vanish(tape, [back], region, budget=Budget(20))[0].status == "proved"


def test_what_long_sums_share_is_gone_from_their_difference():
    tape = Tape()
    left = [sp.sin(x) ** k / (1 + y) for k in range(1, 100)]
    a = tape.load(sp.Add(*left, y, 3))
    b = tape.load(sp.Add(*left[:-1], 2 * left[-1], sp.exp(x), 1))
    rest = tape.load(sp.Add(2, y, -left[-1], -sp.exp(x)))
    assert tape.minus(a, b) == rest
    assert tape.minus(a, a) == tape.zero
    short = tape.minus(tape.load(x + y), tape.load(x + 1))  # as it was written: forms are kept where they are small
    assert len(tape.arguments(short)) == 2
